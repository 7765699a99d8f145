#!/bin/sh
# SPDX-License-Identifier: MIT
# coverage.sh DIRECTORY HEADER... - from the .gcov files (gcov -b -c) of many programs under DIRECTORY: which lines and branches no
# program reached, in DIRECTORY/report and on the screen, and the shares.  The counts are those that gcovr finds.
# Exit status 1 if a line is never reached, or more than 4 of 100 ways out of the conditions of a header are never taken
# (BRANCHES=96).  There is no list of exceptions: a line that nothing reaches has no place in a header.  Of the ways some stay open
# that no input takes, such as the second half of a guard; make mutants asks the same conditions by another way.
set -u
dir=$1; shift
for h; do
    awk -v name="$h" -f tests/scripts/coverage.awk "$dir"/*.gcda.d/"${h##*/}".gcov
done >"$dir/report"
grep -v '^#' "$dir/report"
sed -n 's/^# //p' "$dir/report"
awk -v least="${BRANCHES:-96}" '/^# / { lines += $4; few += $8 < least } # see the last line of coverage.awk
    END {
        if (lines) print lines " lines never reached"
        if (few) print few " headers with less than " least " % of branches"
        if (!lines && !few) print "every line reached, and at least " least " % of branches in each header"
        exit lines > 0 || few > 0
    }' "$dir/report"
