"""Every tolerance stands in one table, with its reason; it is used, and no module has one of its own."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from decimal import Decimal
from pathlib import Path

from linkanim.mechanics import tolerances

ROOM = Path(tolerances.__file__).parent
TABLE = Path(tolerances.__file__).read_text(encoding="utf-8")
SMALL = 1e-5
"""Constants below this in size are tolerances."""


def sources() -> dict[str, str]:
    files = (file for file in ROOM.rglob("*.py") if file.name != "tolerances.py")
    return {str(file.relative_to(ROOM)): file.read_text(encoding="utf-8") for file in files}


def test_every_tolerance_has_a_reason_and_is_used() -> None:
    names = [name for name in vars(tolerances) if name.isupper()]
    used = "\n".join(sources().values())
    assert len(names) > 30
    for name in names:
        assert re.search(rf'^{name} = .*\n"""[A-Z]', TABLE, flags=re.MULTILINE), name
        assert re.search(rf"\b{name}\b", used), name


def numbers(code: ast.AST) -> Iterator[float]:
    """Yield the numbers that are written in code, powers and Decimals among them."""
    for node in ast.walk(code):
        if isinstance(node, ast.Constant) and isinstance(node.value, float):
            yield node.value
        elif re.fullmatch(
            r"Decimal\('[-+.e0-9]+'\)|(Decimal\(10\)|[0-9.]+) \*\* \(?-[0-9]+\)?", ast.unparse(node)
        ):
            yield float(eval(ast.unparse(node), {"Decimal": Decimal}))


def test_no_module_has_a_tolerance_of_its_own() -> None:
    own = [
        (path, number)
        for path, text in sources().items()
        for number in numbers(ast.parse(text))
        if 0 < abs(number) < SMALL
    ]
    assert own == []
