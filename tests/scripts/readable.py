#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""readable.py [-v] FILE... - how much a reader must hold in the head; make lint prints it, and nothing fails for it.
Of the implementation of a header, of other files all, number tables left out:

  tokens     words, numbers and signs of the code: layout, blank lines and comments cost nothing
  decisions  if, for, while, case, &&, ||, ?: per 100 statements
  big        functions with more than 10 decisions, argument checks `if (..) return X_E..;` left out
  bare       private functions of more than three lines without a sentence in front
  commas     statements with a comma operator, heads of loops left out
  words      words of comment per 100 lines of code

A number met by squeezing is a number missed.  -v names the functions and lines that are counted."""
import re
import sys

MOST = 10  # decisions
DECISION = re.compile(r"\b(?:if|for|while|case)\b|&&|\|\||\?")
ARGUMENT_CHECK = re.compile(r"if \([^;]*?\)\s*return [A-Z]+_E[A-Z]+;")
NUMBERS = re.compile(r"^(?=.*\d)[\s{}\d.,/*+eExXa-fA-F()\-]+$")
TOKEN = re.compile(r"[A-Za-z_]\w*|\d[\w.]*|[^\s\w]")
PART = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'', re.S)
DECLARATION = re.compile(
    r"\s*(?:static|const|int|double|size_t|ptrdiff_t|unsigned|char|signed|uint\w+|\w+_t|\w+__\w+|enum|struct|void)\b[^=]*\s\**\w")


def split(text):
    """The code, with comments and the insides of strings blank, and the comments with their first lines."""
    comments = []

    def blank(match):
        part = match.group()
        if part[0] == "/":
            comments.append((text.count("\n", 0, match.start()), part))
            return re.sub(r"[^\n]", " ", part)
        return "S" + re.sub(r"[^\n]", " ", part[1:])

    return PART.sub(blank, text), comments


def functions(lines):
    """name, first line, line of the opening brace, line of the closing one"""
    i = 0
    while i < len(lines):
        start = i
        i += 1
        if not re.match(r"[A-Za-z_].*\(", lines[start]):
            continue
        head = start
        while head < len(lines) and not lines[head].rstrip().endswith((";", "{")):
            head += 1
        if head == len(lines) or not lines[head].rstrip().endswith("{") or "=" in " ".join(lines[start:head + 1]):
            continue
        end = head
        while end < len(lines) and not lines[end].startswith("}"):
            end += 1
        yield re.search(r"([\w:~]+)\s*\(", lines[start]).group(1), start, head, end
        i = end + 1


def has_comma_operator(line):
    line = re.sub(r"\bfor\s*\(.*", "", line)
    inner = None
    while inner != line:  # calls, indices, initialisers
        inner, line = line, re.sub(r"\([^()]*\)|\[[^\[\]]*\]|\{[^{}]*\}", "", line)
    if "," not in line or DECLARATION.match(line):
        return False
    return re.search(r"[^=!<>]=[^=].*,.*(=|\+\+|--)", line) is not None


def implementation(text):
    """The part between the lines of X_IMPLEMENTATION, and its first line; all, where there is none."""
    begin = re.search(r"^#\s*if defined\(\w+_IMPLEMENTATION\)", text, re.M)
    if not begin:
        return text, 0
    end = re.search(r"^#endif\s*/\* \w+_IMPLEMENTATION", text[begin.start():], re.M)
    part = text[begin.start():begin.start() + end.start()] if end else text[begin.start():]
    return part, text.count("\n", 0, begin.start())


def measure(path, verbose):
    with open(path, encoding="utf8") as file:
        text, first = implementation(file.read())
    code, comments = split(text)
    lines = code.split("\n")
    kept = [line for line in lines if line.strip() and not line.lstrip().startswith("#") and not NUMBERS.match(line)]
    joined = "\n".join(kept)
    commented = {number + part.count("\n") for number, part in comments} | {number for number, _ in comments}
    big, bare, commas = [], [], []
    for name, start, head, end in functions(lines):
        body = "\n".join(lines[head:end + 1])
        decisions = len(DECISION.findall(ARGUMENT_CHECK.sub("", body)))
        if decisions > MOST:
            big.append(f"{decisions} decisions  {name} ({first + start + 1})")
        private = "_API " not in lines[start]
        if private and end - head > 4 and not commented & {start - 1, start, head}:
            bare.append(f"no sentence  {name} ({first + start + 1})")
        commas += [f"comma  {first + k + 1}: {lines[k].strip()}" for k in range(head, end) if has_comma_operator(lines[k])]
    words = sum(len(re.findall(r"\w+", part)) for _, part in comments)
    print(f"{path:24} {len(TOKEN.findall(joined)):7} {100 * len(DECISION.findall(joined)) / max(1, joined.count(';')):10.0f}"
          f" {len(big):4} {len(bare):5} {len(commas):7} {100 * words / max(1, len(kept)):6.0f}")
    if verbose:
        print("".join(f"    {line}\n" for line in big + bare + commas), end="")


def main():
    print(f"{'':24} {'tokens':>7} {'decisions':>10} {'big':>4} {'bare':>5} {'commas':>7} {'words':>6}")
    for path in sys.argv[1:]:
        if path != "-v":
            measure(path, "-v" in sys.argv)


if __name__ == "__main__":
    main()
