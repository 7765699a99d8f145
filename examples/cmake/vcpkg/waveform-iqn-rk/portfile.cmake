# SPDX-License-Identifier: MIT
# An overlay port, used from a clone as it is:  vcpkg install waveform-iqn-rk --overlay-ports=CLONE/examples/cmake/vcpkg
# For a registry, vcpkg_from_github(...) sets SOURCE_PATH instead.
if(NOT DEFINED SOURCE_PATH)
  get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../../.." ABSOLUTE)
endif()
set(VCPKG_BUILD_TYPE release) # headers alone
file(INSTALL "${SOURCE_PATH}/waveform.h" "${SOURCE_PATH}/iqn.h" "${SOURCE_PATH}/rk.h" "${SOURCE_PATH}/examples/rk_proof.h" DESTINATION "${CURRENT_PACKAGES_DIR}/include")

# The target, with the headers' place in the package, and its version
set(_config "${CURRENT_PACKAGES_DIR}/share/waveform_iqn_rk")
file(READ "${SOURCE_PATH}/examples/cmake/CMakeLists.txt" _text)
string(REPLACE "{CMAKE_CURRENT_LIST_DIR}/../.." "{CMAKE_CURRENT_LIST_DIR}/../../include" _text "${_text}")
file(WRITE "${_config}/waveform_iqn_rk-config.cmake" "${_text}")
include(CMakePackageConfigHelpers)
write_basic_package_version_file("${_config}/waveform_iqn_rk-config-version.cmake" VERSION "${VERSION}"
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
