# SPDX-License-Identifier: MIT
"""The part of the report about many worlds in one call."""

import csv

TEXT = """## Many worlds

Milliseconds of processor time for all worlds, one thread, from arrays to the lists of each world. Uniform boxes, about two pairs
a box; medians of rounds on other worlds, in which the ways took turns ([decision 26](decisions/0026-many-worlds.md)).

| way | what |
|---|---|
| loop | an `OverlapSearch` that is kept, called for each world |
| side by side | one call for all worlds, moved apart |
| kept | a `WorldsSearch` that is kept |
| once | the function `overlapsInWorlds()` |

Recorded by hand in [benchmarks-worlds.csv](benchmarks-worlds.csv) from what `worlds_benchmark` prints, for each instruction set. AVX2 was asked for by name, and a call on 5 boxes
then uses its vectors, where it would test pairs one by one otherwise:

"""

COLUMNS = ("loop_ms", "side_by_side_ms", "kept_ms", "once_ms", "loop_float64_ms", "kept_float64_ms")


def write_worlds(docs):
    path = docs / "benchmarks-worlds.csv"
    if not path.exists():
        return ""
    heading = ["worlds", "instruction set", "loop", "side by side", "kept", "once", "float64: loop", "float64: kept"]
    lines = ["| " + " | ".join(heading) + " |", "|---|---|" + "---:|" * (len(heading) - 2)]
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            cells = [f"{int(row['worlds']):,} of {row['boxes']}", row["instruction_set"], *(row[name] for name in COLUMNS)]
            lines.append("| " + " | ".join(cells) + " |")
    return TEXT + "\n".join(lines) + "\n"
