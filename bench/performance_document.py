# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

"""docs/performance.md as a function of what performance.py measured.

Nearly all of it are ratios of two rows of one run, for those hold on other machines, too."""

import textwrap

from performance_targets import TARGETS

ALPHAS = ("0.1", "0.5", "1")
QUESTIONS = ("construct", "prepare", "build", "eval", "sample", "pdf")
VECTORS = (("avx2", "AVX2"), ("avx512", "AVX-512"))


class Data:
    """Rows by name, and ratios of them; None where something was not measured."""

    def __init__(self, data):
        self.rows = data["rows"]
        counts = data.get("instructions")
        self.counts = counts["counts"] if counts else {}

    def time(self, name):
        row = self.rows.get(name)
        return row["ns"] if row else None

    def time_ratio(self, name, reference):
        return ratio(self.time(name), self.time(reference))

    def count_ratio(self, name, reference):
        return ratio(self.counts.get(name), self.counts.get(reference))


def ratio(a, b):
    return a / b if a is not None and b else None


def number(x):
    """Two digits or three that mean something."""
    if x is None:
        return ""
    return f"{x:.2f}" if x < 10 else f"{x:.1f}" if x < 100 else f"{x:.0f}"


def numbers(values):
    """One number for each alpha in one cell."""
    cells = [number(v) for v in values]
    return " / ".join(cell or "-" for cell in cells) if any(cells) else ""


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines)


def prose(text):
    """Paragraphs, whatever way they are written here, in lines of the width of other documents."""
    return "\n\n".join(textwrap.fill(" ".join(p.split()), 110, break_long_words=False,
                                     break_on_hyphens=False) for p in text.split("\n\n"))


def section(title, text, *tables):
    return f"\n## {title}\n\n{prose(text)}\n" + "".join(f"\n{t}\n" for t in tables)


def heading(data):
    m = data["machine"]
    passes = "one pass" if data["passes"] == 1 else f"{data['passes']} passes"
    facts = [
        f"Processor: {m['cpu']}, {m['cores']} cores; " + ", ".join(m["instruction_sets"] or ["no vectors"]),
        f"Compiler: {data['compiler']}, `{data['flags']}`; for vectors, AVX2 and FMA or AVX-512 F, CD, DQ "
        "and BW besides",
        f"{m['system']}, {m['libc']}; Regain {data['regain']}, {data['date']}"]
    counts = data.get("instructions")
    if counts:
        facts.append(f"Instructions: callgrind; {counts['compiler']}, `{counts['flags']}`; "
                     f"{counts['libc']} as for a plain x86-64")
    text = prose(
        f"""This page comes out of `bench/performance.py`, which measures and writes it; nobody edits it.
        What is compared stands in the same run: times are medians over {passes}, each over all
        benchmarks in an order by chance. Numbers are ratios unless a unit stands beside them, and most
        are to a white GGX mirror without compensation at the same alpha: 1 is what that takes for the
        same question. All is single precision.""")
    return ("<!-- SPDX-License-Identifier: Apache-2.0 -->\n"
            "<!-- Copyright Contributors to the Regain project -->\n\n# Speed and memory\n\n"
            + text + "\n\n" + "\n".join(f"- {fact}" for fact in facts) + "\n")


def steadiness(data):
    """How far apart the passes were, or nothing where they were too few to say."""
    spreads = sorted(row["spread"] for row in data["rows"].values())
    if data["passes"] < 4:
        return ""
    middle, most = (100 * spreads[int(len(spreads) * share)] for share in (0.5, 0.9))
    return "\n" + prose(f"The middle half of a row's times spans {middle:.1f} % of their median in half of the "
                        f"rows, and at most {most:.1f} % in nine of ten.") + "\n"


def reference(d):
    parts = []
    for question in ("eval", "sample", "build"):
        ns = d.time(f"ggx/white/none/0.5/float/{question}")
        if ns is not None:
            parts.append(f"{question} {number(ns)} ns")
    if not parts:
        return ""
    return "\n" + prose("For scale, the white GGX mirror of alpha 0.5, one point at a time, takes here: "
                        + ", ".join(parts) + ".") + "\n"


