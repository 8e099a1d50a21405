#!/usr/bin/env python3
"""check.py [ROOT]: reads the sources and prints each breach of the structure with its file, line and cure.

Rings of folders, includes that go up (layers.txt says where up is), files that are too long, types of one name,
and what has strayed to the top of the checkout.
Exit code 1 if there is any.
"""
import os
import sys

from rules import all_findings, read_layers, strays
from sources import read


def main(arguments):
    here = os.path.dirname(os.path.abspath(__file__))
    root = arguments[0] if arguments else os.path.join(here, "..", "..", "..")
    layers, tables, top = read_layers(os.path.join(here, "layers.txt"))
    sources = read(root)
    if not sources:
        print(f"{root}: no sources here\n  cure: name the root of the checkout")
        return 1
    ignore = os.path.join(root, ".gitignore")
    with open(ignore if os.path.exists(ignore) else os.devnull, encoding="utf-8") as file:
        ignored = file.read().split()
    findings = [*all_findings(sources, layers, tables), *strays(os.listdir(root), ignored, top)]
    for finding in findings:
        print(finding)
    print(f"{len(sources)} sources, {len(findings)} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
