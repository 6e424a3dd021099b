# SPDX-License-Identifier: MIT
import os

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, get, rmdir

required_conan_version = ">=2.0"


class AllpairsConan(ConanFile):
    name = "allpairs"
    version = "0.1.0"
    description = "Exact, deterministic broad-phase collision detection: every pair of boxes that may touch"
    license = "MIT"
    url = "https://example.org/allpairs"
    homepage = "https://example.org/allpairs"
    topics = ("collision-detection", "broad-phase", "aabb", "simd")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {
        "shared": [True, False],
        "fPIC": [True, False],
        "with_parallel": [True, False],
        "with_c": [True, False],
    }
    default_options = {"shared": False, "fPIC": True, "with_parallel": True, "with_c": False}
    implements = ["auto_shared_fpic"]

    def layout(self):
        cmake_layout(self, src_folder="src")

    def requirements(self):
        self.requires("highway/1.2.0")
        if self.options.with_parallel or self.options.with_c:
            self.requires("onetbb/2021.12.0")

    def build_requirements(self):
        self.tool_requires("cmake/[>=3.25]")

    def validate(self):
        check_min_cppstd(self, 17)

    def source(self):
        get(
            self,
            url="https://example.org/allpairs/allpairs-0.1.0.tar.gz",
            sha256="0000000000000000000000000000000000000000000000000000000000000000",
            strip_root=True,
        )

    def generate(self):
        toolchain = CMakeToolchain(self)
        values = toolchain.cache_variables
        values["ALLPAIRS_BUILD_PARALLEL"] = bool(self.options.with_parallel or self.options.with_c)
        values["ALLPAIRS_BUILD_C"] = bool(self.options.with_c)
        for name in ("BUILD_APP", "BUILD_SCENE", "BUILD_TESTS", "BUILD_EXAMPLES", "FCL", "MPI", "SOFA", "BULLET", "COAL"):
            values[f"ALLPAIRS_{name}"] = False
        toolchain.generate()
        dependencies = CMakeDeps(self)
        # Highway's recipe names its CMake package and target after itself; Highway's own names are those that Allpairs asks for.
        dependencies.set_property("highway", "cmake_file_name", "HWY")
        dependencies.set_property("highway", "cmake_target_name", "hwy::hwy")
        dependencies.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()
        rmdir(self, os.path.join(self.package_folder, "lib", "cmake"))
        rmdir(self, os.path.join(self.package_folder, "lib", "pkgconfig"))

    def add_part(self, part, library, requires):
        """A component as `allpairs::PART`, with the library of that name."""
        component = self.cpp_info.components[part]
        component.set_property("cmake_target_name", f"allpairs::{part}")
        component.set_property("pkg_config_name", library.replace("_", "-"))
        component.libs = [library]
        component.requires = requires

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "Allpairs")
        self.add_part("allpairs", "allpairs", ["highway::highway"])
        for part in ("collision", "elements", "partition", "generate"):
            self.add_part(part, f"allpairs_{part}", ["allpairs"])
        if self.options.with_parallel or self.options.with_c:
            self.add_part("parallel", "allpairs_parallel", ["allpairs", "onetbb::libtbb"])
        if self.options.with_c:
            self.add_part("c", "allpairs_c", [])
