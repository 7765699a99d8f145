#!/bin/sh
# SPDX-License-Identifier: MIT
# fmi_reference.sh SOURCES BUILD... - modelica/Reference-FMUs through fmi.c: each co-simulation FMU alone, in the windows of
# its reference table SOURCES/NAME/NAME_out.csv, and the columns of numbers compared.  BUILD: where cmake has made fmus/*.fmu,
#
#     git clone https://github.com/modelica/Reference-FMUs && cd Reference-FMUs
#     for v in 2 3; do cmake -S . -B b$v -DFMI_VERSION=$v && make -C b$v; done
#     sh fmi_reference.sh . b2 b3
#
# Reads CC, CFLAGS; builds ./fmi here.
set -eu
cc=${CC:-cc}
here=$(cd "$(dirname "$0")" && pwd)
sources=$1
shift
[ -x ./fmi ] || $cc -std=c99 ${CFLAGS:--O2} -I"$here/../.." "$here/fmi.c" -lm -ldl -o fmi
echo '| FMU | rows | columns compared | largest difference |'
echo '|---|---|---|---|'
failed=0
for fmu in $(for build; do ls "$build"/fmus/*.fmu; done); do
    name=$(basename "$fmu" .fmu) version=$(unzip -p "$fmu" modelDescription.xml | sed -n 's/.*fmiVersion="\([0-9.]*\)".*/\1/p')
    reference=$sources/$name/${name}_out.csv
    [ -f "$reference" ] && unzip -p "$fmu" modelDescription.xml | grep -q '<CoSimulation' || continue
    described=$(unzip -p "$fmu" modelDescription.xml)
    known=0
    for column in $(sed -n '1s/^time,//p' "$reference" | tr -d '\r' | tr ',' ' '); do
        echo "$described" | grep -q "name=\"$column\"" && known=1
    done
    [ $known = 1 ] || { echo "| $name, FMI $version | its table is another FMU's | | |" && continue; }
    # the table's steps; its length may be that of an FMU that has ended itself
    stop=$(unzip -p "$fmu" modelDescription.xml | tr '\n' ' ' | sed -n 's/.*stopTime="\([^"]*\)".*/\1/p')
    windows=$(awk -F, -v stop="$stop" 'NR == 3 { printf "%d", stop / $1 + 0.5 }' "$reference")
    if ! ./fmi "$fmu" --windows "$windows" --steps 1 --stop "$stop" --csv reference.csv >reference.txt 2>&1; then
        echo "| $name, FMI $version | $(tail -1 reference.txt) | | |"
        failed=1
        continue
    fi
    row=$(awk -F, '
        function off(a, b,    d, s) { d = a - b; s = b < 0 ? -b : b; return (d < 0 ? -d : d) / (1 + s) }
        FNR == NR { if (FNR == 1) for (i = 1; i <= NF; i++) { sub(/\r/, "", $i); column[$i] = i }
                    sub(/\r/, ""); line[FNR] = $0; rows = FNR; next }
        FNR == 1 { for (i = 1; i <= NF; i++) if ($i in column) { of[i] = column[$i]; count++ } next }
        { split(line[FNR], r, ",")
          for (i in of) {
              gsub(/false/, 0, r[of[i]]); gsub(/true/, 1, r[of[i]])
              n = split(r[of[i]], a, " "); m = split($i, b, " ")
              if (n != m) worst = 1e9
              for (j = 1; j <= n; j++) { d = off(b[j], a[j]); if (d > worst) worst = d }
          } }
        END { if (FNR != rows || count < 2) worst = 1e9; printf "%d | %d | %.0e", rows - 1, count - 1, worst }' "$reference" reference.csv)
    echo "| $name, FMI $version | $row |"
    awk "BEGIN { exit !(${row##*| } <= 1e-12) }" || failed=1
done
exit $failed
