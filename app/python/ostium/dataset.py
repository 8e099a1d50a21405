"""Labelled pictures of scripts' runs: COCO, masks, depth, key points, as `ostium dataset` writes them.

    tasks = ostium.sweep.tasks("rca-mid-focal", "rca-from-the-ostium", seeds=[1], vary={"person": [0, 1, 2, 3]},
                               values={"begin": "RCA"})
    with concurrent.futures.ProcessPoolExecutor() as pool:
        pictures = ostium.dataset.make(tasks, "set", every_s=0.5, pixels=512, map=pool.map)

Of single moments, ostium.Imager(model).labels(data) has the same as arrays. The page of the program says what is in each file.
"""

import builtins
import functools
import json
import os
import re
from pathlib import Path

from ._ostium import _label_run, _write_label_set
from .errors import OstiumError

CLASSES = ("background", "vessel", "coronary artery", "catheter", "wire", "device shaft", "balloon", "stent")
DEPTH_UNIT_MM = 0.02  # of the numbers in depth/*.png


def _name(number, of, task):
    what = "-".join([Path(task["case"]).name, *map(str, task["values"].values()), str(task["seed"])])
    return f"{number:0{len(str(of))}}-{re.sub(r'[^A-Za-z0-9.-]', '_', what)[:150]}"


def run(numbered, folder, of, every_s, pixels, dicom, identity):
    """Plays one task, numbered from 1, and writes its pictures and runs/NAME.json, which is there only once all of them
    are; a run that is done is left as it is. A run that cannot be is one without pictures, with its reason."""
    number, task = numbered
    name = _name(number, of, task)
    path = Path(folder) / "runs" / f"{name}.json"
    if path.exists():
        if json.loads(path.read_text(encoding="utf-8")).get("dataset") != identity:
            raise OstiumError(f"{path}: is of another set of pictures; remove it, or name another folder")
        return name
    try:
        text = _label_run(**task, name=name, folder=folder, every_s=every_s, pixels=pixels, dicom=dicom)
        made = json.loads(text)
    except OstiumError as error:
        made = {"name": name, "case": task["case"], "script": task["script"], "seed": task["seed"], "person": name,
                "outcome": "aborted", "reason": " ".join(str(error).split()), "simulated_s": 0, "pictures": []}
    made = {"dataset": identity, **made, "values": {key: str(value) for key, value in task["values"].items()}}
    beside = path.with_suffix(f".{os.getpid()}.unfinished")
    beside.write_text(json.dumps(made) + "\n", encoding="utf-8")
    beside.replace(path)
    return name


def make(tasks, folder, every_s=0.5, pixels=512, dicom=False, map=None):
    """Plays `tasks` (ostium.sweep.tasks) and writes a set of labelled pictures; -> how many there are.

    every_s  seconds of simulated time between pictures, 0.05 to 3,600
    pixels   on a side, 64 to 1,024
    dicom    as DICOM films with segmentations, too (in builds with DICOM)
    map      what plays them: the builtin, or that of a pool of processes
    The same call goes on where it was ended. Raises OstiumError if the folder has another set."""
    tasks, folder = list(tasks), Path(folder)
    for below in ("images", "masks", "depth", "runs"):
        (folder / below).mkdir(parents=True, exist_ok=True)
    identity = json.dumps([tasks, every_s, pixels, dicom], sort_keys=True, default=str)
    one = functools.partial(run, folder=folder, of=len(tasks), every_s=every_s, pixels=pixels, dicom=dicom,
                            identity=identity)
    names = list((map or builtins.map)(one, enumerate(tasks, 1)))
    runs = [(folder / "runs" / f"{name}.json").read_text(encoding="utf-8") for name in names]
    keys = list(dict.fromkeys(key for task in tasks for key in task["values"]))
    return _write_label_set(folder, every_s, pixels, keys, runs)
