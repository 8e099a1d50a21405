import numpy as np

from .. import spaces


def batch_space(space, n):
    if isinstance(space, spaces.Dict):
        return spaces.Dict({key: batch_space(one, n) for key, one in space.spaces.items()})
    return spaces.Box(np.stack([space.low] * n), np.stack([space.high] * n), dtype=space.dtype)
