# SPDX-License-Identifier: MIT
"""The report's pictures: time against number of boxes, cost per pair, throughput per thread. Written by matplotlib, the
same bytes for the same records."""

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update(
    {
        "svg.hashsalt": "allpairs",
        "svg.fonttype": "none",  # text stays text
        "font.family": "sans-serif",
        "font.size": 9,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "axes.axisbelow": True,
        "axes.titlelocation": "left",
        "grid.color": "#e5e7eb",
        "legend.frameon": False,
    }
)

from matplotlib import pyplot
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter, NullLocator

from records import OURS

# Each contender keeps its colour and its mark in every picture.
STYLES = {
    "allpairs": ("#1d4ed8", "o"),
    "allpairs ordered": ("#60a5fa", "o"),
    "Embree": ("#b45309", "s"),
    "CGAL": ("#15803d", "^"),
    "FCL": ("#7e22ce", "D"),
    "Bullet": ("#be123c", "v"),
    "Boost.Geometry": ("#0e7490", "s"),
    "native loop": ("#374151", "^"),
    "scalar loop": ("#6b7280", "D"),
}
OTHER_STYLES = [("#a16207", "o"), ("#9d174d", "^"), ("#3f6212", "D"), ("#5b21b6", "v"), ("#7c2d12", "s")]
WIDTH = 7.6  # inches


def style_of(name, others):
    """Colour and mark; of a name that is not in STYLES by its place among `others`."""
    return STYLES[name] if name in STYLES else OTHER_STYLES[others.index(name) % len(OTHER_STYLES)]


def number_text(value):
    for limit, suffix in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if value >= limit:
            return f"{value / limit:g}{suffix}"
    return f"{value:g}"


def time_text(ms):
    for limit, factor, unit in ((1e3, 1e-3, "s"), (1.0, 1.0, "ms"), (1e-3, 1e3, "µs")):
        if ms >= limit * 0.9999:
            return f"{float(f'{ms * factor:.3g}'):g} {unit}"
    return f"{float(f'{ms * 1e6:.3g}'):g} ns"


def save(figure, path):
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Date": None, "Creator": None}, bbox_inches="tight")
    pyplot.close(figure)


def _start(height, title, subtitle):
    figure, axes = pyplot.subplots(figsize=(WIDTH, height))
    axes.set_title(f"{title}\n", fontweight="bold")
    axes.text(0, 1.01, subtitle, transform=axes.transAxes, fontsize=8, color="#4b5563", va="bottom")
    return figure, axes


def _logarithmic(axis, text, subs=(1.0,)):
    axis.axes.set(**{f"{axis.axis_name}scale": "log"})
    axis.set_major_locator(LogLocator(subs=subs))
    axis.set_major_formatter(FuncFormatter(lambda value, _: text(value)))
    axis.set_minor_locator(NullLocator())
    axis.set_minor_formatter(NullFormatter())


def _ours_last(names):
    return sorted(names, key=lambda name: (name == OURS, name))


def time_chart(table, scene):
    """Processor time of a whole search against the number of boxes, one line for each contender."""
    lines = {}
    for boxes in table.sizes(scene):
        for name, record in table.cell(scene, boxes).items():
            if record.is_peer or name == OURS:
                lines.setdefault(name, []).append((record.boxes, record.cpu_ms))
    others = [name for name in table.peers() if name not in STYLES]
    figure, axes = _start(4.2, f"{scene}: time of one search", "processor time, one thread, median")
    for name in _ours_last(lines):
        colour, mark = style_of(name, others)
        width = 2.4 if name == OURS else 1.4
        axes.plot(*zip(*lines[name]), mark + "-", color=colour, linewidth=width, markersize=4, label=name)
    _logarithmic(axes.xaxis, number_text)
    _logarithmic(axes.yaxis, time_text)
    axes.set_xlabel("boxes")
    axes.legend(*_by_last_value(axes), loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure


def _by_last_value(axes):
    """The key in the order of the ends of the lines, from the top."""
    handles, labels = axes.get_legend_handles_labels()
    order = sorted(zip(handles, labels), key=lambda item: -item[0].get_ydata()[-1])
    return [handle for handle, _ in order], [label for _, label in order]


def row_chart(title, subtitle, rows, text, others=(), subs=(1.0,)):
    """A row for each task, a mark for each contender, on one logarithmic axis; rows: [(label, {name: value})]."""
    figure, axes = _start(0.9 + 0.3 * len(rows), title, subtitle)
    for name in _ours_last({name for _, row in rows for name in row}):
        places = [(row[name], index) for index, (_, row) in enumerate(rows) if name in row]
        colour, mark = style_of(name, others)
        axes.plot(*zip(*places), mark, color=colour, markersize=7 if name == OURS else 5, label=name)
    axes.set_yticks(range(len(rows)), [label for label, _ in rows])
    axes.set_ylim(len(rows) - 0.5, -0.5)
    _logarithmic(axes.xaxis, text, subs)
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(handles[::-1], labels[::-1], loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure


def pair_cost_chart(table, cells):
    """Nanoseconds per pair found, a row for each scene."""
    rows = []
    for scene, boxes in cells:
        cell = table.cell(scene, boxes)
        costs = {n: r.cpu_ms * 1e6 / r.pairs for n, r in cell.items() if (r.is_peer or n == OURS) and r.pairs > 0}
        rows.append((f"{scene} {number_text(boxes)}", costs))
    others = [name for name in table.peers() if name not in STYLES]
    subtitle = "processor time of one search divided by the pairs it finds, one thread"
    return row_chart("Cost per pair", subtitle, rows, lambda ns: time_text(ns * 1e-6), others)


def thread_chart(table):
    """Boxes a second and thread, against the number of threads: level means that the work splits without loss."""
    figure, axes = _start(3.4, "Throughput per thread", "boxes a second divided by the threads; level means no loss")
    for index, ((scene, boxes), row) in enumerate(table.scaling.items()):
        points = [(threads, boxes / (row[threads].wall_ms * 1e-3) / threads) for threads in sorted(row)]
        colour, mark = list(STYLES.values())[index * 2 % len(STYLES)]
        axes.plot(*zip(*points), mark + "-", color=colour, markersize=4, label=f"{scene} {number_text(boxes)}")
    _logarithmic(axes.yaxis, lambda value: number_text(value) + "/s", (1.0, 2.0, 5.0))
    axes.set_xticks(sorted({threads for row in table.scaling.values() for threads in row}))
    axes.set_xlabel("threads")
    axes.legend(*_by_last_value(axes), loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure
