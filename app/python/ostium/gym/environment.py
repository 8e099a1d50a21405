"""One environment, as Gymnasium has it."""

import gymnasium
import numpy as np

import ostium
from ostium.navigation import TASKS, Course, Task, patient, spaces_of


def require_task(task) -> Task:
    if isinstance(task, Task):
        return task
    if task not in TASKS:
        raise ValueError(f'there is no task "{task}"; expected one of {", ".join(TASKS)}, or a Task')
    return TASKS[task]


def require_image(image):
    if image is not None and not 84 <= image <= 512:
        raise ValueError(f"image is {image}; expected None or 84 to 512 pixels")
    return image


def require_view(view):
    if view is not None and view not in ostium.views():
        raise ValueError(f'there is no view "{view}"; expected one of {", ".join(ostium.views())}')
    return view


def require_actions(actions):
    if actions not in ("unit", "physical"):
        raise ValueError(f'actions is "{actions}"; expected "unit" or "physical"')
    return actions == "physical"


class NavigationEnv(gymnasium.Env):
    """gymnasium.make("ostium/BasicWireNav-v0", image=None, actions="unit", view=None, render_mode=None)

    image    84 to 512: the observation has an X-ray picture of so many pixels, too
    actions  "unit": -1 to 1 for each drive; "physical": m/s and rad/s
    view     of pictures: a name of `ostium views`; None: as the C-arm begins
    reset(seed, options={"person", "target", "state"}): a person's number, a place ("left carotid+20") or a sphere's
    number, a state of this environment's `data`
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 7.5}

    def __init__(self, task="BasicWireNav", image=None, actions="unit", view=None, render_mode=None, pixels=256):
        self.task = require_task(task)
        self.image, self.physical, self.view = require_image(image), require_actions(actions), require_view(view)
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f'render_mode is "{render_mode}"; expected None or "rgb_array"')
        self.render_mode, self.pixels = render_mode, pixels
        self.observation_space, self.action_space = spaces_of(self.task, self.physical, self.image,
                                                              gymnasium.spaces)
        self.data = self.course = None
        self._imagers = {}
        self._datas = {}

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        options = dict(options or {})
        person, target, state = (options.pop(key, None) for key in ("person", "target", "state"))
        if options:
            raise ValueError(f"options has {sorted(options)}; expected person, target, state")
        if person is None:
            person = self.task.persons[self.np_random.integers(len(self.task.persons))]
        who = patient(self.task, None if person is None else int(person))
        if who.person not in self._datas:
            self._datas[who.person] = ostium.Data(who.model)
        data = self._datas[who.person]
        self.data = self.course = None  # a reset that fails leaves no half of an episode to go on with
        for imager in self._imagers.values():
            imager.reset()
        data.reset()
        # Where a state is given, the seed still decides on the target, but nothing is waited for.
        who.begin(lambda to: data.reset(to) if np.isscalar(to) else data.set_state(to),
                  data.step if state is None else lambda steps: None, self.np_random)
        if state is not None:
            data.set_state(state)
        self.course = Course(self.task, who, self.np_random, data.nodes(who.leader), data.tip(who.leader), target)
        self.data = data
        return self._observation(), self._info(reached=False, nan=0)

    def step(self, action):
        if self.data is None:
            raise RuntimeError("reset this environment before its first step")
        drives, nan = self.course.drives(action, self.physical)
        self.data.inputs[self.course.patient.driven] = drives
        try:
            self.data.step(self.course.patient.hops)
        except BaseException:  # an interrupt: the episode would go on with a step that is too short
            self.data = self.course = None
            raise
        reward, reached, truncated, _ = self.course.see(*self._leading(), self.data.phase,
                                                        float(self.data.peaks[self.course.patient.felt, 2].max()),
                                                        self.data.signals)
        return self._observation(), reward, reached, truncated, self._info(reached, nan)

    def render(self):
        if self.render_mode is None:
            return None
        if self.course is None:
            raise RuntimeError("reset this environment before its first picture")
        return np.repeat(self._picture("rendered", self.pixels)[:, :, None], 3, axis=2)

    def close(self):
        self.data = self.course = None
        self._datas, self._imagers = {}, {}

    def _leading(self):
        leader = patient(self.task, self.data.model.vessel.person).leader
        return self.data.nodes(leader), self.data.tip(leader)

    def _picture(self, use, pixels):
        key = self.course.patient.person, use  # one for each: noise and lag go on from picture to picture
        if key not in self._imagers:
            # A field that shows the whole way from the arch on.
            self._imagers[key] = ostium.Imager(self.data.model, view=self.view, pixels=pixels, field=0.3)
        return self._imagers[key].frame(self.data)

    def _observation(self):
        who = self.course.patient
        seen = self.course.observation([self.data.nodes(name) for name, _ in self.task.tools],
                                       self.data.signals[who.inserted])
        if self.image:
            seen["image"] = self._picture("seen", self.image)[:, :, None]
        return seen

    def _info(self, reached, nan):
        info = self.course.results(reached)
        info.update(person=self.course.patient.person, target=self.course.target, p_target=self.course.p_target,
                    left_m=self.course.left_m, forces=self.data.forces.copy(), trouble=self.data.trouble,
                    depth_m=self.data.depth, nan_actions=nan, time_s=self.data.time)
        return info
