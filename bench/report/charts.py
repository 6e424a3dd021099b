# SPDX-License-Identifier: MIT
"""The report's pictures: time against number of boxes, cost per pair, throughput per thread."""

import math

from records import OURS
from svg import Picture

# Each contender keeps its colour (on light, on dark) and its mark in every picture.
STYLES = {
    "allpairs": ("#1d4ed8", "#79b0ff", "circle"),
    "allpairs ordered": ("#60a5fa", "#3b6fc4", "circle"),
    "Embree": ("#b45309", "#f2a33c", "square"),
    "CGAL": ("#15803d", "#4ec27a", "triangle"),
    "FCL": ("#7e22ce", "#c492ff", "diamond"),
    "Bullet": ("#be123c", "#ff7d92", "down"),
    "Boost.Geometry": ("#0e7490", "#3fc4dd", "square"),
    "native loop": ("#374151", "#c5ced8", "triangle"),
    "scalar loop": ("#6b7280", "#8b96a3", "diamond"),
}
EXTERNAL_STYLES = [
    ("#a16207", "#e3c04b", "circle"),
    ("#9d174d", "#f58cc0", "triangle"),
    ("#3f6212", "#a9d152", "diamond"),
    ("#5b21b6", "#a78bfa", "down"),
    ("#7c2d12", "#e0936b", "square"),
]


def style_of(name, others):
    if name in STYLES:
        return STYLES[name]
    return EXTERNAL_STYLES[others.index(name) % len(EXTERNAL_STYLES)]


def css_name(name):
    return "c-" + "".join(c if c.isalnum() else "-" for c in name.lower())


class LogScale:
    """Maps numbers to pixels by their logarithm."""

    def __init__(self, values, start, end, pad=0.06):
        low, high = math.log10(min(values)), math.log10(max(values))
        if high - low < 0.3:
            low, high = low - 0.5, high + 0.5
        room = pad * (high - low)
        self.low, self.high = low - room, high + room
        self.start, self.end = start, end

    def __call__(self, value):
        share = (math.log10(value) - self.low) / (self.high - self.low)
        return self.start + share * (self.end - self.start)

    def decades(self):
        return self.ticks((1,))

    def ticks(self, mantissas):
        """The numbers with these first digits that lie on the scale."""
        exponents = range(math.floor(self.low), math.floor(self.high) + 1)
        values = [mantissa * 10.0**e for e in exponents for mantissa in mantissas]
        return [value for value in values if self.low <= math.log10(value) <= self.high]


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


def spread_labels(wanted, gap):
    """Moves labels apart, as little as possible: {name: y} to {name: y} at least `gap` from each other."""
    placed = {}
    previous = -math.inf
    for name, y in sorted(wanted.items(), key=lambda item: item[1]):
        previous = placed[name] = max(y, previous + gap)
    shift = sum(placed[n] - wanted[n] for n in wanted) / max(len(wanted), 1)
    return {name: y - shift for name, y in placed.items()}


class Plot:
    """A frame with two logarithmic axes."""

    left, right, top, bottom = 62, 150, 46, 44

    def __init__(self, title, subtitle, size=(760, 420)):
        self.picture = Picture(*size, title)
        self.width, self.height = size
        self.picture.text(16, 22, title, size=15, weight="600")
        self.picture.text(16, 38, subtitle, css="soft", size=11.5)

    def scales(self, xs, ys):
        self.x = LogScale(xs, self.left, self.width - self.right)
        self.y = LogScale(ys, self.height - self.bottom, self.top + 8)

    def draw_axes(self, x_label, y_text):
        for value in self.y.decades():
            y = self.y(value)
            self.picture.line([(self.left, y), (self.width - self.right, y)], "grid")
            self.picture.text(self.left - 8, y + 4, y_text(value), css="soft", size=11, anchor="end")
        base = self.height - self.bottom
        self.picture.line([(self.left, base), (self.width - self.right, base)], "axis")
        for value in self.x.decades():
            x = self.x(value)
            self.picture.line([(x, base), (x, base + 4)], "axis")
            self.picture.text(x, base + 17, number_text(value), css="soft", size=11, anchor="middle")
        middle = (self.left + self.width - self.right) / 2
        self.picture.text(middle, self.height - 9, x_label, css="soft", size=11.5, anchor="middle")

    def draw_series(self, name, style, points, hints):
        light, dark, shape = style
        css = css_name(name)
        self.picture.colour(css, light, dark)
        ours = name == OURS
        pixels = [(self.x(px), self.y(py)) for px, py in points]
        self.picture.line(pixels, css, width=2.6 if ours else 1.5, dash="4 4" if name == "scalar loop" else "")
        for (x, y), hint in zip(pixels, hints):
            self.picture.marker(x, y, shape, css, size=4.6 if ours else 3.4, hint=hint)
        return pixels[-1]

    def draw_labels(self, ends):
        """Names beside the ends of their lines: in one column, or above the end of a line that stops early."""
        column = self.width - self.right + 22
        last = max(x for x, _ in ends.values())
        placed = spread_labels({name: y for name, (x, y) in ends.items() if x == last}, 15)
        for name, (x, y) in ends.items():
            if name not in placed:
                self.picture.text(x - 4, y - 9, name, css=css_name(name), anchor="end", halo=True)
                continue
            self.picture.line([(x + 6, y), (column - 4, placed[name])], "grid")
            weight = "700" if name == OURS else "normal"
            self.picture.text(column, placed[name] + 4, name, css=css_name(name), size=12, weight=weight)


