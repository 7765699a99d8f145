# SPDX-License-Identifier: MIT
"""mutants.py HEADER [seed=1] [count=100] [seconds=0] [jobs=2] [least=0] [quick=0] [first=1] [last=0] [rules=1]:
do the unit tests notice a wrong line?

Changes one line of the implementation half of HEADER at a time and builds every tests/test_HEADER*.c with it.  A mutant is
killed when a test fails, a program crashes, or it runs three times as long as the right one.  The lines and the changes
are drawn by the seed, which is any word.  Prints every survivor and the score: killed of all that count.

These do not count: mutants that do not compile, those with the same object code at -O2, and those that a RULE below takes
out.  A rule is about a kind of change, and reads the header for what it needs; there is no list of lines.  rules=0: all count.

Where tcc is installed, which compiles twenty times faster, it goes first; what survives there is built and run by CC, with
its sanitizers of addresses and undefined behaviour where it has them (make sanitize runs the unit tests so, too).
The programs, and the tests in each, run in the order of their time, the shortest first; runs of seconds are shortened: LESS
in tests/check.h.
seconds: stop after that time.  first, last: the lines that may be changed; 0: to the end.  quick=1: what survives under tcc
is not run again.
least: exit status 1 below that score; with seconds, which leave a small sample, only if a header of that score would do
so badly in less than one sample of a hundred.
"""
import collections
import concurrent.futures
import glob
import math
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.dirname(os.path.dirname(HERE))
CC = os.environ.get("CC", "cc").split()
QUICK = [shutil.which("tcc")] if shutil.which("tcc") else []
LIBS = ["-lcmocka"] + os.environ.get("LDLIBS", "-llapack -lblas").split() + ["-lm"]

Mutant = collections.namedtuple("Mutant", "number function old new kind at part by")  # number: of the line, from 0; at: column


# ---- the source ----

def blank(text):
    """The text with comments, strings and characters replaced by spaces; every other character stays in its place."""
    pattern = r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\''
    return re.sub(pattern, lambda m: re.sub(r"[^\n]", " ", m.group()), text, flags=re.S)


def implementation(lines):
    """The range of lines between #ifdef .._IMPLEMENTATION and its #endif."""
    first = next((i for i, line in enumerate(lines) if re.match(r"#\s*if.*_IMPLEMENTATION", line)), None)
    if first is None:
        return 0, len(lines)
    depth = 0
    for i in range(first, len(lines)):
        if re.match(r"#\s*if", lines[i]):
            depth += 1
        elif re.match(r"#\s*endif", lines[i]):
            depth -= 1
            if depth == 0:
                return first + 1, i
    return first + 1, len(lines)


def functions(lines):
    """For every line the name of the function, macro or table it stands in."""
    names, name = [], "-"
    for line in lines:
        found = re.match(r"#\s*define\s+(\w+)", line) or (
            re.match(r"[A-Za-z_]", line) and not line.rstrip().endswith(";") and re.search(r"(\w+)\s*(?:\(|\[|=)", line))
        if found:
            name = found.group(1)
        names.append(name)
    return names


# ---- the changes: each takes a blanked line and yields (start, end, text, kind) ----

COMPARISONS = {"<": ("<=", ">="), "<=": ("<", ">"), ">": (">=", "<="), ">=": (">", "<"), "==": ("!=",), "!=": ("==",)}
OPERATORS = {"+": "-", "-": "+", "*": "/", "/": "*", "%": "/", "&": "|", "|": "&", "<<": ">>", ">>": "<<"}
ASSIGNMENTS = {"+=": ("=", "-="), "-=": ("=", "+="), "*=": ("=", "/="), "/=": ("=", "*="), "|=": ("=",), "&=": ("=",)}
NUMBER = r"(?<![\w.])(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?:[uU]?[lL]{0,2})(?![\w.])"
TYPE = r"(?:const|static|enum|struct|union|typedef|extern|int|double|char|size_t|ptrdiff_t|uint\w+|return|break|continue|" \
       r"goto|case|default|do|else|unsigned|long|volatile|void|\}|#)\b"


def comparisons(code):
    for m in re.finditer(r"(?<![-<>=!+*/&|^%])(<=|>=|==|!=|<|>)(?![<>=])", code):
        for new in COMPARISONS[m.group()]:
            yield m.start(), m.end(), new, "comparison"


