"""Formulas set in LaTeX or in MathML, in symbols or with the numbers put in: one walk, two notations."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from html import escape
from unicodedata import normalize

from linkanim.explain.expression import Formula, Symbol

_GREEK = {
    "α": "alpha", "β": "beta", "γ": "gamma", "δ": "delta", "θ": "theta", "ω": "omega", "φ": "varphi",
    "ψ": "psi", "ξ": "xi", "η": "eta", "μ": "mu", "σ": "sigma", "π": "pi", "ℓ": "ell", "→": "rightarrow",
}  # fmt: skip
_INDEX = re.compile(r"([^\W\d_]+|\W+|[^\W0-9])|([0-9]+)")
_NOT_SET = re.compile("[^\0-\u017f]|[ĦħĸĿŀŉŦŧſ]")
"""What LaTeX's standard fonts have no letter for."""


@dataclass(frozen=True)
class Notation:
    """How formulas are put together in one language; every function takes and gives markup."""

    symbol: Callable[[Symbol], str]
    number: Callable[[str, bool], str]
    infix: Callable[[str, str, str], str]
    fraction: Callable[[str, str], str]
    root: Callable[[str], str]
    squared: Callable[[str], str]
    call: Callable[[str, Sequence[str]], str]
    group: Callable[[str], str]
    unit: Callable[[str], str]
    matrix: Callable[[Sequence[Sequence[str]]], str]
    name: Callable[[str], str]
    blank: str


def typeset(e: Formula, how: Notation, *, numbers: bool = False) -> str:
    """Return a formula in symbols, or with the shown digits in their place."""
    return _Setting(how, numbers).of(e)


@dataclass(frozen=True)
class _Setting:
    """How a formula is set; a minus that is not the `first` sign of its formula stands in parentheses."""

    how: Notation
    numbers: bool

    def of(self, e: Formula, first: bool = True) -> str:
        how = self.how
        match e.operation:
            case "leaf":
                return self._leaf(e, first)
            case "+" | "-" | "·":
                return self._infix(e, first)
            case "neg":
                return how.infix("-", "", self._grouped(e.parts[0], "+", "-", "neg"))
            case "/":
                return how.fraction(*map(self.of, e.parts))
            case "sqrt":
                return how.root(self.of(e.parts[0]))
            case "square":
                return how.squared(self._base(e.parts[0]))
            case "atan2":
                return how.call("atan2", [self.of(part) for part in e.parts])
            case function:
                part = e.parts[0]
                text = self.of(part, first=False)
                return how.call(function, [text if part.operation == "leaf" else how.group(text)])

    def _leaf(self, e: Formula, first: bool) -> str:
        if e.symbol is not None and not self.numbers:
            return self.how.symbol(e.symbol)
        text = self.how.number(e.shown, e.in_degrees)
        return self.how.group(text) if e.shown.startswith("-") and not first else text

    def _grouped(self, e: Formula, *kinds: str, first: bool = False) -> str:
        """Return a part that is not the first, in parentheses if it is of these kinds."""
        return self.how.group(self.of(e)) if e.operation in kinds else self.of(e, first)

    def _base(self, e: Formula) -> str:
        """Return what is squared, in parentheses but for a plain leaf."""
        primed = e.symbol is not None and e.symbol.mark != "" and not self.numbers
        return self.of(e, first=False) if e.operation == "leaf" and not primed else self.how.group(self.of(e))

    def _infix(self, e: Formula, first: bool) -> str:
        left, right = e.parts
        if e.operation == "·":
            sign = "·" if self._dotted(left, right) else ""
            before = self._grouped(left, "+", "-", "neg", first=first)
            return self.how.infix(sign, before, self._grouped(right, "+", "-", "neg"))
        kinds = ("+", "-", "neg") if e.operation == "-" else ("neg",)
        return self.how.infix(e.operation, self.of(left, first), self._grouped(right, *kinds))

    def _dotted(self, left: Formula, right: Formula) -> bool:
        """Whether a product needs its dot: before a number, and behind what a function could swallow."""
        while right.operation == "·":
            right = right.parts[0]
        while left.operation == "·":
            left = left.parts[1]
        swallows = left.operation in ("cos", "sin", "atan2", "arccos")
        return self.numbers or right.constant is not None or swallows


def plain_latex(text: str) -> str:
    """Return words as LaTeX sets them; what its standard fonts have no letter for is a question mark."""
    return _NOT_SET.sub("?", normalize("NFC", text).translate(_TEXT))


_TEXT = str.maketrans(
    {
        **{letter: f"$\\{name}$" for letter, name in _GREEK.items()},
        **{char: f"\\{char}" for char in "#$%&_{}"},
        **{chr(0x2080 + n): f"$_{n}$" for n in range(10)},
        "\\": r"\textbackslash{}",
        "~": r"\textasciitilde{}",
        "^": r"\textasciicircum{}",
        "°": r"\textdegree{}",
        "–": "--",
        "—": "---",
        "−": "$-$",
        "′": "$'$",
        "²": r"$^{2}$",
        "·": r"$\cdot$",
        "’": "'",
        "ⁿ": "$^{n}$",
        "ᵗ": "$^{t}$",
        "ᶜ": "$^{c}$",
        "∞": r"$\infty$",
        "≥": r"$\geq$",
        "×": r"$\times$",
        "…": r"\dots{}",
    }
)


def _latex_index(text: str) -> str:
    """Return an index or a name: letters, each number lowered."""
    found = [
        f"_{{{digits}}}" if digits and n else digits or _letters(word)
        for n, (word, digits) in enumerate(_INDEX.findall(text))
    ]
    return "".join(found)


