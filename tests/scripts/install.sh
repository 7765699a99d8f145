#!/bin/sh
# SPDX-License-Identifier: MIT
# install.sh - make install into a temporary directory, and consumers that find it by pkg-config, by CMake's find_package
# and, without installing, by CMake's add_subdirectory and FetchContent.  Prints TAP; reads CC, CXX.
set -u
cc=${CC:-cc} cxx=${CXX:-c++}
top=$(cd "$(dirname "$0")/../.." && pwd)
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1
name=waveform_iqn_rk
series=$(awk '/^#define WF_VERSION/ { printf "%d.%d", $3 / 10000, $3 / 100 % 100 }' "$top/waveform.h")
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
#define RK_PROOF_IMPLEMENTATION
#include <rk_proof.h>

int main(void)
{
    const rk_table *T = rk_find("rk4");
    if (wf_linked_version() != WF_VERSION || iqn_linked_version() != IQN_VERSION) return 1;
    return T && rk_check(T, NULL) == RK_OK ? 0 : 2;
}
END
cp consumer.c consumer.cc

check 'make install with DESTDIR and PREFIX' make -s -C "$top" install DESTDIR="$dir/stage" PREFIX=/opt/kit
for file in include/waveform.h include/iqn.h include/rk.h include/rk_proof.h lib/pkgconfig/$name.pc lib/cmake/$name/$name-config.cmake; do
    check "$file is there" test -s "stage/opt/kit/$file"
done
mkdir readonly && cp -r "$top/Makefile" "$top"/*.h "$top/tests" "$top/examples" readonly && chmod -R a-w readonly
check 'a second make install, from a read-only tree' make -s -C readonly install DESTDIR="$dir/stage" PREFIX=/opt/kit
check 'its owner may write what was installed' sh -c '[ "$(ls -l stage/opt/kit/include/*.h | cut -c1-10 | sort -u)" = -rw-r--r-- ]'
chmod -R u+w readonly
check 'nothing refers to where it was staged' sh -c "! grep -r '$dir' stage/opt/kit/lib"
mv stage/opt/kit moved
sed 's/^#define RK_VERSION .*/#define RK_VERSION 99/; s/RK_VERSION != [0-9]*/RK_VERSION != 99/' moved/include/rk.h >rk.h
check 'rk_proof.h beside a rk.h of another version is refused by a sentence' sh -c "
    ! $cc -std=c99 -I. -Imoved/include -c consumer.c -o other.o 2>refused && grep -q 'rk_proof.h and rk.h are of different versions' refused"
rm rk.h

if command -v pkg-config >/dev/null; then
    PKG_CONFIG_PATH=$dir/moved/lib/pkgconfig
    export PKG_CONFIG_PATH
    check 'pkg-config knows the version' sh -c "test \"\$(pkg-config --modversion $name)\" = \"\$(awk '/^#define WF_VERSION/ { printf \"%d.%d.%d\", \$3 / 10000, \$3 / 100 % 100, \$3 % 100 }' '$top/waveform.h')\""
    check 'C consumer by pkg-config' sh -c "$cc -std=c99 \$(pkg-config --cflags $name) consumer.c -o by_pkg \$(pkg-config --libs $name) && ./by_pkg"
    check 'C++ consumer by pkg-config' sh -c "$cxx \$(pkg-config --cflags $name) consumer.cc -o by_pkgxx \$(pkg-config --libs $name) && ./by_pkgxx"
else
    skip 'consumers by pkg-config' pkg-config
fi

