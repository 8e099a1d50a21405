#!/usr/bin/env bash
# What the page of recordings tells a reader with h5py to write, written; and what it says is there, is there.
#   tests/integration/read_recording.sh OSTIUM
set -euo pipefail
ostium=$1
here=$(dirname "$(readlink -f "$0")")
. "$here/expect.sh"
python=/usr/bin/python3  # the system's, which has Debian's packages
"$python" -c "import h5py" 2>/dev/null || { echo "skipped: python3-h5py is not installed"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -B "$here/../tools/comparison/made_up_tube.py" tube.stl 3 160
"$ostium" run tube.stl --units mm --entry 5,0,0 --towards 20,0.2,0 --script iliac-wire --record shapes=50 --out out >/dev/null
sed -n '/^```python/,/^```/p' "$here/../../data/recording/README.md" | grep -v '^```' >page.py
expect 0 "tool_in" "$python" page.py
cat >>page.py <<'END'
    steps, tip = f["shapes_step"][:, 0], f["shapes/wire"][:, -1]
    assert len(steps) == len(tip) and (np.diff(steps) == 20).all() and f["shapes/wire"].shape[2] == 3
    # The tip's signals, every 10 steps and in mm, are those of the last node.
    for axis, name in enumerate("xyz"):
        signal = signals[f"wire.tip_{name}_mm"][steps[1:] // 10 - 1] / 1e3
        inside = ~np.isnan(tip[1:, axis])
        assert inside.any() and np.abs(signal - tip[1:, axis])[inside].max() < 1e-6
    assert f["shapes/wire"].attrs["from_tip_m"][-1] == 0 and len(f["inputs"].attrs["units"]) == f["inputs"].shape[1]
    assert f["step_s"][()] == 0.001 and f["signals"].attrs["steps_per_row"] == 10
    lengths = np.linalg.norm(np.diff(wire, axis=0), axis=1)
    # Elements are as long as they are unloaded: a wire is all but inextensible.
    assert np.abs(lengths[1:] / -np.diff(f["shapes/wire"].attrs["from_tip_m"])[-len(lengths) + 1:] - 1).max() < 1e-3
    print("as the page says")
END
expect 0 "as the page says" "$python" page.py
# A step that is not the run's would stretch every second of a report.
"$python" -c 'import h5py; h5py.File("out/run.h5", "r+")["step_s"][()] = 0.002'
expect 3 "its step is 0.002 s" "$ostium" report out/run.h5 -o none.html
