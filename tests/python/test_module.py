"""Data, Batch, rollout: the same numbers whichever way, and no way to break the interpreter."""

import ast
import copy
import gc
import multiprocessing
import pickle
import resource
import signal
import threading
from pathlib import Path

import numpy as np
import ostium
import pytest
from helpers import FEED, drive, tube

def in_a_child(pickled):
    data, seed = pickle.loads(pickled)
    return drive(data, seed).hash()


def test_names_and_ranges(model, data):
    assert model.input_names[:2] == ["wire.advance_m_s", "wire.turn_rad_s"]
    assert model.input_ranges.shape == (len(model.input_names), 2)
    assert np.isfinite(model.input_ranges).all()
    assert (model.input_ranges[:, 0] <= data.inputs).all() and (data.inputs <= model.input_ranges[:, 1]).all()
    assert len(model.signals) == len(data.signals)
    assert model.tools == [("wire", "wire-014-workhorse")]


def test_a_wire_comes_in_as_far_as_it_is_fed(data):
    data.inputs[0] = FEED
    ostium.step(data.model, data, n=500)
    assert data.time == pytest.approx(0.5)
    assert data.signal("wire.inserted_mm") == pytest.approx(1e3 * FEED * 0.5, rel=1e-6)
    nodes = data.nodes("wire")
    assert nodes[-1] == pytest.approx(data.tip("wire"))
    length = np.linalg.norm(np.diff(nodes, axis=0), axis=1).sum()
    assert length == pytest.approx(FEED * 0.5, rel=2e-3)  # inextensible
    assert np.linalg.norm(data.tip_direction("wire")) == pytest.approx(1)


def test_views_are_the_engines_own_memory(data):
    assert np.shares_memory(data.inputs, data.inputs)
    assert np.shares_memory(data.signals, data.signals)
    assert np.shares_memory(data.forces, data.forces) and np.shares_memory(data.peaks, data.peaks)
    data.inputs[0] = FEED
    ostium.step(data.model, data, 500)
    nodes, signals = data.nodes("wire"), data.signals
    assert np.shares_memory(nodes, data.nodes("wire"))
    before = signals.copy()
    ostium.step(data.model, data, 100)
    assert (signals != before).any()
    for view in (nodes, signals, data.forces, data.peaks):
        with pytest.raises(ValueError):
            view[...] = 0


def test_two_wires_in_one_guide(vessel):
    tools = [("guide", "guide-jr4-6f"), ("balloon", "balloon-20x15", "second wire"), ("wire", "wire-014-workhorse"),
             ("second wire", "wire-014-workhorse")]
    data = ostium.Data(pickle.loads(pickle.dumps(ostium.Model(vessel, tools=tools))))
    names = data.model.input_names
    for name in ("guide", "wire", "second wire"):
        data.inputs[names.index(f"{name}.advance_m_s")] = 0.1
        ostium.step(data.model, data, n=300)
        data.inputs[names.index(f"{name}.advance_m_s")] = 0
    for name in ("wire", "second wire"):
        assert data.signal(f"{name}.inserted_mm") == pytest.approx(30, rel=1e-6)
    with pytest.raises(ostium.OstiumError, match="say which, as \"over\""):
        ostium.Model(vessel, tools=[tool[:2] for tool in tools])


def test_a_view_outlives_its_owner(model):
    data = ostium.Data(model)
    inputs, signals = data.inputs, data.signals
    del data
    gc.collect()
    inputs[:] = 1
    assert (inputs == 1).all() and len(signals) > 0
    batch = ostium.Batch(model, 2)
    tips = batch.tips
    del batch
    gc.collect()
    assert np.isfinite(tips).all()


def test_one_call_or_many(model):
    a, b = ostium.Data(model), ostium.Data(model)
    a.inputs[0] = b.inputs[0] = FEED
    a.step(150)
    for _ in range(150):
        b.step()
    assert a.hash() == b.hash()


def test_state_goes_out_and_in(model):
    a = drive(ostium.Data(model), 1)
    state, kept = a.get_state(), a.hash()
    assert state.shape == (model.state_size,)
    drive(a, 2)
    b = ostium.Data(model)
    b.set_state(state)
    assert b.hash() == kept
    assert drive(b, 2).hash() == a.hash()


