# SPDX-License-Identifier: MIT
"""tables.py - the tables of README.md and ../precice.md as the hosts print them

    sh run.sh [WORD...] | python3 tables.py

A table whose first line is the same is written anew; the others stay.  Names what it has changed."""
import sys
from pathlib import Path

printed, table = {}, None
for line in sys.stdin:
    line = line.rstrip("\n").removeprefix("#   ")
    if line.startswith("|"):
        if table is None:
            table = printed.setdefault(line, [line])
        else:
            table.append(line)
    else:
        table = None
here = Path(__file__).resolve().parent
for page in here / "README.md", here.parent / "precice.md":
    lines, inside = [], None
    for line in page.read_text().split("\n"):
        if inside and line.startswith("|"):
            continue
        inside = line if line in printed else None
        lines += printed[line] if inside else [line]
        if inside:
            print(page.name, line)
    page.write_text("\n".join(lines))
