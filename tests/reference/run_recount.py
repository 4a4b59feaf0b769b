# SPDX-License-Identifier: Apache-2.0
"""run_recount.py LEAFHULL RECOUNT TREE extracts the tree with every method and style and recounts each
report by brute force."""

import pathlib
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
VERTICES = ["--points", "vertices"]
DRAFT = ["--preset", "draft", *VERTICES]
# A filled hollow cannot be recounted from kernels.
AREA = ["--preset", "draft", "--points", "area", "--hollows", "keep"]
CASES = {
    "painterly, standard": ["--preset", "standard", *VERTICES],
    "painterly, draft": DRAFT,
    "paper-thin": ["--style", "paper-thin", *DRAFT],
    "paper-fat": ["--style", "paper-fat", *DRAFT],
    "paper-previous": ["--style", "paper-previous", *DRAFT],
    "isotropic": ["--method", "isotropic", *DRAFT],
    "threshold": ["--threshold", "3", *DRAFT],
    "threshold percent": ["--threshold", "20%", *DRAFT],
    "falloff 1": ["--falloff", "1", *DRAFT],
    "falloff 3": ["--falloff", "3", *DRAFT],
    "variance": ["--spread", "variance", *DRAFT],
    "density grid": ["--density", "grid", *DRAFT],
    "dense": ["--dense", *DRAFT],
    "bricks": ["--mesher", "bricks", *DRAFT],
}
AREA_CASES = {
    "area, painterly": AREA,
    "area, thin": ["--style", "thin", *AREA],
    "area, fat": ["--style", "fat", *AREA],
    "area, previous": ["--style", "previous", *AREA],
    "area, uncontrolled": ["--method", "uncontrolled", *AREA],
    "area, threshold": ["--threshold", "0.7", *AREA],
    "area, threshold percent": ["--threshold", "30%", *AREA],
    "area, falloff 1": ["--falloff", "1", *AREA],
    "area, falloff 3": ["--falloff", "3", *AREA],
    "area, finer points": ["--point-spacing", "0.2", *AREA],
}


def extract(leafhull, tree, options, folder):
    folder.mkdir()
    files = [folder / "kernels.ply", folder / "report.json", folder / "shape.ply"]
    subprocess.run([leafhull, "extract", tree, "-q", "-o", files[2], "--save-kernels", files[0],
                    "--report", files[1], *options], check=True)
    return files


def agrees(recount, name, files, extra=()):
    start = time.perf_counter()
    result = subprocess.run([recount, *files, *extra], stdout=subprocess.PIPE, text=True)
    verdict = "agrees" if result.returncode == 0 else "DIFFERS"
    print(f"{name}: {verdict} ({time.perf_counter() - start:.1f} s)\n{result.stdout}", flush=True)
    return result.returncode == 0


def main(leafhull, recount, tree):
    if not pathlib.Path(tree).exists():
        print(f"SKIPPED: no {tree}; the recount of this tree was NOT run")
        return SKIPPED
    with tempfile.TemporaryDirectory() as root:
        root = pathlib.Path(root)
        uncontrolled = extract(leafhull, tree, ["--method", "uncontrolled", *DRAFT],
                               root / "uncontrolled")
        failed = [] if agrees(recount, "uncontrolled", uncontrolled) else ["uncontrolled"]
        for name, options in CASES.items():
            files = extract(leafhull, tree, options, root / name)
            if not agrees(recount, name, files, ["--leaf-radii", uncontrolled[0]]):
                failed.append(name)
        for name, options in AREA_CASES.items():
            if not agrees(recount, name, extract(leafhull, tree, options, root / name)):
                failed.append(name)
    cases = len(CASES) + len(AREA_CASES) + 1
    print(f"differ: {', '.join(failed)}" if failed else f"all {cases} cases agree")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
