"""Compile symbolic expressions into a function of floats and into passes over blocks of arrays.

`scalar` writes straight-line Python on floats, which is how one frame is solved. `Batch` writes the
same operations as numpy calls into reused buffers, a block of the array at a time, so that the
buffers stay in the cache and memory is taken for the results only.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from ctypes import addressof, c_char
from dataclasses import dataclass, field
from decimal import Decimal
from functools import lru_cache
from types import CodeType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.formulas.buffers import allocated
from linkanim.mechanics.formulas.constant import digits_of
from linkanim.mechanics.formulas.expression import WHOLE, Expr, Value
from linkanim.mechanics.formulas.precise import cosine, sine, square_root

Array = NDArray[np.float64]
Bools = NDArray[np.bool_]


BLOCK = 16384
CACHE_LINE = 64
"""Bytes."""

FORMULAS = {
    "add": "{} + {}",
    "sub": "{} - {}",
    "mul": "{} * {}",
    "div": "{} / {}",
    "neg": "-{}",
    "sqrt": "sqrt({})",
    "sin": "sin({})",
    "cos": "cos({})",
    "rint": f"(({{0}} + {WHOLE!r}) - {WHOLE!r} or {{0}} * 0.0)",
    "arctan2": "atan2({}, {})",
    "minimum": "min({}, {})",
    "maximum": "max({}, {})",
    "select": "({2} if {0} < {1} else {3})",
}
"""In floats and Decimals; only graphs that are `exact` have sines and cosines."""
_IN_PLACE = frozenset({"add", "sub", "mul", "div", "neg", "sqrt"})
"""In what a formula may stand as an argument: others are longer, or use theirs twice."""
UFUNCS: Mapping[str, Callable[..., Any]] = {
    "add": np.add,
    "sub": np.subtract,
    "mul": np.multiply,
    "div": np.divide,
    "neg": np.negative,
    "sqrt": np.sqrt,
    "rint": np.rint,
    "arctan2": np.arctan2,
    "minimum": np.minimum,
    "maximum": np.maximum,
}


def needed(outputs: Sequence[Value]) -> list[Expr]:
    """Return the nodes that the outputs depend on, arguments before their users.

    They stand as they were recorded, joint by joint: few values wait long for their use, so that what is in
    use stays in the cache.
    """
    found: dict[int, Expr] = {}
    stack: list[Expr | float | str] = list(outputs)
    while stack:
        node = stack.pop()
        if isinstance(node, Expr) and node.index not in found:
            found[node.index] = node
            stack.extend(node.args)
    return [found[index] for index in sorted(found)]


class _Constants:
    """Numbers by the names that stand for them in a program, whose text is the same with other numbers."""

    def __init__(self) -> None:
        self._names: dict[tuple[str, float], str] = {}
        self.numbers: dict[str, float] = {}

    def name(self, value: Value | str) -> str:
        """Return the name of a node or number; 0.0 and -0.0, which are equal, have two."""
        if isinstance(value, Expr):
            return _name(value)
        number = value if isinstance(value, float) else float(value)
        name = self._names.setdefault((number.hex(), number), f"k{len(self._names)}")
        self.numbers[name] = number
        return name

    @property
    def floats(self) -> dict[str, float]:
        """The numbers as plain floats: one that knows what it stands for computes many times as long."""
        return {name: float(number) for name, number in self.numbers.items()}

    def assignment(self, node: Expr) -> str:
        """Return the line that works a node out."""
        return f"{_name(node)} = {FORMULAS[node.op].format(*map(self.name, node.args))}"


def _name(value: Expr) -> str:
    return str(value.args[0]) if value.op == "input" else f"v{value.index}"


def _function(
    name: str, inputs: Iterable[str], lines: Iterable[str], names: Mapping[str, Any]
) -> Callable[..., Any]:
    """Return the function of that name, inputs and lines, which this module wrote, given what it uses."""
    source, space = "\n    ".join([f"def {name}({', '.join(inputs)}):", *lines]), dict(names)
    exec(_compiled(source, f"<linkanim {name}>"), space)
    function: Callable[..., Any] = space.pop(name)
    return function


@lru_cache(maxsize=128)
def _compiled(source: str, name: str) -> CodeType:
    """Return the code of a text; a linkage of other lengths mostly has the same."""
    return compile(source, name, "exec")


FLOAT_NAMES = {"sqrt": math.sqrt, "atan2": math.atan2}
DEEPEST = 40
"""Brackets in brackets; Python reads 200."""


def scalar(inputs: Sequence[str], outputs: Sequence[Value], layout: str) -> Callable[..., Any]:
    """Return a function of float inputs that gives the outputs in `layout`.

    `layout` is a Python expression with one `{}` for each output, which may use the inputs. Raises what
    `math` raises (ValueError, ZeroDivisionError) where the arrays would hold NaN or infinity.
    """
    constants = _Constants()
    lines, texts = _inlined(needed(outputs), outputs, constants)
    result = layout.format(
        *(texts[value.index] if isinstance(value, Expr) else constants.name(value) for value in outputs)
    )
    known = [*inputs, *(f"{name}={name}" for name in constants.numbers)]  # read faster than a global
    return _function("pose", known, [*lines, f"return {result}"], FLOAT_NAMES | constants.floats)


def _inlined(
    nodes: Sequence[Expr], outputs: Sequence[Value], constants: _Constants
) -> tuple[list[str], dict[int, str]]:
    """Return assignments to variables, and what stands for each node: a name, or in brackets its formula.

    A formula stands where it is used, if that is at one place only.
    """
    uses = Counter(value.index for value in outputs if isinstance(value, Expr))
    for node in nodes:
        times = 1 if node.op in _IN_PLACE else 2
        uses.update([argument.index for argument in node.args * times if isinstance(argument, Expr)])
    lines, texts, depths = [], dict[int, str](), dict[int, int]()
    for node in nodes:
        index = node.index
        if node.op == "input":
            texts[index], depths[index] = str(node.args[0]), 0
            continue
        depth, parts = 0, []
        for argument in node.args:
            if isinstance(argument, Expr):
                parts.append(texts[argument.index])
                depth = max(depth, depths[argument.index])
            else:
                parts.append(constants.name(argument))
        text = FORMULAS[node.op].format(*parts)
        if uses[index] == 1 and depth + 1 < DEEPEST:
            texts[index], depths[index] = f"({text})", depth + 1
        else:
            texts[index], depths[index] = f"v{index}", 0
            lines.append(f"v{index} = {text}")
    return lines, texts


DECIMAL_NAMES = {"sqrt": square_root, "sin": sine, "cos": cosine}


def decimals(inputs: Sequence[str], outputs: Sequence[Value]) -> Callable[..., tuple[Decimal, ...]]:
    """Return a function of Decimals that gives the outputs; call it in a `precise.context`."""
    constants = _Constants()
    lines = [constants.assignment(node) for node in needed(outputs) if node.op != "input"]
    result = "".join(f"{constants.name(value)}, " for value in outputs)
    digits = {name: digits_of(number) for name, number in constants.numbers.items()}
    return _function("exact", inputs, [*lines, f"return ({result})"], {**DECIMAL_NAMES, **digits})


@dataclass(frozen=True)
class Batch:
    """A compiled pass over arrays: call it with one value or array (N,) for each input."""

    arrays: tuple[str, ...]
    outputs: tuple[Value, ...]
    block: Callable[..., Any]
    prelude: Callable[..., tuple[float, ...]]
    constants: tuple[Array, ...]
    buffers: int
    spare: list[list[Array]] = field(default_factory=list, compare=False, repr=False)
    """Buffers of calls that are over; a call takes its own, so that threads do not share any."""

    def __call__(self, *values: Array | float) -> Array:
        """Return the outputs as rows (outputs, N)."""
        several = len(self.arrays)
        arrays: Sequence[Any] = values[:several]
        numbers = self._numbers(values[several:])
        count = arrays[0].shape[0]
        results = aligned_rows(len(self.outputs), count)
        size = _block_size(count)
        work = self._buffers(size)
        if count == size:
            self.block(*arrays, *numbers, *results, *work)
        else:
            for part in (slice(first, min(first + size, count)) for first in range(0, count, size)):
                inside = [row[: part.stop - part.start] for row in work]
                self.block(*(array[part] for array in arrays), *numbers, *results[:, part], *inside)
        self.spare.append(work)
        return results

    def _numbers(self, values: Sequence[Any]) -> list[Array]:
        """Return what is the same along the array, without a dimension."""
        return [*(np.array(value, np.float64) for value in self.prelude(*values)), *self.constants]

    def _buffers(self, size: int) -> list[Array]:
        """Return buffers for one call, used ones where they fit: fresh memory costs a page at a time."""
        work = self.spare.pop() if self.spare else []
        if work and len(work[0]) == size:
            return work
        return list(aligned_rows(self.buffers, size))


def aligned_rows(rows: int, count: int) -> Array:
    """Return an array (rows, count) to be filled, each row from a cache line's begin on.

    Vector units take whole cache lines; a row that begins elsewhere costs them two for each.
    """
    line = CACHE_LINE // np.dtype(np.float64).itemsize
    width = -(-count // line) * line
    memory = np.empty(rows * width + line)
    skipped = -addressof(c_char.from_buffer(memory.data)) % CACHE_LINE
    strides = (width * memory.itemsize, memory.itemsize)
    return np.ndarray((rows, count), np.float64, memory, skipped, strides)


def _block_size(count: int) -> int:
    """Return the size of equal blocks, whole cache lines of them; all where one is enough."""
    if count <= BLOCK:
        return count
    return -(-count // (-(-count // BLOCK) * CACHE_LINE)) * CACHE_LINE


def batch(inputs: Mapping[str, bool], outputs: Sequence[Value]) -> Batch:
    """Compile the outputs; `inputs` says of each name whether it is an array, those first, or uniform."""
    nodes = needed(outputs)
    fixed = [node for node in nodes if node.uniform and node.op != "input"]
    block = _Block([node for node in nodes if not node.uniform], outputs)
    arrays = tuple(name for name, array in inputs.items() if array)
    uniform = [name for name, array in inputs.items() if not array]
    used = {_name(node) for node in nodes} & set(uniform)
    numbers = [*sorted(used), *map(_name, fixed)]
    return Batch(
        arrays,
        tuple(outputs),
        block.function(arrays, numbers),
        _prelude(uniform, fixed, numbers),
        tuple(map(np.array, block.constants.numbers.values())),
        block.places.buffers,
    )


def _prelude(
    names: Sequence[str], fixed: Sequence[Expr], numbers: Sequence[str]
) -> Callable[..., tuple[float, ...]]:
    """Return the function that computes from the uniform inputs what is the same along the array."""
    constants = _Constants()
    lines = [constants.assignment(node) for node in fixed]
    result = "".join(f"{name}, " for name in numbers)
    return _function("prelude", names, [*lines, f"return ({result})"], FLOAT_NAMES | constants.floats)


class _Block:
    """The passes over one block of arrays, as text."""

    def __init__(self, nodes: Sequence[Expr], outputs: Sequence[Value]) -> None:
        self.nodes = [node for node in nodes if node.op != "input"]
        self.rows = [f"o{row}" for row in range(len(outputs))]
        self.places = allocated(self.nodes, outputs)
        self.constants = _Constants()

    def function(self, arrays: Sequence[str], uniform: Sequence[str]) -> Callable[..., Any]:
        """Return the function that runs one block, of arrays, numbers, result rows and buffers."""
        calls = list(self._calls())
        buffers = (f"b{index}" for index in range(self.places.buffers))
        names = (*arrays, *uniform, *self.constants.numbers, *self.rows, *buffers)
        return _function("block", names, calls or ["pass"], {**UFUNCS, "where": np.where})

    def _calls(self) -> Iterator[str]:
        """Yield the numpy calls in order."""
        for node in self.nodes:
            *arguments, place = [self._variable(argument) for argument in (*node.args, node)]
            if node.op == "select":
                a, b, below, otherwise = arguments
                yield f"{place}[...] = where({a} < {b}, {below}, {otherwise})"
            else:
                # By keyword costs time at every call; numpy asks it only of these two.
                target = f"out={place}" if node.op in ("minimum", "maximum") else place
                yield f"{node.op}({', '.join(arguments)}, {target})"
        for row, value in self.places.copies:
            yield f"{self.rows[row]}[...] = {self._variable(value)}"

    def _variable(self, value: Value | str) -> str:
        """Return the variable that holds the value inside the function."""
        held = self.places.held.get(value.index) if isinstance(value, Expr) else None
        # a constant is an array of no dimension: numpy would make one of a plain number at every call
        return held or self.constants.name(value)
