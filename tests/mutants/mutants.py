# SPDX-License-Identifier: MIT
"""mutants.py HEADER [seed=1] [count=100] [seconds=0] [jobs=2] [least=0] [quick=0] [first=1] [last=0]:
do the unit tests notice a wrong line?

Changes one line of the implementation half of HEADER at a time and builds that header's own unit test with it.  A mutant
is killed when a test fails, the program crashes, or it runs three times as long as the right one.  Mutants that do not
compile, and those with the same object code at -O2, do not count.  The lines and the changes are drawn by the seed.
Where tcc is installed, which compiles twenty times faster, it goes first; what survives there is built and run by CC, with
its sanitizers of addresses and undefined behaviour where it has them (make sanitize runs the unit tests so, too).
The tests run in the order of their time, the shortest first.
Runs of seconds are shortened: LESS in tests/check.h.
Those in the file "equivalent" beside this one do not count either.
Prints every survivor and the score: killed of all that count.
seconds: stop after that time.  least: exit status 1 below that score.  quick=1: what survives under tcc is not run again.
first, last: the lines that may be changed; 0: to the end.
"""
import collections
import concurrent.futures
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

Mutant = collections.namedtuple("Mutant", "number function old new kind")  # number: of the line, from 0


# ---- the source ----

def blank(text):
    """The text with comments, strings and characters replaced by spaces; every other character stays in its place."""
    pattern = r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\''
    return re.sub(pattern, lambda m: re.sub(r"[^\n]", " ", m.group()), text, flags=re.S)


def implementation(lines):
    """The range of lines between #ifdef .._IMPLEMENTATION and its #endif."""
    first = next(i for i, line in enumerate(lines) if re.match(r"#\s*if.*_IMPLEMENTATION", line))
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
                larger_array = new > int(m.group()) and re.match(r"\s*(?:static |const |struct )*\w+ [^=;(]*\[", code)
                if not larger_array:
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
            row.append(Mutant(i, names[i], lines[i].strip(), line.strip(), kind))
        if row:
            found.append(row)
    return lines, found


# ---- building and running ----

class Judge:
    def __init__(self, header, lines):
        self.header, self.lines, self.compilers = header, lines, [QUICK, CC] if QUICK else [CC]
        self.dir = tempfile.mkdtemp(prefix="mutants")
        self.test = os.path.join(self.dir, "test.c")
        shutil.copy(os.path.join(TOP, "tests", "test_%s.c" % header[:-2]), self.test)
        self.limit = {}  # by compiler, in seconds
        self.sanitizers = self.sanitizers_of(CC)

    def compile(self, cc, where, flags, out):
        command = cc + ["-std=c99", "-w", "-I" + where, "-I" + TOP, "-I" + os.path.join(TOP, "tests")] + flags
        result = subprocess.run(command + ["-o", os.path.join(where, out)], cwd=TOP, stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL, timeout=900)
        return os.path.join(where, out) if result.returncode == 0 else None

    def build(self, cc, where):
        flags = ["-O0"] if cc == QUICK else ["-Og"] + self.sanitizers  # gcc -O1 with both takes minutes
        return self.compile(cc, where, flags + ["-DLESS=9", self.test] + LIBS, "test")

    def sanitizers_of(self, cc):
        flags = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
        empty = os.path.join(self.dir, "empty.c")
        open(empty, "w").write("int main(void) { return 0; }\n")
        return flags if self.compile(cc, self.dir, flags + [empty], "empty") else []

    def run(self, cc, program, times=None):
        """How the test program ends: passed, the name of a test, or what else happened; and its seconds of processor.
        times: receives the seconds of every test."""
        limit = self.limit.get(cc[0], 300)

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

    def order(self, times):
        """The list of tests at the end of the file in the order of their times."""
        text = open(self.test).read()
        head, main = text[:text.index("int main(")], text[text.index("int main("):]
        entry = re.compile(r"^ *cmocka_unit_test\((\w+)\),\n", re.M)
        lines = sorted((times.get(m.group(1), 0), m.group()) for m in entry.finditer(re.sub(r"#if.*?#endif", "", main, flags=re.S)))
        outside = re.sub(r"#if.*?#endif\n", lambda m: m.group().replace("cmocka", "CMOCKA"), main, flags=re.S)
        outside = entry.sub("", outside).replace("CMOCKA", "cmocka")
        main = re.sub(r"(\btests\[\] = \{\n)", lambda m: m.group() + "".join(line for _, line in lines), outside, count=1)
        open(self.test, "w").write(head + main)

    def prepare(self):
        where = os.path.join(self.dir, "right")
        os.mkdir(where)
        self.write(where, self.lines)
        for cc in list(self.compilers):
            times = {}
            program = self.build(cc, where)
            result, seconds = self.run(cc, program, times) if program else ("does not compile", 0)
            if result == "passed":
                self.limit[cc[0]] = int(3 * seconds) + 2
                self.order(times)
            elif len(self.compilers) == 1:
                sys.exit("the unit test of the unchanged %s: %s" % (self.header, result))
            else:
                self.compilers.remove(cc)
        self.object = self.optimised(where)

    def optimised(self, where):
        """The object code of the header alone at -O2: a mutant with the same is no mutant."""
        alone = os.path.join(self.dir, "alone.c")
        name = {"waveform.h": "WF", "iqn.h": "IQN", "rk.h": "RK"}[self.header]
        if not os.path.exists(alone):
            open(alone, "w").write('#define %s_IMPLEMENTATION\n#include "%s"\n' % (name, self.header))
        program = self.compile(CC, where, ["-O2", "-c", alone], "alone.o")
        return open(program, "rb").read() if program else None

    def write(self, where, lines):
        with open(os.path.join(where, self.header), "w") as f:
            f.write("\n".join(lines))

    def judge(self, mutant):
        where = tempfile.mkdtemp(dir=self.dir)
        lines = list(self.lines)
        indent = lines[mutant.number][:len(lines[mutant.number]) - len(lines[mutant.number].lstrip())]
        lines[mutant.number] = indent + mutant.new
        self.write(where, lines)
        try:
            for cc in self.compilers:
                program = self.build(cc, where)
                if not program and cc == self.compilers[-1]:
                    return "does not compile"
                result, _ = self.run(cc, program) if program else ("passed", 0)
                if result != "passed":
                    return result
                if cc == self.compilers[0]:
                    if self.optimised(where) == self.object:
                        return "same code"
            return "passed"
        finally:
            shutil.rmtree(where)


