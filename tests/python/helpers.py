"""What several tests of the Python module use."""

import numpy as np
import ostium

FEED = 0.02  # m/s


def drive(data, seed, calls=10, n=20):
    """The same drives for the same seed."""
    random = np.random.default_rng(seed)
    for _ in range(calls):
        data.inputs[0], data.inputs[1] = random.uniform(-0.2, 1) * FEED, random.uniform(-3, 3)
        ostium.step(data.model, data, n)
    return data


def tube(path, length_mm=120.0, radius_mm=6.0, around=24, along=40):
    """A closed tube along x as ASCII STL, in mm."""
    angle = 2 * np.pi * np.arange(around) / around
    ring = np.stack([np.zeros(around), np.cos(angle), np.sin(angle)], axis=1) * radius_mm
    rings = [ring + [x, 0, 0] for x in np.linspace(0, length_mm, along)]
    corners = []
    for a, b in zip(rings, rings[1:]):
        for i in range(around):
            j = (i + 1) % around
            corners += [(a[i], a[j], b[i]), (b[i], a[j], b[j])]
    for ring, turned in ((rings[0], True), (rings[-1], False)):
        middle = ring.mean(axis=0)
        for i in range(around):
            j = (i + 1) % around
            corners.append((middle, ring[j], ring[i]) if turned else (middle, ring[i], ring[j]))
    lines = ["solid tube"]
    for triangle in corners:
        lines += ["facet normal 0 0 0", "outer loop", *("vertex {:.6f} {:.6f} {:.6f}".format(*p) for p in triangle),
                  "endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid tube"]))
