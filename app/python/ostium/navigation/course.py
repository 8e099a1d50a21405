"""One episode of a task: where to, how far it is, what was met on the way. Shared by all environments."""

import functools
import operator
from typing import Optional

import numpy as np

import ostium

from .tasks import Moment, Task, target_places


class Patient:
    """A person's vessel and model for a task, with what its episodes share."""

    def __init__(self, task: Task, person: Optional[int]):
        self.person = person
        self.vessel = ostium.Vessel(task.case, person=person)
        self.model = ostium.Model(self.vessel, tools=list(task.tools), begin=task.begin)
        self.targets = target_places(task, self.vessel)
        points = np.concatenate([branch["points"] for branch in self.vessel.branches])
        self.low, self.high = points.min(axis=0) - 0.02, points.max(axis=0) + 0.02
        names = self.model.input_names
        self.columns = {tool: [names.index(f"{tool}.advance_m_s"), names.index(f"{tool}.turn_rad_s")]
                        for tool, _ in task.tools}
        self.driven = [column for tool, _ in task.moved for column in self.columns[tool]]  # by actions, in their order
        if task.max_gauge_Pa > 0:
            self.driven.append(names.index("gauge_Pa"))
        self.inserted = [self.model.signal_names.index(f"{tool}.inserted_mm") for tool, _ in task.tools]
        self.leader = task.leader or task.tools[-1][0]  # and its number
        tools = [name for name, _ in task.tools]
        self.led = tools.index(self.leader)
        self.felt = [tools.index(name) for name, _ in task.moved]  # whose forces on the walls count
        self.hops = round(task.step_s / self.model.step_s)
        self.prepared = self._prepare(task) if task.prepared else None

    def _prepare(self, task):
        data = ostium.Data(self.model)
        for tool, feed, turn, seconds in task.prepared:
            data.inputs[self.columns[tool]] = feed, turn
            data.step(round(seconds / self.model.step_s))
            data.inputs[self.columns[tool]] = 0.0
        return data.get_state()

    def begin(self, reset, wait, random):
        """Brings a session to where an episode begins: by reset(seed or state), then wait(steps)."""
        if self.prepared is None:
            reset(int(random.integers(1, 2**31)))
        else:
            reset(self.prepared)
            wait(int(random.integers(1, round(60 / self.vessel.heart_rate / self.model.step_s))))

    def in_box(self, points):
        """Points as numbers from -1 to 1, within the box about the vessel."""
        return np.clip(2 * (points - self.low) / (self.high - self.low) - 1, -1, 1).astype(np.float32)


@functools.lru_cache(maxsize=32)
def patient(task: Task, person: Optional[int]) -> Patient:
    return Patient(task, person)


def points_along(nodes, along):
    """Points at distances from the tip, (len(along), 3): nodes from the base to the tip, (n, 3). Where so much of the
    tool is not in the body, its first node; zeros if nothing is."""
    if len(nodes) == 0:
        return np.zeros((len(along), 3))
    backwards = nodes[::-1]
    at = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(backwards, axis=0), axis=1))])
    return np.stack([np.interp(along, at, backwards[:, k]) for k in range(3)], axis=1)