def squeeze(text):
    return re.sub(r"\s+", " ", text).strip()


def equivalents(header):
    """{(function, old, new): reason}; a blank line ends an entry: header function, old, new, reason on a line each.
    Function *: in any function, and old and new are parts of the line."""
    known = {}
    for entry in open(os.path.join(HERE, "equivalent")).read().split("\n\n"):
        part = [line for line in entry.split("\n") if line and not line.startswith("#")]
        if len(part) >= 4 and part[0].split()[0] == header:
            known[part[0].split()[1], squeeze(part[1]), squeeze(part[2])] = " ".join(part[3:])
    return known


def is_known(known, mutant):
    old, new = squeeze(mutant.old), squeeze(mutant.new)
    if (mutant.function, old, new) in known:
        return True
    return any(name == "*" and new == old.replace(a, b, 1) != old for name, a, b in known)


def stale(known, rows):
    """The entries of lines that are no more."""
    now = {(m.function, squeeze(m.old), squeeze(m.new)) for row in rows for m in row}
    return [entry for entry in known if entry[0] != "*" and entry not in now]


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


def main():
    header = sys.argv[1]
    option = dict(seed=1, count=100, seconds=0, jobs=2, least=0, quick=0, first=1, last=0)
    option.update((key, int(value)) for key, value in (a.split("=") for a in sys.argv[2:] if a.split("=")[1]))
    lines, rows = mutants(os.path.join(TOP, header))
    known, last = equivalents(header), option["last"] or len(lines)
    within = [row for row in rows if option["first"] <= row[0].number + 1 <= last]
    chosen = draw(within, option["seed"], 10 * option["count"])
    judge = Judge(header, lines)
    if QUICK and option["quick"]:
        judge.compilers = [QUICK]
    tally, killed, survived, start = collections.Counter(), 0, 0, time.time()
    by_kind = collections.defaultdict(lambda: [0, 0])
    try:
        judge.prepare()
        with concurrent.futures.ThreadPoolExecutor(option["jobs"]) as pool:
            waiting, source, done = {}, iter(chosen), 0
            while True:
                late = option["seconds"] and time.time() - start > option["seconds"]
                while not late and len(waiting) < option["jobs"] and done + len(waiting) < option["count"]:
                    mutant = next(source, None)
                    if mutant is None:
                        break
                    if is_known(known, mutant):
                        tally["equivalent"] += 1
                        continue
                    waiting[pool.submit(judge.judge, mutant)] = mutant
                if not waiting:
                    break
                for future in concurrent.futures.wait(waiting, return_when="FIRST_COMPLETED").done:
                    mutant, result = waiting.pop(future), future.result()
                    if result in ("does not compile", "same code"):
                        tally[result] += 1
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
    print("%s seed %d: %d mutants of %d changeable lines; beside them %s" %
          (header, option["seed"], total, len(within), ", ".join("%d %s" % (n, what) for what, n in sorted(tally.items())) or "none"))
    print("  " + ", ".join("%s %d/%d" % (kind, a, b) for kind, (a, b) in sorted(by_kind.items())))
    for function, old, _ in stale(known, rows):
        print("equivalent: no such line in %s of %s any more: %s" % (function, header, old))
    score = 100 * killed / total if total else 100
    print("%s seed %d: %d of %d killed, %.1f %%, in %.0f s" % (header, option["seed"], killed, total, score, time.time() - start))
    return 1 if score < option["least"] else 0


if __name__ == "__main__":
    sys.exit(main())
