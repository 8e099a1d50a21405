"""Recordings of `ostium run` in Python, and the same run stepped from there."""

import os
import subprocess

import numpy as np
import ostium
import pytest


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    if "OSTIUM" not in os.environ:
        pytest.skip("the environment names no program of ours: OSTIUM=build/ostium")
    folder = tmp_path_factory.mktemp("run")
    subprocess.run([os.environ["OSTIUM"], "run", "rca-mid-focal", "--script", "aorta-arch-wire", "--seconds", "2",
                    "--record", "shapes", "--out", str(folder)], check=False, capture_output=True)
    return ostium.Recording(folder / "run.h5")


def test_the_same_inputs_give_the_same_states(recording):
    vessel = ostium.Vessel("rca-mid-focal")
    model = ostium.Model(vessel, tools=[("wire", "j-wire-035-150")])
    assert model.input_names == recording.inputs.names
    assert model.signal_names == recording.signals.names
    data = ostium.Data(model)
    for row, expected in zip(recording.inputs.numbers, recording.hashes):
        data.inputs[:] = row
        data.step()
        assert data.hash() == expected


def test_tables_have_their_columns(recording):
    signals = recording.signals
    assert len(signals) == recording.steps // 10
    inserted = signals["wire.inserted_mm"]
    assert (np.diff(inserted) >= -1e-6).all() and inserted[-1] > 50
    assert set(signals.to_dict()) == set(signals.names)
    assert list(signals) == signals.names and "wire.push_N" in signals and 0 not in signals
    with pytest.raises(KeyError, match="wire.tip_x_mm"):
        signals["nothing"]
    assert recording.setup["seed"] == 0 and recording.step_s == 1e-3
    assert recording.end is not None and "outcome" in recording.end
    assert recording.tools == ["wire"] and "RCA" in recording.branches
    assert {"time_s", "name", "tool", "value"} == set(recording.events[0])
    assert all(isinstance(event["name"], str) for event in recording.events)


def test_shapes_end_at_the_tip(recording):
    times, points = recording.shapes("wire")
    signals = recording.signals
    last = points[-1][~np.isnan(points[-1][:, 0])]
    at = int(round(times[-1] * 100)) - 1
    tip = np.array([signals[f"wire.tip_{axis}_mm"][at] for axis in "xyz"])
    assert np.linalg.norm(1e3 * last[-1] - tip) < 2  # a sample apart at most
    with pytest.raises(ValueError, match="guide"):
        recording.shapes("guide")


def test_what_is_no_recording_is_refused(tmp_path):
    file = tmp_path / "run.h5"
    file.write_bytes(b"not HDF5")
    with pytest.raises(ostium.OstiumError) as raised:
        ostium.Recording(file)
    assert raised.value.file == str(file)


def test_h5py_reads_the_same_file_at_the_same_time(recording):
    h5py = pytest.importorskip("h5py")
    with h5py.File(recording.path, locking=False) as file:
        assert (file["signals"][:] == recording.signals.numbers).sum() > 0
        assert list(file.attrs["tools"]) == recording.tools


def test_a_script_is_played_as_the_program_plays_it(recording, tmp_path):
    played = ostium.run_script("rca-mid-focal", "aorta-arch-wire", seconds=2, recording=tmp_path / "run.h5")
    assert played["outcome"] == recording.end["outcome"]
    assert (ostium.Recording(tmp_path / "run.h5").hashes == recording.hashes).all()
    assert played["hash"] == recording.hashes[-1]


def test_a_sweep_has_a_row_for_each_run(tmp_path):
    tasks = ostium.sweep.tasks("rca-mid-focal", "aorta-arch-wire", seeds=[1, 2], vary={"wire": ["rosen", "no-wire"]},
                               seconds=0.5)
    rows = [ostium.sweep.run(task) for task in tasks]
    assert [(row["wire"], row["seed"]) for row in rows] == [("rosen", 1), ("rosen", 2), ("no-wire", 1), ("no-wire", 2)]
    assert [row["outcome"] == "error" for row in rows] == [False, False, True, True]
    assert "no-wire" in rows[2]["reason"]
    ostium.sweep.write_csv(rows, tmp_path / "table.csv")
    assert len((tmp_path / "table.csv").read_text().splitlines()) == 5
    with pytest.raises(ostium.OstiumError, match="aorta-arch-wire"):
        ostium.run_script("rca-mid-focal", "no-such-script")
