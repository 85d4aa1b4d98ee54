"""Build the formulas of a worked solution as trees, and set them in LaTeX or MathML.

Its parts, in reading order:

- Formulas of a worked solution as trees, whose leaves hold the digits that are printed.
- Formulas set in LaTeX or in MathML, in symbols or with numbers: one traversal, two notations.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from html import escape
from typing import Literal, NamedTuple
from unicodedata import normalize

from linkanim.frozen import frozen
from linkanim.letters import spelt_out

# Formulas of a worked solution as trees, whose leaves hold the digits that are printed.
#
# A leaf is a symbol with its number in shown digits, or a number alone: a reader who puts the digits in gets
# what the tree evaluates to. Angles are in degrees. A term of exactly 0 and a factor of exactly 1 are left
# out as a formula is put together.


class Symbol(NamedTuple):
    """A letter with its index `sub`; `mark` is a dot or two over it, or a prime or two behind it."""

    letter: str
    sub: str = ""
    mark: Literal["", "˙", "¨", "′", "″"] = ""
    bold: bool = False


Operation = Literal[
    "leaf", "+", "-", "·", "/", "neg", "sqrt", "square", "cos", "sin", "atan2", "arccos", "arcsin"
]  # fmt: skip


@frozen
class Formula:
    """A formula: an operation on others, or a leaf with its `shown` digits, and a symbol if it has one.

    A leaf that is `in_degrees` is printed with a degree sign.
    """

    operation: Operation
    parts: tuple[Formula, ...] = ()
    symbol: Symbol | None = None
    shown: str = ""
    in_degrees: bool = False

    @property
    def constant(self) -> float | None:
        """The value of a number without a symbol; None for anything else."""
        return float(self.shown) if self.operation == "leaf" and self.symbol is None else None

    @property
    def value(self) -> float:
        """What the shown digits evaluate to; ValueError or ZeroDivisionError where they have no value."""
        if self.operation == "leaf":
            return float(self.shown)
        return _VALUES[self.operation](*(part.value for part in self.parts))

    @property
    def symbolic(self) -> bool:
        """Whether the formula has any symbol."""
        return self.symbol is not None or any(part.symbolic for part in self.parts)

    @property
    def leaves(self) -> Iterator[Formula]:
        """The leaves with a symbol, from left to right."""
        if self.symbol is not None:
            yield self
        for part in self.parts:
            yield from part.leaves

    def __add__(self, other: Formula) -> Formula:
        if self.constant == 0:
            return other
        if other.constant == 0:
            return self
        match other.operation:
            case "neg":
                return self - other.parts[0]
            case "+":
                return (self + other.parts[0]) + other.parts[1]
            case "-":
                return (self + other.parts[0]) - other.parts[1]
        return Formula("+", (self, other))

    def __sub__(self, other: Formula) -> Formula:
        if other.constant == 0:
            return self
        if self.constant == 0:
            return -other
        if other.operation == "neg":
            return self + other.parts[0]
        return Formula("-", (self, other))

    def __mul__(self, other: Formula) -> Formula:
        for one, rest in ((self, other), (other, self)):
            if one.constant == 0:
                return ZERO
            if one.constant in (1.0, -1.0):
                return rest if one.constant == 1 else -rest
            if one.operation == "neg":
                return -(one.parts[0] * rest) if one is self else -(rest * one.parts[0])
        return Formula("·", (self, other))

    def __truediv__(self, other: Formula) -> Formula:
        if self.constant == 0:
            return ZERO
        if other.constant == 1:
            return self
        return Formula("/", (self, other))

    def __neg__(self) -> Formula:
        if self.constant == 0:
            return self
        if self.constant is not None:
            return number(f"-{self.shown}".removeprefix("--"), self.in_degrees)
        return self.parts[0] if self.operation == "neg" else Formula("neg", (self,))


_VALUES: Mapping[str, Callable[..., float]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "·": lambda a, b: a * b,
    "/": lambda a, b: a / b,
    "neg": lambda a: -a,
    "sqrt": math.sqrt,
    "square": lambda a: a * a,
    "cos": lambda a: math.cos(math.radians(a)),
    "sin": lambda a: math.sin(math.radians(a)),
    "atan2": lambda y, x: math.degrees(math.atan2(y, x)),
    "arccos": lambda a: math.degrees(math.acos(a)),
    "arcsin": lambda a: math.degrees(math.asin(a)),
}


def number(shown: str, in_degrees: bool = False) -> Formula:
    """Return a number without a symbol, in the digits given."""
    return Formula("leaf", shown=shown, in_degrees=in_degrees)


ZERO, ONE, TWO = number("0"), number("1"), number("2")


def sqrt(e: Formula) -> Formula:
    """Return the square root."""
    return Formula("sqrt", (e,))


def square(e: Formula) -> Formula:
    """Return the square, which has no sign in it; of 0 and ±1 the number alone."""
    e = e.parts[0] if e.operation == "neg" else e
    return number(str(int(e.constant) ** 2)) if e.constant in (0.0, 1.0, -1.0) else Formula("square", (e,))


def cos(e: Formula) -> Formula:
    """Return the cosine of an angle in degrees; 0, 1 or -1 as a number for a multiple of 90."""
    return _turned("cos", e, ("1", "0", "-1", "0"))


def sin(e: Formula) -> Formula:
    """Return the sine of an angle in degrees; 0, 1 or -1 as a number for a multiple of 90."""
    return _turned("sin", e, ("0", "1", "0", "-1"))


def _turned(operation: Literal["cos", "sin"], e: Formula, quarters: tuple[str, ...]) -> Formula:
    if e.constant is not None and e.constant % 90 == 0:
        return number(quarters[int(e.constant // 90) % 4])
    return Formula(operation, (e,))


def atan2(y: Formula, x: Formula) -> Formula:
    """Return the angle of a vector from its components, in degrees from -180 to 180."""
    return Formula("atan2", (y, x))


def arccos(e: Formula) -> Formula:
    """Return the angle from 0 to 180 degrees that has this cosine."""
    return Formula("arccos", (e,))


def arcsin(e: Formula) -> Formula:
    """Return the angle from -90 to 90 degrees that has this sine."""
    return number("0", in_degrees=True) if e.constant == 0 else Formula("arcsin", (e,))


class Components(NamedTuple):
    """A vector by its components."""

    x: Formula
    y: Formula

    def __add__(self, other: Components) -> Components:  # type: ignore[override]
        return Components(self.x + other.x, self.y + other.y)

    def __sub__(self, other: Components) -> Components:
        return Components(self.x - other.x, self.y - other.y)

    def __neg__(self) -> Components:
        return Components(-self.x, -self.y)

    @property
    def value(self) -> complex:
        """What the shown digits evaluate to, as x + yi."""
        return complex(self.x.value, self.y.value)

    def times(self, factor: Formula) -> Components:
        """Return the vector times a factor, which is written first."""
        return Components(factor * self.x, factor * self.y)

    def left(self) -> Components:
        """Return the vector turned by a right angle, anticlockwise."""
        return Components(-self.y, self.x)


def dot(one: Components, other: Components) -> Formula:
    """Return the scalar product."""
    return one.x * other.x + one.y * other.y


NOWHERE = Components(ZERO, ZERO)


def along(angle: Formula) -> Components:
    """Return the unit vector at an angle in degrees."""
    return Components(cos(angle), sin(angle))


# Formulas set in LaTeX or in MathML, in symbols or with numbers: one traversal, two notations.

_GREEK = {
    "α": "alpha", "β": "beta", "γ": "gamma", "δ": "delta", "θ": "theta", "ω": "omega", "φ": "varphi",
    "ψ": "psi", "ξ": "xi", "η": "eta", "μ": "mu", "σ": "sigma", "π": "pi", "ℓ": "ell", "→": "rightarrow",
    "λ": "lambda",
}  # fmt: skip
_OUT_OF_LATEX = re.compile("[^\0-\u017f]|[ĦħĸĿŀŉŦŧſ]")
_INDEX = re.compile(r"([^\W\d_]+|\W+|[^\W0-9])|([0-9]+)")


@frozen
class Notation:
    """How formulas are put together in one language; its functions return markup."""

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


@frozen
class _Setting:
    """The printing of one formula; a minus that is not the `first` sign is put in parentheses."""

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
        """Return a part, in parentheses if it is of one of these kinds, or negative and not the `first`."""
        return self.how.group(self.of(e)) if e.operation in kinds else self.of(e, first)

    def _base(self, e: Formula) -> str:
        """Return the base of a square, in parentheses unless it is a plain leaf."""
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
        """Return whether a product needs its dot: before a number, and after a function."""
        while right.operation == "·":
            right = right.parts[0]
        while left.operation == "·":
            left = left.parts[1]
        swallows = left.operation in ("cos", "sin", "atan2", "arccos", "arcsin")
        return self.numbers or right.constant is not None or swallows


def plain_latex(text: str) -> str:
    """Return words as LaTeX sets them; letters that its standard fonts lack are kept, for other engines."""
    return spelt_out(normalize("NFC", text), _is_kept).translate(_TEXT)


def _is_kept(char: str) -> bool:
    return latex_has(char) or char.isalnum()


def latex_has(char: str) -> bool:
    """Return whether LaTeX's standard fonts have a character of a text."""
    return ord(char) in _TEXT or _OUT_OF_LATEX.match(char) is None


