#!/bin/sh
# SPDX-License-Identifier: MIT
# goals.sh FOLDER - the last lines of make bench: which goals of speed, growth, memory and size are not met, and how many are
awk -F '\t' '
    { if (!($1 in value)) name[++n] = $1; value[$1] = $2; limit[$1] = $3 } # the last measurement counts
    END { print ""
          for (i = 1; i <= n; i++) {
              if (value[name[i]] <= limit[name[i]]) { met++; continue }
              if (!open++) print "goals not met:"
              printf "  %-84s %8.4g   goal %.4g\n", name[i], value[name[i]], limit[name[i]]
          }
          printf "%d of %d goals met\n", met, n }' "$1/goals"