def operators(code):
    for m in re.finditer(r"(?<= )(\+|-|\*|/|%|&|\||<<|>>)(?= )", code):
        yield m.start(), m.end(), OPERATORS[m.group()], "operator"
    for m in re.finditer(r"&&|\|\|", code):
        yield m.start(), m.end(), "||" if m.group() == "&&" else "&&", "logic"
    for m in re.finditer(r"(?<= )(\+=|-=|\*=|/=|\|=|&=)(?= )", code):
        for new in ASSIGNMENTS[m.group()]:
            yield m.start(), m.end(), new, "assignment"
    for m in re.finditer(r"\+\+|--", code):
        yield m.start(), m.end(), "--" if m.group() == "++" else "++", "increment"


def constants(code):
    table = len(re.findall(NUMBER, code)) >= 3 and not re.search(r"\w\(|;", code) or re.search(r"\d\.\d{9}", code)
    for m in re.finditer(NUMBER, code):
        if (table and len(m.group()) > 2) or len(re.sub(r"[eE].*|\D", "", m.group())) > 6:
            for k in [i for i, c in enumerate(m.group()) if c.isdigit()][:8]:
                digit = str((int(m.group()[k]) + 1) % 10)
                yield m.start() + k, m.start() + k + 1, digit, "digit"
        elif m.group().isdigit():
            for new in (int(m.group()) + 1, int(m.group()) - 1):
                yield m.start(), m.end(), str(new) if new >= 0 else "(%d)" % new, "constant"
        else:
            yield m.start(), m.end(), "(%s + 1)" % m.group(), "constant"


def statements(code, before):
    whole = re.match(r"(\s*)(\S.*;)\s*(\\?)\s*$", code)
    starts = re.search(r"[;{}:)\\]\s*\\?\s*$|\belse\s*$|^\s*$", before)
    if whole and starts and not re.match(TYPE, whole.group(2)) and not re.match(r"\w+\s+\*?\w+\s*(?:[;,=\[])", whole.group(2)):
        yield whole.start(2), whole.end(2), ";", "guard" if whole.group(2).startswith("if ") else "statement"


def conditions(code):
    for m in re.finditer(r"\b(?:if|while) \(", code):
        depth, end = 1, m.end()
        while end < len(code) and depth:
            depth += {"(": 1, ")": -1}.get(code[end], 0)
            end += 1
        if depth == 0:
            yield m.end(), end - 1, "!(" + code[m.end():end - 1] + ")", "condition"


def mutants(path):
    """A list of lists: for every line that can be changed, its mutants."""
    text = open(path).read()
    lines, code = text.split("\n"), blank(text).split("\n")
    first, last = implementation(lines)
    names, found, in_directive = functions(code), [], False
    for i in range(first, last):
        directive = re.match(r"\s*#", code[i]) and not re.match(r"\s*#\s*define\s+\w+\(", code[i])
        skip = in_directive if in_directive else directive
        in_directive = bool(skip and code[i].rstrip().endswith("\\"))
        if skip:
            continue
        before = next((code[k] for k in range(i - 1, first, -1) if code[k].strip()), "")
        body = code[i]
        macro = re.match(r"\s*#\s*define\s+\w+\([^)]*\)", body)
        if macro:
            body = " " * macro.end() + body[macro.end():]
        changes = [c for source in (comparisons(body), operators(body), constants(body), statements(body, before),
                                    conditions(body)) for c in source]
        row = []
        for start, end, new, kind in changes:
            line = lines[i][:start] + new + lines[i][end:]
            row.append(Mutant(i, names[i], lines[i].strip(), line.strip(), kind, start, lines[i][start:end], new))
        if row:
            found.append(row)
    return lines, found


# ---- the rules: which changes no test can, or need, notice ----