_TEXT = str.maketrans(
    {
        **{letter: f"$\\{name}$" for letter, name in _GREEK.items()},
        **{char: f"\\{char}" for char in "#$%&_{}"},
        **{chr(0x2080 + n): f"$_{n}$" for n in range(10)},
        **{chr(0x2070 + n): f"$^{n}$" for n in (0, *range(4, 10))},
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
    """Return an index or a name in LaTeX: numbers in it are subscripts, but not those after a comma."""
    before = [",", *(word for word, _ in _INDEX.findall(text))]
    parts = [
        f"_{{{digits}}}" if digits and last != "," else digits or _letters(word)
        for last, (word, digits) in zip(before, _INDEX.findall(text), strict=False)
    ]
    return "".join(parts)


def _letters(word: str) -> str:
    if word in _GREEK:
        return f"\\{_GREEK[word]} "
    safe = re.sub(r"([#$%&_{}])", r"\\\1", re.sub(r"[\\~^]", "", normalize("NFC", word)))
    if not safe.isascii():
        # what is no letter by its number, as a stand-in would leave two names alike
        kept = (char if _is_kept(char) else f"U{ord(char):X}" for char in safe)
        return f"\\text{{{''.join(kept)}}}"
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
    parts: list[str] = []
    for n, (word, digits) in enumerate(tokens):
        if digits and n and tokens[n - 1][0] != ",":
            parts[-1] = f"<msub>{parts[-1]}<mn>{digits}</mn></msub>"
        else:
            parts.append(f"<mn>{digits}</mn>" if digits else f"<mtext>{escape(word)}</mtext>")
    return parts[0] if len(parts) == 1 else f"<mrow>{''.join(parts)}</mrow>"


def _mathml_symbol(symbol: Symbol) -> str:
    letter = ("<mi class=v>" if symbol.bold else "<mi>") + f"{symbol.letter}</mi>"
    if symbol.mark in ("˙", "¨"):
        letter = f"<mover accent=true>{letter}<mo>{symbol.mark}</mo></mover>"
    index = _mathml_index(symbol.sub) if symbol.sub else ""
    prime = f"<mo>{symbol.mark}</mo>" if symbol.mark in ("′", "″") else ""
    kind = "m" + "sub" * bool(index) + "sup" * bool(prime)
    return f"<{kind}>{letter}{index}{prime}</{kind}>" if index or prime else letter


def _mathml_number(shown: str, degrees: bool) -> str:
    minus, digits = ("<mo form=prefix>−</mo>", shown[1:]) if shown.startswith("-") else ("", shown)
    return f"{minus}<mn>{digits}{'°' if degrees else ''}</mn>"


def _mathml_unit(unit: str) -> str:
    if unit in ("", "°"):
        return unit and "<mo class=u>°</mo>"
    return f"<mtext>\u00a0{escape(unit)}</mtext>"


_THIN = "<mo rspace=.12em>{}</mo>"
_ENDS = re.compile(r"<(/?)\w[^>]*?(/?)>")


def _one(markup: str) -> str:
    """Return a formula as one element: in a row, unless it is one."""
    depth = 0
    for tag in _ENDS.finditer(markup):
        depth += -1 if tag[1] else 0 if tag[2] else 1
        if not depth:
            return markup if tag.end() == len(markup) else f"<mrow>{markup}</mrow>"
    return f"<mrow>{markup}</mrow>"


def _mathml_call(name: str, parts: Sequence[str]) -> str:
    if name == "atan2":
        parts = [f"<mo>(</mo>{'<mo>,</mo>'.join(parts)}<mo>)</mo>"]
    return f"<mi>{name}</mi>{_THIN.format(chr(0x2061))}{_one(parts[0])}"


_SIGNS = {sign: f"<mo>{sign.replace('-', '−')}</mo>" for sign in "·+-="} | {"": _THIN.format("\u2062")}

MATHML = Notation(
    symbol=_mathml_symbol,
    number=_mathml_number,
    infix=lambda sign, a, b: f"{a}{_SIGNS[sign]}{b}",
    fraction=lambda a, b: f"<mfrac>{_one(a)}{_one(b)}</mfrac>",
    root=lambda a: f"<msqrt>{a}</msqrt>",
    squared=lambda a: f"<msup>{_one(a)}<mn>2</mn></msup>",
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
