#!/usr/bin/env python3
"""How fast environments of the Python module are, on this machine: PYTHONPATH=build/python tests/bench/environments.py

Each speed is of 132 ms simulated at 1 ms, driven by the same random actions whatever is measured, in environment steps a
second and core. Others on the machine make it slower: the best of the rounds stands beside the median.
"""

import argparse
import json
import resource
import statistics
import time

import numpy as np
import ostium
from ostium.navigation import patient
from ostium.navigation.tasks import CORONARY_WIRE, GUIDE_AND_WIRE, TASKS, WIRE, Task

SETUPS = {
    "J wire from the groin": (Task(WIRE, "", max_feed_m_s=0.035), 100),
    "guide and wire from the groin": (Task(GUIDE_AND_WIRE, "", max_feed_m_s=0.035), 60),
    "wire in the right coronary": (Task(CORONARY_WIRE, "", begin="RCA", targets=("RCA+70",), max_feed_m_s=0.02), 120),
}


def drive(batch, who, task, random, steps):
    """Mostly forwards, as a policy on its way."""
    n = len(batch)
    began = time.perf_counter()
    for _ in range(steps):
        for feed, turn in zip(who.driven[::2], who.driven[1::2]):
            batch.inputs[:, feed] = random.uniform(-0.3, 1, n) * task.max_feed_m_s
            batch.inputs[:, turn] = random.uniform(-1, 1, n) * task.max_turn_rad_s
        batch.step(who.hops)
    return n * steps / (time.perf_counter() - began)


def speeds(task, rounds, warm, steps, threads, num):
    who = patient(task, 0)
    found = []
    for k in range(rounds):
        batch = ostium.Batch(who.model, num, threads)
        random = np.random.default_rng(k)
        drive(batch, who, task, random, warm)
        found.append(drive(batch, who, task, random, steps))
    return found


def best_ms(work, times):
    took = []
    for _ in range(times):
        began = time.perf_counter()
        work()
        took.append(time.perf_counter() - began)
    return 1e3 * min(took), 1e3 * statistics.median(took)


def grown_MB(resets):
    """How much memory of the process grows over so many resets to new seeds, each with a step after it."""
    batch = ostium.Batch(patient(TASKS["BasicWireNav"], 0).model, 2)
    batch.inputs[:, 0] = 0.035

    def work(times):
        for _ in range(times):
            batch.reset(0, next(seeds))
            batch.step(1)

    seeds = iter(range(1, 10**9))
    work(500)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    work(resets)
    return (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--json", action="store_true", help="print numbers instead of a table")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--resets", type=int, default=2000, help="over which the growth of memory is measured")
    a = parser.parse_args()
    rows = []
    for name, (task, wanted) in SETUPS.items():
        found = speeds(task, a.rounds, warm=60, steps=40, threads=1, num=1)
        rows.append({"what": name, "unit": "steps/s", "best": max(found), "median": statistics.median(found),
                     "at_least": wanted})
    task = SETUPS["wire in the right coronary"][0]
    pairs = [speeds(task, 1, 20, 20, 2, 8)[0] / speeds(task, 1, 20, 20, 1, 8)[0] for _ in range(a.rounds)]
    rows.append({"what": "two threads over one", "unit": "times", "best": max(pairs),
                 "median": statistics.median(pairs), "at_least": 1.9})
    who = patient(TASKS["BasicWireNav"], 0)
    data = ostium.Data(who.model)
    data.inputs[0] = 0.035
    data.step(5000)
    state = data.get_state()
    imager = ostium.Imager(who.model, lao=40, pixels=84, field=0.3)
    seeds = iter(range(1, 10**6))
    for what, work, wanted in (("reset to a state", lambda: data.set_state(state), 20),
                               ("reset to a seed", lambda: data.reset(next(seeds)), 20),
                               ("copy", lambda: data.copy(), None),
                               ("picture of 84 x 84", lambda: imager.frame(data), 4)):
        work()
        best, median = best_ms(work, 20)
        rows.append({"what": what, "unit": "ms", "best": best, "median": median, "at_most": wanted})
    batch = ostium.Batch(who.model, 16)
    batch.inputs[:, 0] = 0.035
    batch.step(132)
    rows.append({"what": "memory of this process, 16 sessions in it", "unit": "MB",
                 "best": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024, "at_most": 1500})
    rows.append({"what": f"growth over {a.resets:,} resets and steps", "unit": "MB", "best": grown_MB(a.resets),
                 "at_most": 1})
    if a.json:
        print(json.dumps(rows, indent=2))
        return
    print(f"{'':<42} {'best':>9} {'median':>9}  {'wanted':<10}")
    for row in rows:
        wanted = f">= {row['at_least']}" if row.get("at_least") else f"<= {row['at_most']}" if row.get("at_most") else ""
        print(f"{row['what']:<42} {row['best']:>9.3g} {row.get('median', row['best']):>9.3g}  {wanted:<8} {row['unit']}")


if __name__ == "__main__":
    main()
