"""Ostium for Python: instruments in beating coronary arteries, stepped from Python.

    import ostium
    model = ostium.Model(ostium.Vessel("rca-mid-focal"), tools=[("wire", "wire-014-workhorse")])
    data = ostium.Data(model)
    data.inputs[0] = 0.03                  # wire.advance_m_s
    ostium.step(model, data, n=1000)
    print(data.tip("wire"))

All in SI units and in the patient's frame, unless a name says another unit.
"""

from pathlib import Path as _Path

from . import _ostium
from .errors import OstiumError
from ._ostium import (
    Batch, Data, Imager, Model, Vessel, cases, explain, instruments, rollout, run_script, scripts, step, views,
)
from .recording import Recording
from . import dataset, sweep
from . import vessel_file as _vessel_file  # Vessel.save, Vessel.load

__version__ = _ostium.__version__
__all__ = [
    "Batch", "Data", "Imager", "Model", "OstiumError", "Recording", "Vessel", "cases", "dataset", "explain", "instruments",
    "rollout", "run_script", "scripts", "step", "sweep", "views",
]

_here = _Path(__file__).parent
if not (_here / "data").is_dir():  # a build folder: its files are links to the source's
    _here = _Path(_ostium.__file__).parent
_ostium.set_folders(str(_here / "data"), str(_here / "ostium-reader"))

for _one in (Batch, Data, Imager, Model, Vessel, cases, explain, instruments, rollout, run_script, scripts, step, views):
    _one.__module__ = "ostium"