def test_copies_and_pickles_go_on_alike(model):
    data = drive(ostium.Data(model), 3)
    others = [data.copy(), copy.copy(data), copy.deepcopy(data), pickle.loads(pickle.dumps(data))]
    expected = drive(data, 4).hash()
    for other in others:
        assert drive(other, 4).hash() == expected
    assert pickle.loads(pickle.dumps(model)).state_size == model.state_size


@pytest.mark.parametrize("way", ["fork", "spawn"])
def test_in_other_processes(model, way):
    data = ostium.Data(model)
    with multiprocessing.get_context(way).Pool(1) as pool:
        there = pool.map(in_a_child, [pickle.dumps((data, 5))])[0]
    assert there == drive(data, 5).hash()


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_a_batch_is_one_by_one(model, threads):
    alone = [drive(ostium.Data(model), seed) for seed in range(5)]
    batch = ostium.Batch(model, num=5, threads=threads)
    random = [np.random.default_rng(seed) for seed in range(5)]
    for _ in range(10):
        for i, r in enumerate(random):
            batch.inputs[i, :2] = r.uniform(-0.2, 1) * FEED, r.uniform(-3, 3)
        batch.step(20)
    for i, data in enumerate(alone):
        assert batch.hash(i) == data.hash()
        assert (batch.signals[i] == data.signals).all() or np.isnan(data.signals).any()
        assert (batch.tips[i, 0] == data.tip("wire")).all()
        assert batch.data(i).hash() == data.hash()


def test_a_mask_leaves_the_others(model):
    batch = ostium.Batch(model, num=3)
    batch.reset(0, np.int64(5))  # as numpy's generators draw them
    for wrong in (True, np.array(5), 0.5):
        with pytest.raises((ValueError, TypeError)):
            batch.reset(0, wrong)
    batch.reset()
    batch.inputs[:, 0] = FEED
    before = [batch.hash(i) for i in range(3)]
    batch.step(10, mask=np.array([True, False, True]))
    after = [batch.hash(i) for i in range(3)]
    assert [a != b for a, b in zip(after, before)] == [True, False, True]


def test_a_reset_is_fresh(model):
    batch = ostium.Batch(model, num=2)
    for seed in (0, 7):
        fresh = ostium.Data(model)
        fresh.reset(seed)
        batch.inputs[:, 0] = FEED
        batch.step(100)
        batch.reset(1, seed)
        assert batch.hash(1) == fresh.hash() != batch.hash(0)
    drive(fresh, 1)
    batch.reset(0, fresh.get_state())
    assert batch.hash(0) == fresh.hash()


def test_rollouts(model):
    starts = [drive(ostium.Data(model), seed, calls=3) for seed in range(3)]
    states = np.stack([data.get_state() for data in starts])
    inputs = np.repeat(starts[0].inputs[None, None], 3, axis=0).repeat(4, axis=1)
    inputs[:, :, 0] = FEED
    signals, ends = ostium.rollout(model, states, inputs, hold=25, threads=2)
    assert signals.shape == (3, 4, len(model.signal_names)) and ends.shape == states.shape
    for i, data in enumerate(starts):
        for k in range(4):
            data.inputs[:] = inputs[i, k]
            data.step(25)
            assert np.array_equal(signals[i, k], data.signals, equal_nan=True)
        assert np.array_equal(ends[i].view(np.uint64), data.get_state().view(np.uint64))


def test_a_second_thread_is_refused(model):
    data = ostium.Data(model)
    data.inputs[0] = FEED
    refused = []

    def other():
        try:
            while not done.is_set():
                data.get_state()
        except RuntimeError as error:
            refused.append(str(error))

    done = threading.Event()
    thread = threading.Thread(target=other)
    thread.start()
    for _ in range(50):
        try:
            data.step(50)
        except RuntimeError as error:
            refused.append(str(error))
        if refused:
            break
    done.set()
    thread.join()
    assert refused and "another thread" in refused[0]


