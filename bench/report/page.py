# SPDX-License-Identifier: MIT
"""docs/benchmarks.md from the records."""

from charts import number_text, time_text
from records import OURS, OWN_VARIANTS

INTRODUCTION = """# Benchmarks

This page compares the time that Allpairs and other programs take to find all overlapping pairs of n boxes, on the same
boxes in the same run. This page, its charts and [the records](benchmarks.csv) are written by

```
./dev bench --report
```

which takes about a quarter of an hour. `./dev bench` alone measures a few small scenes in a minute and does not change
this page. `allpairs bench` measures one scene or file.
"""

METHOD = """## How it is measured

- **What**: one search from boxes in memory, rows of six float32, to an array of pairs in memory. It includes the check
  for NaNs and every copy, sort and tree. Nothing is kept from the previous search except freed memory that glibc's
  allocator keeps. Teardown is not timed, except where a sample holds many runs because one takes less than a
  millisecond.
- **Time**: processor time of the whole process, all threads together; on one thread it equals wall time on an idle
  machine and is hardly affected by other load. Times are medians; the records also hold wall time, spread and
  repetitions.
- **Data**: boxes are others from repetition to repetition, from at least three sets of the scene and 40,000 boxes in all, since
  a processor learns the branches of a small set that it sees again. Above a million boxes there is one set.
- **Fairness**: contenders are interleaved on the same boxes. Each peer is tried in several settings on each scene, and
  its best one counts; settings are tried at up to 100,000 boxes, and the best one is used above.
- **Same answer**: each contender's complete list of pairs is compared with ours before its time counts. Of those that
  only count, the numbers are.
  The hash is FNV-1a, 64 bits, over the pairs in the order (first, second), each as two 32-bit little-endian numbers.
- **Compilation**: everything with -O3 and without assertions; header-only peers (CGAL, Boost.Geometry) and
  the native loop also with -march=native. Allpairs selects its instruction set at run time; AVX3 is AVX-512.

The sections below have a table for each scene. Our columns are:

| column | what |
|---|---|
| unordered | `Order::Unordered`: pairs in the order of discovery |
| ordered | pairs by (first, second) |
| overlaps(boxes) | the same from the function `overlaps()`, in a vector |
| memory kept | the unordered search with a reused `OverlapSearch` object |
| count only | no pairs, only their number |
"""

PEERS = """## The peers

| name | what | how |
|---|---|---|
| Embree | `rtcCollide` | one user geometry; the device is created before the clock starts; the callback tests the boxes of leaves, because Embree reports all pairs of two leaves |
| CGAL | `box_self_intersection_d` | 28-byte boxes, by value and by pointer; cutoffs from 10 to 3,000 |
| FCL | `DynamicAABBTreeCollisionManager`, also `_Array` | all boxes registered at once, without geometry; in float64 |
| Bullet | `btDbvt` collided with itself; `btDbvtBroadphase`; `bt32BitAxisSweep3` | inserted one by one, or rebuilt top down; the sweep's rounded boxes are tested again |
| Boost.Geometry | packed `rtree` | one query per box, in the tree's order; nodes of 4 to 32 |
| native loop | two loops over six arrays | this processor's widest vectors, compressed stores |
| scalar loop | two loops over an array of boxes | the obvious implementation |

Loops and Bullet's sweep are omitted where they would take minutes. A program that is not packaged can be measured
separately, on the boxes that `allpairs generate` writes, and recorded in
[benchmarks-external.csv](benchmarks-external.csv); the next report then compares its time and the hash of its pairs
with ours.
"""

SCENES = """## The scenes

`allpairs generate SCENE -n N --seed 1` generates them, byte for byte the same on every machine. `-sorted` scenes hold
the same boxes in Morton order, which favours most peers.

| scene | boxes |
|---|---|
| uniform | equal cubes, centres uniformly distributed in a unit cube; about 2.3 pairs per box |
| clusters | clouds of about 500 cubes, each cloud with its own size and position; about 3 pairs per box |
| power-law | cubes of many sizes, P(side > s) ~ 1/s^2 up to a quarter of the scene; about 2 pairs per box |
| city | blocks on a plane: a flat scene, all boxes at the same height; about 3 pairs per box |
| needles | 10 to 30 times as long as thick, along a random axis; about 4 pairs per box |
| all-overlap | boxes around one common point: all n(n-1)/2 pairs |
| mesh | boxes of the triangles of a wavy torus, shuffled; about 6 pairs per box |
"""


def write_page(table, records, moving="", worlds=""):
    parts = [INTRODUCTION, _machine(records), _mistakes(records), _summary(table), METHOD]
    parts += [_scene_section(table, scene) for scene in table.scenes()]
    parts += [_sorted_section(table), _pair_cost(), _threads(table), _kernel(table), _external(table), moving, worlds, SCENES, PEERS, _settings(table)]
    return "\n".join(part for part in parts if part)


def _row(cells):
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def _grid(heading, rows):
    aligned = "|---|" + "---:|" * (len(heading) - 1)
    return "\n".join([_row(heading), aligned] + [_row(row) for row in rows]) + "\n"


def _machine(records):
    p = next(r.provenance for r in records if not r.external)
    return (
        f"Measured on {p['date'][:10]}: {p['processor']}, {p['processors']} cores, {p['instruction_set']}; "
        f"{p['compiler']}, {p['build']}; commit {p['commit']}.\n"
    )


def _mistakes(records):
    wrong = [r for r in records if r.mistake]
    contests = sum(1 for r in records if r.hash and not r.external)
    if not wrong:
        return f"All {contests} results give the same pairs, compared one by one.\n"
    lines = [f"- {r.name} on {r.scene} {r.boxes}: {r.mistake}" for r in wrong]
    return "**Results that differ from ours:**\n\n" + "\n".join(lines) + "\n"


