# SPDX-License-Identifier: MIT
"""The part of the report about repeated steps: moving boxes, the component, queries, deforming meshes."""

import csv
from dataclasses import dataclass

import records as searches
from charts import number_text, row_chart, save, time_text

OURS = "Allpairs"
FULL = "full rebuild"  # The component without its kept search.


@dataclass(frozen=True)
class Task:
    """The time of one contender for one task."""

    task: str
    subject: str
    size: int
    contender: str
    setting: str
    results: int
    repetitions: int
    cpu_ms: float
    late_ms: float  # The 99th percentile of a frame's time; 0 where there are no frames.
    worst_ms: float
    right: bool
    provenance: dict
    ratio: float = 0.0  # The median, over the frames of both, of its time to the first contender's; 0 where there are none.
    turn: int = 1  # Frames of a turn.


PROVENANCE = ("commit", "compiler", "processor")


def read_moving(path):
    """Frames of moving boxes, as moving_benchmark writes them."""
    with open(path, newline="", encoding="utf-8") as file:
        return [_frames_record(row) for row in csv.DictReader(file)]


def _frames_record(row):
    return Task(
        task="frames",
        subject=row["motion"],
        size=int(row["boxes"]),
        contender=row["contender"],
        setting=row["setting"],
        results=int(row["pairs"]),
        repetitions=int(row["frames"]),
        cpu_ms=float(row["median_cpu_ms"]),
        late_ms=float(row["p99_cpu_ms"]),
        worst_ms=float(row["worst_cpu_ms"]),
        right=int(row["wrong_frames"]) == 0,
        provenance={key: row.get(key, "") for key in PROVENANCE},
        ratio=float(row["median_ratio"]),
        turn=int(row["turn_frames"]),
    )


def read_tasks(path):
    """Records of the other benchmarks, which share a format: bench/measure/RecordFile.h."""
    with open(path, newline="", encoding="utf-8") as file:
        return [_task_record(row) for row in csv.DictReader(file)]


def _task_record(row):
    return Task(
        task=row["task"],
        subject=row["subject"],
        size=int(row["size"]),
        contender=row["contender"],
        setting=row["setting"],
        results=int(row["results"]),
        repetitions=int(row["repetitions"]),
        cpu_ms=float(row["median_cpu_ms"]),
        late_ms=0.0,
        worst_ms=float(row["most_cpu_ms"]),
        right=row["right"] == "yes",
        provenance={key: row[key] for key in PROVENANCE},
    )


def groups_of(records, key):
    """Records grouped by key, in the order in which the keys first occur."""
    groups = {}
    for record in records:
        groups.setdefault(key(record), []).append(record)
    return groups


def best_by_contender(records):
    """The fastest setting of each contender."""
    best = {}
    for record in records:
        if record.contender not in best or record.cpu_ms < best[record.contender].cpu_ms:
            best[record.contender] = record
    return best


def cost_chart(title, subtitle, rows):
    """One row per task, one mark per contender; rows: [(label, {name: record})]."""
    names = {OURS: searches.OURS}
    values = [(label, {names.get(name, name): r.cpu_ms for name, r in row.items()}) for label, row in rows]
    return row_chart(title, subtitle, values, time_text, [FULL, "one-shot"])


def _row(cells):
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def _grid(heading, texts, rows):
    """A table whose first columns are text and whose other columns are numbers."""
    aligned = "|" + "---|" * texts + "---:|" * (len(heading) - texts)
    return "\n".join([_row(heading), aligned] + [_row(row) for row in rows]) + "\n"


def _name(record):
    return f"{record.contender}, {record.setting}" + ("" if record.right else " **(other results)**")


def _ratio(record, ours):
    return f"{record.cpu_ms / ours.cpu_ms:.1f}x" if record is not ours else ""


def _machine(records):
    p = records[0].provenance
    commits = ", ".join(dict.fromkeys(r.provenance["commit"] for r in records))
    return f"Measured on {p['processor']}; {p['compiler']}; commit {commits}.\n"


