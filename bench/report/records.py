# SPDX-License-Identifier: MIT
"""The records of a run, as allpairs_bench writes them, and of programs measured outside of it."""

import csv
from dataclasses import dataclass

OURS = "allpairs"
OWN_VARIANTS = {
    "allpairs": "unordered",
    "allpairs ordered": "ordered",
    "allpairs vector": "overlaps(boxes)",
    "allpairs warm": "memory kept",
    "allpairs count": "count only",
}


@dataclass(frozen=True)
class Record:
    name: str
    setting: str
    part: str  # "contest": against peers; ours alone: "threads", by their number, and "kernel", exhaustive.
    scene: str
    boxes: int
    threads: int
    pairs: int
    hash: str
    wall_ms: float
    cpu_ms: float
    min_ms: float
    max_ms: float
    repetitions: int
    mistake: str
    provenance: dict
    external: bool = False
    ours_ms: float = 0.0  # Of a program measured aside: our time in that run, or 0.

    @property
    def is_peer(self):
        """Whether it is another program that was measured in the same run."""
        return self.name not in OWN_VARIANTS and not self.external


PROVENANCE = ("commit", "compiler", "build", "processor", "processors", "instruction_set", "date")


def read_results(path):
    """The records that allpairs_bench wrote."""
    with open(path, newline="", encoding="utf-8") as file:
        return [_own_record(row) for row in csv.DictReader(file)]


def read_external(path):
    """Records of other programs: name,scene,n,ms,pairs,hash and perhaps setting,allpairs_ms; # begins a comment."""
    with open(path, newline="", encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("#")]
    return [_external_record(row) for row in csv.DictReader(lines)]


def _own_record(row):
    return Record(
        name=row["name"],
        setting=row["setting"],
        part=row["part"],
        scene=row["scene"],
        boxes=int(row["n"]),
        threads=int(row["threads"]),
        pairs=int(row["pairs"]),
        hash=row["hash"],
        wall_ms=float(row["median_ms"]),
        cpu_ms=float(row["median_cpu_ms"]),
        min_ms=float(row["min_ms"]),
        max_ms=float(row["max_ms"]),
        repetitions=int(row["repetitions"]),
        mistake=row["mistake"],
        provenance={key: row[key] for key in PROVENANCE},
    )


def _external_record(row):
    time = float(row["ms"])
    return Record(
        name=row["name"],
        setting=row.get("setting") or "",
        part="contest",
        scene=row["scene"],
        boxes=int(row["n"]),
        threads=1,
        pairs=int(row["pairs"]),
        hash=row["hash"],
        wall_ms=time,
        cpu_ms=time,
        min_ms=time,
        max_ms=time,
        repetitions=1,
        mistake="",
        provenance={},
        external=True,
        ours_ms=float(row.get("allpairs_ms") or 0),
    )


class Table:
    """Records by scene and number of boxes: of the contests by name, of the scaling part by number of threads."""

    def __init__(self, records):
        self.contests = {}
        self.scaling = {}
        self.kernel = []
        for record in records:
            key = (record.scene, record.boxes)
            if record.part == "threads":
                self.scaling.setdefault(key, {})[record.threads] = record
            elif record.part == "kernel":
                self.kernel.append(record)
            else:
                self.contests.setdefault(key, {})[record.name] = record

    def scenes(self, is_sorted=False):
        names = [scene for scene, _ in self.contests if scene.endswith("-sorted") == is_sorted]
        return list(dict.fromkeys(names))

    def sizes(self, scene):
        return sorted(boxes for name, boxes in self.contests if name == scene)

    def cell(self, scene, boxes):
        return self.contests.get((scene, boxes), {})

    def peers(self):
        names = [name for cell in self.contests.values() for name, record in cell.items() if record.is_peer]
        return list(dict.fromkeys(names))
