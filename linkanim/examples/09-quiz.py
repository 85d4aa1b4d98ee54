"""09  A quiz for a learning platform: questions in GIFT, which Moodle and others read.

Each wrong answer tells the misconception behind it.
"""

import json
import re
import subprocess
import sys
from pathlib import Path

command = [
    sys.executable,
    "-P",
    "-m",
    "linkanim",
    "quiz",
    "crank-rocker",
    "-n",
    "10",
    "--seed",
    "1",
    "--json",
]
questions = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)


def plain(text):
    """Return a text with the signs that GIFT reads escaped."""
    return re.sub(r"([~=#{}:\\])", r"\\\1", text)


lines = []
for number, one in enumerate(questions, 1):
    lines.append(f"::{one['scene']} {number}:: {plain(one['question'])} {{")
    for index, (answer, slip) in enumerate(zip(one["answers"], one["slips"])):
        said = one["why"] if index == one["right"] else slip
        lines.append(f"  {'=' if index == one['right'] else '~'}{plain(answer)} #{plain(said)}")
    lines.append("}\n")
Path("quiz.gift").write_text("\n".join(lines), encoding="utf-8")
print(f"quiz.gift: {len(questions)} questions")
