# SPDX-License-Identifier: MIT
# package.sh NAME VERSION LIBDIR - write a pkg-config file and a CMake package; both find the headers beside themselves.
set -eu
name=$1 version=$2 lib=$3
cat >"$lib/pkgconfig/$name.pc" <<END
prefix=\${pcfiledir}/../..
includedir=\${prefix}/include

Name: $name
Description: Waveforms in time, interface quasi-Newton and Runge-Kutta tables: waveform.h, iqn.h, rk.h
Version: $version
Cflags: -I\${includedir}
Libs: -lm
END
cat >"$lib/cmake/$name/$name-config.cmake" <<END
if(NOT TARGET $name::$name)
  add_library($name::$name INTERFACE IMPORTED)
  get_filename_component(_${name}_prefix "\${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
  set_target_properties($name::$name PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "\${_${name}_prefix}/include"
    INTERFACE_LINK_LIBRARIES m)
endif()
END
cat >"$lib/cmake/$name/$name-config-version.cmake" <<END
set(PACKAGE_VERSION $version)
if(PACKAGE_FIND_VERSION VERSION_GREATER PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE FALSE)
else()
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  if(PACKAGE_FIND_VERSION VERSION_EQUAL PACKAGE_VERSION)
    set(PACKAGE_VERSION_EXACT TRUE)
  endif()
endif()
END
echo "$name $version: -lm is all it needs; cc \$(pkg-config --cflags $name) ... \$(pkg-config --libs $name)"
