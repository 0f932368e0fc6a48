#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

"""Instructions per call of what is hot, by callgrind: exact, where times are not.

  bench/instructions.py                         print counts
  bench/instructions.py --compare               beside the record; 1 if any grew by more than 3 %
  bench/instructions.py --record [--reason WHY] make these the record

The record is bench/instructions.json. A count that has to grow is recorded with a reason, which is
kept beside it until it is recorded without. Counts are of regain_count, compiled with flags of its
own, and of glibc's functions for the plain x86-64, so that they are the same on every such machine
with that compiler and that glibc. Needs valgrind."""

import argparse
import json
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
RECORD = HERE / "instructions.json"
MOST_GROWTH = 0.03

# Which of glibc's functions run must not depend on the processor. Names are spelled as before
# glibc 2.33, and since.
NO_VECTORS = "glibc.cpu.hwcaps=" + ",".join(
    f"-{name}{suffix}"
    for name in ("SSSE3", "SSE4_1", "SSE4_2", "AVX", "AVX2", "AVX512F", "FMA", "FMA4", "BMI2", "ERMS",
                 "FSRM")
    for suffix in ("", "_Usable"))


class Unavailable(Exception):
    """Nothing can be counted here; says why."""


def replace_file(path, text):
    """Writes all of a file or nothing."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=path.name + ".")
    try:
        with os.fdopen(handle, "w") as out:
            out.write(text)
        os.chmod(name, 0o644)
        os.replace(name, path)
    except BaseException:
        os.unlink(name)
        raise


def program_of(build):
    program = Path(build) / "bench" / "regain_count"
    if not program.is_file():
        raise Unavailable(
            f"there is no '{program}'; configure with -DREGAIN_BUILD_BENCHMARKS=ON on x86-64 with "
            "valgrind's headers, and build the target regain_count")
    return program


def about(build):
    """The compiler, the flags and the C library that counts depend on."""
    answer = json.loads(subprocess.run([program_of(build), "--about"], check=True,
                                       capture_output=True, text=True).stdout)
    answer["libc"] = " ".join(platform.libc_ver())
    return answer


def count(build):
    """Instructions per call by the name of the operation."""
    if not shutil.which("valgrind"):
        raise Unavailable("valgrind is not installed (Debian, Ubuntu: valgrind)")
    program = program_of(build)
    calls = about(build)["calls"]
    totals = {}
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run(
            ["valgrind", "--tool=callgrind", "--collect-atstart=no",
             f"--callgrind-out-file={folder}/out", program],
            env={**os.environ, "GLIBC_TUNABLES": NO_VECTORS}, capture_output=True, text=True)
        if run.returncode != 0:
            raise Unavailable(f"'{program}' failed under valgrind:\n{run.stderr.strip()}")
        for file in Path(folder).glob("out.*"):
            text = file.read_text()
            name = re.search(r"^desc: Trigger: Client Request: (.*)$", text, re.M)
            total = re.search(r"^totals: (\d+)", text, re.M)
            if name and total:
                totals[name.group(1)] = int(total.group(1))
    if "nothing" not in totals:
        raise Unavailable(f"valgrind wrote no counts of '{program}'")
    loop = totals.pop("nothing")
    return {name: round((total - loop) / calls, 2) for name, total in sorted(totals.items())}


def read_record():
    if not RECORD.is_file():
        raise Unavailable(f"there is no record '{RECORD}'; --record makes one")
    return json.loads(RECORD.read_text())


def compare(record, conditions, now):
    """Prints a table; whether nothing grew too much."""
    was = {key: record[key] for key in conditions}
    if was != conditions:
        raise Unavailable(f"the record was made with {was}, this program with {conditions}: counts "
                          "do not compare; build with that compiler, or make a record with --record")
    good = True
    print(f"{'operation':<36} {'record':>10} {'now':>10} {'change':>8}")
    for name in sorted(set(record["counts"]) | set(now)):
        entry, new = record["counts"].get(name), now.get(name)
        if entry is None:
            print(f"{name:<36} {'':>10} {new:>10.2f}   is not in the record")
        elif new is None:
            print(f"{name:<36} {entry['instructions']:>10.2f} {'':>10}   is not counted any more")
            good = False
        else:
            old = entry["instructions"]
            grew = new > old * (1 + MOST_GROWTH)
            good = good and not grew
            note = "  grew" if grew else ""
            if "reason" in entry:
                note += f"  ({entry['reason']})"
            print(f"{name:<36} {old:>10.2f} {new:>10.2f} {100 * (new / old - 1):>+7.2f}%{note}")
    if not good:
        print(f"Counts grew by more than {100 * MOST_GROWTH:g} %, or are gone. Where that is for a "
              "reason: --record --reason 'WHY'")
    return good


def make_record(conditions, now, reason):
    """A reason goes to what grew too much, and stays with what has not changed since."""
    old = json.loads(RECORD.read_text())["counts"] if RECORD.is_file() else {}
    counts = {}
    for name, instructions in now.items():
        entry = {"instructions": instructions}
        before = old.get(name)
        if before and instructions == before["instructions"] and "reason" in before:
            entry["reason"] = before["reason"]
        elif before and instructions > before["instructions"] * (1 + MOST_GROWTH) and reason:
            entry["reason"] = reason
        counts[name] = entry
    replace_file(RECORD, json.dumps({**conditions, "counts": counts}, indent=1) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=HERE.parent / "build" / "release",
                        help="build folder (default: build/release)")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--compare", action="store_true")
    what.add_argument("--record", action="store_true")
    parser.add_argument("--reason", help="why counts grew; with --record")
    options = parser.parse_args()
    if options.reason and not options.record:
        parser.error("--reason goes with --record")

    record = read_record() if options.compare else None
    conditions = about(options.build)
    now = count(options.build)
    if options.compare:
        return 0 if compare(record, conditions, now) else 1
    if options.record:
        again = count(options.build)
        differ = [name for name in now if again.get(name) != now[name]]
        if differ:
            raise Unavailable(f"two runs count differently, so there is no record: {differ}")
        make_record(conditions, now, options.reason)
        print(f"Two runs count the same. {RECORD} has {len(now)} operations.")
        return 0
    for name, instructions in now.items():
        print(f"{name:<36} {instructions:>10.2f}")
    return 0


def run(main, name):
    """Ends the program with what main returns, 2 where it cannot be done, 130 after Ctrl-C."""
    try:
        sys.exit(main())
    except Unavailable as why:
        print(f"{name}: {why}", file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)


if __name__ == "__main__":
    run(main, "instructions.py")