def test_wrong_things_raise(model, vessel, data):
    for wrong in (np.nan, np.inf, 1e9):
        bad = ostium.Data(model)
        bad.inputs[model.input_names.index("heart_rate_1_min")] = wrong
        before = bad.hash()
        with pytest.raises(ValueError, match="heart_rate_1_min"):
            bad.step()
        assert bad.hash() == before
    with pytest.raises(ValueError, match="from 1 to"):
        data.step(0)
    with pytest.raises(ValueError, match="expected one of wire"):
        data.nodes("guide")
    with pytest.raises(ValueError, match="shape"):
        data.inputs = np.zeros(3)
    count = len(model.input_names)
    for wrong in ("fast", ["0.1"] * count, np.zeros(count, complex), np.array([None] * count)):
        with pytest.raises(TypeError):
            data.inputs = wrong
    with pytest.raises(TypeError):
        ostium.rollout(model, [data.get_state()], np.zeros((1, 2, count), complex))
    with pytest.raises(ValueError, match=r"shape \(3,\); expected \(\d+,\)"):
        data.inputs = [0, 0, 0]
    with pytest.raises(ValueError, match="and this has 5; expected what get_state gave"):
        data.set_state(np.zeros(5))
    edited = data.get_state()
    edited[100] += 1
    with pytest.raises(ValueError, match="cannot be edited"):
        data.set_state(edited)
    other = ostium.Model(vessel, tools=[("wire", "wire-014-workhorse")], begin="RCA", seed=3)
    with pytest.raises(ValueError, match="another model"):
        data.set_state(ostium.Data(other).get_state())
    with pytest.raises(ValueError, match="another model"):
        ostium.step(other, data)
    with pytest.raises(TypeError):
        ostium.Data(None)
    with pytest.raises(ValueError, match="tools is empty"):
        ostium.Model(vessel, tools=[])
    with pytest.raises(ValueError, match="name of its own"):
        ostium.Model(vessel, tools=[("a", "j-wire-035-150"), ("a", "j-wire-035-150")])
    with pytest.raises(ostium.OstiumError, match="j-wire-035-150"):
        ostium.Model(vessel, tools=[("wire", "no-such-wire")])
    with pytest.raises(ostium.OstiumError, match="expected one of: .*RCA"):
        ostium.Model(vessel, tools=[("wire", "wire-014-workhorse")], begin="aorta")
    with pytest.raises(ostium.OstiumError, match="rca-mid-focal"):
        ostium.Vessel("no-such-case")
    with pytest.raises(ValueError, match="expected one of .*RCA"):
        vessel.sphere("nowhere")
    with pytest.raises(IndexError):
        vessel.point(10**6)
    with pytest.raises(ValueError, match="num is 0"):
        ostium.Batch(model, 0)
    with pytest.raises(IndexError):
        ostium.Batch(model, 1).hash(1)
    with pytest.raises(ValueError, match="spider"):
        ostium.Imager(model, view="nowhere")


def test_an_error_knows_its_file(tmp_path, vessel):
    file = tmp_path / "bad.json"
    file.write_text('{\n "schema": "ostium-instrument/1",\n "nonsense": 1\n}\n')
    with pytest.raises(ostium.OstiumError) as raised:
        ostium.Model(vessel, tools=[("wire", str(file))])
    assert raised.value.file == str(file) and isinstance(raised.value.line, int)


def test_absurd_drives_are_limited_and_said(data):
    data.inputs[:2] = 1e300, np.nan
    data.step(5)
    assert "drive_limited" in data.trouble and "drive_not_finite" in data.trouble
    assert np.isfinite(data.tip("wire")).all()


def test_a_vessel_is_saved_and_read(tmp_path, vessel):
    vessel.save(tmp_path / "vessel.npz")
    same = ostium.Vessel.load(tmp_path / "vessel.npz")
    assert same.key == vessel.key
    np.savez(tmp_path / "other.npz", a=1)
    with pytest.raises(ValueError, match="is no vessel"):
        ostium.Vessel.load(tmp_path / "other.npz")
    good = (tmp_path / "vessel.npz").read_bytes()
    for at in range(0, len(good), 97):  # read as it was, or refused with the file's name
        (tmp_path / "bad.npz").write_bytes(good[:at] + bytes([good[at] ^ 0x55]) + good[at + 1:])
        try:
            assert ostium.Vessel.load(tmp_path / "bad.npz").key == vessel.key
        except (ValueError, ostium.OstiumError) as refusal:
            assert "bad.npz" in str(refusal)


