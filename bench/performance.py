#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

"""Measures speed and memory, and writes docs/performance.md from what it finds.

  bench/performance.py                        build, measure, write build/performance.json and the document
  bench/performance.py --from build/performance.json       write the document again, measuring nothing

Benchmarks run in passes, each over all of them in an order of its own; what counts is the median
over passes, so that a slow minute of the machine is no benchmark's alone. Leave the machine alone
meanwhile. Instructions are counted by instructions.py; without valgrind they are left out."""

import argparse
import json
import os
import platform
import re
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True  # nothing beside the sources
import instructions
import performance_document
from instructions import Unavailable, replace_file

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent


def say(text):
    print(text, file=sys.stderr, flush=True)


def built(build):
    """Builds what is run; the program of benchmarks."""
    if not (build / "CMakeCache.txt").is_file():
        raise Unavailable(f"'{build}' is no build folder; configure one with "
                          "cmake --preset release -DREGAIN_BUILD_BENCHMARKS=ON")
    cache = (build / "CMakeCache.txt").read_text()
    if not re.search(r"^REGAIN_BUILD_BENCHMARKS:BOOL=(ON|1|TRUE|YES)$", cache, re.M | re.I):
        raise Unavailable(f"'{build}' has no benchmarks; configure it with "
                          "-DREGAIN_BUILD_BENCHMARKS=ON")
    known = subprocess.run(["cmake", "--build", build, "--target", "help"], capture_output=True,
                           text=True).stdout
    for target in ("regain_bench", "regain_count"):
        if target == "regain_bench" or target in known:
            if subprocess.run(["cmake", "--build", build, "--target", target],
                              stdout=sys.stderr).returncode != 0:
                raise Unavailable(f"the target {target} does not build")
    return build / "bench" / "regain_bench"


def machine():
    """What this runs on, without anything that tells whose it is."""
    about = {"cpu": platform.processor() or platform.machine(), "instruction_sets": [],
             "cores": len(os.sched_getaffinity(0)), "system": platform.system(),
             "libc": " ".join(platform.libc_ver())}
    try:
        info = Path("/proc/cpuinfo").read_text()
    except OSError:
        return about
    model = re.search(r"^model name\s*: (.*)$", info, re.M)
    flags = re.search(r"^flags\s*: (.*)$", info, re.M)
    if model:
        about["cpu"] = model.group(1).strip()
    if flags:
        has = set(flags.group(1).split())
        of_interest = ("sse4_2", "avx", "avx2", "fma", "avx512f", "avx512cd", "avx512dq", "avx512bw")
        about["instruction_sets"] = [name for name in of_interest if name in has]
    return about


def one_pass(program, options, number, rows):
    """Runs all benchmarks once; adds to `rows`, and answers the context."""
    with tempfile.TemporaryDirectory() as folder:
        out, errors = Path(folder) / "pass.json", Path(folder) / "errors"
        run = subprocess.Popen(
            [program, f"--benchmark_filter={options.filter}", "--benchmark_repetitions=1",
             "--benchmark_enable_random_interleaving=true",
             f"--benchmark_min_time={options.min_time}", "--benchmark_out_format=json",
             f"--benchmark_out={out}"],
            stdout=subprocess.PIPE, stderr=errors.open("w"), text=True)
        try:
            started, done = time.monotonic(), 0
            for line in run.stdout:
                done += "/" in line
                if done % 500 == 0 and "/" in line:
                    say(f"pass {number} of {options.passes}: {done} benchmarks in "
                        f"{time.monotonic() - started:.0f} s")
            if run.wait() != 0:
                raise Unavailable(f"'{program}' failed:\n{errors.read_text().strip()}")
        finally:
            run.kill()
            run.wait()
        text = out.read_text()
    if not text.strip():
        raise Unavailable(f"no benchmark's name matches '{options.filter}'")
    result = json.loads(text)
    for b in result["benchmarks"]:
        row = rows.setdefault(b["name"], {"ns": []})
        if b["name"].startswith("threads/"):
            row["ns"].append(1e9 / b["items_per_second"])
        else:
            row["ns"].append(b["cpu_time"] / b["points"])
        for key in ("closure_bytes", "prepared_bytes", "table_bytes"):
            if key in b:
                row[key] = int(b[key])
    return result["context"]


