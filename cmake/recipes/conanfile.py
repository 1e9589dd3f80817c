from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load
import os
import re


class RestirRecipe(ConanFile):
    name = "restir"
    license = "MIT"
    description = "ReSTIR for any Vulkan engine"
    settings = "os", "compiler", "build_type", "arch"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": False, "fPIC": True}

    def _root(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "include/*", "lib/*", "shaders/*"):
            copy(self, pattern, self._root(), self.export_sources_folder)

    def set_version(self):
        text = load(self, os.path.join(self._root(), "include", "restir", "version.h"))
        parts = (re.search(rf"RESTIR_VERSION_{part} (\d+)", text).group(1) for part in ("MAJOR", "MINOR", "PATCH"))
        self.version = ".".join(parts)

    def config_options(self):
        if self.settings.os == "Windows":
            del self.options.fPIC

    def requirements(self):
        self.requires("vulkan-headers/1.3.239.0", transitive_headers=True)
        self.requires("glm/cci.20230113")

    def build_requirements(self):
        self.tool_requires("glslang/1.3.239.0")

    def layout(self):
        cmake_layout(self)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        for part in ("SAMPLES", "TESTS"):
            toolchain.cache_variables[f"RESTIR_{part}"] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()

    def package_info(self):
        # The package brings its own config file, which also finds the shaders.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs.append("lib/cmake/restir")
        self.cpp_info.libs = ["restir"]
