"""The adapter for Stable-Baselines3, on the interface of its VecEnv that its documentation promises, or on the real one."""

import dataclasses
import sys
import types
from abc import ABC, abstractmethod

import numpy as np
import ostium
import pytest
from ostium.gym import TASKS, NavigationEnv, sb3

FORWARDS = np.array([1.0, 0.1], dtype=np.float32)
SHORT = dataclasses.replace(TASKS["CrossLesion"], steps=3)


class VecEnv(ABC):
    """As far as algorithms use it."""

    def __init__(self, num_envs, observation_space, action_space):
        self.num_envs, self.observation_space, self.action_space = num_envs, observation_space, action_space
        self.render_mode, = set(self.get_attr("render_mode"))

    def step(self, actions):
        self.step_async(actions)
        return self.step_wait()

    def _get_indices(self, indices):
        return range(self.num_envs) if indices is None else [indices] if isinstance(indices, int) else indices


for _name in ("reset", "step_async", "step_wait", "close", "get_attr", "set_attr", "env_method", "env_is_wrapped"):
    setattr(VecEnv, _name, abstractmethod(lambda self, *_, **__: None))
VecEnv.__abstractmethods__ = frozenset(name for name in vars(VecEnv)
                                       if getattr(getattr(VecEnv, name), "__isabstractmethod__", False))


@pytest.fixture(autouse=True)
def baselines(monkeypatch):
    try:
        import stable_baselines3.common.vec_env  # noqa: F401
    except ImportError:
        for name in ("stable_baselines3", "stable_baselines3.common", "stable_baselines3.common.vec_env"):
            monkeypatch.setitem(sys.modules, name, types.ModuleType(name))
        sys.modules["stable_baselines3.common.vec_env"].VecEnv = VecEnv


def test_episodes_are_those_of_one_environment_and_begin_again_at_once():
    envs, env = sb3.vec_env(SHORT, num_envs=2, seed=5), NavigationEnv(SHORT)
    seen = envs.reset()
    alone, _ = env.reset(seed=6)
    assert envs.observation_space.contains({key: seen[key][1] for key in seen})
    assert all((seen[key][1] == alone[key]).all() for key in alone)
    for k in range(3):
        seen, rewards, over, infos = envs.step(np.tile(FORWARDS, (2, 1)))
        alone, reward, _, cut, info = env.step(FORWARDS)
        assert rewards.dtype == np.float32 and rewards[1] == np.float32(reward)
        assert over.tolist() == [k == 2] * 2 and infos[1]["max_wall_N"] == info["max_wall_N"]
    last = infos[1]["terminal_observation"]
    assert cut and infos[1]["TimeLimit.truncated"] and all((last[key] == alone[key]).all() for key in alone)
    begun, _ = env.reset()
    assert all((seen[key][1] == begun[key]).all() for key in begun)
    assert envs.step(np.tile(FORWARDS, (2, 1)))[3][1]["steps"] == 1


def test_what_algorithms_ask_for():
    envs = sb3.vec_env(SHORT, num_envs=2)
    assert envs.seed(7) == [7, 8]
    first, again = envs.reset(), (envs.seed(7), envs.reset())[1]
    assert all((first[key] == again[key]).all() for key in first)
    assert envs.get_attr("num_envs", 0) == [2] and envs.env_is_wrapped(object) == [False, False]
    with pytest.raises(NotImplementedError):
        envs.env_method("reset")
    envs.close()


def test_pictures_of_a_batch():
    seen = sb3.vec_env(SHORT, num_envs=2, seed=1, image=84).reset()
    assert seen["image"].shape == (2, 84, 84, 1) and seen["image"].dtype == np.uint8
    assert isinstance(ostium.gym.sb3, types.ModuleType)
