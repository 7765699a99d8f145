#!/bin/sh
# SPDX-License-Identifier: MIT
# vectors.sh - the host's code runs at its own speed after a call of ours.  A function that leaves the upper halves of the
# vector registers in use slows down all code for older processors that runs after it, until something cleans them.
# So: whatever way a function takes, the halves are clean where it returns, calls, or jumps to another function; and a
# function that uses them calls no function of its file that does not.  Read from the machine code of every header,
# gcc and clang, extern and static.  A header without the attribute "target" is for one processor throughout: two levels of
# optimisation are enough there.  At the end: the bits of these kernels.  Prints TAP; reads CC.
set -u
cc=${CC:-cc}
top=$(cd "$(dirname "$0")/../.." && pwd)
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1
count=0

if ! command -v objdump >/dev/null; then echo '1..0 # SKIP no objdump'; exit 0; fi
if ! echo '#ifndef __x86_64__
#error
#endif' | $cc -E -x c - >/dev/null 2>&1; then echo '1..0 # SKIP not an x86-64'; exit 0; fi

report() { # report OK NAME FILE: one line of TAP, and what FILE has to say about a failure
    count=$((count + 1))
    if [ "$1" = 0 ]; then echo "ok $count - $2"; else echo "not ok $count - $2"; sed 's/^/# /' "$3" | head -20; fi
}

cat >flow.awk <<'END'
# Instructions in, offences out.  Follows the one bit "upper halves in use" along every way through each function.
# f.cold and f.part.0 belong to f.
function family(name) { sub(/\.(cold|part|constprop|isra|lto_priv)[.0-9]*.*/, "", name); return name }
function offend(i, text) {
    text = where[i] ": " text ": " op[i] " " arg[i]
    if (!(text in said)) print text
    said[text] = bad = 1
}
function reach(i, state) {
    if (i > n || (i in dirty && dirty[i] >= state)) return
    dirty[i] = state
    todo[++last] = i
}
/^[0-9a-f]+ <.*>:$/ { name = $2; gsub(/[<>:]/, "", name); self = family(name); next }
/^ *[0-9a-f]+:\t/ {
    i = ++n
    address = $1
    sub(/:/, "", address)
    at[address] = i
    text = $0
    sub(/^[^\t]*\t/, "", text)
    sub(/ *[#;].*/, "", text)
    while (text ~ /^(bnd|notrack|repz?|repnz|lock|data16|cs|ds) /) sub(/^[a-z0-9]+ +/, "", text)
    op[i] = text; sub(/ .*/, "", op[i])
    arg[i] = text; if (!sub(/^[^ ]+ +/, "", arg[i])) arg[i] = ""
    where[i] = self
    if (arg[i] ~ /%[yz]mm/) uses[self]++
    if (op[i] ~ /^v/) vector[self] = 1
    if (!(self in first)) first[self] = i
    known[self] = 1
}
END {
    for (i = 1; i <= n; i++) { # an instruction that nothing seen leads to (first of a function, case of a switch) is entered clean
        target[i] = ""
        if (op[i] ~ /^(j|call)/ && arg[i] ~ /^[0-9a-f]+ </) {
            address = arg[i]
            sub(/ .*/, "", address)
            if (address in at) target[i] = at[address]
        }
        ends[i] = op[i] ~ /^(jmp|ret|ud2|hlt|iret)/
        if (target[i] != "" && where[target[i]] == where[i] && op[i] ~ /^j/) led[target[i]] = 1
        if (!ends[i] && i < n && where[i + 1] == where[i]) led[i + 1] = 1
    }
    for (i = 1; i <= n; i++) if (!(i in led)) {
        reach(i, 0)
        if (i != first[where[i]]) cases[where[i], ++many[where[i]]] = i
    }
    while (last > 0) {
        i = todo[last--]
        state = dirty[i]
        if (op[i] ~ /^vzero/) state = 0
        else if (arg[i] ~ /%[yz]mm/) state = 1
        if (op[i] ~ /^ret/ && state) offend(i, "returns with the upper halves in use")
        if (op[i] ~ /^call/) {
            if (state) offend(i, "calls with the upper halves in use")
            state = 0
        }
        if (op[i] ~ /^j/) {
            if (target[i] != "" && where[target[i]] == where[i]) reach(target[i], state)
            else if (arg[i] ~ /^\*/ && many[where[i]]) # the table of a switch: to any of its cases
                for (k = 1; k <= many[where[i]]; k++) reach(cases[where[i], k], state)
            else if (state) offend(i, "jumps away with the upper halves in use")
        }
        if (!ends[i] && i < n && where[i + 1] == where[i]) reach(i + 1, state)
    }
    for (i = 1; i <= n; i++)
        if (op[i] ~ /^(call|jmp)/ && target[i] != "" && uses[where[i]] && where[target[i]] != where[i]) {
            callee = where[target[i]]
            if (callee !~ /@plt/ && !(callee in vector)) offend(i, "uses vector registers and calls code that does not")
        }
    for (f in known) { functions++; if (uses[f]) users++ }
    print users + 0, "of", functions, "functions use them" >"summary"
    exit bad
}
END
look() { objdump -d -w --no-show-raw-insn "$1" | awk -f flow.awk >offences; } # look PROGRAM

# The judge first: functions that are right, and one for each way to be wrong.
cat >good.c <<'END'
#define USE __asm__ volatile("vaddpd %%ymm0, %%ymm0, %%ymm0" ::: "xmm0")
#define CLEAN __asm__ volatile("vzeroupper" ::: "xmm0")
extern volatile int want;
void clean(void) { USE; CLEAN; }
void both_ways(void) { if (want) { USE; CLEAN; } }
void around_a_loop(void) { int i; for (i = 0; i < want; i++) USE; CLEAN; }
END
cat >bad.c <<'END'
#define USE __asm__ volatile("vaddpd %%ymm0, %%ymm0, %%ymm0" ::: "xmm0")
#define CLEAN __asm__ volatile("vzeroupper" ::: "xmm0")
extern volatile int want;
__attribute__((noinline)) void plain(void) { want++; }
void bad_return(void) { USE; }
void bad_branch(void) { USE; if (want) CLEAN; }
void bad_call(void) { USE; plain(); CLEAN; }
void bad_tail(void) { USE; plain(); }
void bad_baseline(void) { USE; CLEAN; plain(); CLEAN; }
void bad_loop(void) { int i; CLEAN; for (i = 0; i < want; i++) USE; }
END
echo 'volatile int want; int main(void) { return 0; }' >main.c
for o in -O0 -O2; do
    $cc $o good.c main.c -o good && look good
    report $? "the judge accepts functions that clean up, $o" offences
    { $cc $o bad.c main.c -o bad && ! look bad; } && for f in return branch call tail baseline loop; do
        grep -q "^bad_$f:" offences || { echo "bad_$f is not noticed" >>offences; false; } || break
    done
    report $? "the judge names each of six that do not, $o" offences
done

compilers='' seen=''
for c in $cc gcc clang; do # each once, whatever it is called
    real=$(readlink -f "$(command -v "$c")") && case " $seen " in *" $real "*) ;; *) seen="$seen $real" compilers="$compilers $c" ;; esac