class Source:
    """What the rules ask of a header."""

    def __init__(self, path):
        text = open(path).read()
        self.lines, self.code = text.split("\n"), blank(text).split("\n")
        self.first, self.last = implementation(self.lines)
        self.names = functions(self.code)
        self.body = collections.defaultdict(str)
        for name, line in zip(self.names[self.first:self.last], self.code[self.first:self.last]):
            self.body[name] += line + "\n"
        self.all = "\n".join(self.code[self.first:self.last])
        public = "\n".join(self.code[:self.first])
        found = re.findall(r"\b[A-Z]+\(([A-Z]+_[A-Z]\w*), *\(?(-?\d+)", public)  # the list of statuses
        found = found or re.findall(r"\b([A-Z]+_(?:E[A-Z]\w*|OK))\s*=\s*\(?(-?\d+)", public)
        self.statuses = {name: int(number) for name, number in found}
        self.errors = {name for name, number in self.statuses.items() if number <= -100}
        self.tolerances = "|".join(re.findall(r"#\s*define\s+(\w+)\s+\(?(?:[\w ]+\* )?\d*(?:\.\d|\.? ?\d*[eE]-|\d\.)", "\n".join(self.code))) or "-"
        self.telling = self.functions_that_tell()

    def functions_that_tell(self):
        """The functions that return a status."""
        telling = {name for name, body in self.body.items() if set(re.findall(r"\b[A-Z]+_E[A-Z]\w*", body)) & self.errors
                   and re.search(r"\breturn\b", body)}
        while True:
            calls = r"\breturn (?:[^;]*[?:] )?(?:%s)\(" % "|".join(map(re.escape, telling))
            more = {name for name, body in self.body.items() if telling and re.search(calls, body)} - telling
            if not more:
                return telling
            telling |= more

    def is_status(self, word, function):
        """Is this word a function that tells a status, or a name that holds what one told?"""
        call = r"\b%s = (?:[^;]*[?:] )?(?:%s)\(" % (re.escape(word), "|".join(map(re.escape, self.telling)))
        return bool(word in self.telling or word and self.telling and re.search(call, self.body[function]))

    def is_asked_for_truth(self, name, function, depth=0):
        """Is this variable, member or static function only asked whether it is 0?"""
        body = self.body[function]
        declaration = r"\b(?:int|char)\b[^;(){}]*\b%s\b" % re.escape(name)
        local = name != function and (re.search(declaration, body.split("{", 1)[-1]) or name in self.parameters(function))
        if not local and not re.search(declaration, "\n".join(self.code)):
            return False
        text = body.split("{", 1)[-1] if local else self.all
        uses = 0
        for use in re.finditer(r"(?<![\w.>])((?:\w+(?:\[[^]]*\])?(?:->|\.))*)%s\b" % re.escape(name), text):
            before, after = text[:use.start()].rstrip(), text[use.end():]
            line = text[text.rfind("\n", 0, use.start()) + 1:].split("\n")[0]
            if after.startswith("("):
                if re.match(r"[A-Za-z]", line) and not line.rstrip().endswith(";"):
                    continue  # its definition
                after = after[closing(after, 0):]
            after = after[closing(after, 0):] if after.startswith("[") else after
            after = after.lstrip()
            if re.match(r"\s*(?:const |static )*(?:int|char)\b", line) and re.match(r"[,;=\[]", after) or re.search(r"\bint$", before):
                continue  # its declaration
            if re.match(r"\|?=(?!=)", after):
                continue
            uses += 1
            alone = re.search(r"(?:[!(,;:?{}]|[^=!<>]=|&&|\|\||\breturn)$", before) and re.match(r"[);:,]|&&|\|\||\?|[!=]= 0\b", after)
            asked = alone and (re.search(r"(?:!|\b(?:if|while) \(|&&|\|\|)$", before) or re.match(r"&&|\|\||\?|[!=]= 0\b", after))
            handed = before.endswith("return") and after.startswith(";") and depth < 4
            where = self.names_at(use.start()) if not local else function
            passed = alone and depth < 4 and self.parameter_at(text, use.start())
            if passed and self.is_asked_for_truth(passed[1], passed[0], depth + 1):
                continue
            if not asked and not (handed and self.is_asked_for_truth(where, where, depth + 1)):
                return False
        return uses > 0

    def parameters(self, function):
        """The names of the parameters of a function, in their order."""
        head = re.search(r"\b%s\(" % re.escape(function), self.body[function].split("{")[0])
        if not head:
            return []
        inside = self.body[function][head.end() - 1:]
        return [re.search(r"(\w*)(?:\[[^]]*\])*\s*$", part).group(1) for part in inside[1:closing(inside, 0) - 1].split(",")]

    def parameter_at(self, text, place):
        """The function that what stands at this place is an argument of, and the name of its parameter there."""
        depth, commas = 0, 0
        for i in range(place - 1, -1, -1):
            depth += (text[i] in ")]") - (text[i] in "([")
            if depth < 0 or text[i] in ";{}":
                name = re.search(r"(\w+)$", text[:i])
                names = self.parameters(name.group(1)) if text[i] == "(" and name and name.group(1) in self.body else []
                return (name.group(1), names[commas]) if commas < len(names) else None
            commas += depth == 0 and text[i] == ","
        return None

    def names_at(self, offset):
        return self.names[self.first + self.all.count("\n", 0, offset)]


