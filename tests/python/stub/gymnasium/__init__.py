"""The interface of Gymnasium 1.x that its documentation promises, as far as ostium.gym uses it. Debian has no package of
it: the tests run on this where the real one is not installed, and say which it was."""

import importlib

import numpy as np

from . import spaces, vector  # noqa: F401

__version__ = "stub of 1.0"


class Env:
    metadata = {"render_modes": []}
    render_mode = None
    _np_random = None

    def reset(self, *, seed=None, options=None):
        if seed is not None:
            self._np_random = np.random.default_rng(seed)

    @property
    def np_random(self):
        if self._np_random is None:
            self._np_random = np.random.default_rng()
        return self._np_random

    @property
    def unwrapped(self):
        return self

    def close(self):
        pass


_registry = {}


def register(id, entry_point=None, vector_entry_point=None, kwargs=None, **_):
    _registry[id] = entry_point, vector_entry_point, dict(kwargs or {})


def _load(name):
    module, _, attribute = name.partition(":")
    return getattr(importlib.import_module(module), attribute)


def make(id, **options):
    entry, _, own = _registry[id]
    return _load(entry)(**{**own, **options})


def make_vec(id, num_envs=1, **options):
    _, entry, own = _registry[id]
    return _load(entry)(num_envs=num_envs, **{**own, **options})