LOOPS = ("native loop", "scalar loop")


def best_peer(cell):
    """The fastest of the packaged peers."""
    peers = [r for r in cell.values() if r.is_peer and r.name not in LOOPS and not r.mistake]
    return min(peers, key=lambda r: r.cpu_ms, default=None)


def _ratio(record, ours):
    return f"{record.cpu_ms / ours.cpu_ms:.1f}x" if record else ""


def _summary_row(scene, boxes, cell):
    ours = cell[OURS]
    peer = best_peer(cell)
    call = cell.get("allpairs vector")
    return [
        f"{scene} {number_text(boxes)}",
        number_text(float(f"{ours.pairs:.3g}")),
        time_text(ours.cpu_ms),
        time_text(call.cpu_ms) if call else "",
        time_text(peer.cpu_ms) if peer else "",
        peer.name if peer else "",
        "**" + _ratio(peer, ours) + "**" if peer else "",
        _ratio(cell.get("native loop"), ours),
    ]


def _summary(table):
    cells = [(scene, boxes, table.cell(scene, boxes)) for scene in table.scenes() for boxes in table.sizes(scene)]
    rows = [_summary_row(scene, boxes, cell) for scene, boxes, cell in cells if OURS in cell]
    heading = ["scene", "pairs", "unordered", "overlaps(boxes)", "best peer", "which", "ratio", "native loop"]
    return (
        "## Summary\n\nOne thread, from boxes to pairs.\n\n"
        "- *Unordered* gives pairs in the order of discovery, *overlaps(boxes)* by (first, second), in a vector.\n"
        "- *Ratio* is the best packaged peer's time divided by ours, both unordered.\n"
        "- *Native loop* is the same ratio for two loops compiled for this processor.\n\n"
        + _grid(heading, rows)
    )


def _columns(table):
    found = {name for cell in table.contests.values() for name in cell}
    return [name for name in OWN_VARIANTS if name in found] + table.peers()


def _scene_rows(table, scene):
    for boxes in table.sizes(scene):
        cell = table.cell(scene, boxes)
        times = [time_text(cell[name].cpu_ms) if name in cell else "" for name in _columns(table)]
        yield [number_text(boxes)] + times


def _heading(table):
    return ["boxes"] + [OWN_VARIANTS.get(name, name) for name in _columns(table)]


def _scene_section(table, scene):
    picture = f"![Time against number of boxes, {scene}](images/benchmarks/time-{scene}.svg)\n"
    return f"## {scene}\n\n{picture}\n" + _grid(_heading(table), _scene_rows(table, scene))


def _sorted_section(table):
    rows = []
    for scene in table.scenes(is_sorted=True):
        rows += [[f"{scene} {row[0]}"] + row[1:] for row in _scene_rows(table, scene)]
    if not rows:
        return ""
    return "## Spatially sorted\n\nThe same boxes, in Morton order.\n\n" + _grid(_heading(table), rows)


def _pair_cost():
    return "## Cost per pair\n\n![Processor time per pair found](images/benchmarks/pair-cost.svg)\n"


def _threads(table):
    rows = []
    for (scene, boxes), row in table.scaling.items():
        alone = row[min(row)]
        for threads in sorted(row):
            r = row[threads]
            times = [time_text(r.wall_ms), time_text(r.cpu_ms), f"{alone.wall_ms / r.wall_ms:.2f}x"]
            rows.append([f"{scene} {number_text(boxes)}", threads] + times)
    if not rows:
        return ""
    picture = "![Throughput per thread](images/benchmarks/threads.svg)\n"
    heading = ["boxes", "threads", "wall", "processor", "speedup"]
    return f"## Threads\n\nTimes in this section are wall time.\n\n{picture}\n" + _grid(heading, rows)


def _kernel(table):
    rows = []
    for r in table.kernel:
        tests = r.boxes * (r.boxes - 1) / 2
        rows.append([number_text(r.boxes), r.setting, time_text(r.cpu_ms), f"{tests / r.cpu_ms / 1e6:.2f}"])
    if not rows:
        return ""
    text = (
        "## The exhaustive kernel\n\nEvery pair is tested: `Strategy::Exhaustive`, counting only, one thread, by "
        "instruction set.\n\n"
    )
    return text + _grid(["boxes", "instruction set", "time", "billion tests a second"], rows)


def _external(table):
    rows = []
    for (scene, boxes), cell in table.contests.items():
        for r in (r for r in cell.values() if r.external):
            ours = cell.get(OURS)
            same = "" if not ours or not r.hash else ("yes" if r.hash == ours.hash else "**no**")
            ratio = f"{r.cpu_ms / r.ours_ms:.1f}x" if r.ours_ms else ""
            rows.append([f"{scene} {number_text(boxes)}", r.name, r.setting, time_text(r.cpu_ms), r.pairs, same, ratio])
    if not rows:
        return ""
    text = (
        "## Programs that are not packaged\n\nMeasured by hand on boxes from `allpairs generate`, on another machine than "
        "above; [benchmarks-external.csv](benchmarks-external.csv)\nsays how and on which. The ratio is to our time in the "
        "same run, where that is recorded.\n\n"
    )
    return text + _grid(["boxes", "program", "setting", "time", "pairs", "same pairs", "ratio"], rows)


def _settings(table):
    rows = [
        [f"{scene} {number_text(boxes)}", r.name, r.setting]
        for (scene, boxes), cell in table.contests.items()
        for r in cell.values()
        if r.is_peer
    ]
    body = _grid(["boxes", "peer", "its best setting"], rows)
    summary = "<summary>Which setting of each peer was the fastest</summary>"
    return f"## Settings\n\n<details>{summary}\n\n{body}\n</details>\n"
