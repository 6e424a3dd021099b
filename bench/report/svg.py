# SPDX-License-Identifier: MIT
"""Pictures as SVG text, readable on light and on dark pages."""

from html import escape

LIGHT = {"surface": "#ffffff", "ink": "#1f2937", "soft": "#4b5563", "grid": "#e5e7eb", "axis": "#9ca3af"}
DARK = {"surface": "#0d1117", "ink": "#e6edf3", "soft": "#9da7b3", "grid": "#262c36", "axis": "#57606a"}

FONT = "font-family:system-ui,-apple-system,'Segoe UI',Helvetica,Arial,sans-serif"


class Picture:
    """An SVG under construction; colours are named by class, so that a dark page can have its own."""

    def __init__(self, width, height, title):
        self.width = width
        self.height = height
        self.title = title
        self.parts = []
        self.colours = {}

    def colour(self, name, light, dark):
        """Makes a colour known; shapes refer to it by its name."""
        self.colours[name] = (light, dark)

    def line(self, points, css, width=1.0, dash=""):
        path = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(
            f'<path class="s-{css}" d="{path}" fill="none" stroke-width="{width}" '
            f'stroke-linejoin="round" stroke-linecap="round"{dashes}/>'
        )

    def text(self, x, y, text, css="ink", size=12, anchor="start", weight="normal", halo=False):
        """Text; with a halo in the page's colour where it may lie over lines."""
        rim = " halo" if halo else ""
        self.parts.append(
            f'<text class="f-{css}{rim}" x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}" '
            f'font-weight="{weight}">{escape(text)}</text>'
        )

    def rect(self, x, y, width, height, css, radius=0):
        self.parts.append(
            f'<rect class="f-{css}" x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" rx="{radius}"/>'
        )

    def marker(self, x, y, shape, css, size=4.0, hint=""):
        """A filled circle, square, triangle or diamond with a rim in the page's colour."""
        hint_text = f"<title>{escape(hint)}</title>" if hint else ""
        body = _marker_shape(x, y, shape, size)
        self.parts.append(f'<g class="f-{css} rim">{body[:-2]}>{hint_text}</{body[1:body.index(" ")]}></g>')

    def render(self):
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {self.height}" '
            f'width="{self.width}" height="{self.height}" role="img" aria-label="{escape(self.title)}" '
            f'style="{FONT}">\n<title>{escape(self.title)}</title>\n<style>{self._css()}</style>\n'
            f'<rect class="f-surface" width="{self.width}" height="{self.height}" rx="6"/>\n'
            + "\n".join(self.parts)
            + "\n</svg>\n"
        )

    def _css(self):
        light = {**LIGHT, **{name: pair[0] for name, pair in self.colours.items()}}
        dark = {**DARK, **{name: pair[1] for name, pair in self.colours.items()}}
        return _rules(light) + "@media (prefers-color-scheme:dark){" + _rules(dark) + "}"


def _rules(colours):
    rules = "".join(f".f-{name}{{fill:{value}}}.s-{name}{{stroke:{value}}}" for name, value in colours.items())
    surface = colours["surface"]
    halo = f".halo{{stroke:{surface};stroke-width:4;paint-order:stroke;stroke-linejoin:round}}"
    return rules + f".rim{{stroke:{surface};stroke-width:1.2}}" + halo


def _marker_shape(x, y, shape, size):
    if shape == "circle":
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{size:.1f}"/>'
    if shape == "square":
        side = 1.75 * size
        return f'<rect x="{x - side / 2:.1f}" y="{y - side / 2:.1f}" width="{side:.1f}" height="{side:.1f}"/>'
    corners = {
        "triangle": [(0, -1.25), (1.15, 0.85), (-1.15, 0.85)],
        "down": [(0, 1.25), (1.15, -0.85), (-1.15, -0.85)],
        "diamond": [(0, -1.35), (1.35, 0), (0, 1.35), (-1.35, 0)],
    }[shape]
    points = " ".join(f"{x + size * dx:.1f},{y + size * dy:.1f}" for dx, dy in corners)
    return f'<polygon points="{points}"/>'