# Three ways to the target, in a C project and in a C++ project: only the lines that find it differ.
consumer() { # consumer WAY LANGUAGE SUFFIX COMPILER LINES...
    way=$1 language=$2 suffix=$3 compiler=$4
    shift 4
    mkdir -p "$way$suffix/b"
    cp "consumer.$suffix" "$way$suffix"
    {
        printf '%s\n' 'cmake_minimum_required(VERSION 3.18)' "project(consumer $language)" "$@"
        printf '%s\n' "add_executable(consumer consumer.$suffix)" "target_link_libraries(consumer $name::$name)"
    } >"$way$suffix/CMakeLists.txt"
    check "$language consumer by $way" sh -c "
        cmake -S $way$suffix -B $way$suffix/b -DCMAKE_${language}_COMPILER=$compiler -DCMAKE_PREFIX_PATH='$dir/moved' &&
        cmake --build $way$suffix/b && $way$suffix/b/consumer"
}
three_ways() { # three_ways LANGUAGE SUFFIX COMPILER
    consumer find_package "$@" "find_package($name $series REQUIRED)"
    consumer add_subdirectory "$@" "add_subdirectory(\"$top/examples/cmake\" kit)"
    consumer FetchContent "$@" 'include(FetchContent)' \
        "FetchContent_Declare($name SOURCE_DIR \"$top\" SOURCE_SUBDIR examples/cmake)" "FetchContent_MakeAvailable($name)"
}
if command -v cmake >/dev/null; then
    three_ways C c "$cc"
    three_ways CXX cc "$cxx"
    check 'two ways at once' sh -c "echo 'find_package($name REQUIRED)' >>FetchContentc/CMakeLists.txt &&
        cmake -S FetchContentc -B FetchContentc/b -DCMAKE_PREFIX_PATH='$dir/moved'"
    asked_for() { # asked_for VERSION: does find_package take what is installed for it?
        sed -i "s/find_package.*/find_package($name $1 REQUIRED)/" find_packagec/CMakeLists.txt
        rm -rf find_packagec/other
        cmake -S find_packagec -B find_packagec/other -DCMAKE_PREFIX_PATH="$dir/moved"
    }
    refused() { ! asked_for "$1"; }
    minor=${series#*.}
    check 'any version is found' asked_for ''
    check "$series.0 is found" asked_for "$series.0"
    for other in "${series%.*}.$((minor - 1))" "${series%.*}.$((minor + 1))" "$series.99" "$((${series%.*} + 1))" "${series%.*}"; do
        check "asked for $other, $series is not found" refused "$other"
    done
    # The recipes: vcpkg's port with its two functions written here, Conan's by Conan.
    cat >port.cmake <<END
set(VERSION $(sed -n 's/.*"version-semver": "\(.*\)".*/\1/p' "$top/examples/cmake/vcpkg/waveform-iqn-rk/vcpkg.json"))
set(CURRENT_PACKAGES_DIR "$dir/port")
function(vcpkg_install_copyright)
  cmake_parse_arguments(_a "" "" FILE_LIST \${ARGN})
  file(INSTALL \${_a_FILE_LIST} DESTINATION "$dir/port/share/waveform-iqn-rk" RENAME copyright)
endfunction()
include("$top/examples/cmake/vcpkg/waveform-iqn-rk/portfile.cmake")
END
    check 'vcpkg: the port installs' sh -c "cmake -P port.cmake && test -s port/include/rk.h && test -s port/share/waveform-iqn-rk/copyright"
    check 'vcpkg: its version is that of the headers' grep -q "\"version-semver\": \"$(awk '/^#define WF_VERSION/ { printf "%d.%d.%d", $3 / 10000, $3 / 100 % 100, $3 % 100 }' "$top/waveform.h")\"" "$top/examples/cmake/vcpkg/waveform-iqn-rk/vcpkg.json"
    mkdir find_packagec/port
    sed -i "s/find_package.*/find_package($name $series REQUIRED)/" find_packagec/CMakeLists.txt
    check 'vcpkg: a consumer' sh -c "cmake -S find_packagec -B find_packagec/port -DCMAKE_PREFIX_PATH='$dir/port' &&
        cmake --build find_packagec/port && find_packagec/port/consumer && grep -q '$dir/port' find_packagec/port/CMakeCache.txt"
    if command -v conan >/dev/null; then
        export CONAN_HOME="$dir/conan"
        printf '[requires]\nwaveform-iqn-rk/[~%s]\n[generators]\nCMakeDeps\nCMakeToolchain\n' "$series" >conanfile.txt
        check 'Conan: the recipe' sh -c "conan profile detect && conan create '$top/examples/cmake' -nr"
        check 'Conan: a consumer' sh -c "conan install . -nr -of deps && cmake -S find_packagec -B find_packagec/conan \
            -DCMAKE_TOOLCHAIN_FILE='$dir/deps/conan_toolchain.cmake' -DCMAKE_BUILD_TYPE=Release &&
            cmake --build find_packagec/conan && find_packagec/conan/consumer"
    else
        skip 'Conan: the recipe' conan
    fi
else
    skip 'consumers by CMake' cmake
fi

cp "$top"/waveform.h "$top"/iqn.h "$top"/rk.h "$top"/examples/rk_proof.h .
check 'headers merely copied' sh -c "$cc -std=c99 -I. consumer.c -o copied -lm && ./copied"
check 'copied headers compile without LAPACK' sh -c "! nm -u copied | grep -E 'dge|dpo|dtr|dsy|dgb'"
echo "1..$count"