def test_a_vessel_that_cannot_be_written_leaves_what_was_there(tmp_path, vessel):
    vessel.save(tmp_path / "vessel.npz")
    before, limits = (tmp_path / "vessel.npz").read_bytes(), resource.getrlimit(resource.RLIMIT_FSIZE)
    ignored = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1024, limits[1]))
    try:
        with pytest.raises(OSError):
            vessel.save(tmp_path / "vessel.npz")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        signal.signal(signal.SIGXFSZ, ignored)
    assert (tmp_path / "vessel.npz").read_bytes() == before
    assert [file.name for file in tmp_path.iterdir()] == ["vessel.npz"]


def test_ways_along_the_tree(vessel):
    a, b = vessel.sphere("RCA+10"), vessel.sphere("RCA+50")
    assert vessel.between(a, b) == pytest.approx(0.040, abs=1.5e-3)  # to the spacing of spheres
    assert vessel.between(a, a) == 0
    assert vessel.between(a, b) == pytest.approx(vessel.between(b, a))
    aorta = vessel.sphere("left carotid+10")
    assert vessel.between(aorta, b) > 0.05
    names = [branch["name"] for branch in vessel.branches]
    assert names[vessel.branch_of(a)] == "RCA"
    vertices, triangles = vessel.mesh(0.3)
    assert triangles.max() < len(vertices) and np.isfinite(vertices).all()


def test_pictures(model, data):
    imager = ostium.Imager(model, lao=40, pixels=84, fill="right")
    picture = imager.frame(data)
    assert picture.shape == (84, 84) and picture.dtype == np.uint8
    assert picture.std() > 5


def test_memory_does_not_grow(model):
    batch = ostium.Batch(model, num=2)
    batch.inputs[:, 0] = FEED

    def many(count):
        for _ in range(count):
            batch.reset()
            batch.step(2)

    many(200)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    many(1000)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 4000  # kB


@pytest.mark.parametrize("kind", [ostium.Vessel, ostium.Model, ostium.Data, ostium.Batch, ostium.Imager])
def test_everything_says_what_it_is(kind):
    for name in (name for name in dir(kind) if not name.startswith("_")):
        said = (getattr(kind, name).__doc__ or "").strip()
        first, _, rest = said.partition("\n")
        assert rest.strip() if first.startswith(f"{name}(") else first, name


def test_the_types_are_those_of_the_classes():
    stub = ast.parse((Path(ostium.__file__).parent / "_ostium.pyi").read_text())
    for node in (node for node in stub.body if isinstance(node, ast.ClassDef)):
        told = {one.target.id if isinstance(one, ast.AnnAssign) else one.name for one in node.body}
        there = {name for name in vars(getattr(ostium._ostium, node.name)) if not name.startswith("_")}
        assert {name for name in told if not name.startswith("_")} == there, node.name


def test_a_mesh_of_ones_own(tmp_path):
    tube(tmp_path / "tube.stl")
    vessel = ostium.Vessel.from_mesh(tmp_path / "tube.stl", "mm", entry=(3, 0, 0), towards=(60, 0, 0))
    assert not vessel.beats
    model = ostium.Model(vessel, tools=[("wire", "wire-014-workhorse")])
    data = drive(ostium.Data(model), 1, calls=30, n=50)
    nodes = data.nodes("wire")
    assert np.linalg.norm(nodes[:, 1:], axis=1).max() < 6e-3  # within the wall
    vessel.save(tmp_path / "tube.npz")
    again = ostium.Model(ostium.Vessel.load(tmp_path / "tube.npz"), tools=[("wire", "wire-014-workhorse")])
    assert drive(ostium.Data(again), 1, calls=30, n=50).hash() == data.hash()
    with pytest.raises(ostium.OstiumError, match="outside"):
        ostium.Vessel.from_mesh(tmp_path / "tube.stl", "mm", entry=(3, 50, 0), towards=(60, 0, 0))
    (tmp_path / "bad.stl").write_bytes(b"solid" + bytes(200))
    with pytest.raises(ostium.OstiumError) as raised:
        ostium.Vessel.from_mesh(tmp_path / "bad.stl", "mm", entry=(3, 0, 0), towards=(60, 0, 0))
    assert raised.value.file == str(tmp_path / "bad.stl")
    with pytest.raises(ostium.OstiumError, match="furlong"):
        ostium.Vessel.from_mesh(tmp_path / "tube.stl", "furlong", entry=(3, 0, 0), towards=(60, 0, 0))
