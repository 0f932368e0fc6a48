#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

"""What planning costs a scene that calls for nothing: instructions of a render of smooth metals at
a tolerance of 0.01 beside those of the same render with --method none, by callgrind.

  bench/smooth_scene.py [--build build/release] [--size 192x64]

Two numbers of samples tell what a sample takes from what starting takes, plans included. Exit code
1 where a sample takes 2 % more than without compensation, or the plan has a table or a method. Needs
valgrind; takes some minutes."""

import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

METALS = ("aluminium", "gold", "copper")
SMOOTH = ["--set", "roughness=0.005, 0.005"]
SAMPLES = (8, 40)
MOST = 0.02


def selected():
    return [word for metal in METALS for word in ("--select", f"{metal}_polished")]


def run(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"smooth_scene.py: {' '.join(command)} failed:\n{done.stderr.strip()}")
    return done


def instructions(program, size, samples, how, folder):
    command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/callgrind.out", program,
               "render", *METALS, *selected(), *SMOOTH, "--object", "sphere", "--threads", "1", "--size",
               size, "--spp", str(samples), *how, "-o", f"{folder}/smooth.exr"]
    found = re.search(r"Collected : (\d+)", run(command).stderr)
    if not found:
        sys.exit("smooth_scene.py: valgrind has collected nothing")
    return int(found.group(1))


def is_bare(program):
    """The plan has neither table nor compensation."""
    plan = json.loads(run([program, "plan", *METALS, *SMOOTH, "--tolerance", "0.01", "--json"]).stdout)
    methods = {closure["method"] for material in plan["materials"] if material["material"].endswith("_polished")
               for closure in material["closures"]}
    tables = [material["tables"] for material in plan["materials"] if material["material"].endswith("_polished")]
    print(f"methods: {', '.join(sorted(methods))}; tables: {sum(len(t) for t in tables)}")
    return methods == {"none"} and not any(tables)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build/release")
    parser.add_argument("--size", default="192x64")
    options = parser.parse_args()
    program = str(Path(options.build) / "tools" / "regain")
    if not shutil.which("valgrind"):
        sys.exit("smooth_scene.py: there is no valgrind")
    bare = is_bare(program)
    counts = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, how in (("none", ["--method", "none"]), ("planned", ["--tolerance", "0.01"])):
            few, many = (instructions(program, options.size, s, how, folder) for s in SAMPLES)
            each = (many - few) / (SAMPLES[1] - SAMPLES[0])
            counts[name] = each
            print(f"{name}: {each / 1e6:.3f} million instructions for a sample of each pixel, "
                  f"{(few - SAMPLES[0] * each) / 1e6:.0f} million besides")
    more = counts["planned"] / counts["none"] - 1
    print(f"planned over none: {100 * more:+.3f} %")
    return 0 if bare and more <= MOST else 1


if __name__ == "__main__":
    sys.exit(main())
