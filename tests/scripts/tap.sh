# SPDX-License-Identifier: MIT
# tap.sh COMMAND... - cmocka 1.1.5 reports a skipped test as "not ok # SKIP", which prove takes for a failure.
{ "$@"; echo "# exit $?"; } | sed -e 's/^not ok \([0-9]* # SKIP\)/ok \1/' -e 's/^# exit [1-9].*/not ok 99999 Bail out! &/'
