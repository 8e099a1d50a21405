"""A learner small enough to read: the cross-entropy method with a linear policy, in numpy.

    python3 -m ostium.learner --out out         # some minutes on two cores; out/curve.csv, out/policy.npz, out/film.mp4
    python3 -m ostium.learner --help

Each round draws policies about the best ones so far, plays an episode with each, side by side, and moves the middle and
the spread of the drawing to the best tenth of them (Rubinstein 1999; Mannor, Rubinstein and Gat 2003).
"""

import argparse
import csv
import dataclasses
import shutil
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

import ostium
from ostium.navigation import TASKS, Course, patient


def features(seen, task):
    """What the policy looks at: where the target lies from the tip, where the tool points, a constant."""
    tip, behind = seen["points"][-1][0], seen["points"][-1][1]
    return np.concatenate([20 * (seen["target"] - tip), 20 * (tip - behind), seen["inserted"], [1.0]])


def play(task, who, policies, seeds, targets, threads=None):
    """One episode with each policy, side by side; -> (returns, successes)."""
    n = len(policies)
    batch = ostium.Batch(who.model, n, threads)
    courses = []
    for i, (seed, target) in enumerate(zip(seeds, targets)):
        random, only = np.random.default_rng(seed), np.arange(n) == i
        who.begin(lambda to: batch.reset(i, to), lambda steps: batch.step(steps, mask=only), random)
        courses.append(Course(task, who, random, batch.nodes(i, who.leader), batch.tips[i, who.led], target))
    returns, reached, going = np.zeros(n), np.zeros(n, bool), np.ones(n, bool)
    names = [name for name, _ in task.tools]
    while going.any():
        for i in np.flatnonzero(going):
            seen = courses[i].observation([batch.nodes(i, name) for name in names], batch.signals[i, who.inserted])
            batch.inputs[i, who.driven], _ = courses[i].drives(np.tanh(policies[i] @ features(seen, task)), physical=False)
        batch.step(who.hops, mask=going)
        peaks, phases = batch.peaks[:, who.felt, 2].max(axis=1), batch.phases
        for i in np.flatnonzero(going):
            reward, arrived, cut, _ = courses[i].see(batch.nodes(i, who.leader), batch.tips[i, who.led], phases[i],
                                                      peaks[i], batch.signals[i])
            returns[i] += reward
            reached[i] = arrived
            going[i] = not (arrived or cut)
    return returns, reached


def learn(task, who, rounds, drawn, random, targets, say=print):
    """-> (policy, [(round, simulated episodes, mean return, best return, share that arrived), ...])."""
    empty = np.zeros((0, 3))
    seen = Course(task, who, random, empty, who.vessel.entry).observation([empty] * len(task.tools), [0.0] * len(task.tools))
    shape = len(who.driven), len(features(seen, task))
    middle, spread = np.zeros(shape), np.ones(shape)
    curve, began = [], time.time()
    for k in range(rounds):
        policies = middle + spread * random.standard_normal((drawn, *shape))
        policies[0] = middle
        seeds = random.integers(0, 2**31, drawn)
        returns, reached = play(task, who, policies, seeds, [targets[s % len(targets)] for s in seeds])
        best = np.argsort(-returns)[:max(2, drawn // 6)]
        middle = policies[best].mean(axis=0)
        spread = np.maximum(policies[best].std(axis=0), 0.05 + 0.3 * (1 - k / rounds) * (k < rounds - 1))
        curve.append((k + 1, (k + 1) * drawn, returns.mean(), returns.max(), reached.mean()))
        say(f"round {k + 1:2d} of {rounds}: mean return {returns.mean():6.3f}, best {returns.max():6.3f}, "
            f"{reached.sum()} of {drawn} arrived, {time.time() - began:.0f} s")
    return middle, curve


def film(task, who, policy, seeds, targets, path, pixels=512):
    """Plays an episode for each seed and films them, 15 frames a second in life's time, by ffmpeg."""
    data = ostium.Data(who.model)
    imager = ostium.Imager(who.model, lao=40, pixels=pixels, field=0.2, cine=True)
    isocentre = [i for i, name in enumerate(who.model.input_names) if name.startswith("isocentre")]
    command = ["ffmpeg", "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "gray", "-s", f"{pixels}x{pixels}",
               "-r", "15", "-i", "-", "-pix_fmt", "yuv420p", str(path)]
    with subprocess.Popen(command, stdin=subprocess.PIPE) as encoder:
        for seed, target in zip(seeds, targets):
            random = np.random.default_rng(seed)
            data.reset()
            who.begin(lambda to: data.reset(to) if np.isscalar(to) else data.set_state(to), data.step, random)
            course = Course(task, who, random, data.nodes(who.leader), data.tip(who.leader), target)
            data.inputs[isocentre] = (course.p_target + course.tip) / 2
            over = False
            while not over:
                seen = course.observation([data.nodes(name) for name, _ in task.tools], data.signals[who.inserted])
                data.inputs[who.driven], _ = course.drives(np.tanh(policy @ features(seen, task)), physical=False)
                for half in (who.hops // 2, who.hops - who.hops // 2):
                    data.step(half)
                    encoder.stdin.write(imager.frame(data).tobytes())
                _, arrived, cut, _ = course.see(data.nodes(who.leader), data.tip(who.leader), data.phase,
                                                float(data.peaks[who.felt, 2].max()), data.signals)
                over = arrived or cut
        encoder.stdin.close()
    if encoder.returncode != 0:
        raise ostium.OstiumError(f"{path}: ffmpeg could not write it")


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="python3 -m ostium.learner", description=__doc__.split("\n")[0],
                                     epilog="example: python3 -m ostium.learner --task CrossLesion --target RCA+30 RCA+80 --out out")
    parser.add_argument("--task", default="CrossLesion", choices=sorted(TASKS))
    parser.add_argument("--target", default=["RCA+60"], nargs="+", help="places to reach; drawn for each episode")
    parser.add_argument("--rounds", type=int, default=12)
    parser.add_argument("--drawn", type=int, default=24, help="policies a round")
    parser.add_argument("--steps", type=int, default=80, help="of the environment, an episode at most")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=Path, default=Path("out"))
    a = parser.parse_args(arguments)
    task = dataclasses.replace(TASKS[a.task], steps=a.steps)
    who, random = patient(task, task.persons[0]), np.random.default_rng(a.seed)
    targets = [who.vessel.sphere(place) for place in a.target]
    policy, curve = learn(task, who, a.rounds, a.drawn, random, targets)
    fresh = np.arange(1000, 1020)
    returns, reached = play(task, who, [policy] * len(fresh), fresh, [targets[s % len(targets)] for s in fresh])
    print(f"the policy in {len(fresh)} fresh episodes: {reached.sum()} arrived, mean return {returns.mean():.3f}")
    a.out.mkdir(parents=True, exist_ok=True)
    with open(a.out / "curve.csv", "w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["round", "episodes", "mean_return", "best_return", "share_arrived"])
        rows.writerows(curve)
    np.savez(a.out / "policy.npz", policy=policy)
    print(f"wrote {a.out / 'curve.csv'}, {a.out / 'policy.npz'}")
    if shutil.which("ffmpeg"):
        film(task, who, policy, fresh[:3], [targets[s % len(targets)] for s in fresh[:3]], a.out / "film.mp4")
        print(f"wrote {a.out / 'film.mp4'}")
    else:
        print("no film: ffmpeg is not installed", file=sys.stderr)


if __name__ == "__main__":
    main()
