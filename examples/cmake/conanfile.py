# SPDX-License-Identifier: MIT
"""A Conan 2 recipe, used from a clone as it is:  conan create examples/cmake

then in a project  requires = "waveform-iqn-rk/[~0.3]",  and in CMake find_package(waveform_iqn_rk)."""
import os
import re

from conan import ConanFile
from conan.tools.files import copy, load


class WaveformIqnRk(ConanFile):
    name = "waveform-iqn-rk"
    description = "Waveforms in time, interface quasi-Newton acceleration and Runge-Kutta tables"
    license = "MIT"
    package_type = "header-library"
    settings = "os"  # for libm alone: the package is the same everywhere
    no_copy_source = True
    files = "waveform.h", "iqn.h", "rk.h", "examples/rk_proof.h", "LICENSE"

    def set_version(self):
        top = os.path.join(self.recipe_folder, "..", "..")
        number = int(re.search(r"#define WF_VERSION (\d+)", load(self, os.path.join(top, "waveform.h"))).group(1))
        self.version = f"{number // 10000}.{number // 100 % 100}.{number % 100}"

    def export_sources(self):
        for name in self.files:
            copy(self, name, os.path.join(self.recipe_folder, "..", ".."), self.export_sources_folder)

    def package_id(self):
        self.info.clear()

    def package(self):
        copy(self, "*.h", self.source_folder, os.path.join(self.package_folder, "include"), keep_path=False)
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        self.cpp_info.bindirs = self.cpp_info.libdirs = []
        self.cpp_info.set_property("cmake_file_name", "waveform_iqn_rk")
        self.cpp_info.set_property("cmake_target_name", "waveform_iqn_rk::waveform_iqn_rk")
        if self.settings.os != "Windows":
            self.cpp_info.system_libs = ["m"]