def time_chart(table, scene):
    """Processor time of a whole search against the number of boxes, one line for each contender."""
    plot = Plot(
        f"{scene}: time of one search",
        "processor time from boxes in memory to pairs in memory, one thread, median; both axes logarithmic",
    )
    lines = {}
    for boxes in table.sizes(scene):
        for name, record in table.cell(scene, boxes).items():
            if record.is_peer or name == OURS:
                lines.setdefault(name, []).append(record)
    records = [record for line in lines.values() for record in line]
    plot.scales([r.boxes for r in records], [r.cpu_ms for r in records])
    plot.draw_axes("boxes", time_text)
    others = [name for name in table.peers() if name not in STYLES]
    ends = {}
    for name in sorted(lines, key=lambda n: n == OURS):
        hints = [f"{name}, {r.boxes} boxes: {time_text(r.cpu_ms)}" for r in lines[name]]
        points = [(r.boxes, r.cpu_ms) for r in lines[name]]
        ends[name] = plot.draw_series(name, style_of(name, others), points, hints)
    plot.draw_labels(ends)
    return plot.picture.render()


def pair_cost_chart(table, cells):
    """Nanoseconds per pair found, a row for each scene, a mark for each contender."""
    left, right, top, row_height = 178, 28, 86, 30
    picture = Picture(760, top + row_height * len(cells) + 44, "Cost per pair")
    picture.text(16, 22, "Cost per pair", size=15, weight="600")
    subtitle = "processor time of one search divided by the pairs it finds, one thread; logarithmic"
    picture.text(16, 38, subtitle, "soft", 11.5)
    rows = [(scene, boxes, _contest(table, scene, boxes)) for scene, boxes in cells]
    costs = [_cost(r) for _, _, row in rows for r in row.values()]
    scale = LogScale(costs, left, picture.width - right)
    _draw_cost_axis(picture, scale, top - 6, top + row_height * len(rows))
    others = [name for name in table.peers() if name not in STYLES]
    for index, (scene, boxes, row) in enumerate(rows):
        y = top + row_height * (index + 0.5)
        picture.text(16, y + 4, scene, size=12)
        picture.text(left - 12, y + 4, number_text(boxes), css="soft", size=11, anchor="end")
        picture.line([(left, y), (picture.width - right, y)], "grid")
        _draw_cost_row(picture, scale, y, row, others)
    _draw_key(picture, _names(rows), others, 60)
    return picture.render()


def _contest(table, scene, boxes):
    cell = table.cell(scene, boxes)
    return {name: r for name, r in cell.items() if (r.is_peer or name == OURS) and r.pairs > 0}


def _cost(record):
    return record.cpu_ms * 1e6 / record.pairs


def _names(rows):
    return sorted({name for _, _, row in rows for name in row}, key=lambda n: (n != OURS, n))


def _draw_cost_axis(picture, scale, top, bottom):
    for value in scale.ticks((1, 2, 5)):
        x = scale(value)
        picture.line([(x, top), (x, bottom)], "grid")
        picture.text(x, bottom + 16, f"{value:g} ns" if value < 1e3 else f"{value / 1e3:g} µs", "soft", 11, "middle")


def _draw_cost_row(picture, scale, y, row, others):
    for name in sorted(row, key=lambda n: n == OURS):
        light, dark, shape = style_of(name, others)
        picture.colour(css_name(name), light, dark)
        hint = f"{name}: {_cost(row[name]):.3g} ns a pair"
        picture.marker(scale(_cost(row[name])), y, shape, css_name(name), 5.6 if name == OURS else 4.2, hint)


def _draw_key(picture, names, others, y):
    x = 20
    for name in names:
        light, dark, shape = style_of(name, others)
        picture.colour(css_name(name), light, dark)
        picture.marker(x, y, shape, css_name(name), 4.2)
        picture.text(x + 9, y + 4, name, size=11.5, weight="700" if name == OURS else "normal")
        x += 26 + 6.6 * len(name)


def thread_chart(table):
    """Boxes a second and thread, against the number of threads: level means that the work splits without loss."""
    size = (760, 340)
    plot = Plot("Throughput per thread", "boxes a second divided by the threads; level means no loss; logarithmic", size)
    lines = {f"{scene} {number_text(boxes)}": row for (scene, boxes), row in table.scaling.items()}
    records = [r for row in lines.values() for r in row.values()]
    plot.scales([r.threads for r in records], [_throughput(r) for r in records])
    _draw_thread_axes(plot, sorted({r.threads for r in records}))
    ends = {}
    for index, (name, row) in enumerate(lines.items()):
        ordered = [row[threads] for threads in sorted(row)]
        hints = [f"{name}, {r.threads} threads: {time_text(r.wall_ms)}" for r in ordered]
        points = [(r.threads, _throughput(r)) for r in ordered]
        style = list(STYLES.values())[index * 2 % len(STYLES)]
        ends[name] = plot.draw_series(name, style, points, hints)
    plot.draw_labels(ends)
    return plot.picture.render()


def _throughput(record):
    return record.boxes / (record.wall_ms * 1e-3) / record.threads


def _draw_thread_axes(plot, threads):
    picture = plot.picture
    base = plot.height - plot.bottom
    for value in plot.y.ticks((1, 2, 5)):
        y = plot.y(value)
        picture.line([(plot.left, y), (plot.width - plot.right, y)], "grid")
        picture.text(plot.left - 8, y + 4, number_text(value) + "/s", "soft", 11, "end")
    picture.line([(plot.left, base), (plot.width - plot.right, base)], "axis")
    for count in threads:
        picture.text(plot.x(count), base + 17, str(count), "soft", 11, "middle")
    picture.text((plot.left + plot.width - plot.right) / 2, plot.height - 9, "threads", "soft", 11.5, "middle")
