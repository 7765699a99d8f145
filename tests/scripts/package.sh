# SPDX-License-Identifier: MIT
# package.sh NAME VERSION LIBDIR - write a pkg-config file and a CMake package (examples/cmake/CMakeLists.txt
# with another path); both find the headers beside themselves.
set -eu
name=$1 version=$2 lib=$3 here=$(dirname "$0")
cat >"$lib/pkgconfig/$name.pc" <<END
prefix=\${pcfiledir}/../..
includedir=\${prefix}/include

Name: $name
Description: Waveforms in time, interface quasi-Newton and Runge-Kutta tables: waveform.h, iqn.h, rk.h
Version: $version
Cflags: -I\${includedir}
Libs: -lm
END
sed -n -e 's|/\.\./\.\.|/../../../include|' -e '1p' -e '/^if(/,$p' "$here/../../examples/cmake/CMakeLists.txt" \
    >"$lib/cmake/$name/$name-config.cmake"
cat >"$lib/cmake/$name/$name-config-version.cmake" <<END
# Below 1.0 a new minor version may rename: 0.4 is asked for as 0.4, and found as 0.4.0 or later.
set(PACKAGE_VERSION $version)
string(REGEX MATCH "^[0-9]+[.][0-9]+" _series "\${PACKAGE_VERSION}")
string(REGEX MATCH "^[0-9]+[.][0-9]+" _wanted "\${PACKAGE_FIND_VERSION}")
set(PACKAGE_VERSION_COMPATIBLE FALSE)
if("\${PACKAGE_FIND_VERSION}" STREQUAL "" OR "\${_wanted}" STREQUAL "\${_series}" AND NOT PACKAGE_FIND_VERSION VERSION_GREATER PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
if(PACKAGE_FIND_VERSION VERSION_EQUAL PACKAGE_VERSION)
  set(PACKAGE_VERSION_EXACT TRUE)
endif()
END
echo "$name $version: -lm is all it needs; cc \$(pkg-config --cflags $name) ... \$(pkg-config --libs $name)"
