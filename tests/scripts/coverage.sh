#!/bin/sh
# SPDX-License-Identifier: MIT
# coverage.sh DIRECTORY HEADER... - from the .gcov files (gcov -b -c) of many programs under DIRECTORY: what no program reached,
# in DIRECTORY/report and on the screen, and the shares.  Exit status 1 if more than OPEN (0) lines are neither reached nor
# explained.  The counts are those that gcovr finds.
set -u
dir=$1; shift
cp tests/unreached "$dir/explained"
grep -qw avx512f /proc/cpuinfo 2>/dev/null || cat tests/unreached.narrow >>"$dir/explained"
for h; do
    awk -v name="$h" -v explained="$dir/explained" -f tests/scripts/coverage.awk "$dir"/*.gcda.d/"$h".gcov
done >"$dir/report"
grep -v '^#' "$dir/report"
sed -n 's/^# //p' "$dir/report"
awk -v limit="${OPEN:-0}" '/^# / { exceptions += $(NF - 2); open += $NF } END { if (!open) print "100 % of lines and branches reached, or explained: " exceptions " exceptions"
     else print open " lines neither reached in full nor explained in tests/unreached; the limit is " limit
     exit open > limit }' "$dir/report"