def closing(text, start):
    """The place behind the bracket that closes the one at start."""
    depth = 0
    for i in range(start, len(text)):
        depth += (text[i] in "([") - (text[i] in ")]")
        if depth == 0:
            return i + 1
    return len(text)


def number(text):
    try:
        return float(re.sub(r"[uUlL()]", "", text))
    except ValueError:
        return None


def argument(source, m):
    """The function that this number is handed to, and the name of its parameter there."""
    code = source.code[m.number]
    alone = re.search(r"[(,] ?$", code[:m.at]) and re.match(r"[,)]", code[m.at + len(m.part):])
    return source.parameter_at(code, m.at) if alone else None


def truth(source, m):
    """1 or 2 where only 0 or not is asked: flags, and static functions that answer yes or no."""
    if m.kind != "constant" or not number(m.part) or not number(m.by):
        return False
    code = source.code[m.number]
    before = code[:m.at]
    returned = re.search(r"\breturn ((?:[^;]* [?:] )?)$", before) and re.match(r"\s*[;:]", code[m.at + len(m.part):])
    if returned and before.count("(", before.rindex("return ")) != before.count(")", before.rindex("return ")):
        return False
    if returned:
        static = re.search(r"\bstatic\b.*\b%s\(" % re.escape(m.function), source.body[m.function].split("{")[0])
        return bool(static) and source.is_asked_for_truth(m.function, m.function)
    handed = argument(source, m)
    if handed:
        return source.is_asked_for_truth(handed[1], handed[0])
    if re.match(r"\s*\{", code):  # a row of a table
        kind = re.search(r"\b(\w+) %s\[\]" % re.escape(m.function), source.all)
        struct = kind and re.search(r"\bstruct %s \{(.*?)\}" % re.escape(kind.group(1)), source.all, re.S)
        members = re.findall(r"(\w+)(?=\s*[,;])", struct.group(1)) if struct else []
        place = before.count(",")
        return place < len(members) and source.is_asked_for_truth(members[place], m.function)
    name = re.search(r"(\w+)(?:\[[^]]*\])? \|?= (?:[^=;,]* [?:] )?$", before)
    chain = re.search(r"[^=!<>]= [^=;]*=", re.split(r"[;{}]", before)[-1])  # every name in it would have to be asked so
    return bool(name) and not chain and source.is_asked_for_truth(name.group(1), m.function)


def sign(source, m):
    """A status is asked for its sign, and no status is 1 or -1: status < -1 is status < 0.  A quotient is asked for its sign: the
    product has the same."""
    if (m.part, m.by) == ("/", "*"):
        factor = r"[\w.>-]+"
        return bool(re.search(r"(?:[(!]|&& |\|\| )%s $" % factor, source.code[m.number][:m.at]) and
                    re.match(r" %s [<>] 0[ );]" % factor, source.code[m.number][m.at + 1:]))
    if m.kind != "constant" or m.part != "0" or number(m.by) in source.statuses.values():
        return False
    asked = re.search(r"(\w+|\)) (<|>=|>|<=) $", source.code[m.number][:m.at])
    right = {"<": "(-1)", ">=": "(-1)", ">": "1", "<=": "1"}
    if not asked or right[asked.group(2)] != m.by:
        return False
    operand = source.code[m.number][:asked.end(1)]
    if operand.endswith(")"):  # a call, or (status = call)
        start = next(i for i in range(len(operand)) if operand[i] == "(" and closing(operand, i) == len(operand))
        inside = operand[start + 1:].split(" = ")[-1]
        operand = operand[:start] if re.search(r"\w$", operand[:start]) else re.split(r"\(", inside)[0]
    return source.is_status(re.search(r"\w*$", operand).group(), m.function)


