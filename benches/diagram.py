"""Diagrams with logarithmic axes, as SVG: what the scripts here draw for docs/figures."""

import math

COLORS = ("#0b5394", "#c8553d", "#588157", "#8a5a9e", "#b8860b", "#008b8b", "#111111", "#777777")
WIDTH, HEIGHT, LEFT, TOP, LEGEND = 420.0, 360.0, 60.0, 34.0, 240.0


def text(x, y, anchor, words):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{words}</text>'


def position(value, ends):
    """Where a value lies on a logarithmic axis, from 0 to 1; what is beyond an end is drawn at the end."""
    low, high = (math.log10(end) for end in ends)
    return min(1.0, max(0.0, (math.log10(max(value, 1e-300)) - low) / (high - low)))


class Panel:
    """One diagram. `x` and `y` are the ends of the axes, powers of ten; the first end of `x` is at the left, whichever is greater."""

    def __init__(self, title, axis, x, y):
        self.title, self.axis, self.x, self.y = title, axis, x, y
        self.lines, self.guides = [], []

    def line(self, name, points, dashed=False):
        """A curve through points (x, y), with its name in the legend."""
        self.lines.append((name, [point for point in points if point[1] is not None], dashed))

    def guide(self, words, start, end):
        """A thin line from one point to another, with words at its end."""
        self.guides.append((words, start, end))

    def drawn(self, left):
        right, bottom = left + WIDTH, TOP + HEIGHT
        at_x = lambda value: left + WIDTH * position(value, self.x)
        at_y = lambda value: bottom - HEIGHT * position(value, self.y)
        out = [text((left + right) / 2, TOP - 12, "middle", self.title)]
        out.append(text((left + right) / 2, bottom + 32, "middle", self.axis))
        powers = lambda ends: range(*sorted(round(math.log10(end)) for end in ends))
        to_right = [*powers(self.x), max(powers(self.x)) + 1]
        for i, power in enumerate(to_right):
            at = at_x(10.0**power)
            out.append(f'<line x1="{at:.1f}" y1="{TOP}" x2="{at:.1f}" y2="{bottom}" stroke="#ddd"/>')
            # Words of many decades would touch each other.
            if len(to_right) < 9 or i % 2 == 0:
                out.append(text(at, bottom + 14, "middle", f"1e{power}"))
        for power in [*powers(self.y), max(powers(self.y)) + 1][::2]:
            at = at_y(10.0**power)
            out.append(f'<line x1="{left}" y1="{at:.1f}" x2="{right}" y2="{at:.1f}" stroke="#ddd"/>')
            out.append(text(left - 4, at + 4, "end", f"1e{power}"))
        for words, (x1, y1), (x2, y2) in self.guides:
            ends = f'x1="{at_x(x1):.1f}" y1="{at_y(y1):.1f}" x2="{at_x(x2):.1f}" y2="{at_y(y2):.1f}"'
            out.append(f'<line {ends} stroke="#aaa" stroke-dasharray="2 3"/>')
            out.append(text(at_x(x2) - 4, at_y(y2) - 6, "end", words))
        for i, (name, points, dashed) in enumerate(self.lines):
            color, dashes = COLORS[i % len(COLORS)], ' stroke-dasharray="5 3"' if dashed else ""
            shown = " ".join(f"{at_x(x):.1f},{at_y(y):.1f}" for x, y in points)
            out.append(f'<polyline points="{shown}" fill="none" stroke="{color}" stroke-width="1.6"{dashes}/>')
            out += [f'<circle cx="{at_x(x):.1f}" cy="{at_y(y):.1f}" r="2" fill="{color}"/>' for x, y in points]
            y = TOP + 12 + 18 * i
            out.append(f'<line x1="{right + 10}" y1="{y}" x2="{right + 34}" y2="{y}" stroke="{color}" stroke-width="1.6"{dashes}/>')
            out.append(text(right + 40, y + 4, "start", name))
        return out


def drawing(panels):
    """Panels side by side, as the text of an SVG file."""
    width = len(panels) * (LEFT + WIDTH + LEGEND)
    frame = f'viewBox="0 0 {width:.0f} {TOP + HEIGHT + 44:.0f}" font-family="sans-serif" font-size="11"'
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" {frame}>', '<rect width="100%" height="100%" fill="white"/>']
    for i, panel in enumerate(panels):
        out += panel.drawn(LEFT + i * (LEFT + WIDTH + LEGEND))
    return "\n".join([*out, "</svg>"]) + "\n"
