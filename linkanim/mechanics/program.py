"""Compile symbolic expressions into a function of floats and into passes over blocks of arrays.

Its parts, in reading order:

- Where the values of a block are held while its passes run: in result rows, and in buffers beside them.
- Compile symbolic expressions into a function of floats and into passes over blocks of arrays.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence, Set
from contextlib import suppress
from dataclasses import field
from decimal import Decimal
from functools import cached_property, lru_cache
from struct import pack
from types import CodeType, FunctionType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkanim.frozen import frozen
from linkanim.mechanics.arithmetic import WHOLE, Expr, LookUp, Value, digits_of
from linkanim.mechanics.machine_code import (
    LANES,
    MachineCode,
    Operation,
    ProgramInputs,
    compiled,
    place,
    variable,
)
from linkanim.mechanics.precise import cosine, sine, square_root

# Where the values of a block are held while its passes run: in result rows, and in buffers beside them.
#
# A pass costs what it fetches and stores. So values that are in use at the same time have to fit in the
# cache, and a result is written over one of its arguments wherever that is not needed any more.


Copies = tuple[tuple[int, int | str], ...]
"""Outputs that are still to be copied into rows: which row, and which value."""


def allocated(
    operations: Sequence[Operation], outputs: Sequence[int | str]
) -> tuple[Mapping[int | str, str], Copies, int]:
    """Return the variable in which each node's values are held, what is to be copied, how many buffers.

    The operations are given in the order of their work. Outputs are held in their own rows, named o0, o1, …;
    other values in rows that are not filled yet, and in buffers, b0, b1, …: in the row of the output that
    becomes of them, if it is free, else in the place that was free last of those that stay free as long. An
    output that is no node, or that has an earlier row, is to be copied.
    """
    computed = {index for index, *_ in operations}
    held: dict[int | str, str] = {}
    copies = []
    for row, value in enumerate(outputs):
        if value in computed and value not in held:
            held[value] = f"o{row}"
        else:
            copies.append((row, value))
    last = {value: at for at, (*_, arguments) in enumerate(operations) for value in arguments}
    filled = {held[index]: at for at, (index, *_) in enumerate(operations) if index in held}
    free, inner, buffers = sorted(filled, key=lambda row: -filled[row]), computed - held.keys(), 0
    becomes = dict(held)
    for at, (index, _, arguments) in reversed([*enumerate(operations)]):
        if index in becomes:
            becomes |= {one: becomes[index] for one in arguments if last[one] == at and one in inner}
    for at, (index, _, arguments) in enumerate(operations):
        free += [held[one] for one in dict.fromkeys(arguments) if last[one] == at and one in inner]
        if index in held:
            continue
        if (own := becomes.get(index)) and own in free and filled[own] >= last[index]:
            free.remove(own)
            held[index] = own
            continue
        for n in range(len(free) - 1, -1, -1):
            if (end := filled.get(free[n], len(operations))) >= last[index]:
                held[index] = free.pop(n)
                break
            if end < at:
                del free[n]
        else:
            held[index], buffers = f"b{buffers}", buffers + 1
    return held, tuple(copies), buffers


# Compile symbolic expressions into a function of floats and into passes over blocks of arrays.
#
# `scalar` writes straight-line Python on floats, which is how one frame is solved. `Batch` writes the
# same operations as numpy calls into reused buffers, a block of the array at a time, so that the
# buffers stay in the cache and memory is taken for the results only.

Array = NDArray[np.float64]
Bools = NDArray[np.bool_]


BLOCK = 16384
CACHE_LINE, SIZE = 64, 8
"""Bytes of a processor's cache line, and of a number."""
_KEPT_BYTES = 16 << 20
"""Freed memory that is kept: more than the largest arrays of a frame take together."""
_FEW, _NOTED = 200_000, 2
"""A program runs uncompiled for up to this many numbers in all, and up to this many times."""
MANY = 100_000
"""After so many poses a program is compiled to machine code: in 10 ms, with the import of llvmlite in 50."""
CHECKED = 1_000
"""The poses that are worked out in both ways then."""

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
    "entry": "{0}[int({1})]",
}
"""In floats and Decimals; only graphs that are `exact` have sines and cosines."""
_IN_PLACE = frozenset({"add", "sub", "mul", "div", "neg", "sqrt"})
"""Operations into which a formula may be inlined: the others are longer, or use an argument twice."""


