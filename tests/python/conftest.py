"""What the tests of the Python module share: one vessel and model for all."""

import sys
from pathlib import Path

import pytest

try:
    import gymnasium  # noqa: F401
except ImportError:
    sys.path.insert(0, str(Path(__file__).parent / "stub"))
    import gymnasium  # noqa: F401

import ostium


def pytest_report_header():
    return f"gymnasium {gymnasium.__version__}"


@pytest.fixture(scope="session")
def vessel():
    return ostium.Vessel("rca-mid-focal")


@pytest.fixture(scope="session")
def model(vessel):
    return ostium.Model(vessel, tools=[("wire", "wire-014-workhorse")], begin="RCA")


@pytest.fixture
def data(model):
    return ostium.Data(model)
