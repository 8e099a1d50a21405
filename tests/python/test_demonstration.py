"""Scripts as experts, and the task that has more to do than to arrive."""

import dataclasses

import numpy as np
import pytest
from ostium.gym import TASKS, NavigationEnv
from ostium.navigation import demonstrate
from ostium.navigation.tasks import VACUUM_PA, treated

ARCH = dataclasses.replace(TASKS["BasicWireNav"], max_feed_m_s=0.05)


def test_a_script_is_followed_at_the_clock_of_the_task():
    # That the run stepped again is the script's, to the bit, is asked within.
    shown = demonstrate(ARCH, "aorta-arch-wire", seed=2, target="left carotid+20", seconds=1.5)
    assert shown.actions.shape == (11, 2) and len(shown.observations) == 12
    assert shown.actions[-1] == pytest.approx([1, 0], abs=0.01) and not shown.beyond.any()  # it feeds 50 mm/s
    assert (shown.observations[-1]["action"] == shown.actions[-1]).all()
    assert not shown.results["success"] and shown.results["steps"] == 11 and shown.results["seed"] == 2
    assert shown.rewards[-1] == pytest.approx(-0.005 + 0.001 * 50 * 0.132, abs=2e-3)


def test_what_the_task_cannot_do_is_said():
    slow = dataclasses.replace(ARCH, max_feed_m_s=0.035)
    shown = demonstrate(slow, "aorta-arch-wire", target="left carotid+20", seconds=0.5)
    assert shown.beyond.tolist() == [True] * 3 and shown.actions.max() == 1
    with pytest.raises(ValueError, match="expected the task's tools: guide, wire"):
        demonstrate("Engage", "aorta-arch-wire", seconds=0.2)
    with pytest.raises(ValueError, match="begins in an artery"):
        demonstrate("CrossLesion", "aorta-arch-wire")


def test_a_lesion_is_treated_where_all_of_it_is():
    good = {"stenosis_worst_percent": 12.0, "stent_margin_least_mm": 2.0, "balloon_atm": 0.0}
    assert treated(good)
    for fault in ({"stenosis_worst_percent": 20.0}, {"stent_margin_least_mm": -0.1}, {"stent_margin_least_mm": np.nan},
                  {"balloon_atm": 3.0}):
        assert not treated({**good, **fault})


def test_one_action_is_the_inflation_device():
    env = NavigationEnv("PCI")
    env.reset(seed=1)
    assert env.action_space.shape == (5,)
    gauge = env.data.model.input_names.index("gauge_Pa")
    for action, expected in ((0.5, 7 * 101325.0), (-0.25, -0.25 * VACUUM_PA)):
        seen, _, over, _, info = env.step(np.array([0, 0, 0, 0, action], dtype=np.float32))
        assert env.data.inputs[gauge] == pytest.approx(expected)
        assert seen["action"][4] == pytest.approx(action) and env.observation_space.contains(seen)
    assert not over and not info["success"]
    physical = NavigationEnv("PCI", actions="physical")
    assert physical.action_space.high[4] == pytest.approx(14 * 101325.0)
    assert physical.action_space.low[4] == pytest.approx(-VACUUM_PA)
