"""Scripts of Ostium as experts: their runs, seen as episodes of a task. A baseline, and something to learn from."""

import os
import tempfile
from dataclasses import dataclass

import numpy as np

import ostium

from .course import Course, patient
from .tasks import TASKS, Task


@dataclass(frozen=True)
class Demonstration:
    """One episode. Of `steps` steps:

    observations  steps + 1 dictionaries, as an environment gives them
    actions       (steps, numbers) from -1 to 1: the script's drives, which change every millisecond, on the mean of a step
    beyond        (steps) bool: the script drove faster, in the mean of a step, than the task allows; actions are clipped
    rewards       (steps)
    results       what an environment reports at the end, and of what: case, script, person, seed
    """

    observations: list
    actions: np.ndarray
    beyond: np.ndarray
    rewards: np.ndarray
    results: dict


def demonstrate(task, script, seed=0, person=0, target=None, seconds=0.0) -> Demonstration:
    """Plays `script` in the task's case and follows it until the task's target is reached or its steps are over.

    The script drives every millisecond, as in `ostium run`; the task only looks. task: a name or a Task that begins at
    the access; target: a place or sphere, None: drawn by the seed; seconds: simulated at most, 0: to the script's end.
    Raises ValueError where the script's tools are others than the task's, OstiumError where it cannot be played."""
    task = task if isinstance(task, Task) else TASKS[task]
    if task.begin is not None:
        raise ValueError("the task begins in an artery; scripts begin at the access")
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "run.h5")
        ostium.run_script(task.case, script, seed=seed, values={} if person is None else {"person": person},
                          seconds=seconds, recording=file)
        recording = ostium.Recording(file)
        inputs, hashes, tools = recording.inputs, recording.hashes, recording.tools
    names = [name for name, _ in task.tools]
    if list(tools) != names:
        raise ValueError(f"{script} has {', '.join(tools)}; expected the task's tools: {', '.join(names)}")
    who = patient(task, person)
    if inputs.names != who.model.input_names:
        raise ValueError(f"{script} has inputs of its own: {', '.join(inputs.names)}")
    data = ostium.Data(who.model if seed == 0 else ostium.Model(who.vessel, tools=list(task.tools), seed=seed))
    return _follow(task, who, data, inputs.numbers, hashes, target, {"script": script, "seed": seed})


def _follow(task, who, data, inputs, hashes, target, said):

    def looked():
        return course.observation([data.nodes(name) for name, _ in task.tools], data.signals[who.inserted])

    random = np.random.default_rng(said["seed"])
    course = Course(task, who, random, data.nodes(who.leader), data.tip(who.leader), target)
    least, most = task.limits
    observations, actions, beyond, rewards, reached = [looked()], [], [], [], False
    for first in range(0, len(inputs) - who.hops + 1, who.hops):
        rows = inputs[first:first + who.hops]
        peak = 0.0
        for row in rows:
            data.inputs[:] = row
            data.step()
            peak = max(peak, float(data.peaks[who.felt, 2].max()))
        drives = rows[:, who.driven].mean(axis=0)
        beyond.append(bool((drives < least - 1e-12).any() or (drives > most + 1e-12).any()))
        course.last_action = task.as_unit(np.clip(drives, least, most))
        reward, reached, cut, _ = course.see(data.nodes(who.leader), data.tip(who.leader), data.phase, peak, data.signals)
        actions.append(course.last_action)
        rewards.append(reward)
        observations.append(looked())
        if reached or cut:
            break
    if actions and data.hash() != hashes[len(actions) * who.hops - 1]:
        raise RuntimeError("the run stepped again is another one; expected the same to the bit")
    results = {"case": task.case, **said, "person": who.person, **course.results(reached)}
    return Demonstration(observations, np.array(actions), np.array(beyond), np.array(rewards), results)


def baseline(task, script, seeds=(0,), persons=(0,), target=None, seconds=0.0):
    """-> one dictionary for each person and seed: the results of `demonstrate`, to lay beside a learner's."""
    return [demonstrate(task, script, seed, person, target, seconds).results for person in persons for seed in seeds]