done
for h in waveform:WF iqn:IQN rk:RK; do
    file=${h%:*} prefix=${h#*:}
    levels='-O2 -O3' kinds=extern
    if grep -q 'target(' "$top/$file.h"; then levels='-O1 -O2 -O3 -Os' kinds='extern static'; fi
    printf '#define %s_IMPLEMENTATION\n#include "%s.h"\n' "$prefix" "$file" >extern.c
    $cc -I"$top" -c extern.c -o names.o
    { printf '#define %s_STATIC\n' "$prefix"; cat extern.c; echo 'const void *const used[] = {' # or nothing static is compiled
        nm names.o | awk '$2 == "T" { print "    (const void *)" $3 "," }'
        echo '    0};'; } >static.c
    for c in $compilers; do
        for o in $levels; do
            for kind in $kinds; do
                $c -std=c99 $o -I"$top" $kind.c main.c -o "$file" -lm >offences 2>&1 && look "$file"
                report $? "$file.h $kind, $c $o: $(cat summary)" offences
            done
        done
    done
done

# clang fuses products with sums by default on some processors (ARM); no macro says so there, and -U hides it here.
cat >fuses.c <<'END'
#include <string.h>
#define RK_IMPLEMENTATION
#include "rk.h"
volatile double third = 1. / 3;
int main(void)
{
    enum { STAGES = 7, MOST = 300 };
    static double y[MOST], k[STAGES * MOST], all[MOST], one[MOST];
    int n, i;
    if (third * 3 - 1 == 0) return 2; /* rounded product by product: -ffp-contract has no effect */
    for (i = 0; i < MOST; i++) y[i] = sin(3. * i);
    for (i = 0; i < STAGES * MOST; i++) k[i] = cos(2. * i);
    for (n = 1; n <= MOST; n++) {
        rk_finish(rk_find("dp5"), 0.1, n, y, k, MOST, all, NULL);
        for (i = 0; i < n; i++) rk_finish(rk_find("dp5"), 0.1, 1, y + i, k + i, MOST, one + i, NULL);
        if (memcmp(all, one, (size_t)n * sizeof *all)) return 1;
    }
    return 0;
}
END
if command -v clang >/dev/null && grep -qw fma /proc/cpuinfo 2>/dev/null; then
    clang -std=c99 -O2 -mfma -U__FMA__ -I"$top" fuses.c -o fuses -lm >offences 2>&1 && ./fuses
    report $? "rk.h, where clang fuses by default: n numbers have the bits of one after the other" offences
fi
echo "1..$count"