def _entry(table: NDArray[np.float64], place: NDArray[np.float64], out: Any = None) -> Any:
    """Return the entries of a table at places, which are whole numbers."""
    return np.take(table, place.astype(np.intp), out=out, mode="clip")


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
    "entry": _entry,
}


def needed(outputs: Sequence[Value]) -> list[Expr]:
    """Return the nodes that the outputs depend on, arguments before their users.

    They stand in the order of recording, joint by joint: few values wait long for their use, so those in use
    stay in the cache.
    """
    nodes: dict[int, Expr] = {}
    stack: list[Expr | float | str | LookUp] = list(outputs)
    while stack:
        node = stack.pop()
        if isinstance(node, Expr) and node.index not in nodes:
            nodes[node.index] = node
            stack.extend(node.args)
    return [nodes[index] for index in sorted(nodes)]


class _Constants:
    """Numbers, and names that stand for them in a program: its text is the same for other numbers."""

    def __init__(self) -> None:
        self._names: dict[object, str] = {}
        self.numbers: dict[str, float] = {}
        self.tables: dict[str, tuple[float, ...]] = {}

    def name(self, value: Value | str | LookUp) -> int | str:
        """Return a node's index, an input's name or a number's; 0.0 and -0.0, which are equal, have two."""
        if isinstance(value, Expr):
            return value.index if value.op != "input" else str(value.args[0])
        if isinstance(value, LookUp):
            table = self._names.setdefault(value, f"t{len(self._names)}")
            self.tables[table] = value.values
            return table
        key = value or (repr(value), value)
        name = self._names.get(key)
        if name is None:
            name = self._names[key] = f"k{len(self._names)}"
            self.numbers[name] = value if isinstance(value, float) else float(value)
        return name

    def operations(self, nodes: Iterable[Expr]) -> tuple[Operation, ...]:
        """Return what the nodes do, inputs left out."""
        return tuple(
            [(node.index, node.op, tuple(map(self.name, node.args))) for node in nodes if node.op != "input"]
        )

    @property
    def floats(self) -> dict[str, float]:
        """The numbers as plain floats: a `Constant` takes many times as long to compute with."""
        return {name: float(number) for name, number in self.numbers.items()}


def _compiled(name: str, inputs: Iterable[str], lines: Iterable[str]) -> CodeType:
    """Return the code that defines a function of that name, inputs and lines, all written by this module."""
    source = "\n    ".join([f"def {name}({', '.join(inputs)}):", *lines])
    return compile(source, f"<linkanim {name}>", "exec")


def _function(code: CodeType, name: str, names: Mapping[str, Any]) -> FunctionType:
    """Return the function that code defines, given what it uses."""
    space = dict(names)
    exec(code, space)
    function: FunctionType = space.pop(name)
    return function


FLOAT_NAMES = {"sqrt": math.sqrt, "atan2": lambda y, x: float(np.arctan2(y, x))}
"""An arc tangent is numpy's in floats as in arrays: a C library's has other bits."""
DEEPEST = 40
"""The most levels of nested brackets; Python reads 200."""
_KEPT = 128
"""Programs of each sort whose code is cached: a linkage of other lengths mostly has the same code."""


def scalar(inputs: Sequence[str], outputs: Sequence[Value], layout: str) -> Callable[..., Any]:
    """Return a function of float inputs that gives the outputs in `layout`.

    `layout` is a Python expression with one `{}` for each output, which may use the inputs. Raises what
    `math` raises (ValueError, ZeroDivisionError) where the arrays would hold NaN or infinity.
    """
    constants = _Constants()
    operations, results = constants.operations(needed(outputs)), tuple(map(constants.name, outputs))
    code = _scalar_code(tuple(inputs), operations, results, layout)
    marked = {_mark(name): number for name, number in constants.floats.items()}
    names = {**FLOAT_NAMES, **constants.tables}
    return FunctionType(code.replace(co_consts=_with_numbers(code.co_consts, marked)), names)


_FIRST_MARK = 2.0**60
_APART = 2.0**8


def _mark(name: str) -> float:
    """Return the number that stands in a pose's code where the constant of that name is to be put.

    Arguments, or names, would be fetched one by one at every call. No operation has only constants as its
    arguments, so none is folded with a mark in it.
    """
    return _FIRST_MARK + _APART * int(name.removeprefix("k"))


