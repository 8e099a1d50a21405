"""Labels of single moments, and sets of labelled pictures: as `ostium dataset` makes them."""

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import ostium
import pytest


@pytest.fixture(scope="module")
def seen():
    """A wire at the ostium, and the labels of its picture."""
    model = ostium.Model(ostium.Vessel("rca-mid-focal"), tools=[("wire", "wire-014-workhorse")], begin="RCA")
    data = ostium.Data(model)
    data.inputs[0] = 0.03
    ostium.step(model, data, n=1000)
    imager = ostium.Imager(model, lao=40, pixels=128)
    return data, imager, imager.labels(data)


def test_masks_say_where_the_wire_is(seen):
    data, imager, labels = seen
    assert labels["mask"].shape == labels["depth_mm"].shape == imager.frame(data).shape
    assert ((labels["mask"] > 0) == (labels["depth_mm"] > 0)).all()
    wire = next(thing for thing in labels["things"] if thing["name"] == "wire")
    assert wire["class"] == "wire" and wire["mask"].sum() == wire["area"] > 20
    assert (ostium.dataset.CLASSES.index("wire") == labels["mask"][wire["mask"]]).all()  # nothing is higher
    rows, columns = np.nonzero(wire["mask"])
    left, top, wide, high = wire["bbox"]
    assert (left, top, left + wide - 1, top + high - 1) == (columns.min(), rows.min(), columns.max(), rows.max())
    assert {"RCA", "aorta"} <= {thing["name"] for thing in labels["things"]}


def test_points_project_as_the_c_arm_says(seen):
    data, _, labels = seen
    tip = next(point for point in labels["points"] if point["name"] == "tip of wire")
    assert np.array(tip["mm"]) == pytest.approx(1e3 * data.tip("wire"), abs=1e-3)
    x, y, w = np.array(labels["c_arm"]["projection"]) @ [*tip["mm"], 1]
    assert [x / w, y / w] == pytest.approx(tip["px"], abs=0.02)
    assert w == pytest.approx(tip["depth_mm"], abs=0.01)  # its third row is the depth
    # A pixel shows what is nearest: the wire's axis, or where the wire passes twice, that of its nearer part.
    line = next(thing for thing in labels["things"] if thing["name"] == "wire")["centreline"]
    columns, rows = np.array(line["px"]).astype(int).T
    off = labels["depth_mm"][rows, columns] - line["depth_mm"]
    assert off.max() < 0.5 and np.mean(np.abs(off) < 0.5) > 0.5


def test_looking_changes_nothing(seen):
    data, imager, labels = seen
    before = data.hash()
    again = imager.labels(data)
    assert data.hash() == before and (again["mask"] == labels["mask"]).all()


def test_a_set_is_that_of_the_command(tmp_path):
    tasks = ostium.sweep.tasks("rca-mid-focal", "rca-from-the-ostium", seeds=[1], vary={"person": [0, 1]},
                               values={"begin": "RCA"}, seconds=1.2)
    made = ostium.dataset.make(tasks, tmp_path / "python", every_s=0.6, pixels=64)
    assert made == 2
    stamps = {path: path.stat().st_mtime_ns for path in (tmp_path / "python" / "runs").iterdir()}
    assert ostium.dataset.make(tasks, tmp_path / "python", every_s=0.6, pixels=64) == 2
    assert stamps == {path: path.stat().st_mtime_ns for path in (tmp_path / "python" / "runs").iterdir()}
    with pytest.raises(ostium.OstiumError, match="another set"):
        ostium.dataset.make(tasks, tmp_path / "python", every_s=0.3, pixels=64)
    others = ostium.sweep.tasks("rca-mid-focal", "rca-from-the-ostium", seeds=[9], values={"begin": "RCA"}, seconds=1.2)
    with pytest.raises(ostium.OstiumError, match="another set"):
        ostium.dataset.make(others, tmp_path / "python", every_s=0.6, pixels=64)
    (tmp_path / "theirs").mkdir()
    (tmp_path / "theirs" / "train.json").write_text("{}")
    with pytest.raises(ostium.OstiumError, match="train.json: is there"):
        ostium.dataset.make(others, tmp_path / "theirs")
    subprocess.run([os.environ["OSTIUM"], "dataset", "rca-mid-focal", "--script", "rca-from-the-ostium", "--set",
                    "begin=RCA", "--seconds", "1.2", "--vary", "person=0,1", "--seeds", "1", "--every", "0.6",
                    "--pixels", "64", "-o", tmp_path / "command"], check=True, capture_output=True)
    for kind in ("images", "masks", "depth"):
        python, command = (sorted((tmp_path / who / kind).iterdir()) for who in ("python", "command"))
        assert [one.read_bytes() for one in python] == [one.read_bytes() for one in command] and python
    coco = json.loads((tmp_path / "python" / "train.json").read_text())
    theirs = json.loads((tmp_path / "command" / "train.json").read_text())
    assert coco["categories"] == theirs["categories"]
    for mine, other in zip(coco["annotations"], theirs["annotations"], strict=True):
        assert mine == other


