"""A NavigationVectorEnv as Stable-Baselines3's VecEnv: what has ended begins again in the same step, and the last
observation stands in its info as "terminal_observation".

    from stable_baselines3 import PPO
    model = PPO("MultiInputPolicy", ostium.gym.sb3.vec_env("BasicWireNav", num_envs=16))
"""

import numpy as np

from .vector import NavigationVectorEnv


def vec_env(task="BasicWireNav", num_envs=1, seed=None, **options):
    """Needs stable_baselines3."""
    from stable_baselines3.common.vec_env import VecEnv

    class Adapter(VecEnv):
        def __init__(self):
            self.inner = NavigationVectorEnv(task, num_envs, **options)
            super().__init__(num_envs, self.inner.single_observation_space, self.inner.single_action_space)
            self.actions, self._seed = None, seed

        def reset(self):
            seen, _ = self.inner.reset(seed=self._seed)
            self._seed = None
            return seen

        def step_async(self, actions):
            self.actions = actions

        def step_wait(self):
            seen, rewards, reached, truncated, _ = self.inner.step(self.actions)
            over = reached | truncated
            infos = [course.results(bool(reached[i])) for i, course in enumerate(self.inner.courses)]
            if over.any():
                for i in np.flatnonzero(over):
                    infos[i]["terminal_observation"] = {key: seen[key][i].copy() for key in seen}
                    infos[i]["TimeLimit.truncated"] = bool(truncated[i])
                seen = self.inner.begin_again(over)
            return seen, rewards.astype(np.float32), over, infos

        def close(self):
            self.inner.close()

        def seed(self, seed=None):
            self._seed = seed
            return [None if seed is None else seed + i for i in range(self.num_envs)]

        def get_attr(self, attr_name, indices=None):
            return [getattr(self.inner, attr_name)] * len(list(self._get_indices(indices)))

        def set_attr(self, attr_name, value, indices=None):
            raise NotImplementedError("environments of one batch share their attributes")

        def env_method(self, method_name, *args, indices=None, **kwargs):
            raise NotImplementedError("environments of one batch have no methods of their own")

        def env_is_wrapped(self, wrapper_class, indices=None):
            return [False] * len(list(self._get_indices(indices)))

    return Adapter()
