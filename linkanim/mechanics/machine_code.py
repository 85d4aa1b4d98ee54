"""Compile passes over arrays to machine code by llvmlite, where it is installed: `linkanim[fast]`.

Eight poses at a time go through all operations in the processor's registers: nothing is fetched but the
inputs, nothing stored but the results. Each operation is the one that numpy does, in the same order; none is
fused with another, and sines and cosines are our own. So the bits are the same.

Code that is written with eight lanes needs no optimiser. LLVM takes some 10 ms for it, a fifth of what the
import of llvmlite takes; so nothing is kept on disk.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from ctypes import CFUNCTYPE, c_char_p, c_ssize_t
from functools import cache
from typing import Any, NamedTuple

from numpy.typing import NDArray

LANES = 8
"""The poses that are worked out at a time, and the fewest that can be."""
OPERATIONS: Mapping[str, tuple[str, ...]] = {
    "add": ("{r} = fadd {v} {0}, {1}",),
    "sub": ("{r} = fsub {v} {0}, {1}",),
    "mul": ("{r} = fmul {v} {0}, {1}",),
    "div": ("{r} = fdiv {v} {0}, {1}",),
    "neg": ("{r} = fneg {v} {0}",),
    "sqrt": ("{r} = call {v} @llvm.sqrt.v8f64({v} {0})",),
    "rint": ("{r} = call {v} @llvm.rint.v8f64({v} {0})",),
    "select": ("{r}a = fcmp olt {v} {0}, {1}", "{r} = select {b} {r}a, {v} {2}, {v} {3}"),
    # as numpy's are: NaN where either is, and of equal ones the second
    "minimum": (
        "{r}a = fcmp olt {v} {0}, {1}",
        "{r}b = fcmp uno {v} {0}, {0}",
        "{r}c = or {b} {r}a, {r}b",
        "{r} = select {b} {r}c, {v} {0}, {v} {1}",
    ),
    "maximum": (
        "{r}a = fcmp ogt {v} {0}, {1}",
        "{r}b = fcmp uno {v} {0}, {0}",
        "{r}c = or {b} {r}a, {r}b",
        "{r} = select {b} {r}c, {v} {0}, {v} {1}",
    ),
    "entry": (
        "{r}a = fptosi {v} {1} to {i}",
        "{r}b = freeze {i} {r}a",
        "{r}c = call {i} @llvm.smax.v8i64({i} {r}b, {i} zeroinitializer)",
        "{r}d = call {i} @llvm.smin.v8i64({i} {r}c, {i} {0}lastv)",
        "{r}e = getelementptr double, ptr {0}, {i} {r}d",
        "{r} = call {v} @llvm.masked.gather.v8f64.v8p0(<8 x ptr> {r}e, i32 8, {b} {all}, {v} poison)",
    ),
}
"""The instructions of each operation; a program with another one is left to numpy."""
_TYPES = {"v": "<8 x double>", "i": "<8 x i64>", "b": "<8 x i1>", "all": f"<{', '.join(['i1 true'] * 8)}>"}
_DECLARED = (
    "declare {v} @llvm.sqrt.v8f64({v})",
    "declare {v} @llvm.rint.v8f64({v})",
    "declare {i} @llvm.smax.v8i64({i}, {i})",
    "declare {i} @llvm.smin.v8i64({i}, {i})",
    "declare {v} @llvm.masked.gather.v8f64.v8p0(<8 x ptr>, i32, {b}, {v})",
)
_HEAD = ("count", "results", "stride", "constants")


class ProgramInputs(NamedTuple):
    """The names of a program's inputs: arrays, numbers of a call, and its own numbers and tables."""

    arrays: tuple[str, ...]
    uniform: tuple[str, ...]
    numbers: tuple[str, ...] = ()
    tables: tuple[str, ...] = ()


Operation = tuple[int, str, tuple[int | str, ...]]
"""A node: its index, its operation and its arguments: other nodes' indices, names of inputs and of numbers.

Linkages that differ in lengths alone mostly have the same operations, and so the same program.
"""


MachineCode = Callable[[bytes], Any]
"""What fills the rows of results, given words of eight bytes.

These are: how many poses there are, where the results lie, the bytes from row to row, where the program's
numbers lie (with the place and the last index of each table), where each array lies, the numbers of the call.
"""


def place(array: NDArray[Any]) -> int:
    """Return where an array's numbers lie; `array.ctypes.data` takes five times as long.

    It is the first word of numpy's part of the object, on which every compiled package relies.
    """
    return c_ssize_t.from_address(id(array) + object.__basicsize__).value


def variable(value: int | str) -> str:
    """Return the name of a node's value, an input or a number."""
    return value if isinstance(value, str) else f"v{value}"


