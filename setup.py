"""How pip builds the Python module: by CMake, its own targets alone. What the package is stands in pyproject.toml."""

import os
import subprocess
import sys
from pathlib import Path
from shutil import which

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    """`cmake --install --component python`, into the package that is being made."""

    def build_extension(self, extension):
        package = Path(self.get_ext_fullpath(extension.name)).absolute().parent
        build = Path(self.build_temp).absolute()
        options = {
            "CMAKE_BUILD_TYPE": "Release",
            "CMAKE_UNITY_BUILD": "ON",
            "OSTIUM_PROGRAM": "OFF",
            "OSTIUM_MPI": "OFF",
            "OSTIUM_DICOM": "OFF",
            "Python_EXECUTABLE": sys.executable,
            "OSTIUM_PYTHON_FOLDER": ".",
        }
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count()))
        for command in (
            ["cmake", "-S", ROOT, "-B", build, *(["-G", "Ninja"] if which("ninja") else []),
             *(f"-D{name}={value}" for name, value in options.items())],
            ["cmake", "--build", build, "--target", "ostium_python", "--parallel", jobs],
            ["cmake", "--install", build, "--component", "python", "--prefix", package.parent],
        ):
            subprocess.run([str(word) for word in command], check=True)
        # What is missing in a shared object shows only when it is loaded.
        subprocess.run([sys.executable, "-c", "import _ostium"], check=True, cwd=package)


setup(ext_modules=[Extension("ostium._ostium", [])], cmdclass={"build_ext": CMakeBuild})