def speed(source, m):
    """What chooses between two ways to the same numbers: lines that the header marks by a comment that begins with "speed"."""
    return "/* speed" in source.lines[m.number] and m.kind in ("comparison", "constant", "condition", "logic", "guard")


def rounding(source, m):
    """Below rounding: the last digits of a long constant; how many units of rounding a tolerance is, within a factor of 2."""
    code, end = source.code[m.number], m.at + len(m.part)
    if m.kind == "digit":
        old = next((n for n in re.finditer(NUMBER, code) if n.start() <= m.at < n.end()), None)
        if not old or not number(old.group()):
            return False
        changed = number(old.group()[:m.at - old.start()] + m.by + old.group()[end - old.start():])
        return abs(changed - number(old.group())) <= 2e-15 * abs(number(old.group()))
    if m.kind != "constant" or not number(m.part) or not number(m.by):
        return False
    beside = re.match(r"[uUlL]* \* \w*(?:EPS|EPSILON|ROUND|ULP)\w*", code[end:]) or re.search(r"(?:EPS|EPSILON|ROUND|ULP) \* $", code[:m.at])
    return bool(beside) and .5 <= number(m.by) / number(m.part) <= 2


NAME = r"[\w.>\[\]-]+(?:\([\w.>, -]*\))?"


def tie(source, m):
    """Equal numbers: < for <= where either way gives the same (the larger of two, a clamp), or where last bits decide (beside a
    tolerance: a named constant with a fraction, or its product)."""
    if m.kind != "comparison" or {m.part, m.by} not in ({"<", "<="}, {">", ">="}):
        return False
    code, end = source.code[m.number], m.at + len(m.part)
    left, right = re.search(r"(%s) $" % NAME, code[:m.at]), re.match(r" (%s)" % NAME, code[end:])
    if left and right:
        pair = "(?:%s|%s)" % tuple(re.escape(re.sub(r"^fabs\((.*)\)$", r"\1", side.group(1))) for side in (left, right))
        chosen = r"\? (?:copysign\()?%s(?:, \w+\))? : (?:copysign\()?%s[;,) ]|\) %s = (?:copysign\()?%s[;,]" % ((pair,) * 4)
        if re.search(chosen, code[m.at:]):
            return True
    if re.match(r" (?:%s)\b" % source.tolerances, code[end:]) or re.search(r"\b(?:%s) $" % source.tolerances, code[:m.at]):
        return True
    sides = re.split(r"&&|\|\||[?;{]", code[:m.at])[-1], re.split(r"&&|\|\||[?;:]", code[end:])[0]
    return any(re.search(r"EPSILON|\b(?:%s) \* |[*/] (?:%s)\b" % ((source.tolerances,) * 2), side) for side in sides)


def largest(source, m):
    """The largest of magnitudes begins at -1 in place of 0."""
    begun = re.search(r"\b(\w+) = $", source.code[m.number][:m.at])
    if m.kind != "constant" or (m.part, m.by) != ("0", "(-1)") or not begun:
        return False
    name = re.escape(begun.group(1))
    if not re.search(r"\bdouble\b[^;(){}]*\b%s = 0" % name, source.code[m.number]):
        return False
    grows = r"\b%s = (?:fmax|\w+__max\w*|\w+__larger)\(%s,|[><]=? %s\) %s = |\(%s < [^;]*\) %s = " % ((name,) * 6)
    set_ = re.findall(r"\b%s [-+*/|]?= [^=]" % name, source.body[m.function])
    return len(set_) == 2 and bool(re.search(grows, source.body[m.function]))


def limit(source, m):
    """How far from the largest number of a type a guard against overflow stands."""
    largest = r"(?:\(size_t\)-1|\b(?:INT|LONG|SIZE|PTRDIFF|DBL)_MAX) (?:[*/] [\w.]+ )*[*/]? ?$"
    return m.kind in ("constant", "operator") and bool(re.search(largest, source.code[m.number][:m.at]))


