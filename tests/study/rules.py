#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""rules.py [-w WORDS] [-n NAMES] [-c] - what each rule of iqn.h buys: the arena and the hosts' own loops without it.

Each row takes one rule out of a copy of iqn.h, by an edit that must meet its text once, and runs the arena's words and the
loops' words with that copy.  Printed: runs of the arena that fail, of users' jobs (told more, and synthetic ones, behind
it), the geometric mean of evaluations over those of iqn.h where both converge; hosts above 1.1 of their own loop and windows
that are given up, by the default; of 20 starts towards several fixed points those that reach one.  Reads B, CC, LDLIBS.  Some 20 seconds a row and word of the arena.
-c: only whether each edit meets its text."""
import argparse
import csv
import math
import os
import re
import subprocess
import sys

RULES = [  # name, the part of the header that says what it buys, edits: what stands there, what stands there instead
    ('1: curvature c_j', [('(drift * drift + iqn__square(m->curvature[slot]))', '(drift * drift)')]),
    ('1: drift D', [('(drift * drift + iqn__square(m->curvature[slot]))', 'iqn__square(m->curvature[slot])')]),
    ('1: noise nu', [('sum += iqn__square(q->set[IQN_NOISE_LEVEL] *', 'sum += 0 * iqn__square(q->set[IQN_NOISE_LEVEL] *')]),
    ('1: beside a block of weight 0', [('if (q->secondary && others >= q->weighted_numbers) return 0;', '')]),
    ('2: misled, c_j', [('if (iqn__is_misled(q, e)) iqn__doubt(q, m, IQN__MISLED * e->growth);', '')]),
    ('2: no answer, c_j', [('if (unanswered) iqn__distrust_past(q, &m);', '')]),
    ('3: surprise, 0.01', [('iqn__doubt(q, m, IQN__CURVATURE);', ';')]),
    ('3: third failure', [('e->wrong = e->failed &&', 'e->wrong = 0 * e->failed &&')]),
    ('3: third failure, by the slope',
     [('fabs(t) * e->gain) * q->predicted', 'fabs(t) * fmax(q->window.steepest, e->slope)) * q->predicted')]),
    ('3: contraction', [('e->wrong |= fmax', 'e->wrong |= 0 * fmax')]),
    ('3: contraction, norm does not fade', [('#define IQN__FADES 0.9 ', '#define IQN__FADES 1 ')]),
    ('3: contraction, by the last gain', [('fmax(q->recent_gain, e->gain)', 'e->gain')]),
    ('3: not below 1e-3', [('!iqn__is_deep(q);\n    e->wrong |=', '1;\n    e->wrong |=')]),
    ('4: the base may stay', [('if (!(e->growth > most) || !e->seen) return IQN__ACCEPT;', 'return IQN__ACCEPT;'),
                              ('if (iqn__is_misled(q, e)) return IQN__KEEP;', '')]),
    ('4: as many pairs as numbers', [('q->secondary || knows_all ?', 'q->secondary || (knows_all && 0) ?')]),
    ('4: growth beside a block of weight 0', [('q->secondary || knows_all ?', '(q->secondary && 0) || knows_all ?')]),
    ('5: the bracket', [('if (line->end == 0 || plain <= noise) return 0;', 'if (noise >= 0) return 0;')]),
    ('7: divided by a slope', [('> r_base ? q->slope : 1;', '> r_base ? 1 : 1;')]),
    ('7: the sign of the slope', [('IQN__ALIKE * sqrt(vv) * sqrt(ss) ? -slope', 'IQN__ALIKE * sqrt(vv) * sqrt(ss) ? slope')]),
    ('8: progress is 0.1 below 1e-3', [('#define IQN__PROGRESS_DEEP 0.1 ', '#define IQN__PROGRESS_DEEP 0.6 ')]),
    ('8: one more pair is progress', [('if (first || fallen || more ||', 'if (first || fallen || (more && 0) ||')]),
    ('8: the second start', [('patience->second_start = patience->has_started_over = 1;', 'if (may) return;'),
                             ('if (patience->has_started_over || q->window.converged',
                              'const int may = 1;\n    if (patience->has_started_over || q->window.converged')]),
    ('patience 20', [('{IQN_PATIENCE, 40,', '{IQN_PATIENCE, 20,')]),
    ('0.9 in "failure"', [('#define IQN__SLOW 0.5 ', '#define IQN__SLOW 0.9 ')]),
]


def without(name, edits, text):
    for old, new in edits:
        if text.count(old) != 1:
            sys.exit(f'rules.py: {name}: {text.count(old)} times in iqn.h: {old}')
        text = text.replace(old, new)
    return text


def build(folder, text):
    os.makedirs(folder, exist_ok=True)
    with open(f'{folder}/iqn.h', 'w') as f:
        f.write(text)
    for name in ('arena', 'loops'):
        libs = os.environ.get('LDLIBS', '-llapack -lblas').split()
        subprocess.run([os.environ.get('CC', 'cc'), '-std=c99', '-O2', '-w', f'-I{folder}', '-I.', '-o', f'{folder}/{name}',
                        f'tests/study/{name}.c', *libs, '-lm'], check=True)


def arena(folder, words):
    """By run (family, seed): class, evaluations, whether it failed; of the default"""
    runs = {}
    for word in words:
        subprocess.run([f'{folder}/arena', folder, 'alone', word], check=True, stdout=subprocess.DEVNULL)
        with open(f'{folder}/arena.csv') as f:
            for row in csv.DictReader(f):
                if row['setting'] == 'default':
                    kind = row['group'] if row['group'] in ('told', 'synthetic') else 'users'
                    runs[row['family'], row['seed']] = kind, int(row['evaluations']), int(row['failed']) > 0
    return runs


def loops(folder, words):
    above = given = hosts = windows = 0
    reached = []
    for word in words:
        out = subprocess.run([f'{folder}/loops', word], check=True, capture_output=True, text=True).stdout
        found = re.search(r'^loops of hosts, iqn\.h +above 1\.1: (\d+) of (\d+).*given up: (\d+) of (\d+)', out, re.M)
        above, hosts, given, windows = (a + int(b) for a, b in zip((above, hosts, given, windows), found.groups()))
        reached += [float(r) for line in re.findall(r'^.*  iqn\.h .*of 20\.0.*$', out, re.M) for r in re.findall(r'([\d.]+) of 20\.0', line)]
    return above, hosts, given, windows, sum(reached) / len(reached)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('-w', '--words', default='dev alpha', help='of the arena')
    parser.add_argument('-l', '--loops', default='dev', help='words of the loops')
    parser.add_argument('-n', '--names', default='', help='rows whose names hold this')
    parser.add_argument('-c', '--check', action='store_true', help='only whether each edit meets its text')
    given = parser.parse_args()
    words = given.words.split()
    text = open('iqn.h').read()
    headers = [(name, without(name, edits, text)) for name, edits in [('(nothing)', [])] + RULES]
    if given.check:
        return
    top = f'{os.environ.get("B", "build")}/rules'
    print('| without | failing: all, users, told, synthetic | evaluations: users, told, synthetic | hosts above 1.1 | given up | starts |')
    print('|---|---|---|---|---|---|', flush=True)
    base = None
    for name, changed in headers[:1] + [h for h in headers[1:] if given.names in h[0]]:
        folder = f'{top}/{re.sub("[^a-z0-9]+", "-", name.lower()).strip("-")}'
        build(folder, changed)
        runs = arena(folder, words)
        base = base or runs
        kinds = ('users', 'told', 'synthetic')
        failed = [sum(r[2] for r in runs.values() if r[0] == kind) for kind in kinds]
        ratios = []
        for kind in kinds:
            logs = [math.log(runs[k][1] / base[k][1]) for k in base
                    if base[k][0] == kind and not base[k][2] and not runs[k][2]]
            ratios.append(f'{math.exp(sum(logs) / len(logs)):.3f}')
        above, hosts, lost, windows, reached = loops(folder, given.loops.split())
        print(f'| {name} | {sum(failed)}: {", ".join(map(str, failed))} of {len(runs)} | {", ".join(ratios)} | '
              f'{above} of {hosts} | {lost} of {windows} | {reached:.2f} of 20 |', flush=True)


main()