def _letters(word: str) -> str:
    if word in _GREEK:
        return f"\\{_GREEK[word]} "
    safe = re.sub(r"([#$%&_{}])", r"\\\1", re.sub(r"[\\~^]", "", normalize("NFC", word)))
    if not safe.isascii():
        return f"\\text{{{_NOT_SET.sub(lambda found: f'U{ord(found[0]):X}', safe)}}}"
    return safe if len(safe) == 1 else f"\\mathrm{{{safe}}}"


def _latex_symbol(symbol: Symbol) -> str:
    letter = f"\\{_GREEK[symbol.letter]}" if symbol.letter in _GREEK else symbol.letter
    if symbol.bold:
        letter = f"\\mathbf{{{letter}}}"
    letter = {"˙": f"\\dot{{{letter}}}", "¨": f"\\ddot{{{letter}}}"}.get(symbol.mark, letter)
    primes = {"′": "'", "″": "''"}.get(symbol.mark, "")
    return f"{letter}{primes}" + (f"_{{{_latex_index(symbol.sub)}}}" if symbol.sub else "")


def _latex_unit(unit: str) -> str:
    if unit in ("", "°"):
        return unit and r"^{\circ}"
    return r"\,\mathrm{" + unit.replace("²", "^{2}").replace("·", r"\,").replace(" ", r"\,") + "}"


def _latex_call(name: str, parts: Sequence[str]) -> str:
    if name == "atan2":
        return r"\operatorname{atan2}\left(" + ",\\; ".join(parts) + r"\right)"
    return f"\\{name} {parts[0]}"


LATEX = Notation(
    symbol=_latex_symbol,
    number=lambda shown, degrees: shown + (r"^{\circ}" if degrees else ""),
    infix=lambda sign, a, b: (
        f"{a} {({'·': chr(92) + 'cdot', '': chr(92) + ','}).get(sign, sign)} {b}".strip()
    ),
    fraction=lambda a, b: f"\\frac{{{a}}}{{{b}}}",
    root=lambda a: f"\\sqrt{{{a}}}",
    squared=lambda a: f"{{{a}}}^{{2}}",
    call=_latex_call,
    group=lambda a: f"\\left({a}\\right)",
    unit=_latex_unit,
    matrix=lambda rows: r"\begin{bmatrix}" + r" \\ ".join(map(" & ".join, rows)) + r"\end{bmatrix}",
    name=lambda name: f"${_latex_index(name)}$",
    blank=r"\underline{\hspace{22mm}}",
)


def _mathml_index(text: str) -> str:
    tokens = _INDEX.findall(text)
    found: list[str] = []
    for word, digits in tokens:
        if digits and found:
            found[-1] = f"<msub>{found[-1]}<mn>{digits}</mn></msub>"
        else:
            found.append(f"<mn>{digits}</mn>" if digits else f"<mi mathvariant='normal'>{escape(word)}</mi>")
    return found[0] if len(found) == 1 else f"<mrow>{''.join(found)}</mrow>"


def _mathml_symbol(symbol: Symbol) -> str:
    letter = ("<mi class='v'>" if symbol.bold else "<mi>") + f"{symbol.letter}</mi>"
    if symbol.mark in ("˙", "¨"):
        letter = f"<mover accent='true'>{letter}<mo>{symbol.mark}</mo></mover>"
    index = _mathml_index(symbol.sub) if symbol.sub else ""
    prime = f"<mo>{symbol.mark}</mo>" if symbol.mark in ("′", "″") else ""
    kind = "m" + "sub" * bool(index) + "sup" * bool(prime)
    return f"<{kind}>{letter}{index}{prime}</{kind}>" if index or prime else letter


def _mathml_number(shown: str, degrees: bool) -> str:
    minus, digits = ("<mo form='prefix'>−</mo>", shown[1:]) if shown.startswith("-") else ("", shown)
    return f"{minus}<mn>{digits}</mn>" + ("<mo class='u'>°</mo>" if degrees else "")


def _mathml_unit(unit: str) -> str:
    if unit in ("", "°"):
        return unit and "<mo class='u'>°</mo>"
    return f"<mspace width='.17em'></mspace><mtext>{escape(unit)}</mtext>"


_THIN = "<mspace width='.12em'></mspace>"


def _mathml_call(name: str, parts: Sequence[str]) -> str:
    if name == "atan2":
        parts = [f"<mo>(</mo>{'<mo>,</mo>'.join(parts)}<mo>)</mo>"]
    return f"<mrow><mi>{name}</mi><mo>&#x2061;</mo>{_THIN}<mrow>{parts[0]}</mrow></mrow>"


_SIGNS = {sign: f"<mo>{sign.replace('-', '−')}</mo>" for sign in "·+-="} | {"": f"<mo>&#x2062;</mo>{_THIN}"}

MATHML = Notation(
    symbol=_mathml_symbol,
    number=_mathml_number,
    infix=lambda sign, a, b: f"{a}{_SIGNS[sign]}{b}",
    fraction=lambda a, b: f"<mfrac><mrow>{a}</mrow><mrow>{b}</mrow></mfrac>",
    root=lambda a: f"<msqrt>{a}</msqrt>",
    squared=lambda a: f"<msup><mrow>{a}</mrow><mn>2</mn></msup>",
    call=_mathml_call,
    group=lambda a: f"<mrow><mo>(</mo>{a}<mo>)</mo></mrow>",
    unit=_mathml_unit,
    matrix=lambda rows: (
        "<mrow><mo>[</mo><mtable>"
        + "".join(f"<mtr>{''.join(f'<mtd>{cell}</mtd>' for cell in row)}</mtr>" for row in rows)
        + "</mtable><mo>]</mo></mrow>"
    ),
    name=lambda name: f"<math>{_mathml_index(name)}</math>",
    blank="<mspace class='blank' width='6em'></mspace>",
)
