"""Many runs of scripts from Python: tasks are plain dictionaries, and `run` takes one anywhere.

    tasks = ostium.sweep.tasks("rca-mid-focal", "aorta-arch-wire", seeds=range(1, 21), vary={"wire": ["rosen", "bentson"]})
    with concurrent.futures.ProcessPoolExecutor() as pool:     # or dask.bag, or Ray
        rows = list(pool.map(ostium.sweep.run, tasks))
    ostium.sweep.write_csv(rows, "table.csv")

`ostium sweep` does the same without Python, with a journal, parts of a cluster, and a table that is the same to the byte.
"""

from __future__ import annotations

import csv
import itertools
from os import PathLike
from typing import Any, Iterable, Mapping, Optional, Sequence, Union

from ._ostium import run_script
from .errors import OstiumError


def tasks(case: str, script: str, seeds: Iterable[int] = range(1, 11), vary: Optional[Mapping[str, Sequence[Any]]] = None,
          values: Optional[Mapping[str, Any]] = None, seconds: float = 0.0) -> list[dict[str, Any]]:
    """A task for each combination of `vary` ({key: [values]}) and each seed, those of one vessel one after the other.
    `values` are the same for all."""
    vary = dict(vary or {})
    return [{"case": case, "script": script, "seed": int(seed), "seconds": seconds,
             "values": {**(values or {}), **dict(zip(vary, chosen))}}
            for chosen in itertools.product(*vary.values()) for seed in seeds]


def run(task: Mapping[str, Any]) -> dict[str, Any]:
    """Plays one task; -> a flat dictionary: what was asked, outcome, reason, metrics. A run that cannot be is a row, too:
    its outcome is "error"."""
    row = {"case": task["case"], "script": task["script"], "seed": task["seed"], **task["values"]}
    try:
        played = run_script(**task)
    except OstiumError as error:
        return {**row, "outcome": "error", "reason": " ".join(str(error).split())}
    return {**row, "outcome": played["outcome"], "reason": played["reason"], "simulated_s": played["simulated_s"],
            "deepest_mm": played["deepest_mm"], **played["metrics"]}


def write_csv(rows: Sequence[Mapping[str, Any]], path: Union[str, PathLike[str]]) -> None:
    """Rows of `run` as a table; columns in the order in which they first come."""
    columns = list(dict.fromkeys(key for row in rows for key in row))
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, columns)
        table.writeheader()
        table.writerows(rows)