def summary(row):
    """The median over passes, and how far apart the middle half of them is, of the median."""
    times = sorted(row.pop("ns"))
    median = statistics.median(times)
    quarter = len(times) // 4
    spread = times[-1 - quarter] - times[quarter]
    return {**row, "ns": round(median, 4), "spread": round(spread / median, 4)}


def counted(build):
    try:
        say("instructions")
        return {**instructions.about(build), "counts": instructions.count(build)}
    except Unavailable as why:
        say(f"instructions are left out: {why}")
        return None


def rendered(build, passes=3):
    """Seconds of a picture on one thread and on two."""
    program = build / "tools" / "regain"
    if not program.is_file():
        say(f"rendering is left out: there is no '{program}'")
        return None
    seconds = {1: [], 2: []}
    with tempfile.TemporaryDirectory() as folder:
        for number in range(passes):
            for threads in seconds:
                say(f"picture {number + 1} of {passes} on {threads} of 2 threads")
                run = subprocess.run(
                    [program, "render", "--threads", str(threads), "--spp", "16", "--size",
                     "480x270", "--quiet", "--json", "-o", f"{folder}/picture.exr"],
                    capture_output=True, text=True)
                if run.returncode != 0:
                    raise Unavailable(f"'{program} render' failed:\n{run.stderr.strip()}")
                seconds[threads].append(json.loads(run.stdout)["seconds"])
    return {str(threads): statistics.median(all_of) for threads, all_of in seconds.items()}


def measure(options):
    build = options.build.resolve()
    program = built(build)
    rows, context = {}, {}
    for number in range(1, options.passes + 1):
        context = one_pass(program, options, number, rows)
        say(f"pass {number} of {options.passes} is done: {len(rows)} benchmarks")
    return {
        "regain": context["regain_version"],
        "date": time.strftime("%Y-%m-%d"),
        "machine": machine(),
        "compiler": context["regain_compiler"],
        "flags": context["regain_flags"],
        "passes": options.passes,
        "min_time": options.min_time,
        "rows": {name: summary(row) for name, row in sorted(rows.items())},
        "instructions": counted(build),
        "render": rendered(build) if options.render else None,
    }


def positive(kind, least, most):
    def parse(text):
        try:
            value = kind(text)
        except ValueError:
            value = None
        if value is None or not least <= value <= most:
            raise argparse.ArgumentTypeError(f"'{text}' is not in [{least}, {most}]")
        return value
    return parse


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "release",
                        help="build folder (default: build/release)")
    parser.add_argument("--json", type=Path, default=ROOT / "build" / "performance.json",
                        help="where measurements go (default: build/performance.json)")
    parser.add_argument("--document", type=Path, default=ROOT / "docs" / "performance.md",
                        help="where the document goes (default: docs/performance.md)")
    parser.add_argument("--from", type=Path, dest="source", metavar="FILE.json",
                        help="write the document of these measurements, and measure nothing")
    parser.add_argument("--passes", type=positive(int, 1, 1000), default=7,
                        help="over all benchmarks (default: 7)")
    parser.add_argument("--min-time", type=positive(float, 1e-4, 60), default=0.005,
                        help="seconds a benchmark, of each pass (default: 0.005)")
    parser.add_argument("--filter", default=".", help="regular expression of benchmarks' names")
    parser.add_argument("--render", action="store_true",
                        help="regain render on one and two threads as well")
    options = parser.parse_args()

    if options.source:
        try:
            data = json.loads(options.source.read_text())
        except (OSError, ValueError) as why:
            raise Unavailable(f"cannot read '{options.source}': {why}") from why
    else:
        data = measure(options)
        replace_file(options.json, json.dumps(data, indent=1) + "\n")
        say(f"wrote {options.json}")
    replace_file(options.document, performance_document.text_of(data))
    say(f"wrote {options.document}")
    return 0


if __name__ == "__main__":
    instructions.run(main, "performance.py")
