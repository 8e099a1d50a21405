#!/usr/bin/env python3
"""A sweep on Dask's workers, one part a task; the workers share the folder of the table.

  sweep_dask.py [--scheduler ADDRESS] [--parts N] -o TABLE.csv CASE... [options of `ostium sweep`]

Without a scheduler, workers on this machine. A part whose worker dies is given to another, which goes on where it was.
"""
import argparse
import os
import subprocess

from dask.distributed import Client, LocalCluster

OSTIUM = os.environ.get("OSTIUM", "ostium")


def run_part(arguments, table, part, folder):
    """Exit code 0, or subprocess.CalledProcessError."""
    subprocess.run([OSTIUM, "sweep", *arguments, "-o", table, "--part", part, "--jobs", "1", "--resume"], check=True,
                   cwd=folder)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scheduler", help="tcp://host:8786")
    parser.add_argument("--parts", type=int, default=os.cpu_count())
    parser.add_argument("-o", "--output", required=True, help="the table")
    given, sweep = parser.parse_known_args()
    cluster = given.scheduler or LocalCluster(n_workers=given.parts, threads_per_worker=1, dashboard_address=None)
    with Client(cluster) as client:
        parts = [client.submit(run_part, sweep, given.output, f"{k + 1}/{given.parts}", os.getcwd(), pure=False)
                 for k in range(given.parts)]
        client.gather(parts)
    subprocess.run([OSTIUM, "sweep", "--merge", given.output], check=True)


if __name__ == "__main__":
    main()
