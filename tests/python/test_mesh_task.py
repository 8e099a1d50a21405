"""stEVE's own vessel, which is no part of this project: $OSTIUM_MESHES, or shared/geometry beside this checkout."""

import dataclasses
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
from ostium.gym import TASKS, NavigationEnv

MESHES = Path(os.environ.get("OSTIUM_MESHES", Path(__file__).resolve().parents[3] / "shared/geometry"))
MESH = MESHES / "iliac-aorta-arch-carotids.obj"
OF_THE_ARCH = ("brachiocephalic", "left carotid", "left subclavian")


@pytest.mark.skipif(not MESH.exists(), reason=f"there is no {MESH}")
@pytest.mark.skipif("OSTIUM" not in os.environ, reason="the environment names no program of ours: OSTIUM=build/ostium")
def test_guide_and_wire_in_the_vessel_of_dual_device_nav(tmp_path):
    case = tmp_path / "steve"
    subprocess.run([os.environ["OSTIUM"], "import", MESH, "-o", case], check=True, capture_output=True)
    env = NavigationEnv(dataclasses.replace(TASKS["DualDeviceNav"], case=str(case), persons=(None,), targets=OF_THE_ARCH))
    hashes = []
    for _ in range(2):
        env.reset(seed=3)
        assert env.course.patient.vessel.person is None
        first_m = env.course.left_m
        for _ in range(25):
            seen, reward, over, cut, info = env.step(np.array([0.8, 0.1, 1, 0.2], np.float32))
            assert env.observation_space.contains(seen) and not (over or cut)
        hashes.append(env.data.hash())
    assert hashes[0] == hashes[1]
    assert first_m - info["left_m"] > 0.08 and info["depth_m"] < 0.2e-3
    vessel = env.course.patient.vessel
    names = [branch["name"] for branch in vessel.branches]
    assert {names[vessel.branch_of(env.reset(seed=s)[1]["target"])] for s in range(20)} == set(OF_THE_ARCH)