class Course:
    """Follows one episode. `see` is called after each step of the engine's with what it came to."""

    def __init__(self, task: Task, who: Patient, random, nodes, tip, target=None):
        """`nodes`, `tip`: of the leading tool as the episode begins."""
        self.task, self.patient = task, who
        if target is None:
            branch = who.targets[random.integers(len(who.targets))]
            target = branch[random.integers(len(branch))]
        elif isinstance(target, str):
            target = who.vessel.sphere(target)
        self.target = operator.index(target)
        self.p_target = who.vessel.point(self.target)
        self.steps = 0
        self.tip = self.leading_point(nodes, tip)
        self.sphere = who.vessel.locate(self.tip)
        self.left_m = self.first_left_m = who.vessel.between(self.sphere, self.target)
        self.path_m = 0.0  # what the leading point has come along the tree, to and fro
        self.forces, self.safe_steps = [], 0
        self.last_action = np.zeros(len(who.driven), dtype=np.float32)

    def leading_point(self, nodes, tip):
        """The point that has to arrive; `tip`, which is the introducer then, while it is not in the body."""
        if len(nodes) == 0:
            return np.array(tip)
        return points_along(nodes, (self.task.lead_m,))[0]

    def see(self, nodes, tip, phase, peak_wall_N, signals):
        """`nodes`, `tip`: of the leading tool; `signals` as the model names them. -> (reward, reached, truncated, moment)."""
        v, tip = self.patient.vessel, self.leading_point(nodes, tip)
        sphere = v.locate(tip, phase)
        left = v.between(sphere, self.target)
        distance = float(np.linalg.norm(tip - v.point(self.target, phase)))
        if self.task.goal:
            reached = bool(self.task.goal(dict(zip(self.patient.model.signal_names, signals))))
        else:
            reached = distance <= self.task.reach_m
        moment = Moment(left, self.left_m - left, distance, reached, peak_wall_N)
        self.path_m += v.between(self.sphere, sphere)
        self.left_m, self.tip, self.sphere = left, tip, sphere
        self.steps += 1
        self.forces.append(peak_wall_N)
        self.safe_steps += peak_wall_N <= self.task.safe_wall_N
        return self.task.reward(moment), reached, not reached and self.steps >= self.task.steps, moment

    def results(self, reached):
        """What is reported of an episode so far."""
        most = max(self.forces, default=0.0)
        return {
            "success": bool(reached),
            "safe_success": bool(reached and most <= self.task.safe_wall_N),
            "mean_wall_N": float(np.mean(self.forces)) if self.forces else 0.0,
            "max_wall_N": float(most),
            "safe_share": self.safe_steps / self.steps if self.steps else 1.0,
            "path_ratio": self.path_m / self.first_left_m if self.first_left_m > 0 else 0.0,
            "steps": self.steps,
        }

    def observation(self, nodes, inserted_mm):
        """`nodes`: one (n, 3) for each tool; `inserted_mm`: one number each."""
        box = self.patient.in_box
        return {
            "points": box(np.stack([points_along(n, self.task.along) for n in nodes])),
            "inserted": np.clip(np.asarray(inserted_mm) / 2000, 0, 1).astype(np.float32),
            "target": box(self.p_target),
            "action": self.last_action.copy(),
        }

    def drives(self, action, physical):
        """-> (what the driven inputs become, how many numbers were NaN). Unit actions are scaled, all are clipped."""
        least, most = self.task.limits
        action = np.asarray(action, dtype=float)
        if action.shape != most.shape:
            raise ValueError(f"the action has shape {action.shape}; expected {most.shape}")
        bad = int(np.isnan(action).sum())
        action = np.nan_to_num(action, nan=0.0)
        if not physical:
            action = np.clip(action, -1, 1)  # infinity too, before it is scaled
            action = np.where(action < 0, -action * least, action * most)
        drives = np.clip(action, least, most)
        self.last_action = self.task.as_unit(drives)
        return drives, bad


def spaces_of(task: Task, physical: bool, image, spaces):
    """(observation space, action space) of one environment; `spaces` is gymnasium.spaces."""
    tools = len(task.tools)
    least, most = (limit.astype(np.float32) for limit in task.limits)
    inside = {
        "points": spaces.Box(-1.0, 1.0, (tools, len(task.along), 3), np.float32),
        "inserted": spaces.Box(0.0, 1.0, (tools,), np.float32),
        "target": spaces.Box(-1.0, 1.0, (3,), np.float32),
        "action": spaces.Box(-1.0, 1.0, most.shape, np.float32),
    }
    if image:
        inside["image"] = spaces.Box(0, 255, (image, image, 1), np.uint8)
    return spaces.Dict(inside), (spaces.Box(least, most, dtype=np.float32) if physical else
                                 spaces.Box(-1.0, 1.0, most.shape, np.float32))
