#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""lists.py [--check] - the list at the end of each tests/test_*.c: its tests in the order in which they are defined, one a
line, within the #if that a test stands in.  Writes it; --check: says which file's list is another one, and fails."""
import glob
import os
import re
import sys

TOP = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
LIST = re.compile(r"(?<=    const struct CMUnitTest tests\[\] = \{\n).*?(?=    \};\n)", re.S)


def tests_of(text):
    """(conditions, name) of each TEST(name), a condition as its line says it"""
    conditions = []
    for line in text.splitlines():
        line = re.sub(r"\s*/\*.*", "", line)
        if re.match(r"#\s*if", line):
            conditions.append(line)
        elif re.match(r"#\s*el", line):
            conditions[-1] = None  # no test stands there
        elif re.match(r"#\s*endif", line):
            conditions.pop()
        elif line.startswith("TEST("):
            yield list(conditions), line[len("TEST("):line.index(")")]


def list_of(text):
    lines, inside = [], []
    for conditions, name in tests_of(text):
        if None in conditions:
            sys.exit(f"{name} stands behind an #else: give it an #if of its own")
        if conditions != inside:
            lines += ["#endif"] * len(inside) + conditions
            inside = conditions
        lines.append(f"        cmocka_unit_test({name}),")
    return "".join(line + "\n" for line in lines + ["#endif"] * len(inside))


def main():
    wrong = 0
    for path in sorted(glob.glob(os.path.join(TOP, "tests", "test_*.c"))):
        with open(path) as file:
            text = file.read()
        new, found = LIST.subn(lambda _: list_of(text), text)
        if found != 1:
            sys.exit(f"{path}: no list of tests")
        if new == text:
            continue
        wrong += 1
        if "--check" in sys.argv:
            print(f"tests/{os.path.basename(path)}: the list of tests is out of order: make lists")
            continue
        with open(path, "w") as file:
            file.write(new)
    return "--check" in sys.argv and wrong > 0


if __name__ == "__main__":
    sys.exit(main())
