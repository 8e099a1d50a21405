"""Vessels as files: what one is made from, so that it is the same in another place."""

import io
import zipfile
import zlib
from pathlib import Path

import numpy as np

from ._ostium import Vessel
from .errors import OstiumError
from .whole_file import write_whole

_NAMES = ("vessel", "case", "person", "vertices", "triangles", "entry", "towards", "shape")


def save(self, path):
    """Writes what this vessel is made from, a mesh included: NAME.npz. `Vessel.load` makes it again."""
    recipe = dict(zip(_NAMES, self.__getstate__()))
    recipe["person"] = -1 if recipe["person"] is None else recipe["person"]
    packed = io.BytesIO()
    np.savez_compressed(packed, format="ostium-vessel/1", **recipe)
    write_whole(path, packed.getvalue())


def load(path):
    """A vessel that `save` wrote. Raises ValueError for another file, or one that is damaged, and OstiumError where its
    case has been imported anew since, and is another."""
    packed = Path(path).read_bytes()
    try:
        with np.load(io.BytesIO(packed), allow_pickle=False) as file:
            if not {"format", *_NAMES} <= set(file.files) or str(file["format"]) != "ostium-vessel/1":
                raise ValueError("another file")
            person = int(file["person"])
            recipe = (str(file["vessel"]), str(file["case"]), None if person < 0 else person,
                      *(file[name] for name in _NAMES[3:-1]), str(file["shape"]))
        vessel = Vessel.__new__(Vessel)
        vessel.__setstate__(recipe)
        return vessel
    except OstiumError as error:  # whatever its case is by now
        raise OstiumError(f"{path}: {error}") from error
    except (ValueError, TypeError, EOFError, OSError, NotImplementedError, RuntimeError, zipfile.BadZipFile,
            zlib.error) as error:
        raise ValueError(f"{path}: is no vessel, or is damaged; expected a file of Vessel.save") from error


Vessel.save, Vessel.load = save, staticmethod(load)  # type: ignore[method-assign, assignment]