def targets(d):
    rows = []
    for target in TARGETS:
        by_time = d.time_ratio(*target.rows) if target.rows else None
        by_count = d.count_ratio(*target.counts) if target.counts else None
        if target.at_least and by_time:
            by_time = 1 / by_time
        found = by_count if target.decided_by == "instructions" else by_time
        verdict = ("not measured" if found is None
                   else "met" if target.met(found) else "**not met**")
        digits = "{:.3f}" if target.decided_by == "instructions" else "{:.2f}"
        rows.append((target.what, ("at least " if target.at_least else "at most ") + f"{target.limit:g}",
                     "" if by_time is None else f"{by_time:.2f}",
                     "" if by_count is None else digits.format(by_count),
                     target.decided_by, verdict))
    return section(
        "Targets", "Where nothing else is said, alpha is 0.5 and points come one at a time.",
        table(("what, over what", "target", "by time", "by instructions", "decided by", ""), rows))


def closures_of(d, distribution):
    """Lobe and method of a distribution's rows, in an order that puts a lobe's together."""
    found = {tuple(name.split("/")[1:3]) for name in d.rows if name.startswith(distribution + "/")}
    return sorted(found, key=lambda pair: (pair[0], pair[1] != "none", pair[1]))


def scalar_table(d, distribution):
    rows = []
    for lobe, method in closures_of(d, distribution):
        cells = []
        for question in QUESTIONS + ("albedo",):
            cells.append(numbers(
                d.time_ratio(f"{distribution}/{lobe}/{method}/{alpha}/float/{question}",
                             f"ggx/white/none/{alpha}/float/{question}") for alpha in ALPHAS))
        if any(cells):
            rows.append((lobe, f"`{method}`", *cells))
    return table(("lobe", "method", *QUESTIONS, "albedo"), rows) if rows else ""


def scalar(d):
    parts = []
    for distribution, title in (("ggx", "GGX"), ("beckmann", "Beckmann"), ("gtr", "GTR, gamma 2"),
                                ("std", "STD, gamma 2"), ("plain", "Without microfacets")):
        rows = scalar_table(d, distribution)
        if rows:
            parts.append(f"\n### {title}\n\n{rows}\n")
    if not parts:
        return ""
    return section(
        "One point at a time",
        """Time over that of the white GGX mirror of the same alpha and question; cells are alpha 0.1 / 0.5 / 1
        (a roughness where there are no microfacets). `construct` makes the closure, with its gain;
        `prepare` makes it ready for a wo; `build` is both, with an alpha that changes from point to
        point. `white` is F = 1, `schlick` has a tint at 82 degrees (F82), `conductor` is the exact n and
        k, `glass` the interface of index 1.5 with `correlated` and `glass-beta` with `beta` shadowing,
        `sheet` thin-walled. wo and wi of what transmits are on either side by chance. Where nothing is
        tabulated, `albedo` integrates, by a thousand samples or more.""") + "".join(parts)


def vectors(d):
    parts = []
    for distribution, title in (("ggx", "GGX"), ("beckmann", "Beckmann"),
                                ("plain", "Without microfacets")):
        rows = []
        for lobe, method in closures_of(d, distribution):
            cells = []
            for question in ("build", "eval", "sample", "pdf"):
                for vector, _ in VECTORS:
                    base = f"{distribution}/{lobe}/{method}/"
                    cells.append(numbers(
                        d.time_ratio(f"{base}{alpha}/float/{question}",
                                     f"{base}{alpha}/{vector}/{question}") for alpha in ALPHAS))
            if any(cells):
                rows.append((lobe, f"`{method}`", *cells))
        head = [f"{question}, {name}" for question in ("build", "eval", "sample", "pdf")
                for _, name in VECTORS]
        if rows:
            parts.append(f"\n### {title}, in vectors\n\n{table(('lobe', 'method', *head), rows)}\n")
    if not parts:
        return ""
    return section(
        "Vectors",
        """How many times faster a point is in a vector of points, 8 with AVX2 and 16 with AVX-512, than
        by the same closure one point at a time; alpha 0.1 / 0.5 / 1. What the processor lacks is left
        empty.""") + "".join(parts)


def instruction_counts(d):
    if not d.counts:
        return ""
    rows = []
    for name, count in sorted(d.counts.items()):
        kind = name.split("/")[-1]
        against = f"white/none/0.5/{kind if kind in QUESTIONS else 'eval'}"
        rows.append((f"`{name}`", f"{count:.1f}", number(d.count_ratio(name, against))))
    return section(
        "Instructions",
        """Instructions a call, and over those of the white GGX mirror of alpha 0.5; a look-up over its
        eval. GGX, one point at a time. They are the same in every run; `bench/instructions.py --compare`
        sets them beside `bench/instructions.json`.""",
        table(("operation", "instructions", "ratio"), rows))