def frames_section(records):
    longer = {(r.subject, r.size, r.contender, r.setting): r for r in records if r.turn > 1}
    rows = []
    for (motion, size), group in groups_of(frame_by_frame(records), lambda r: (r.subject, r.size)).items():
        for r in group:
            times = [time_text(value) for value in (r.cpu_ms, r.late_ms, r.worst_ms)]
            row = [f"{motion}, {number_text(size)}", _name(r), r.repetitions] + times + [_times(r, group[0])]
            tens = longer.get((motion, size, r.contender, r.setting))
            rows.append(row + ([time_text(tens.cpu_ms), _times(tens, group[0])] if tens else ["", ""]))
    heading = ["boxes", "who", "frames", "median", "99 %", "worst", "to the world", "in tens", "to the world in tens"]
    return (
        "### Moving boxes\n\nEach contender gives the pairs of each frame, which are compared with those of the "
        "others; *world* also lists which pairs\nbegan, persist and ended.\n\n"
        "- **Scenes**: cubes that fill a tenth of the room's volume, as in Broadmark. In each frame a box moves by a "
        "tenth of its side, in *slow* by\n  a hundredth; in *one-percent* most boxes rest.\n"
        "- **Turns**: contenders are interleaved frame by frame, so that each finds the caches filled with the others' "
        "data. *In tens* they\n  alternate every ten frames, which is closer to a program that uses one of them.\n"
        "- **Ratios** are medians, over the frames of both, of the contender's time divided by the world's.\n\n"
        "![Time of a frame](images/benchmarks/moving.svg)\n\n" + _grid(heading, 2, rows)
    )


def frame_by_frame(records):
    return [r for r in records if r.turn == 1]


def _times(record, ours):
    return "" if (record.contender, record.setting) == (ours.contender, ours.setting) else f"{record.ratio:.1f}x"


def frames_chart(records):
    rows = []
    for (motion, size), group in groups_of(frame_by_frame(records), lambda r: (r.subject, r.size)).items():
        row = best_by_contender([r for r in group if r.contender != OURS])
        row[OURS] = next((r for r in group if r.setting == "world"), group[0])
        once = [r for r in group if r.contender == OURS and r.setting.startswith("one-shot")]
        if once:
            row["one-shot"] = min(once, key=lambda r: r.cpu_ms)
        rows.append((f"{motion}, {number_text(size)} boxes", row))
    return cost_chart("Time of a frame", "processor time from moved boxes to pairs, one thread, median", rows)


def cycle_section(records):
    rows = []
    for (size, subject), group in groups_of(records, lambda r: (r.size, r.subject)).items():
        kept = next(r for r in group if r.setting == "kept")
        anew = next(r for r in group if r.setting == "anew")
        right = "" if kept.right and anew.right else " **(other results)**"
        times = [time_text(kept.cpu_ms), time_text(anew.cpu_ms), f"{anew.cpu_ms / kept.cpu_ms:.1f}x"]
        rows.append([number_text(size), subject + right, number_text(float(f"{kept.results:.3g}"))] + times)
    heading = ["models", "motion", "pairs", "kept", FULL, "ratio"]
    return (
        "### The component, step after step\n\n`BruteForceBroadPhase` from begin to end of a step, with one box model "
        "per node. *Kept* reuses the last search;\n*full rebuild* searches all models in each step ([decision "
        "13](decisions/0013-component-keeps-its-search.md)).\n\n"
        "![Time of a step of the component](images/benchmarks/cycle.svg)\n\n" + _grid(heading, 2, rows)
    )


def cycle_chart(records):
    rows = []
    for (size, subject), group in groups_of(records, lambda r: (r.size, r.subject)).items():
        names = {"kept": OURS, "anew": FULL}
        rows.append((f"{number_text(size)} models, {subject}", {names[r.setting]: r for r in group}))
    return cost_chart("Time of a step of the component", "processor time from begin to end, one thread, median", rows)


def contest_rows(records, ours_setting):
    """Rows of a table of tasks: ours, and each peer in its best setting, compared with ours in one setting."""
    for (task, subject), group in groups_of(records, lambda r: (r.task, r.subject)).items():
        ours = next((r for r in group if r.contender == OURS and r.setting == ours_setting), group[0])
        best = best_by_contender([r for r in group if r.contender != OURS])
        for r in [r for r in group if r.contender == OURS] + list(best.values()):
            yield [subject, task, _name(r), r.results, time_text(r.cpu_ms), _ratio(r, ours)]