def test_a_build_without_dicom_says_so_before_the_work(tmp_path, monkeypatch):
    def lacking():
        raise ostium.OstiumError("this build writes no DICOM")

    monkeypatch.setattr(ostium.dataset, "_require_dicom", lacking)
    tasks = ostium.sweep.tasks("rca-mid-focal", "rca-from-the-ostium", seeds=[1], values={"begin": "RCA"}, seconds=0.7)
    with pytest.raises(ostium.OstiumError, match="no DICOM"):
        ostium.dataset.make(tasks, tmp_path / "set", dicom=True, map=None)
    assert not (tmp_path / "set").exists()


def test_what_cannot_be_takes_no_folder(tmp_path):
    tasks = ostium.sweep.tasks("rca-mid-focal", "rca-from-the-ostium", seeds=[1])
    for arguments in (dict(tasks=tasks, pixels=63), dict(tasks=tasks, every_s=0.0), dict(tasks=[])):
        with pytest.raises(ValueError, match="expected"):
            ostium.dataset.make(folder=tmp_path / "set", **arguments)
        assert not (tmp_path / "set").exists()


def test_a_run_that_cannot_be_is_told_and_tried_again(tmp_path):
    tasks = ostium.sweep.tasks("rca-mid-focal", "rca-from-the-ostium", seeds=[1], values={"wire": "no-such-wire"})
    with pytest.raises(ostium.OstiumError, match="no-such-wire"):
        ostium.dataset.make(tasks, tmp_path / "none")
    tasks += ostium.sweep.tasks("rca-mid-focal", "rca-from-the-ostium", seeds=[1], values={"begin": "RCA"}, seconds=0.7)
    assert ostium.dataset.make(tasks, tmp_path / "one", every_s=0.6, pixels=64) == 1
    run = json.loads((tmp_path / "one" / "manifest.json").read_text())["runs"][0]
    assert run["outcome"] == "aborted" and "no-such-wire" in run["reason"]
    assert len(list((tmp_path / "one" / "runs").iterdir())) == 1  # what failed is not kept as done
    # A script that somebody changed makes another set.
    script = tmp_path / "mine.json"
    script.write_bytes((Path(ostium.__file__).parent / "data/scripts/rca-from-the-ostium.json").read_bytes())
    tasks = ostium.sweep.tasks("rca-mid-focal", str(script), seeds=[1], values={"begin": "RCA"}, seconds=0.7)
    assert ostium.dataset.make(tasks, tmp_path / "mine", every_s=0.6, pixels=64) == 1
    script.write_text("{ broken")
    with pytest.raises(ostium.OstiumError, match="another set"):
        ostium.dataset.make(tasks, tmp_path / "mine", every_s=0.6, pixels=64)
