#!/bin/sh
# SPDX-License-Identifier: MIT
# install.sh - make install into a temporary directory, and consumers that find it by pkg-config, by CMake's find_package
# and, without installing, by CMake's FetchContent.  Prints TAP; reads CC, CXX.
set -u
cc=${CC:-cc} cxx=${CXX:-c++}
top=$(cd "$(dirname "$0")/../.." && pwd)
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1
name=waveform_iqn_rk
count=0

check() { # check NAME COMMAND...: ok when the command succeeds
    what=$1
    shift
    count=$((count + 1))
    if "$@" >log 2>&1; then echo "ok $count - $what"; else
        echo "not ok $count - $what"
        sed 's/^/# /' log | head -20
    fi
}
skip() {
    count=$((count + 1))
    echo "ok $count - $1 # SKIP $2 is not installed"
}

cat >consumer.c <<'END'
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include <iqn.h>
#include <rk.h>
#include <waveform.h>

int main(void) { return wf_version() == WF_VERSION && iqn_version() == IQN_VERSION && rk_find("rk4") ? 0 : 1; }
END
cp consumer.c consumer.cc

check 'make install with DESTDIR and PREFIX' make -s -C "$top" install DESTDIR="$dir/stage" PREFIX=/opt/kit
for file in include/waveform.h include/iqn.h include/rk.h lib/pkgconfig/$name.pc lib/cmake/$name/$name-config.cmake; do
    check "$file is there" test -s "stage/opt/kit/$file"
done
check 'nothing refers to where it was staged' sh -c "! grep -r '$dir' stage/opt/kit/lib"
mv stage/opt/kit moved

if command -v pkg-config >/dev/null; then
    PKG_CONFIG_PATH=$dir/moved/lib/pkgconfig
    export PKG_CONFIG_PATH
    check 'pkg-config knows the version' sh -c "test \"\$(pkg-config --modversion $name)\" = \"\$(awk '/^#define WF_VERSION/ { printf \"%d.%d.%d\", \$3 / 10000, \$3 / 100 % 100, \$3 % 100 }' '$top/waveform.h')\""
    check 'C consumer by pkg-config' sh -c "$cc -std=c99 \$(pkg-config --cflags $name) consumer.c -o by_pkg \$(pkg-config --libs $name) && ./by_pkg"
    check 'C++ consumer by pkg-config' sh -c "$cxx \$(pkg-config --cflags $name) consumer.cc -o by_pkgxx \$(pkg-config --libs $name) && ./by_pkgxx"
else
    skip 'consumers by pkg-config' pkg-config
fi

if command -v cmake >/dev/null; then
    mkdir found fetched
    cp consumer.c found
    cat >found/CMakeLists.txt <<END
cmake_minimum_required(VERSION 3.14)
project(consumer C)
find_package($name 0.1 REQUIRED)
add_executable(consumer consumer.c)
target_link_libraries(consumer $name::$name)
END
    check 'consumer by find_package' sh -c "cmake -S found -B found/b -DCMAKE_C_COMPILER=$cc -DCMAKE_PREFIX_PATH='$dir/moved' && cmake --build found/b && found/b/consumer"
    cp consumer.c fetched
    cat >fetched/CMakeLists.txt <<END
cmake_minimum_required(VERSION 3.14)
project(consumer C)
include(FetchContent)
FetchContent_Declare(kit SOURCE_DIR "$top")  # or GIT_REPOSITORY ... GIT_TAG ...
FetchContent_MakeAvailable(kit)
add_executable(consumer consumer.c)
target_include_directories(consumer PRIVATE \${kit_SOURCE_DIR})
target_link_libraries(consumer m)
END
    check 'consumer by FetchContent' sh -c "cmake -S fetched -B fetched/b -DCMAKE_C_COMPILER=$cc && cmake --build fetched/b && fetched/b/consumer"
else
    skip 'consumers by CMake' cmake
fi

cp "$top"/waveform.h "$top"/iqn.h "$top"/rk.h .
check 'headers merely copied' sh -c "$cc -std=c99 -I. consumer.c -o copied -lm && ./copied"
check 'copied headers compile without LAPACK' sh -c "! nm -u copied | grep -E 'dge|dpo|dtr|dsy|dgb'"
echo "1..$count"
