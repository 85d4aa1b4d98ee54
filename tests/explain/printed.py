"""Read a worked solution as it is printed, and evaluate it: LaTeX, or MathML turned into it."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import NamedTuple
from xml.etree.ElementTree import Element, fromstring

_TOKEN = re.compile(r"\\[a-zA-Z]+|\\.|\d+(?:\.\d+)?|[^\s]")
_SKIPPED = {"\\left", "\\right", "\\,", "\\;"}
_FUNCTIONS: dict[str, Callable[[float], float]] = {
    "\\cos": lambda a: math.cos(math.radians(a)),
    "\\sin": lambda a: math.sin(math.radians(a)),
    "\\arccos": lambda a: math.degrees(math.acos(a)),
    "\\arcsin": lambda a: math.degrees(math.asin(a)),
}


class Check(NamedTuple):
    """A formula with its numbers, and the value that is printed for it."""

    formula: str
    shown: str

    @property
    def holds(self) -> bool:
        """Whether the formula gives the value to its last digit."""
        decimals = len(self.shown.partition(".")[2])
        return abs(evaluated(self.formula) - float(self.shown)) <= 0.5 * 10.0**-decimals * (1 + 1e-7)


def evaluated(tex: str) -> float:
    """Return what a formula of numbers comes to; ValueError for what is none."""
    reader = _Reader([token for token in _TOKEN.findall(tex) if token not in _SKIPPED])
    value = reader.sum()
    if reader.tokens:
        raise ValueError(f"{tex}: {reader.tokens[0]} was not expected")
    return value


@dataclass
class _Reader:
    tokens: list[str] = field(default_factory=list)

    def peek(self) -> str:
        return self.tokens[0] if self.tokens else ""

    def take(self, *wanted: str) -> str:
        token = self.tokens.pop(0)
        if wanted and token not in wanted:
            raise ValueError(f"{token} where {wanted} was expected")
        return token

    def sum(self) -> float:
        sign = -1.0 if self.peek() == "-" and self.take() else 1.0
        value = sign * self.product()
        while self.peek() in ("+", "-"):
            value += (1.0 if self.take() == "+" else -1.0) * self.product()
        return value

    def product(self) -> float:
        value = self.power()
        while self.peek() == "\\cdot":
            self.take()
            value *= self.power()
        return value

    def power(self) -> float:
        value = self.atom()
        while self.peek() == "^":
            self.take()
            raised = self.take_braced()
            value = value * value if raised == "2" else value
            if raised not in ("2", "\\circ"):
                raise ValueError(f"to the power {raised}")
        return value

    def take_braced(self) -> str:
        self.take("{")
        inside = self.take()
        self.take("}")
        return inside

    def inside(self, opening: str, closing: str) -> float:
        self.take(opening)
        value = self.sum()
        self.take(closing)
        return value

    def atom(self) -> float:
        token = self.peek()
        if token == "(":
            return self.inside("(", ")")
        if token == "{":
            return self.inside("{", "}")
        self.take()
        if token in _FUNCTIONS:
            return _FUNCTIONS[token](self.power())
        if token == "\\frac":
            return self.inside("{", "}") / self.inside("{", "}")
        if token == "\\sqrt":
            return math.sqrt(self.inside("{", "}"))
        if token == "\\operatorname":
            while self.take() != "(":
                pass
            y = self.sum()
            self.take(",")
            x = self.sum()
            self.take(")")
            return math.degrees(math.atan2(y, x))
        return float(token)


_NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
_CELLS = re.compile(r"\\begin\{bmatrix\}(.*?)\\end\{bmatrix\}")


def checks_of(equations: list[list[str]]) -> Iterator[Check]:
    """Yield each formula with numbers and what is printed after it; `equations` are the sides of each."""
    before: list[str] | None = None
    for sides in equations:
        if "bmatrix" in sides[0]:
            cells = [cell for part in (_CELLS.findall(side) for side in sides) for cell in _numbers_of(part)]
            if (
                before is not None
                and not any(map(_symbols, before))
                and all(_NUMBER.fullmatch(cell) for cell in cells)
            ):
                yield from (Check(*pair) for pair in zip(before, cells, strict=True))
            before = cells
            continue
        before = None
        if len(sides) > 2 and (shown := _NUMBER.match(sides[-1])) and not _symbols(sides[-2]):
            yield Check(sides[-2], shown[0])


def _numbers_of(matrices: list[str]) -> list[str]:
    """Return the cells of the first matrix of a side: of the left the second one holds the unknowns."""
    return [cell.strip() for row in matrices[0].split("\\\\") for cell in row.split("&")]


def _symbols(tex: str) -> bool:
    plain = re.sub(r"\\(cos|sin|arccos|arcsin|operatorname\{atan2\}|left|right|frac|sqrt|cdot|circ)", "", tex)
    return re.search(r"[^\W\d_]", plain) is not None


def of_markdown(text: str) -> list[list[str]]:
    """Return the equations of a solution in Markdown, each as its sides."""
    return [line.strip("$").split(" = ") for line in text.splitlines() if line.startswith("$")]


def of_latex(text: str) -> list[list[str]]:
    """Return the equations of a solution in LaTeX: each row of an alignment goes on with the one before."""
    found: list[list[str]] = []
    for block in re.findall(r"\\begin\{align\*\}\n(.*?)\n\\end\{align\*\}", text, re.S):
        for row in block.split(" \\\\\n"):
            left, _, right = row.partition("&= ")
            if left.strip():
                found.append([left.strip()])
            found[-1] += right.split(" = ")
    return found


def of_html(text: str) -> list[list[str]]:
    """Return the equations of a page, its MathML turned into LaTeX."""
    found: list[list[str]] = []
    for math_element in re.findall(r"<math display=block>.*?</math>", text, re.S):
        # a page needs no quotes about a word, XML does
        for row in fromstring(re.sub(r"=([\w.]+)(?=[ >])", r"='\1'", math_element))[0]:
            left, right = ("".join(map(_tex, cell)) for cell in row)
            if left:
                found.append([left])
            found[-1] += right.removeprefix("=").split("=")
    return found


_SIGNS = {"−": "-", "·": "\\cdot ", "\u2061": " ", "\u2062": "\\,", "°": "^{\\circ}", "[": "", "]": ""}


def _tex(e: Element) -> str:
    """Return an element of MathML as the LaTeX that means the same."""
    inside, text = [_tex(part) for part in e], (e.text or "").strip()
    match e.tag:
        case "mfrac":
            return f"\\frac{{{inside[0]}}}{{{inside[1]}}}"
        case "msqrt":
            return f"\\sqrt{{{''.join(inside)}}}"
        case "msup":
            return f"{{{inside[0]}}}^{{{inside[1]}}}"
        case "mtable":
            return "\\begin{bmatrix}" + "\\\\".join(inside) + "\\end{bmatrix}"
        case "mspace":
            return "\\,"
        case "mtr":
            return "&".join(inside)
        case "mi" if text == "atan2":
            return "\\operatorname{atan2}"
        case "mi" if text in ("cos", "sin", "arccos", "arcsin"):
            return f"\\{text} "
        case "mn":
            return text.replace("°", "^{\\circ}")
        case "mtext" if (e.text or "").startswith("\u00a0"):
            return f"\\,{text}"
        case "mo":
            return _SIGNS.get(text, text)
    return text + "".join(inside)
