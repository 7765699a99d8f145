#!/bin/sh
# SPDX-License-Identifier: MIT
# goals.sh FOLDER - the last lines of make bench: which goals of speed, growth, memory and size are not met, and how many are
awk -F '\t' '
    { n++; if ($2 <= $3) met++; else open[++m] = sprintf("  %-84s %8.4g   goal %.4g", $1, $2, $3) }
    END { print ""; if (m) print "goals not met:"; for (i = 1; i <= m; i++) print open[i]
          printf "%d of %d goals met\n", met, n }' "$1/goals"
