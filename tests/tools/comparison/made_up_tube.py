#!/usr/bin/env python3
"""made_up_tube.py FILE.stl RADIUS_MM LENGTH_MM: a coarse bent tube along x, closed at both ends, as an STL text in mm."""
import math
import sys


def write_tube(path, radius_mm=2.0, length_mm=60.0, closed=False, around=32, along=60):
    """Its axis is y = 0.005 x^2 / mm."""
    def middle(i):
        s = length_mm * i / along
        return s, 0.005 * s * s, 0.0

    def at(i, k):
        x, y, _ = middle(i)
        a = 2 * math.pi * k / around
        return x, y + radius_mm * math.cos(a), radius_mm * math.sin(a)
    triangles = []
    for i in range(along):
        for k in range(around):
            a, b, c, d = at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)
            triangles += [(a, b, c), (a, c, d)]
    if closed:
        for k in range(around):
            triangles += [(middle(0), at(0, k), at(0, k + 1)), (middle(along), at(along, k + 1), at(along, k))]
    with open(path, "w", encoding="ascii") as file:
        file.write("solid tube\n")
        for corners in triangles:
            file.write("facet normal 0 0 0\nouter loop\n")
            file.writelines(f"vertex {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in corners)
            file.write("endloop\nendfacet\n")
        file.write("endsolid tube\n")


if __name__ == "__main__":
    write_tube(sys.argv[1], float(sys.argv[2]), float(sys.argv[3]), closed=True, around=16, along=40)