def look_ups(d):
    names = sorted({name.rsplit("/", 2)[0] for name in d.rows if name.startswith("table/")})
    rows = []
    for name in names:
        scalar_name = f"{name}/float/look-up"
        rows.append((name.split("/", 1)[1].replace("/", " "),
                     number(d.time_ratio(scalar_name, "ggx/white/none/0.5/float/eval")),
                     *(number(d.time_ratio(scalar_name, f"{name}/{vector}/look-up"))
                       for vector, _ in VECTORS)))
    if not rows:
        return ""
    return section(
        "Tables",
        """A look-up, over an eval of the white GGX mirror of alpha 0.5, and how many times faster a point
        is in vectors. `view` and `grid` are look-ups by coordinates alone, the others of a cosine at
        alpha 0.5, index 1.5.""",
        table(("what", "over an eval", *(f"{name}, times faster" for _, name in VECTORS)), rows))


def threads(d):
    found = {}
    for name in d.rows:
        if name.startswith("threads/"):
            count = int(name.rsplit("/threads:", 1)[1])
            found.setdefault(tuple(name.split("/")[1:7]), {})[count] = d.time(name)
    if not found:
        return ""
    counts = sorted({count for times in found.values() for count in times})
    rows = []
    for path, times in sorted(found.items()):
        distribution, lobe, method, _, _, question = path
        rows.append((f"{distribution} {lobe}", f"`{method}`", question,
                     *(number(ratio(times.get(1), times.get(count))) for count in counts)))
    return section("Threads", "Answers in a given time on that many threads, over those on one.",
                   table(("lobe", "method", "", *(str(count) for count in counts)), rows))


def rendering(data):
    times = data.get("render")
    if not times:
        return ""
    return (f"\n`regain render` is {number(times['1'] / times['2'])} times as fast on two threads as "
            "on one.\n")


def construct_rows(d, distribution):
    """Of a distribution, lobe and method with the row that has their bytes."""
    for lobe, method in closures_of(d, distribution):
        row = d.rows.get(f"{distribution}/{lobe}/{method}/0.5/float/construct")
        if row:
            yield lobe, method, row


def memory(d):
    sizes = []
    for distribution in ("ggx", "plain"):
        for lobe, method, row in construct_rows(d, distribution):
            in_vectors = (d.rows.get(f"{distribution}/{lobe}/{method}/0.5/{vector}/construct")
                          for vector, _ in VECTORS)
            sizes.append((lobe, f"`{method}`", str(row["closure_bytes"]), str(row["prepared_bytes"]),
                          *(str(v["prepared_bytes"]) if v else "" for v in in_vectors)))
    distributions = ("ggx", "beckmann", "gtr", "std")
    tables = {}
    for distribution in distributions:
        for lobe, method, row in construct_rows(d, distribution):
            if row["table_bytes"]:
                kind = "mirror" if lobe in ("white", "schlick", "conductor") else lobe
                tables.setdefault((kind, method), {})[distribution] = row["table_bytes"]
    if not sizes:
        return ""
    kilobytes = [(kind, f"`{method}`",
                  *(f"{of[name] / 1024:.1f}" if name in of else "" for name in distributions))
                 for (kind, method), of in sorted(tables.items())]
    in_bytes = table(("lobe", "method", "closure", "prepared", *(name for _, name in VECTORS)), sizes)
    text = prose("""kB of the tables that a closure may read, those of `albedo` included; all closures of a
                 distribution share them, and those of `ggx` mirrors come together. They are 16 bits a number;
                 the library that loads them keeps the same as floats besides, three times as much in all.""")
    return section("Memory",
                   """Bytes of a closure, of what `prepare` makes of it, and of the latter in vectors; of GGX,
                   and of what has no microfacets.""",
                   in_bytes, text, table(("lobe", "method", *distributions), kilobytes))


def text_of(data):
    d = Data(data)
    return "".join((heading(data), reference(d), steadiness(data), targets(d), scalar(d), vectors(d),
                    instruction_counts(d), look_ups(d), threads(d), rendering(data), memory(d)))
