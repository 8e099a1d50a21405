import enum

import numpy as np

from . import utils  # noqa: F401


class AutoresetMode(enum.Enum):
    NEXT_STEP = "NextStep"
    SAME_STEP = "SameStep"
    DISABLED = "Disabled"


class VectorEnv:
    metadata = {}
    num_envs = 1

    def _add_info(self, vector_infos, env_info, env_num):
        for key, value in env_info.items():
            if key not in vector_infos:
                vector_infos[key] = np.zeros(self.num_envs, dtype=type(value))
                vector_infos[f"_{key}"] = np.zeros(self.num_envs, dtype=bool)
            vector_infos[key][env_num] = value
            vector_infos[f"_{key}"][env_num] = True
        return vector_infos