def _with_numbers(constants: tuple[Any, ...], marked: Mapping[float, float]) -> tuple[Any, ...]:
    """Return the constants of a code with numbers instead of their marks, in pairs as well."""
    return tuple(
        _with_numbers(value, marked)
        if isinstance(value, tuple)
        else marked.get(value, value)
        if isinstance(value, float)
        else value
        for value in constants
    )


@lru_cache(maxsize=_KEPT)
def _scalar_code(
    inputs: tuple[str, ...], operations: tuple[Operation, ...], outputs: tuple[int | str, ...], layout: str
) -> CodeType:
    """Return the code of a pose, with marks for its constants."""
    lines, texts = _inlined(operations, outputs, set(inputs))
    result = layout.format(*(texts.get(value, value) for value in outputs))
    return _function(_compiled("pose", inputs, [*lines, f"return {result}"]), "pose", FLOAT_NAMES).__code__


def _inlined(
    operations: Sequence[Operation], outputs: Sequence[int | str], inputs: Set[str]
) -> tuple[list[str], dict[int | str, str]]:
    """Return assignments to variables, and the text that stands for each value but the inputs.

    For a constant that is a mark; for a node its name, or, where it is used in one place only, its formula in
    brackets.
    """
    uses = Counter(outputs)
    for _, op, arguments in operations:
        uses.update(arguments * (1 if op in _IN_PLACE else 2))
    texts: dict[int | str, str] = {
        value: repr(_mark(value))
        for value in uses
        if isinstance(value, str) and value not in inputs and not value.startswith("t")
    }
    lines, depths = [], dict[int | str, int]()
    for index, op, arguments in operations:
        depth = max([depths.get(argument, 0) for argument in arguments])
        text = FORMULAS[op].format(*[texts.get(argument, argument) for argument in arguments])
        if uses[index] == 1 and depth + 1 < DEEPEST:
            texts[index], depths[index] = f"({text})", depth + 1
        else:
            texts[index] = f"v{index}"
            lines.append(f"v{index} = {text}")
    return lines, texts


DECIMAL_NAMES = {"sqrt": square_root, "sin": sine, "cos": cosine}


def decimals(inputs: Sequence[str], outputs: Sequence[Value]) -> Callable[..., tuple[Decimal, ...]]:
    """Return a function of Decimals that gives the outputs; call it in a `precise.context`."""
    constants = _Constants()
    operations, results = constants.operations(needed(outputs)), tuple(map(constants.name, outputs))
    digits = {name: digits_of(number) for name, number in constants.numbers.items()}
    return _function(
        _tuple_code("exact", tuple(inputs), operations, results), "exact", DECIMAL_NAMES | digits
    )


@lru_cache(maxsize=_KEPT)
def _tuple_code(
    name: str, inputs: tuple[str, ...], operations: tuple[Operation, ...], outputs: tuple[int | str, ...]
) -> CodeType:
    """Return the code of a function that gives the outputs as they stand, a line for each operation."""
    lines = [f"v{index} = {FORMULAS[op].format(*map(variable, given))}" for index, op, given in operations]
    result = "".join(f"{variable(value)}, " for value in outputs)
    return _compiled(name, inputs, [*lines, f"return ({result})"])


