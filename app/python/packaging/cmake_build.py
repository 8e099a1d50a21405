"""How pip builds the module: CMake, the same build as app/run's, of the module's targets alone."""

import os
import subprocess
import sys
from pathlib import Path

from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[3]


class CMakeBuild(build_ext):
    def run(self):
        build = Path(self.build_temp).absolute() / "cmake"
        packages = ROOT / "app/python/ostium" if self.inplace else Path(self.build_lib).absolute() / "ostium"
        generator = ["-G", "Ninja"] if not self._lacks("ninja") else []
        options = {"CMAKE_BUILD_TYPE": "Release", "CMAKE_UNITY_BUILD": "ON", "OSTIUM_TESTS": "OFF",
                   "Python_EXECUTABLE": sys.executable, "OSTIUM_PYTHON_FOLDER": "."}
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count()))
        for command in (["cmake", "-S", str(ROOT), "-B", str(build), *generator,
                         *(f"-D{name}={value}" for name, value in options.items())],
                        ["cmake", "--build", str(build), "--target", "ostium_python", "--parallel", jobs],
                        ["cmake", "--install", str(build), "--component", "python", "--prefix", str(packages.parent)]):
            subprocess.run(command, check=True)

    @staticmethod
    def _lacks(program):
        return subprocess.run(["which", program], stdout=subprocess.DEVNULL).returncode != 0