def contest_chart(title, subtitle, records):
    rows = []
    for (task, subject), group in groups_of(records, lambda r: (r.task, r.subject)).items():
        rows.append((f"{subject}: {task}", best_by_contender(group)))
    return cost_chart(title, subtitle, rows)


def queries_section(records):
    each = number_text(records[0].size)
    heading = ["of", "query", "who", "results", f"{each} queries", "ratio"]
    return (
        "### Queries\n\nEach cube overlaps about five others; queries are at random positions among them, in random "
        "order. Trees are built before\nthe clock starts. A ratio below 1 is a peer that is faster than our batch.\n\n"
        "Results are compared: ids exactly, times and distances up to the peers' rounding to float32. Ours are computed "
        "in float64.\n\n![Time of a batch of "
        "queries](images/benchmarks/queries.svg)\n\n"
        + _grid(heading, 3, contest_rows(records, "in a batch"))
    )


def elements_section(records):
    heading = ["step", "list", "who", "candidates", "time", "ratio"]
    return (
        "### Candidates of deforming meshes\n\nSteps of the Scalable-CCD sample data.\n\n"
        "- **Ours**: from float64 positions at start and end to the list, keeping only the topology; *second step* also "
        "reuses memory.\n"
        "- **Peers** receive precomputed boxes, in float32 rounded outward, which adds some pairs. They remove pairs with "
        "a common vertex afterwards.\n\n"
        "![Time of a list of candidates](images/benchmarks/elements.svg)\n\n" + _grid(heading, 3, contest_rows(records, "once"))
    )


def external_section(path):
    """Programs measured by hand on the same steps: step,list,name,setting,ms,candidates,allpairs_ms; # begins a comment."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    cells = [
        [r["step"], r["list"], f"{r['name']}, {r['setting']}", r["candidates"], time_text(float(r["ms"]))]
        + [f"{float(r['ms']) / float(r['allpairs_ms']):.1f}x"]
        for r in rows
    ]
    heading = ["step", "list", "who", "candidates", "time", "to ours in that run"]
    return (
        "### Candidates: programs that are not packaged\n\nMeasured by hand, as "
        "[benchmarks-elements-external.csv](benchmarks-elements-external.csv)\nsays.\n\n"
        + _grid(heading, 3, cells)
    )


QUERY_TASKS = ("overlapping a box", "first on a ray", "all on a ray", "nearest", "nearest 8")
ELEMENT_TASKS = ("vertex-face", "edge-edge", "face-face")

INTRODUCTION = """## Repeated steps

The sections below, their charts and their records, [frames](benchmarks-moving.csv) and
[the rest](benchmarks-tasks.csv), are written by

```
./dev bench --moving --report
```

which takes about five minutes. Contenders are interleaved; times are processor time, on one thread.
"""


def write_moving(docs):
    """The sections and charts for the records that exist; empty without any."""
    pictures = docs / "images" / "benchmarks"
    moving, tasks = docs / "benchmarks-moving.csv", docs / "benchmarks-tasks.csv"
    frames = read_moving(moving) if moving.exists() else []
    records = read_tasks(tasks) if tasks.exists() else []
    parts = []
    if frames:
        parts.append(frames_section(frames))
        save(frames_chart(frames), pictures / "moving.svg")
    cycle = [r for r in records if r.task == "cycle"]
    if cycle:
        parts.append(cycle_section(cycle))
        save(cycle_chart(cycle), pictures / "cycle.svg")
    parts += _contests(docs, pictures, records)
    if not parts:
        return ""
    return "\n".join([INTRODUCTION, _machine(frames + records)] + parts)


def _contests(docs, pictures, records):
    subtitle = "processor time, one thread, median, each in its best setting"
    queries = [r for r in records if r.task in QUERY_TASKS]
    if queries:
        save(contest_chart("Time of a batch of queries", subtitle, queries), pictures / "queries.svg")
        yield queries_section(queries)
    elements = [r for r in records if r.task in ELEMENT_TASKS]
    if elements:
        save(contest_chart("Time of a list of candidates", subtitle, elements), pictures / "elements.svg")
        yield elements_section(elements)
    external = docs / "benchmarks-elements-external.csv"
    if external.exists():
        yield external_section(external)
