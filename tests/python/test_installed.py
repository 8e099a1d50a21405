"""What `cmake --install --component python` lays down, as pip does, stands alone: with all data, and to the bit."""

import os
import subprocess
import sys
from pathlib import Path

import ostium
import pytest

PROGRAM = """
import ostium
model = ostium.Model(ostium.Vessel("rca-mid-focal"), tools=[("wire", "wire-014-workhorse")], begin="RCA")
data = ostium.Data(model)
data.inputs[0] = 0.02
data.step(20)
print(data.hash(), data.input_names, ostium.cases(), ostium.instruments(), ostium.scripts())
print(ostium.run_script("rca-mid-focal", "perforation-treated", seconds=0.01)["hash"])
print(ostium.__file__)
"""


def run(package, folder):
    said = subprocess.run([sys.executable, "-c", PROGRAM], env={**os.environ, "PYTHONPATH": str(package)}, cwd=folder,
                          capture_output=True, text=True)
    assert said.returncode == 0, said.stderr
    *same, file = said.stdout.splitlines()
    assert Path(file).is_relative_to(package)
    return same


def test_what_is_installed_is_what_was_built(tmp_path):
    build = Path(ostium._ostium.__file__).parents[2]
    if not (build / "CMakeCache.txt").is_file():
        pytest.skip("this ostium is none of a build folder")
    subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", tmp_path], check=True,
                   capture_output=True)
    package = next(tmp_path.rglob("ostium/__init__.py")).parents[1]
    assert run(package, tmp_path) == run(build / "python", tmp_path)
