# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

"""What speed is wanted, as ratios of two rows, each over the other: of benchmarks, named in
benchmarks.h, and of instructions, in count.cpp."""

from dataclasses import dataclass
from typing import Optional, Tuple


@dataclass(frozen=True)
class Target:
    what: str
    limit: float
    rows: Optional[Tuple[str, str]] = None
    counts: Optional[Tuple[str, str]] = None
    decided_by: str = "time"
    at_least: bool = False  # how many times faster the first row is, at least

    def met(self, found):
        return found >= self.limit if self.at_least else found <= self.limit


def scalar(name, alpha="0.5"):
    """Benchmark and count of lobe/method/question."""
    lobe, method, question = name.split("/")
    return (f"ggx/{lobe}/{method}/{alpha}/float/{question}", f"{lobe}/{method}/{alpha}/{question}")


def of(what, limit, name, reference, alpha="0.5", decided_by="time"):
    first, second = scalar(name, alpha), scalar(reference, alpha)
    return Target(what, limit, (first[0], second[0]), (first[1], second[1]), decided_by)


def added(what, limit, method, question):
    return of(what, limit, f"schlick/{method}/{question}", f"schlick/none/{question}",
              decided_by="instructions")


TARGETS = (
    of("F82 conductor, `turquin`: eval over white GGX", 1.3, "schlick/turquin/eval", "white/none/eval"),
    of("the same: sample", 1.2, "schlick/turquin/sample", "white/none/sample"),
    of("F82 conductor, `directional`: eval over white GGX", 1.3, "schlick/directional/eval",
       "white/none/eval"),
    of("the same: sample", 1.2, "schlick/directional/sample", "white/none/sample"),
    of("F82 conductor, `turquin`: construction with the gain, over its own eval", 1.5,
       "schlick/turquin/construct", "schlick/turquin/eval"),
    of("the same with prepare, which looks the gain up", 1.5, "schlick/turquin/build",
       "schlick/turquin/eval"),
    of("F82 conductor, `directional`: construction with the gain, over its own eval", 1.5,
       "schlick/directional/construct", "schlick/directional/eval"),
    of("the same with prepare, which looks the gain up", 1.5, "schlick/directional/build",
       "schlick/directional/eval"),
    of("glass, `turquin`: eval over white GGX", 2, "glass/turquin/eval", "white/none/eval"),
    of("the same: sample", 1.5, "glass/turquin/sample", "white/none/sample"),
    Target("F82 conductor, `turquin`: eval a point in AVX2 vectors, times as fast as one at a time", 5,
           ("ggx/schlick/turquin/0.5/avx2/eval", "ggx/schlick/turquin/0.5/float/eval"), at_least=True),
    Target("F82 conductor, `walk`: sample a point in AVX2 vectors, over a single-scattering sample "
           "of one point", 1.5,
           ("ggx/schlick/walk/0.5/avx2/sample", "ggx/schlick/none/0.5/float/sample")),
    Target("the same of `walk-bounded`", 1.5,
           ("ggx/schlick/walk-bounded/0.5/avx2/sample", "ggx/schlick/none/0.5/float/sample")),
    added("what `turquin` adds: eval over that of `none`", 1.02, "turquin", "eval"),
    added("the same: sample", 1.02, "turquin", "sample"),
    added("what `directional` adds: eval over that of `none`", 1.05, "directional", "eval"),
    added("the same: sample", 1.05, "directional", "sample"),
    added("what `balanced` adds: eval over that of `none`", 1.10, "balanced", "eval"),
    added("what `tail` adds: eval over that of `none`", 1.5, "tail", "eval"),
    of("F82 conductor, `walk`, alpha 1: sample over a single-scattering sample", 2.5,
       "schlick/walk/sample", "schlick/none/sample", "1"),
    of("the same of `walk-bounded`", 2.5, "schlick/walk-bounded/sample", "schlick/none/sample", "1"),
    of("glass, `walk`, alpha 1: sample over a single-scattering sample", 3, "glass-beta/walk/sample",
       "glass-beta/none/sample", "1"),
    of("the same of `walk-bounded`", 3, "glass-beta/walk-bounded/sample", "glass-beta/none/sample", "1"),
)