def compiled(
    inputs: ProgramInputs, operations: Sequence[Operation], outputs: Sequence[int | str]
) -> MachineCode | None:
    """Return a program as machine code; None where there is no llvmlite, or where it fails."""
    target = _target()
    if target is None or not all(op in OPERATIONS for _, op, _ in operations):
        return None
    llvm, machine = target
    try:
        module = llvm.parse_assembly("\n".join(_lines(inputs, operations, outputs)))
        engine = llvm.create_mcjit_compiler(module, machine())
        engine.finalize_object()
        code = CFUNCTYPE(None, c_char_p)(engine.get_function_address("run"))
    except (RuntimeError, OSError):
        return None
    vars(code)["engine"] = engine  # which holds the code
    return code


@cache
def _target() -> tuple[Any, Callable[[], Any]] | None:
    """Return llvmlite and what makes a compiler for this processor; None where either is missing."""
    if sys.implementation.name != "cpython":  # elsewhere `place` is none
        return None
    try:
        import llvmlite.binding as llvm

        llvm.initialize_native_target()
        llvm.initialize_native_asmprinter()
        target, processor = llvm.Target.from_default_triple(), llvm.get_host_cpu_name()
        features = llvm.get_host_cpu_features().flatten()
    except (ImportError, RuntimeError, OSError):
        return None
    return llvm, lambda: target.create_target_machine(cpu=processor, features=features, opt=2, jit=True)


def _lines(
    inputs: ProgramInputs, operations: Sequence[Operation], outputs: Sequence[int | str]
) -> Iterator[str]:
    """Yield the text of the function, whose last eight poses may have been worked out before."""
    yield from (line.format(**_TYPES) for line in _DECLARED)
    yield "define void @run(ptr noalias readonly %words) {"
    yield "begin:"
    yield from _fetched("words", {"count": "i64", "results": "ptr", "stride": "i64", "constants": "ptr"}, 0)
    given = dict.fromkeys(inputs.arrays, "ptr") | dict.fromkeys(inputs.uniform, "double")
    yield from _fetched("words", given, 4)
    lasts = [(table, f"{table}last") for table in inputs.tables]
    tables = {name: kind for pair in lasts for name, kind in zip(pair, ("ptr", "i64"), strict=True)}
    yield from _fetched("constants", dict.fromkeys(inputs.numbers, "double") | tables, 0)
    for name in (*inputs.uniform, *inputs.numbers):
        yield from _in_all_lanes(name, "double")
    for _, last in lasts:
        yield from _in_all_lanes(last, "i64")
    for row in range(len(outputs)):
        yield f"%off{row} = mul i64 %stride, {row}"
        yield f"%row{row} = getelementptr i8, ptr %results, i64 %off{row}"
    yield f"%last = sub i64 %count, {LANES}"
    yield "br label %loop"
    yield "loop:"
    yield "%at = phi i64 [0, %begin], [%next, %loop]"
    for name in inputs.arrays:
        yield f"%{name}p = getelementptr double, ptr %{name}, i64 %at"
        yield f"%{name}v = load <8 x double>, ptr %{name}p, align 8"
    held = {name: f"%{name}" for name in inputs.tables}
    held |= {name: f"%{name}v" for name in (*inputs.arrays, *inputs.uniform, *inputs.numbers)}
    for index, op, arguments in operations:
        result = held[variable(index)] = f"%n{index}"
        values = [held[variable(value)] for value in arguments]
        yield from (line.format(*values, r=result, **_TYPES) for line in OPERATIONS[op])
    for row, value in enumerate(outputs):
        yield f"%out{row} = getelementptr double, ptr %row{row}, i64 %at"
        yield f"store <8 x double> {held[variable(value)]}, ptr %out{row}, align 8"
    yield f"%more = add i64 %at, {LANES}"
    yield "%over = icmp sgt i64 %more, %last"
    yield "%next = select i1 %over, i64 %last, i64 %more"
    yield "%done = icmp sge i64 %at, %last"
    yield "br i1 %done, label %end, label %loop"
    yield "end:"
    yield "ret void"
    yield "}"


def _fetched(words: str, types: Mapping[str, str], first: int) -> Iterator[str]:
    """Yield what reads named words of eight bytes."""
    for place, (name, kind) in enumerate(types.items(), first):
        yield f"%{name}w = getelementptr i64, ptr %{words}, i64 {place}"
        yield f"%{name} = load {kind}, ptr %{name}w"


def _in_all_lanes(name: str, kind: str) -> Iterator[str]:
    yield f"%{name}f = insertelement <8 x {kind}> poison, {kind} %{name}, i32 0"
    yield f"%{name}v = shufflevector <8 x {kind}> %{name}f, <8 x {kind}> poison, <8 x i32> zeroinitializer"
