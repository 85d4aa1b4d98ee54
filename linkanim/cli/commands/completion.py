"""`linkanim completion`: a script that lets a shell complete commands, options, choices and scenes.

Everything in it is read from the parser, so that a new command or option needs no change here.
"""

from __future__ import annotations

from argparse import Action, ArgumentParser, Namespace, _SubParsersAction
from collections.abc import Callable, Iterable, Iterator, Mapping
from shlex import quote

from linkanim.cli.command_table import build
from linkanim.scenes import chapters, names


def run(options: Namespace) -> None:
    """Print the script for a shell."""
    parser = build()
    print(SHELLS[options.shell](parser, _commands(parser)), end="")


def _commands(parser: ArgumentParser) -> Mapping[str, ArgumentParser]:
    """Return the parser of each command."""
    commands: dict[str, ArgumentParser] = {}
    for action in parser._actions:
        if isinstance(action, _SubParsersAction):
            commands = dict(action.choices)
    return commands


def _options(parser: ArgumentParser) -> Iterator[Action]:
    return (action for action in parser._actions if action.option_strings)


def _option_strings(parser: ArgumentParser) -> list[str]:
    return [option for action in _options(parser) for option in action.option_strings]


def _first_words(parser: ArgumentParser) -> list[str]:
    """Return the choices of a command's words that are no options, with scenes and chapters among them."""
    words: list[str] = []
    for action in parser._actions:
        if not action.option_strings:
            words += map(str, action.choices or ())
            words += names() if action.dest == "scene" else ()
            words += chapters() if "CHAPTER" in str(action.metavar) else ()
    return words


def _bash(parser: ArgumentParser, commands: Mapping[str, ArgumentParser]) -> str:
    top = _option_strings(parser)
    cases = [
        f"        {quote(f'{name} {option}')}) words={quote(_listed(action.choices or ()))}; given=1 ;;"
        for name, command in commands.items()
        for action in _options(command)
        if action.nargs != 0
        for option in action.option_strings
    ]
    options = [
        f"            {name}) words={quote(_listed(_option_strings(command)))} ;;"
        for name, command in commands.items()
    ]
    places = [
        f"            {name}) words={quote(_listed(_first_words(command)))} ;;"
        for name, command in commands.items()
    ]
    return "\n".join(
        [
            "# linkanim completion for bash:  source <(linkanim completion bash)",
            "_linkanim() {",
            "    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} words= given=",
            '    if [ "$COMP_CWORD" -eq 1 ]; then',
            f"        words={quote(_listed([*commands, *names(), *top]))}; given=1",
            "    fi",
            '    case "${COMP_WORDS[1]} $prev" in',
            *cases,
            "    esac",
            '    if [ -z "$given" ] && [ "${cur#-}" != "$cur" ]; then',
            "        case ${COMP_WORDS[1]} in",
            *options,
            "        esac",
            '    elif [ -z "$given" ]; then',
            "        case ${COMP_WORDS[1]} in",
            *places,
            "        esac",
            "    fi",
            '    COMPREPLY=($(compgen -W "$words" -- "$cur"))',
            "}",
            "# where nothing fits, files are completed",
            "complete -o default -F _linkanim linkanim",
            "",
        ]
    )


def _zsh(parser: ArgumentParser, commands: Mapping[str, ArgumentParser]) -> str:
    head = "# linkanim completion for zsh:  source <(linkanim completion zsh)\n"
    head += "autoload -U +X bashcompinit && bashcompinit\n"
    return head + _bash(parser, commands).partition("\n")[2]


def _fish(parser: ArgumentParser, commands: Mapping[str, ArgumentParser]) -> str:
    lines = ["# linkanim completion for fish:  linkanim completion fish | source"]
    lines += [_fish_option("__fish_use_subcommand", action) for action in _options(parser)]
    lines.append(f"complete -c linkanim -n __fish_use_subcommand -a {_fish_quote(_listed(names()))}")
    about = {
        choice.dest: choice.help or ""
        for action in parser._actions
        if isinstance(action, _SubParsersAction)
        for choice in action._choices_actions
    }
    for name, command in commands.items():
        within = _fish_quote(f"__fish_seen_subcommand_from {name}")
        described = _fish_quote(about.get(name, ""))
        lines.append(f"complete -c linkanim -n __fish_use_subcommand -a {name} -d {described}")
        if words := _first_words(command):
            lines.append(f"complete -c linkanim -n {within} -a {_fish_quote(_listed(words))}")
        lines += [_fish_option(within, action) for action in _options(command)]
    return "\n".join([*lines, ""])


def _fish_option(where: str, action: Action) -> str:
    words = ["complete -c linkanim -n", where]
    for option in action.option_strings:
        words += ["-l" if option.startswith("--") else "-s", option.lstrip("-")]
    if action.nargs != 0:
        words.append("-r")
    if action.choices:
        words += ["-f -a", _fish_quote(_listed(action.choices))]
    return " ".join([*words, "-d", _fish_quote((action.help or "").replace("%%", "%"))])


def _fish_quote(text: str) -> str:
    """Return a text in fish's single quotes, in which a backslash and a quote take a backslash."""
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"


def _listed(words: Iterable[object]) -> str:
    return " ".join(str(word) for word in words if " " not in str(word))


SHELLS: Mapping[str, Callable[[ArgumentParser, Mapping[str, ArgumentParser]], str]] = {
    "bash": _bash,
    "zsh": _zsh,
    "fish": _fish,
}
"""The script for each shell, from the parser and its commands."""
