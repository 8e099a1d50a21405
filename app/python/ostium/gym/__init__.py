"""Environments for Gymnasium (1.0 or later), registered by importing this.

    import gymnasium, ostium.gym
    env = gymnasium.make("ostium/BasicWireNav-v0")
    envs = gymnasium.make_vec("ostium/BasicWireNav-v0", num_envs=16)
"""

try:
    import gymnasium
except ImportError as missing:
    raise ImportError("ostium.gym needs gymnasium 1.0 or later: pip install gymnasium") from missing

from . import sb3
from .environment import NavigationEnv
from ostium.navigation import TASKS, Moment, Task
from .vector import NavigationVectorEnv

__all__ = ["TASKS", "Moment", "NavigationEnv", "NavigationVectorEnv", "Task", "sb3"]

for _name in TASKS:
    gymnasium.register(
        id=f"ostium/{_name}-v0",
        entry_point="ostium.gym.environment:NavigationEnv",
        vector_entry_point="ostium.gym.vector:NavigationVectorEnv",
        kwargs={"task": _name},
    )