def room(source, m):
    """An array with more room than it needs; a named size that only arrays have."""
    code = source.code[m.number]
    name = re.search(r"\b(\w+) = [^,{}]*\+ $", code[:m.at]) if re.match(r"\s*enum \{", code) else None
    if name and m.kind == "constant" and number(m.by) > number(m.part):
        return set(re.findall(r"(.)%s(?!\w| =)" % name.group(1), source.all)) == {"["}
    declared = re.match(r"\s*(?:static |const |struct |unsigned )*(?!return|case)\w+ [^=;(]*\[", code)
    if not declared or "=" in code.replace("= {0}", "") or m.kind not in ("constant", "operator"):
        return False
    inside = code[:m.at].count("[") > code[:m.at].count("]")
    more = number(m.by) > number(m.part) if m.kind == "constant" else (m.part, m.by) in (("-", "+"), ("/", "*"))
    return inside and more


RULES = (truth, sign, speed, rounding, tie, largest, limit, room)


def rule_of(source, mutant):
    return next((rule.__name__ for rule in RULES if rule(source, mutant)), None)


# ---- building and running ----

class Judge:
    def __init__(self, header, lines):
        self.header, self.lines, self.compilers = header, lines, [QUICK, CC] if QUICK else [CC]
        self.dir = tempfile.mkdtemp(prefix="mutants")
        self.tests = []
        name = os.path.basename(header)[:-2]
        for path in sorted(glob.glob(os.path.join(TOP, "tests", "test_%s*.c" % name))):
            self.tests.append(os.path.join(self.dir, os.path.basename(path)))
            shutil.copy(path, self.tests[-1])
        if not self.tests:
            sys.exit("no tests/test_%s*.c" % name)
        self.limit = {}  # by compiler and test, in seconds; None: this compiler cannot
        self.sanitizers = self.sanitizers_of(CC)

    def compile(self, cc, where, flags, out):
        include = [where, os.path.join(where, os.path.dirname(self.header)), TOP, os.path.join(TOP, "tests"),
                   os.path.join(TOP, "examples")]
        command = cc + ["-std=c99", "-w"] + ["-I" + place for place in include] + flags
        result = subprocess.run(command + ["-o", os.path.join(where, out)], cwd=TOP, stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL, timeout=900)
        return os.path.join(where, out) if result.returncode == 0 else None

    def build(self, cc, where, test):
        flags = ["-O0"] if cc == QUICK else ["-Og"] + self.sanitizers  # gcc -O1 with both takes minutes
        return self.compile(cc, where, flags + ["-DLESS=9", test] + LIBS, "test")

    def sanitizers_of(self, cc):
        flags = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
        empty = os.path.join(self.dir, "empty.c")
        open(empty, "w").write("int main(void) { return 0; }\n")
        return flags if self.compile(cc, self.dir, flags + [empty], "empty") else []

    def run(self, program, limit, times=None):
        """How the test program ends: passed, the name of a test, or what else happened; and its seconds of processor.
        times: receives the seconds of every test."""

        def restrict():
            resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1))
            if not self.sanitizers:
                resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        environment = dict(os.environ, CMOCKA_MESSAGE_OUTPUT="TAP", ASAN_OPTIONS="detect_leaks=0:verify_asan_link_order=0:"
                           "allocator_may_return_null=1:max_allocation_size_mb=4096")
        process = subprocess.Popen(["stdbuf", "-oL", program], cwd=os.path.dirname(program), env=environment,
                                   preexec_fn=restrict, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        late = []
        watch = threading.Timer(8 * limit, lambda: (late.append(1), os.kill(process.pid, signal.SIGKILL)))
        watch.start()
        failed, last = None, time.time()
        for raw in process.stdout:
            line = raw.decode(errors="replace")
            if line.startswith("not ok") and "# SKIP" not in line:
                failed = line.split("-", 1)[-1].strip()
                os.kill(process.pid, signal.SIGKILL)
                break
            if times is not None and line.startswith("ok"):
                times[line.split("-", 1)[-1].strip()] = time.time() - last
                last = time.time()
        _, status, usage = os.wait4(process.pid, 0)
        watch.cancel()
        process.returncode = status
        process.stdout.close()
        seconds = usage.ru_utime + usage.ru_stime
        if failed:
            return failed, seconds
        if os.WIFSIGNALED(status):
            return ("time" if late or seconds > limit - 1 else "signal %d" % os.WTERMSIG(status)), seconds
        return ("passed" if os.WEXITSTATUS(status) == 0 else "exit %d" % os.WEXITSTATUS(status)), seconds

    def order(self, test, times):
        """The list of tests at the end of the file in the order of their times, where it is a list of lines."""
        text = open(test).read()
        if "int main(" not in text:
            return
        head, main = text[:text.index("int main(")], text[text.index("int main("):]
        entry = re.compile(r"^ *cmocka_unit_test\((\w+)\),\n", re.M)
        lines = sorted((times.get(m.group(1), 0), m.group()) for m in entry.finditer(re.sub(r"#if.*?#endif", "", main, flags=re.S)))
        outside = re.sub(r"#if.*?#endif\n", lambda m: m.group().replace("cmocka", "CMOCKA"), main, flags=re.S)
        outside = entry.sub("", outside).replace("CMOCKA", "cmocka")
        sorted_main, lists = re.subn(r"(\btests\[\] = \{\n)", lambda m: m.group() + "".join(line for _, line in lines), outside, count=1)
        if lists:
            open(test, "w").write(head + sorted_main)

    def prepare(self):
        """The unchanged header, by the first compiler; CC follows when something survives."""
        self.right, self.lock = os.path.join(self.dir, "right"), threading.Lock()
        os.mkdir(self.right)
        self.write(self.right, self.lines)
        self.object = self.optimised(self.right)
        spent = {test: self.time_of(self.compilers[0], test) for test in self.tests}
        if None in spent.values() and len(self.compilers) > 1:
            spent = {test: seconds or self.time_of(CC, test) for test, seconds in spent.items()}
        self.tests.sort(key=spent.get)

    def time_of(self, cc, test):
        """Time the unchanged header, and order its tests; None: tcc cannot."""
        times = {}
        program = self.build(cc, self.right, test)
        result, seconds = self.run(program, 300, times) if program else ("does not compile", 0)
        if result == "passed":
            self.limit[cc[0], test] = int(3 * seconds) + 2
            self.order(test, times)
            return seconds
        print("%s of the unchanged %s by %s: %s" % (os.path.basename(test), self.header, cc[0], result), flush=True)
        if cc == CC:
            sys.exit(1)
        self.limit[cc[0], test] = None
        return None

    def limit_of(self, cc, test):
        with self.lock:
            if (cc[0], test) not in self.limit:
                self.time_of(cc, test)
            return self.limit[cc[0], test]

    def optimised(self, where):
        """The object code of the header alone at -O2: a mutant with the same is no mutant."""
        alone = os.path.join(self.dir, "alone.c")
        if not os.path.exists(alone):
            names = sorted(set(re.findall(r"#\s*if.*\b(\w+_IMPLEMENTATION)\b", "\n".join(self.lines))))
            open(alone, "w").write("".join("#define %s\n" % name for name in names) + '#include "%s"\n' % self.header)
        program = self.compile(CC, where, ["-O2", "-c", alone], "alone.o")
        return open(program, "rb").read() if program else None

    def write(self, where, lines):
        path = os.path.join(where, self.header)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w") as f:
            f.write("\n".join(lines))

    def judge(self, mutant):
        where = tempfile.mkdtemp(dir=self.dir)
        lines = list(self.lines)
        indent = lines[mutant.number][:len(lines[mutant.number]) - len(lines[mutant.number].lstrip())]
        lines[mutant.number] = indent + mutant.new
        self.write(where, lines)
        try:
            for cc in self.compilers:
                for test in self.tests:
                    limit = self.limit_of(cc, test)
                    program = self.build(cc, where, test) if limit else None
                    if not program and cc == self.compilers[-1]:
                        return "does not compile"
                    result, _ = self.run(program, limit) if program else ("passed", 0)
                    if result != "passed":
                        return result
                if cc == self.compilers[0] and self.optimised(where) == self.object:
                    return "same code"
            return "passed"
        finally:
            shutil.rmtree(where)


def draw(rows, seed, count):
    """Lines without repetition until all have had their turn; of each a kind of change at random, and one of that kind."""
    chance = random.Random(seed)
    rows, drawn = [list(row) for row in rows], []
    while rows and len(drawn) < count:
        order = sorted(range(len(rows)), key=lambda _: chance.random())
        for k in order:
            kinds = sorted({m.kind for m in rows[k]})
            kind = kinds[int(chance.random() * len(kinds))]
            those = [m for m in rows[k] if m.kind == kind]
            drawn.append(those[int(chance.random() * len(those))])
            rows[k].remove(drawn[-1])
        rows = [row for row in rows if row]
    return drawn[:count]


def is_below(killed, total, least, is_sample):
    """Is the score below least?  Of a sample: would a header of that score do so badly in less than one of a hundred?"""
    if not is_sample:
        return 100 * killed < least * total
    p = min(least / 100, 1 - 1e-9)
    chance = sum(math.comb(total, k) * p ** k * (1 - p) ** (total - k) for k in range(killed + 1))
    return chance < .01


def options(arguments):
    option = dict(seed="1", count=100, seconds=0, jobs=2, least=0, quick=0, first=1, last=0, rules=1)
    for key, value in (a.split("=") for a in arguments):
        if key not in option:
            sys.exit("no option %s: %s" % (key, " ".join(option)))
        if value:
            option[key] = value if key == "seed" else float(value) if key == "least" else int(value)
    return option


def main():
    header = sys.argv[1]
    option = options(sys.argv[2:])
    lines, rows = mutants(os.path.join(TOP, header))
    source, last = Source(os.path.join(TOP, header)), option["last"] or len(lines)
    within = [row for row in rows if option["first"] <= row[0].number + 1 <= last]
    chosen = draw(within, option["seed"], 10 * option["count"])
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # leave no folder behind
    judge = Judge(header, lines)
    if QUICK and option["quick"]:
        judge.compilers = [QUICK]
    beside, killed, survived = collections.Counter(), 0, 0
    by_kind = collections.defaultdict(lambda: [0, 0])
    try:
        judge.prepare()
        start = time.time()
        with concurrent.futures.ThreadPoolExecutor(option["jobs"]) as pool:
            waiting, drawn, done = {}, iter(chosen), 0
            while True:
                late = option["seconds"] and time.time() - start > option["seconds"]
                while not late and len(waiting) < option["jobs"] and done + len(waiting) < option["count"]:
                    mutant = next(drawn, None)
                    if mutant is None:
                        break
                    rule = rule_of(source, mutant) if option["rules"] else None
                    if rule:
                        beside["by rule: " + rule] += 1
                        continue
                    waiting[pool.submit(judge.judge, mutant)] = mutant
                if not waiting:
                    break
                for future in concurrent.futures.wait(waiting, return_when="FIRST_COMPLETED").done:
                    mutant, result = waiting.pop(future), future.result()
                    if result in ("does not compile", "same code"):
                        beside[result] += 1
                        continue
                    done += 1
                    by_kind[mutant.kind][1] += 1
                    if result == "passed":
                        survived += 1
                        print("%s:%d: %s (%s)\n  - %s\n  + %s" % (header, mutant.number + 1, mutant.function, mutant.kind,
                                                                mutant.old, mutant.new), flush=True)
                    else:
                        killed += 1
                        by_kind[mutant.kind][0] += 1
    finally:
        shutil.rmtree(judge.dir)
    total = killed + survived
    marked = sum("/* speed" in line for line in lines)
    print("%s seed %s: %d mutants of %d changeable lines, %d marked as a matter of speed; beside them %s" %
          (header, option["seed"], total, len(within), marked,
           ", ".join("%d %s" % (n, what) for what, n in sorted(beside.items())) or "none"))
    print("  " + ", ".join("%s %d/%d" % (kind, a, b) for kind, (a, b) in sorted(by_kind.items())))
    score = 100 * killed / total if total else 100
    print("%s seed %s: %d of %d killed, %.1f %%, in %.0f s" % (header, option["seed"], killed, total, score, time.time() - start))
    return 1 if is_below(killed, total, option["least"], option["seconds"] > 0) else 0


if __name__ == "__main__":
    sys.exit(main())
