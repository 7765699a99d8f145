#!/bin/sh
# SPDX-License-Identifier: MIT
# petsc_snes.sh - petsc_snes.c as a library, loaded into PETSc's own tutorials, which are compiled as they are: iterations of
# -snes_type iqn beside -snes_type anderson with as many columns, on 1, 2 and 4 ranks.  A long run with few columns is chaotic:
# 309 to 538 iterations for inputs that differ by 1e-13, so the mean of six such inputs is judged.  Builds here; reads CFLAGS.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
tutorials=$1
warn='-Wall -Wextra -Wconversion -Wshadow -Wdouble-promotion -Wmissing-prototypes -Werror'
flags=$(pkg-config --cflags --libs petsc)
mpicc -std=c99 $warn ${CFLAGS:--O2} -fPIC -shared -I"$here/../.." "$here/petsc_snes.c" $flags -lm -o libiqn.so
for example in ex5 ex19; do mpicc -w -O2 "$tutorials/$example.c" $flags -lm -o "snes_$example"; done
as_root=''
[ "$(id -u)" = 0 ] && mpirun --version | grep -q 'Open MPI' && as_root=--allow-run-as-root
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_btl_base_warn_component_unused=0 OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1

iterations() { # iterations RANKS PROGRAM OPTIONS...: the mean over the digits in $digits, each put for an @; nothing: one of them fails
    ranks=$1
    shift
    for digit in $digits; do
        mpirun $as_root -n "$ranks" "./snes_$1" $(echo "$@" | cut -d' ' -f2- | tr @ "$digit") -dll_append ./libiqn.so \
            -snes_max_it 1000 -snes_stol 0 -snes_converged_reason </dev/null 2>&1 |
            sed -n 's/.*solve converged.*iterations \([0-9]*\).*/\1/p' | tail -1
    done | awk -v runs="$(echo $digits | wc -w)" '{ sum += $1 } END { if (NR == runs) printf "%.0f\n", sum / NR }'
}
echo '| PETSc tutorial, columns | anderson | iqn | iqn on 2, 4 ranks |'
echo '|---|---|---|---|'
while IFS='|' read -r name columns distributed options; do
    case $options in *@*) digits='0 1 2 3 4 5' ;; *) digits=0 ;; esac
    old=$(iterations 1 $options -snes_type anderson -snes_anderson_m "$columns")
    new=$(iterations 1 $options -snes_type iqn -snes_iqn_columns "$columns")
    others=''
    for ranks in $distributed; do others="$others $(iterations "$ranks" $options -snes_type iqn -snes_iqn_columns "$columns")"; done
    echo "| $name, $columns | ${old:-fails} | ${new:-fails} |${others:- -} |"
    [ "$new" ]
    # Within a third of the framework's own method, or better; ranks differ by the rounding of sums.
    for other in $old $others; do [ $((3 * new)) -le $((4 * other + 6)) ]; done
    for other in $others; do [ $((3 * other)) -le $((4 * new + 6)) ]; done
done <<'END'
Bratu 41 x 41, x - F(x)|20|2 4|ex5 -da_grid_x 41 -da_grid_y 41 -par 6.0
Bratu 41 x 41, x - F(x)|5|2 4|ex5 -da_grid_x 41 -da_grid_y 41 -par 6.000000000000@
cavity 13 x 13, Gauss-Seidel|20||ex19 -da_refine 2 -npc_snes_type ngs -npc_snes_max_it 1 -lidvelocity 100 -grashof 1e4
cavity 13 x 13, Gauss-Seidel|5||ex19 -da_refine 2 -npc_snes_type ngs -npc_snes_max_it 1 -lidvelocity 100 -grashof 1e4
cavity 25 x 25, FAS|20||ex19 -da_refine 3 -npc_snes_type fas -npc_fas_levels_snes_type ngs -npc_fas_levels_snes_max_it 6 -npc_fas_coarse_snes_max_it 1 -lidvelocity 100 -grashof 4e4 -npc_snes_max_it 1
END
