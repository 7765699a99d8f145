# SPDX-License-Identifier: MIT
# links.sh - succeeds if LDLIBS holds a LAPACK.
dir=$(mktemp -d) && echo 'void dgetrf_(void); int main(void) { dgetrf_(); return 0; }' | "$CC" -x c - -o "$dir/a" $LDLIBS -lm 2>/dev/null
result=$?
rm -rf "$dir"
exit $result
