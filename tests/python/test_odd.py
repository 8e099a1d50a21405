"""Objects that are half made, copied in every way, or given what they cannot take: they answer, or raise."""

import copy
import pickle

import numpy as np
import ostium
import pytest
from helpers import drive, tube


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_every_protocol_of_pickle(data, protocol):
    assert pickle.loads(pickle.dumps(drive(data, 1), protocol)).hash() == data.hash()
    for whole in (ostium.Batch(data.model, 1), ostium.Imager(data.model)):
        with pytest.raises(TypeError, match="cannot be pickled"):
            pickle.dumps(whole, protocol)


def test_a_pickled_data_is_of_its_model(data):
    other = pickle.loads(pickle.dumps(data))
    ostium.step(data.model, other)
    ostium.Imager(data.model, pixels=64).frame(other)


@pytest.mark.parametrize("kind", [ostium.Vessel, ostium.Model, ostium.Data, ostium.Batch, ostium.Imager])
def test_half_made_objects_raise(kind):
    half = kind.__new__(kind)
    for name in (name for name in dir(kind) if not name.startswith("_")):
        with pytest.raises(TypeError):
            value = getattr(half, name)
            value()
            raise AssertionError(f"{kind.__name__}.{name} answered")


def test_half_made_objects_raise_where_they_are_handed_over(model, data):
    half = {kind: kind.__new__(kind) for kind in (ostium.Vessel, ostium.Model, ostium.Data, ostium.Batch)}
    wire = [("wire", "wire-014-workhorse")]
    for call in (lambda: ostium.Model(half[ostium.Vessel], wire), lambda: ostium.Data(half[ostium.Model]),
                 lambda: ostium.Batch(half[ostium.Model], 2), lambda: ostium.Imager(half[ostium.Model]),
                 lambda: ostium.step(half[ostium.Model], data), lambda: ostium.step(model, half[ostium.Data]),
                 lambda: half[ostium.Batch].step(1), lambda: ostium.Imager(model).frame(half[ostium.Data]),
                 lambda: ostium.rollout(half[ostium.Model], [data.get_state()], np.zeros((1, 2, len(data.inputs)))),
                 lambda: copy.deepcopy(half[ostium.Model]), lambda: pickle.dumps(half[ostium.Vessel])):
        with pytest.raises(TypeError, match="without __init__"):
            call()


def test_odd_arguments(model, vessel, tmp_path):
    batch = ostium.Batch(model, 2)
    for wrong in (-1, 2**64, [[1.0]]):
        with pytest.raises(ValueError, match="seed"):
            batch.reset(0, wrong)
    batch.step(1, mask=[1, 0])
    batch.step(1, mask=np.array([1, 0]))
    with pytest.raises(ostium.OstiumError, match="has no name"):
        ostium.Vessel("")
    tube(tmp_path / "tube.stl")
    with pytest.raises(ValueError, match="another unit"):
        ostium.Vessel.from_mesh(tmp_path / "tube.stl", "m", entry=(3, 0, 0), towards=(60, 0, 0))
    assert "rca-mid-focal" in ostium.cases() and "rosen" in ostium.instruments()
    assert "aorta-arch-wire" in ostium.scripts() and "spider" in ostium.views()
    with pytest.raises(ValueError, match="reach"):
        ostium.Imager(model, cran=89)


@pytest.mark.parametrize("place, why", [("", "without a name"), (".", "is a folder"),
                                        ("mesh.stl/run.h5", "Not a directory")])
def test_a_recording_that_has_no_place_is_refused_before_anything_is_built(tmp_path, monkeypatch, place, why):
    monkeypatch.chdir(tmp_path)
    tube(tmp_path / "mesh.stl")
    with pytest.raises(ostium.OstiumError, match=why):
        ostium.run_script("no-such-case", "no-such-script", recording=place)