@frozen
class Batch:
    """A compiled pass over arrays: call it with one value or array (N,) for each input."""

    arrays: tuple[str, ...]
    outputs: tuple[Value, ...]
    passes: _Passes
    prelude: Callable[..., tuple[float, ...]]
    constants: tuple[Array, ...]
    spare: list[list[Array]] = field(default_factory=list, compare=False, repr=False)
    """Buffers of calls that are over; a call takes its own, so that threads do not share any."""

    def __call__(self, *values: Array | float, out: Array | None = None) -> Array:
        """Return the outputs as rows (outputs, N): in `out`, whose rows lie one after the other, if given."""
        several = len(self.arrays)
        arrays: Sequence[Any] = values[:several]
        uniform = self.prelude(*values[several:])
        results = aligned_rows(len(self.outputs), len(arrays[0])) if out is None else out
        if not self._run_as_machine_code(arrays, uniform, results):
            self._run(arrays, uniform, results)
        return results

    def _run_as_machine_code(self, arrays: Sequence[Any], uniform: tuple[float, ...], results: Array) -> bool:
        """Fill the results if the passes are worth it; False where they are left to numpy."""
        count = results.shape[1]
        code = self.passes.machine_code(count)
        if code is None:
            return False
        given = [np.ascontiguousarray(array) for array in arrays]
        words = (count, place(results), results.strides[0], self._words[1], *map(place, given), *uniform)
        code(pack(f"{len(words) - len(uniform)}q{len(uniform)}d", *words))
        if not self.passes.checked:
            some = slice(0, CHECKED)
            plain = np.empty((len(results), min(CHECKED, count)))
            self._run([array[some] for array in arrays], uniform, plain)
            self.passes.check(results[:, some], plain)
        return self.passes.checked

    @cached_property
    def _words(self) -> tuple[NDArray[np.int64], int]:
        """The numbers as machine code takes them, then each table's place and last index; where they lie."""
        numbers = [number for number in self.constants if not number.ndim]
        tables = [(place(table), len(table) - 1) for table in self.constants[len(numbers) :]]
        parts = np.array(numbers, np.float64).view(np.int64), np.array(tables, np.int64).ravel()
        return (words := np.concatenate(parts)), place(words)

    @np.errstate(all="ignore")  # which takes half of the time of a statement
    def _run(self, arrays: Sequence[Any], uniform: tuple[float, ...], results: Array) -> None:
        """Fill the results by numpy."""
        if results.shape[1] == 1:
            # numpy takes twice as long to work on one number in its own place as on two
            twice = np.empty((len(results), 2))
            self._run([np.repeat(array, 2) for array in arrays], uniform, twice)
            results[...] = twice[:, :1]
            return
        # as arrays without a dimension: numpy would make them of plain numbers at every operation
        numbers = [*(np.array(value, np.float64) for value in uniform), *self.constants]
        count = results.shape[1]
        if self.passes.run_as_noted((*arrays, *numbers), results):
            return
        block, size = self.passes.block, _block_size(count)
        work = self._buffers(size)
        if count == size:
            block(*arrays, *numbers, *results, *work)
        else:
            for part in (slice(first, min(first + size, count)) for first in range(0, count, size)):
                inside = [row[: part.stop - part.start] for row in work]
                block(*(array[part] for array in arrays), *numbers, *results[:, part], *inside)
        self.spare.append(work)

    def _buffers(self, size: int) -> list[Array]:
        """Return buffers for one call, used ones where they fit: fresh memory costs a page at a time."""
        try:
            work = (
                self.spare.pop()
            )  # without asking first whether there are any: another thread may take them
        except IndexError:
            work = []
        if work and len(work[0]) == size:
            return work
        return list(aligned_rows(self.passes.buffers, size))


def aligned_rows(rows: int, count: int) -> Array:
    """Return an array (rows, count) to be filled, each row from a cache line's begin on.

    Vector units take whole cache lines; a row that begins elsewhere costs them two for each.
    """
    line = CACHE_LINE // SIZE
    width = (count + line - 1) // line * line
    memory = np.empty(rows * width + line)
    skipped = -place(memory) % CACHE_LINE
    return np.ndarray((rows, count), np.float64, memory, skipped, (width * SIZE, SIZE))


def keep_memory() -> None:
    """Have the C library keep the memory that a frame, or a row of forces, frees for the next one.

    glibc returns free memory at the heap's end to the system where it is more than twice the largest block
    that was ever freed; getting it back page by page took a quarter to a half of a frame's time, and two
    thirds of that of forces at ten thousand poses.
    """
    with suppress(MemoryError):
        np.empty(_KEPT_BYTES, np.uint8)


