# SPDX-License-Identifier: Apache-2.0
"""fake_leafhull.py VERB ...: answers like leafhull about forests. A tree has as many leaf vertices
as its file has bytes, a scene names its trees in turn, and a forest is a file of 1,000 bytes. The
scene `broken` fails with an error."""

import argparse
import itertools
import json
import os
import pathlib
import sys

if sys.argv[1:] == ["--version"]:
    print("leafhull 7")
    sys.exit()
parser = argparse.ArgumentParser()
verbs = parser.add_subparsers(dest="verb")
inspect, scatter, forest = (verbs.add_parser(verb) for verb in ("inspect", "scatter", "forest"))
inspect.add_argument("tree", type=pathlib.Path)
inspect.add_argument("--json", action="store_true", required=True)
scatter.add_argument("trees", nargs="+")
for option, kind in (("--count", int), ("--seed", int), ("--spacing", float)):
    scatter.add_argument(option, type=kind, required=True)
forest.add_argument("scene", type=pathlib.Path)
forest.add_argument("--merge", choices=("none", "canopy"))
forest.add_argument("--voxel-size", type=float)
forest.add_argument("--memory")
forest.add_argument("--threads", type=int)
forest.add_argument("-q", action="store_true")
for verb in (scatter, forest):
    verb.add_argument("-o", type=pathlib.Path, required=True)
asked = parser.parse_args()

if asked.verb == "inspect":
    print(json.dumps({"leaves": {"leaf_vertices": asked.tree.stat().st_size}}))
elif asked.verb == "scatter":
    names = [os.path.relpath(tree, asked.o.parent) for tree in asked.trees]
    turns = itertools.islice(itertools.cycle(names), asked.count)
    lines = ["model,x,y,z", *(f"{name},{i},0,0" for i, name in enumerate(turns))]
    asked.o.write_text("\n".join(lines) + "\n")
elif "broken" in str(asked.scene):
    sys.exit("leafhull: the roof fell in")
else:
    held = bytearray(200 * 2**20)
    asked.o.mkdir()
    (asked.o / "forest.glb").write_bytes(held[:1000])
