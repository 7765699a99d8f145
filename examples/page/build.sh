#!/bin/sh
# SPDX-License-Identifier: MIT
# build.sh FOLDER - page.html on standard output: the template, with the files named in it, and with FOLDER/masses.wasm
set -eu
cd "$(dirname "$0")"
awk -v folder="$1" '
    /^@include / {
        while ((got = (getline line < $2)) > 0) print line
        if (got < 0) { print "build.sh: no " $2 > "/dev/stderr"; exit 1 }
        close($2)
        next
    }
    /^@tree$/ {
        while (("sh tree.sh" | getline line) > 0) print line
        next
    }
    /@base64 / {
        match($0, /@base64 [a-z.]*/)
        name = substr($0, RSTART + 8, RLENGTH - 8)
        printf "%s", substr($0, 1, RSTART - 1)
        command = "base64 <\"" folder "/" name "\" | tr -d \"\\n\""
        command | getline text
        close(command)
        print text substr($0, RSTART + RLENGTH)
        next
    }
    { print }' page.html
