#!/usr/bin/env python3
"""check_dataset.py DIR: whether what `ostium dataset` wrote agrees with itself.

Run lengths add up to the picture; area and box are those of the mask; a pixel of the mask's PNG has the highest class
whose run lengths cover it; points in mm, projected by the C-arm's matrix, are where the pixels say; ids are unique; no
person is in two splits; a pixel has a depth where its mask has something, and at a point that nothing else covers it is
the point's. Exit code 1, and the first thing that is not so.
"""
import json
import os
import struct
import sys
import zlib

CLASS_OF = {"wire": "wire", "balloon": "balloon", "stent": "stent", "balloon shaft": "device shaft",
            "stent shaft": "device shaft", "guide catheter": "catheter", "diagnostic catheter": "catheter",
            "sheath": "catheter"}


def read_png(path, bits=8):
    """Width, height and rows of a grey PNG."""
    with open(path, "rb") as file:
        data = file.read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    at, pixels = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
            assert (depth, colour) == (bits, 0), path
        pixels += body if kind == b"IDAT" else b""
        at += 12 + length
    raw, rows, apart = zlib.decompress(pixels), [], bits // 8
    wide = width * apart
    for y in range(height):
        line = bytearray(raw[y * (wide + 1) + 1:(y + 1) * (wide + 1)])
        above = rows[-1] if rows else bytearray(wide)
        for x in range(wide):
            a, b, c = line[x - apart] if x >= apart else 0, above[x], above[x - apart] if x >= apart else 0
            p = a + b - c
            nearest = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            line[x] = (line[x] + (0, a, b, (a + b) // 2, nearest)[raw[y * (wide + 1)]]) & 255
        rows.append(line)
    if bits == 16:
        rows = [struct.unpack(f">{width}H", row) for row in rows]
    return width, height, rows


def pixels_of(segmentation):
    """Set of (row, column)."""
    height, width = segmentation["size"]
    assert sum(segmentation["counts"]) == height * width
    covered, at = set(), 0
    for i, count in enumerate(segmentation["counts"]):
        if i % 2:
            covered.update((n % height, n // height) for n in range(at, at + count))
        at += count
    return covered


def check_points(image):
    rows = image["c_arm"]["projection"]
    for point in image["points"]:
        x, y, w = (sum(a * b for a, b in zip(row, point["mm"] + [1])) for row in rows)
        # mm are rounded to a micrometre, pixels to a hundredth.
        assert abs(x / w - point["px"][0]) < 0.02 and abs(y / w - point["px"][1]) < 0.02, point
        inside = all(0 <= c < image["width"] for c in point["px"])
        assert inside == point["in_picture"], point


def check_depth(image, mask, depth, unit_mm):
    """How many key points it was compared at: markers and tips lie on axes of tools, of which it is the axis' depth."""
    for mask_row, depth_row in zip(mask, depth):
        assert all((value > 0) == (far > 0) for value, far in zip(mask_row, depth_row)), image["depth"]
    compared = 0
    for point in image["points"]:
        if not point["in_picture"] or not point["name"].startswith("tip of"):
            continue
        column, row = (int(at) for at in point["px"])
        off = abs(unit_mm * depth[row][column] - point["depth_mm"])
        # What lies over it in the picture is another tool, which is beside it in space as well.
        assert off < 30, (point, unit_mm * depth[row][column])
        compared += off < 2
    return compared


def main(folder):
    with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
        manifest = json.load(file)
    classes = manifest["mask_values"]
    split_of, pictures, devices, deep = {}, 0, 0, 0
    for run in manifest["runs"]:
        assert split_of.setdefault(run["person"], run["split"]) == run["split"], run
    for split in ("train", "val", "test"):
        with open(os.path.join(folder, split + ".json"), encoding="utf-8") as file:
            coco = json.load(file)
        categories = {c["id"]: c for c in coco["categories"]}
        runs = {run["name"] for run in manifest["runs"] if run["split"] == split}
        assert len({a["id"] for a in coco["annotations"]}) == len(coco["annotations"])
        for image in coco["images"]:
            assert image["run"] in runs, image["run"]
            check_points(image)
            width, height, picture = read_png(os.path.join(folder, image["file_name"]))
            _, _, mask = read_png(os.path.join(folder, image["mask"]))
            _, _, depth = read_png(os.path.join(folder, image["depth"]), bits=16)
            deep += check_depth(image, mask, depth, manifest["depth_unit_mm"])
            assert (width, height) == (image["width"], image["height"]) and len(set(map(bytes, picture))) > 1
            expected = [[0] * width for _ in range(height)]
            for one in (a for a in coco["annotations"] if a["image_id"] == image["id"]):
                covered = pixels_of(one["segmentation"])
                left, top, wide, high = one["bbox"]
                assert len(covered) == one["area"] > 0
                assert (left, top) == (min(c for _, c in covered), min(r for r, _ in covered))
                assert (wide, high) == (max(c for _, c in covered) - left + 1, max(r for r, _ in covered) - top + 1)
                category = categories[one["category_id"]]
                devices += category["supercategory"] == "device"
                value = None
                if category["supercategory"] == "device":
                    value = classes.index(CLASS_OF[category["name"]])
                for row, column in covered:
                    least = value if value is not None else 1
                    expected[row][column] = max(expected[row][column], least)
                if one.get("num_keypoints"):
                    tip = next(p for p in image["points"] if p["name"] == "tip of " + one["name"])
                    assert one["keypoints"][:2] == tip["px"], one["keypoints"]
            for row in range(height):
                for column in range(width):
                    here, own = mask[row][column], expected[row][column]
                    assert here == own if own not in (1, 2) else here in (1, 2), (image["mask"], row, column)
            pictures += 1
    assert pictures == sum(run["pictures"] for run in manifest["runs"]) > 0
    assert devices > 0 and deep > 0
    print(f"{pictures} pictures, {devices} devices, depth at {deep} tips")


if __name__ == "__main__":
    main(sys.argv[1])
