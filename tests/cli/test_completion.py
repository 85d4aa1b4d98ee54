"""Shells complete what the parser knows: each command, option, choice and scene."""

from __future__ import annotations

import subprocess

import pytest

from linkanim.cli import main
from linkanim.cli.command_table import COMMANDS, build
from linkanim.scenes import chapters, names

# The words before the cursor, the last of which is begun, and what they are completed to.
TYPED = {
    "a command": (("rec",), {"record"}),
    "a scene at once": (("pres",), {"press"}),
    "a scene of a command": (("record", "pres"), {"press"}),
    "an option": (("record", "press", "--per"), {"--periods"}),
    "a choice": (("record", "press", "--for", ""), {"slides", "beamer", "web"}),
    "a choice begun": (("draw", "press", "--theme", "da"), {"dark"}),
    "a shell": (("completion", ""), {"bash", "zsh", "fish"}),
    "a chapter": (("quiz", "slid"), {"slider-crank", "sliders"}),
    "a value that is free: files": (("chart", "press", "--data", ""), set()),
    "a command with a hyphen": (("quick-return", "--str"), {"--stroke"}),
}


@pytest.mark.parametrize(("words", "expected"), TYPED.values(), ids=TYPED)
def test_bash_completes(
    words: tuple[str, ...], expected: set[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["completion", "bash"]) == 0
    script = capsys.readouterr().out
    asked = f'COMP_CWORD={len(words)}; _linkanim; printf "%s\\n" "${{COMPREPLY[@]}}"'
    run = [*("bash", "--norc", "-c"), f'{script}\nCOMP_WORDS=(linkanim "$@")\n{asked}', "bash", *words]
    done = subprocess.run(run, capture_output=True, text=True, check=True)
    assert done.stderr == ""
    assert set(done.stdout.split()) == expected


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_every_command_option_scene_and_chapter_is_completed(
    shell: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["completion", shell]) == 0
    script = capsys.readouterr().out
    (commands,) = (action.choices for action in build()._actions if isinstance(action.choices, dict))
    options = {
        option
        for command in commands.values()
        for action in command._actions
        for option in action.option_strings
        if option.startswith("--")
    }
    written = {f"-l {option[2:]}" for option in options} if shell == "fish" else options
    wanted = {*COMMANDS, *names(), *(name for name in chapters() if " " not in name), *written}
    assert {word for word in wanted if word not in script} == set()


def test_fish_completes_a_command_and_a_scene_at_once(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["completion", "fish"]) == 0
    first = "complete -c linkanim -n __fish_use_subcommand -a "
    lines = [line for line in capsys.readouterr().out.splitlines() if line.startswith(first)]
    offered = {
        word for line in lines for word in line.removeprefix(first).partition(" -d ")[0].strip("'").split()
    }
    assert offered == {*COMMANDS, *names()}
