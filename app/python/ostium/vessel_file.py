"""Vessels as files: what one is made from, so that it is the same in another place."""

import numpy as np

from ._ostium import Vessel

_NAMES = ("vessel", "case", "person", "vertices", "triangles", "entry", "towards")


def save(self, path):
    """Writes what this vessel is made from, a mesh included: NAME.npz. `Vessel.load` makes it again."""
    recipe = dict(zip(_NAMES, self.__getstate__()))
    recipe["person"] = -1 if recipe["person"] is None else recipe["person"]
    with open(path, "wb") as file:
        np.savez_compressed(file, format="ostium-vessel/1", **recipe)


def load(path):
    """A vessel that `save` wrote. Raises ValueError for another file."""
    with np.load(path, allow_pickle=False) as file:
        if not {"format", *_NAMES} <= set(file.files) or str(file["format"]) != "ostium-vessel/1":
            raise ValueError(f"{path}: is no vessel; expected a file of Vessel.save")
        person = int(file["person"])
        vessel = Vessel.__new__(Vessel)
        vessel.__setstate__((str(file["vessel"]), str(file["case"]), None if person < 0 else person,
                             file["vertices"], file["triangles"], file["entry"], file["towards"]))
    return vessel


Vessel.save, Vessel.load = save, staticmethod(load)  # type: ignore[method-assign, assignment]