def _block_size(count: int) -> int:
    """Return the size of blocks: whole cache lines, and all of the array where one block is enough."""
    if count <= BLOCK:
        return count
    return -(-count // (-(-count // BLOCK) * CACHE_LINE)) * CACHE_LINE


def batch(inputs: Mapping[str, bool], outputs: Sequence[Value]) -> Batch:
    """Compile the outputs; `inputs` says of each name whether it is an array, those first, or uniform."""
    nodes, constants = needed(outputs), _Constants()
    arrays = tuple(name for name, array in inputs.items() if array)
    uniform = tuple(name for name, array in inputs.items() if not array)
    used = {str(node.args[0]) for node in nodes if node.op == "input"} & set(uniform)
    prelude, numbers = _prelude(uniform, sorted(used), [node for node in nodes if node.uniform])
    operations = constants.operations(node for node in nodes if not node.uniform)
    results = tuple(map(constants.name, outputs))
    kept = tuple(map(np.array, (constants.numbers | constants.tables).values()))
    names = ProgramInputs(arrays, tuple(numbers), tuple(constants.numbers), tuple(constants.tables))
    passes = _passes(names, operations, results)
    return Batch(arrays, tuple(outputs), passes, prelude, kept)


def _prelude(
    inputs: tuple[str, ...], used: Sequence[str], nodes: Sequence[Expr]
) -> tuple[Callable[..., tuple[float, ...]], list[str]]:
    """Return the function of the uniform inputs that computes all uniform values, and the values' names."""
    constants = _Constants()
    operations = constants.operations(nodes)
    outputs: tuple[int | str, ...] = (*used, *(index for index, *_ in operations))
    code = _tuple_code("prelude", inputs, operations, outputs)
    return _function(code, "prelude", FLOAT_NAMES | constants.floats), [*map(variable, outputs)]


class _Passes:
    """The operations on one block in their order, with the block's inputs and the values that are results.

    For few poses the operations are run one by one, up to twice: compiling takes as long as several hundred
    poses, and many programs are for one pose only, with its rates in time and by the input.
    """

    def __init__(
        self, inputs: ProgramInputs, operations: tuple[Operation, ...], outputs: tuple[int | str, ...]
    ) -> None:
        self._kinds, self._operations, self._outputs = inputs, operations, outputs
        self._inputs = [name for names in inputs for name in names]
        self._runs = self._asked = 0
        self.checked = self._refused = False
        """Whether machine code was found to give the bits that numpy gives."""

    def machine_code(self, count: int) -> MachineCode | None:
        """Return what solves that many poses; None where numpy does, for the first of them or for ever."""
        if count < LANES or self._refused:
            return None
        self._asked += count
        return self._code if self._asked >= MANY else None

    @cached_property
    def _code(self) -> MachineCode | None:
        return compiled(self._kinds, self._operations, self._outputs)

    def check(self, values: Array, plain: Array) -> None:
        """Refuse the machine code for ever where its results differ from numpy's in any bit."""
        same = (values.view(np.int64) == plain.view(np.int64)) | (np.isnan(values) & np.isnan(plain))
        self.checked = bool(same.all())
        self._refused = not self.checked

    def run_as_noted(self, given: Sequence[Array], results: Array) -> bool:
        """Fill the results (outputs, N) without compiling; return False where they are left to `block`."""
        if self._runs >= _NOTED or results.shape[1] * len(self._operations) > _FEW:
            return False
        self._runs += 1
        known: dict[str, Any] = dict(zip(self._inputs, given, strict=True))
        for index, op, arguments in self._operations:
            values, name = [known[variable(value)] for value in arguments], variable(index)
            if op == "select":
                a, b, below, otherwise = values
                known[name] = np.where(a < b, below, otherwise)
            else:
                known[name] = UFUNCS[op](*values)
        for row, value in zip(results, self._outputs, strict=True):
            row[...] = known[variable(value)]
        return True

    @cached_property
    def block(self) -> Callable[..., None]:
        """The function that runs one block, given its inputs, result rows and buffers."""
        rows = (f"o{row}" for row in range(len(self._outputs)))
        buffers = (f"b{n}" for n in range(self.buffers))
        held, copies, _ = self._places
        lines = [*_calls(self._operations, held, copies)] or ["pass"]
        code = _compiled("block", (*self._inputs, *rows, *buffers), lines)
        return _function(code, "block", {**UFUNCS, "where": np.where})

    @property
    def buffers(self) -> int:
        """How many buffers a block takes."""
        return self._places[2]

    @cached_property
    def _places(self) -> tuple[Mapping[int | str, str], Copies, int]:
        return allocated(self._operations, self._outputs)


_passes = lru_cache(maxsize=_KEPT)(_Passes)
"""The passes of equal operations, which linkages of one form share."""


def _calls(operations: Sequence[Operation], held: Mapping[int | str, str], copies: Copies) -> Iterator[str]:
    """Yield the numpy calls in order."""
    for index, op, arguments in operations:
        given, place = [held.get(value) or variable(value) for value in arguments], held[index]
        if op == "select":
            a, b, below, otherwise = given
            yield f"{place}[...] = where({a} < {b}, {below}, {otherwise})"
        else:
            # A keyword costs time at every call; numpy requires it of these two only.
            target = f"out={place}" if op in ("minimum", "maximum") else place
            yield f"{op}({', '.join(given)}, {target})"
    for row, value in copies:
        # a constant is an array of no dimension: numpy would make one of a plain number at every call
        yield f"o{row}[...] = {held.get(value) or variable(value)}"
