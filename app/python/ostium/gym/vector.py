"""Many environments in one process, as Gymnasium's vector environments: stepped by an ostium.Batch on all cores."""

import gymnasium
import numpy as np
from gymnasium.vector import VectorEnv
from gymnasium.vector.utils import batch_space

import ostium

try:
    from gymnasium.vector import AutoresetMode
except ImportError:  # Gymnasium 1.0 knows this one way and has no name for it
    AutoresetMode = None

from ostium.navigation import Course, patient, spaces_of
from .environment import require_actions, require_image, require_task, require_view


class NavigationVectorEnv(VectorEnv):
    """gymnasium.make_vec("ostium/BasicWireNav-v0", num_envs=16, threads=None, ...)

    Episodes that have ended begin again with the next step, as AutoresetMode.NEXT_STEP has it. A person of the task is
    drawn once for all (options={"person"} at a reset takes another): one batch has one vessel.
    """

    metadata = {"render_modes": [], **({"autoreset_mode": AutoresetMode.NEXT_STEP} if AutoresetMode else {})}

    def __init__(self, task="BasicWireNav", num_envs=1, image=None, actions="unit", view=None, threads=None,
                 render_mode=None):
        self.task = require_task(task)
        self.image, self.physical, self.view = require_image(image), require_actions(actions), require_view(view)
        if render_mode is not None:
            raise ValueError("vector environments are not rendered; take one environment")
        self.render_mode = None
        if num_envs < 1:
            raise ValueError(f"num_envs is {num_envs}; expected 1 or more")
        self.num_envs, self.threads = num_envs, threads
        self.single_observation_space, self.single_action_space = spaces_of(self.task, self.physical, self.image,
                                                                            gymnasium.spaces)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.batch = self._imagers = None
        self._random = [np.random.default_rng() for _ in range(num_envs)]

    def reset(self, *, seed=None, options=None):
        if seed is not None:
            seeds = [seed + i for i in range(self.num_envs)] if np.isscalar(seed) else list(seed)
            if len(seeds) != self.num_envs:
                raise ValueError(f"seed has {len(seeds)} numbers; expected {self.num_envs}")
            self._random = [np.random.default_rng(s) if s is not None else r for s, r in zip(seeds, self._random)]
        options = dict(options or {})
        person, target = options.pop("person", None), options.pop("target", None)
        if options:
            raise ValueError(f"options has {sorted(options)}; expected person, target")
        if person is None:
            # Each generator draws, as that of one environment would; the first decides.
            drawn = [random.integers(len(self.task.persons)) for random in self._random]
            person = self.task.persons[drawn[0]]
        who = patient(self.task, None if person is None else int(person))
        if self.batch is None or self.batch.model is not who.model:
            self.batch = ostium.Batch(who.model, self.num_envs, self.threads)
            self._imagers = None
        self.patient = who
        self.courses = [None] * self.num_envs
        self._over = np.zeros(self.num_envs, dtype=bool)
        for i in range(self.num_envs):
            self._begin(i, target)
        return self._observations(), self._infos(np.zeros(self.num_envs, bool), np.zeros(self.num_envs, int))

    def step(self, actions):
        try:
            return self._step(actions)
        except KeyboardInterrupt:  # some sessions may have come farther than others
            self.batch = None
            raise

    def _step(self, actions):
        if self.batch is None:
            raise RuntimeError("reset this environment before its first step")
        nan = np.zeros(self.num_envs, dtype=int)
        if np.shape(actions) != self.action_space.shape:
            raise ValueError(f"actions have shape {np.shape(actions)}; expected {self.action_space.shape}")
        actions = np.asarray(actions)
        going = ~self._over
        for i in np.flatnonzero(~going):
            self._begin(i)
        for i in np.flatnonzero(going):
            self.batch.inputs[i, self.patient.driven], nan[i] = self.courses[i].drives(actions[i], self.physical)
        self.batch.step(self.patient.hops, mask=going)
        rewards = np.zeros(self.num_envs)
        reached, truncated = np.zeros(self.num_envs, bool), np.zeros(self.num_envs, bool)
        peaks, phases = self.batch.peaks[:, self.patient.felt, 2].max(axis=1), self.batch.phases
        for i in np.flatnonzero(going):
            course = self.courses[i]
            rewards[i], reached[i], truncated[i], _ = course.see(*self._leading(i), phases[i],
                                                                 float(peaks[i]), self.batch.signals[i])
        self._over = reached | truncated
        return self._observations(), rewards, reached, truncated, self._infos(reached, nan)

    def begin_again(self, over):
        """Begins the episodes that are over, now rather than with the next step; -> the observations."""
        for i in np.flatnonzero(over):
            self._begin(i)
        self._over = self._over & ~over
        return self._observations()

    def close(self, **kwargs):
        self.batch = None

    def _begin(self, i, target=None):
        if self._imagers is not None:
            self._imagers[i].reset()
        random, only = self._random[i], np.arange(self.num_envs) == i
        self.batch.reset(i)
        self.patient.begin(lambda to: self.batch.reset(i, to), lambda steps: self.batch.step(steps, mask=only), random)
        self.courses[i] = Course(self.task, self.patient, random, *self._leading(i), target)

    def _leading(self, i):
        return self.batch.nodes(i, self.patient.leader), self.batch.tips[i, self.patient.led]

    def _observations(self):
        names = [name for name, _ in self.task.tools]
        each = [course.observation([self.batch.nodes(i, name) for name in names],
                                   self.batch.signals[i, self.patient.inserted])
                for i, course in enumerate(self.courses)]
        if self.image:
            if self._imagers is None:
                self._imagers = [ostium.Imager(self.batch.model, view=self.view, pixels=self.image, field=0.3)
                                for _ in range(self.num_envs)]
            for i, one in enumerate(each):
                one["image"] = self._imagers[i].frame(self.batch.data(i))[:, :, None]
        return {key: np.stack([one[key] for one in each]) for key in each[0]}

    def _infos(self, reached, nan):
        info = {}
        for i, course in enumerate(self.courses):
            one = course.results(bool(reached[i]))
            one.update(left_m=course.left_m, target=course.target, nan_actions=int(nan[i]))
            info = self._add_info(info, one, i)
        return info
