#!/bin/sh
# SPDX-License-Identifier: MIT
# sundials_iqn.sh EXAMPLES - sundials_iqn.h in SUNDIALS' own examples, which are compiled as they are, but that their
# constructors SUNNonlinSol_FixedPoint and _Newton mean SUNNonlinSol_IQN: time steps, nonlinear iterations and failures beside
# SUNDIALS' own solver, and the answers compared.  Builds here; reads CC, CFLAGS.
set -eu
cc=${CC:-cc}
here=$(cd "$(dirname "$0")" && pwd)
examples=$1
for l in arkode ida cvode nvecserial sunmatrixdense sunlinsoldense sunmatrixband sunlinsolband sunlinsolspgmr sunlinsolspfgmr \
    sunlinsolspbcgs sunlinsolsptfqmr sunnonlinsolnewton sunnonlinsolfixedpoint; do libs="${libs:-} -lsundials_$l"; done

# The plug compiles under the warnings of the kit.
cat >sundials_plug.c <<'END'
#define IQN_IMPLEMENTATION
#include "iqn.h"
#include "sundials_iqn.h"
SUNNonlinearSolver plug(N_Vector y, SUNContext context);
SUNNonlinearSolver plug(N_Vector y, SUNContext context) { return SUNNonlinSol_IQN(y, 5, SUNNONLINEARSOLVER_ROOTFIND, context); }
END
$cc -std=c99 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wmissing-prototypes -Werror ${CFLAGS:--O2} -I"$here" -I"$here/../.." \
    -c sundials_plug.c -o sundials_plug.o
cat >sundials_taken.h <<'END'
#define IQN_IMPLEMENTATION
#include "sundials_iqn.h"
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#include <sunnonlinsol/sunnonlinsol_newton.h>
#define SUNNonlinSol_FixedPoint(y, m, c) SUNNonlinSol_IQN(y, (m) > 0 ? (m) : 3, SUNNONLINEARSOLVER_FIXEDPOINT, c)
#define SUNNonlinSol_Newton(y, c) SUNNonlinSol_IQN(y, 3, SUNNONLINEARSOLVER_ROOTFIND, c)
END

total() { # total FILE WORDS: the sum of what stands behind one of them
    grep -v '^At t' "$1" | grep -oE "($2) *= *[0-9]+" | awk '{ n += $NF } END { printf "%d", n }'
}
numbers() { # numbers FILE LINE FIELD...: the answer, from the last line like that
    line=$(grep -E "$2" "$1" | tail -1 | tr '=' ' ')
    shift 2
    for field; do echo "$line" | awk -v field="$field" '{ print $field }'; done
}
echo '| SUNDIALS example, solver | steps | iterations | failures | with iqn.h: steps | iterations | failures | answers differ by |'
echo '|---|---|---|---|---|---|---|---|'
before=0 after=0
while IFS='|' read -r name file answer fields; do
    row="| $name |" compiler=$cc more='' start=''
    case $file in cvode/parallel*)
        command -v mpicc >/dev/null && command -v mpirun >/dev/null || continue
        compiler=mpicc more=-lsundials_nvecparallel start='mpirun -n 2'
        [ "$(id -u)" = 0 ] && mpirun --version | grep -q 'Open MPI' && start='mpirun --allow-run-as-root -n 2' ;;
    esac
    for how in own taken; do
        [ $how = own ] && include='' || include='-include sundials_taken.h'
        $compiler -w -O2 $include -I. -I"$here" -I"$here/../.." "$examples/$file.c" $libs $more -lm -o sundials_$how
        OMPI_MCA_rmaps_base_oversubscribe=1 $start ./sundials_$how >sundials_$how.txt </dev/null 2>&1
        steps=$(total sundials_$how.txt 'Internal solver steps|^Steps|nst|Number of steps')
        iterations=$(total sundials_$how.txt 'fixed-point iterations|NLS iters|nni|Number of nonlinear iterations')
        failures=$(total sundials_$how.txt 'solver convergence failures|NLS fails|ncfn|nonlinear convergence failures')
        numbers sundials_$how.txt "$answer" $fields >sundials_$how.numbers
        row="$row $steps | $iterations | $failures |"
        [ $how = own ] && own=$iterations || taken=$iterations
    done
    difference=$(paste sundials_own.numbers sundials_taken.numbers | awk '
        { d = $1 - $2; if (d < 0) d = -d; s = $1 < 0 ? -$1 : $1; if (s > 0) d /= s; if (d > w) w = d }
        END { printf "%.0e", (NR ? w : 1) }')
    echo "$row $difference |"
    before=$((before + own)) after=$((after + taken))
    # The tolerances of these runs are 1e-3 to 1e-6.
    awk "BEGIN { exit !($difference <= 2e-3 && $taken <= 1.2 * $own) }"
done <<'END'
ARKODE brusselator, fixed point|arkode/C_serial/ark_brusselator_fp|^ +10\.0|2 3 4
IDA Roberts, Newton|ida/serial/idaRoberts_dns|^4\.0000e\+06|2 3 4
CVODE diurnal kinetics, Newton-Krylov|cvode/serial/cvKrylovDemo_ls|^c2 .bot|4 5 6
CVODE advection-diffusion on 2 ranks, fixed point|cvode/parallel/cvAdvDiff_non_p|^At t = 2.0|5
CVODE van der Pol, advection, both|cvode/serial/cvDirectDemo_ls|^ +8\.03716|3
END
echo "iterations_own $before"
echo "iterations_iqn $after"
[ $after -le $before ]
