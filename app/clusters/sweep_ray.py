#!/usr/bin/env python3
"""A sweep on a Ray cluster, one part a task; the nodes share the folder of the table.

  sweep_ray.py PARTS TABLE.csv CASE... [options of `ostium sweep`]
"""
import os
import subprocess
import sys

import ray

OSTIUM = os.environ.get("OSTIUM", "ostium")


@ray.remote(num_cpus=1, max_retries=3)
def run_part(arguments, table, part, folder):
    """A part that is tried again goes on where it was."""
    subprocess.run([OSTIUM, "sweep", *arguments, "-o", table, "--part", part, "--jobs", "1", "--resume"], check=True,
                   cwd=folder)


def main():
    parts, table, sweep = int(sys.argv[1]), sys.argv[2], sys.argv[3:]
    ray.init()  # RAY_ADDRESS names a cluster
    ray.get([run_part.remote(sweep, table, f"{k + 1}/{parts}", os.getcwd()) for k in range(parts)])
    subprocess.run([OSTIUM, "sweep", "--merge", table], check=True)


if __name__ == "__main__":
    main()
