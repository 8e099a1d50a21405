"""Labelled pictures of scripts' runs: COCO, masks, depth, key points, as `ostium dataset` writes them.

    tasks = ostium.sweep.tasks("rca-mid-focal", "rca-from-the-ostium", seeds=[1], vary={"person": [0, 1, 2, 3]},
                               values={"begin": "RCA"})
    with concurrent.futures.ProcessPoolExecutor() as pool:
        pictures = ostium.dataset.make(tasks, "set", every_s=0.5, pixels=512, map=pool.map)

Of single moments, ostium.Imager(model).labels(data) has the same as arrays. The page of the program says what is in each file.
"""

from __future__ import annotations

import builtins
import fcntl
import functools
import hashlib
import json
import re
from pathlib import Path
from typing import Any, Callable, Iterable, Mapping, Optional, Union

from ._ostium import _label_run, _require_dicom, _write_label_set
from .errors import OstiumError
from .whole_file import write_whole

CLASSES = ("background", "vessel", "coronary artery", "catheter", "wire", "device shaft", "balloon", "stent")
DEPTH_UNIT_MM = 0.02  # of the numbers in depth/*.png


def _name(number, of, task):
    what = "-".join([Path(task["case"]).name, *map(str, task["values"].values()), str(task["seed"])])
    return f"{number:0{len(str(of))}}-{re.sub(r'[^A-Za-z0-9.-]', '_', what)[:150]}"


def _identity(tasks, *settings):
    """What a set is made of; of files, what they hold."""
    def held(value):
        path = Path(str(value))
        return hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else str(value)

    parts = [[held(part) for part in (task["case"], task["script"], *task["values"].values())] for task in tasks]
    text = json.dumps([tasks, parts, settings], sort_keys=True, default=str)
    return "python " + hashlib.sha256(text.encode()).hexdigest()


def _claim(folder, identity):
    """Names the set in the folder, and keeps it for this program alone, until the file that comes back is closed."""
    path = folder / "set.txt"
    for name in ("train.json", "val.json", "test.json", "manifest.json"):
        if not path.exists() and (folder / name).exists():
            raise OstiumError(f"{folder / name}: is there, and of no set of pictures of ostium; name another folder")
    file = open(path, "a+", encoding="utf-8")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        raise OstiumError(f"{folder}: another program makes these pictures") from None
    file.seek(0)
    if (there := file.read().strip()) and there != identity:
        raise OstiumError(f"{path}: the folder is of another set of pictures; name another folder")
    if not there:
        file.write(identity + "\n")
        file.flush()
    return file


def run(numbered, folder, of, every_s, pixels, dicom):
    """Plays one task, numbered from 1, and writes its pictures and runs/NAME.json, which is there only once all of them
    are; a run that is done is left as it is. -> that file's text. A run that cannot be is one without pictures, with its
    reason; it is tried again the next time."""
    number, task = numbered
    name = _name(number, of, task)
    path = Path(folder) / "runs" / f"{name}.json"
    if path.exists():
        return path.read_text(encoding="utf-8")
    values = {key: str(value) for key, value in task["values"].items()}
    try:
        text = _label_run(**task, name=name, folder=folder, every_s=every_s, pixels=pixels, dicom=dicom)
        made = json.loads(text)
    except OstiumError as error:
        return json.dumps({"name": name, "case": task["case"], "script": task["script"], "seed": task["seed"],
                           "person": name, "outcome": "aborted", "reason": " ".join(str(error).split()),
                           "simulated_s": 0, "pictures": [], "values": values})
    text = json.dumps({**made, "values": values}) + "\n"
    write_whole(path, text.encode())
    return text


def make(tasks: Iterable[Mapping[str, Any]], folder: Union[str, Path], every_s: float = 0.5, pixels: int = 512,
         dicom: bool = False, map: Optional[Callable[..., Iterable[str]]] = None) -> int:
    """Plays `tasks` (ostium.sweep.tasks) and writes a set of labelled pictures; -> how many there are.

    every_s  seconds of simulated time between pictures, 0.05 to 3,600
    pixels   on a side, 64 to 1,024
    dicom    as DICOM films with segmentations, too (in builds with DICOM)
    map      what plays them: the builtin, or that of a pool of processes
    The same call goes on where it was ended. Raises OstiumError if the folder has another set, or files of others, if
    none of the tasks can be played, and at once for dicom in a build without."""
    tasks, folder = list(tasks), Path(folder)
    if dicom:
        _require_dicom()
    if not tasks:
        raise ValueError("there are no tasks; expected one or more of ostium.sweep.tasks")
    if not 64 <= pixels <= 1024:
        raise ValueError(f"pixels is {pixels}; expected 64 to 1024")
    if not 0.05 <= every_s <= 3600:
        raise ValueError(f"every_s is {every_s}; expected 0.05 to 3600 seconds")
    for below in ("images", "masks", "depth", "runs"):
        (folder / below).mkdir(parents=True, exist_ok=True)
    with _claim(folder, _identity(tasks, every_s, pixels, dicom)):
        one = functools.partial(run, folder=folder, of=len(tasks), every_s=every_s, pixels=pixels, dicom=dicom)
        runs = list((map or builtins.map)(one, enumerate(tasks, 1)))
        if tasks and not any((folder / "runs").glob("*.json")):
            raise OstiumError(json.loads(runs[0])["reason"])
        keys = list(dict.fromkeys(key for task in tasks for key in task["values"]))
        return _write_label_set(folder, every_s, pixels, keys, runs)
