"""Charts as SVG text: panels of bars with marks, and lines on logarithmic axes."""

import math
from html import escape

INK, FAINT, GRID = "#222222", "#777777", "#dddddd"
COLOURS = ["#2f6fb0", "#d2691e", "#3a8f4d", "#8a56a8", "#b03a4f"]
FONT = 'font-family="Helvetica, Arial, sans-serif"'


def text(x, y, words, size=11, anchor="start", colour=INK, more=""):
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" {FONT} font-size="{size}" text-anchor="{anchor}" fill="{colour}"{more}>'
        f"{escape(str(words))}</text>"
    )


def line(x0, y0, x1, y1, colour=GRID, width=1, dash=""):
    dashes = f' stroke-dasharray="{dash}"' if dash else ""
    return (
        f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" stroke="{colour}" stroke-width="{width}"{dashes}/>'
    )


def picture(width, height, title, parts):
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" '
        f'role="img"><title>{escape(title)}</title><rect width="{width}" height="{height}" fill="white"/>'
    )
    return "\n".join([head, *parts, "</svg>"]) + "\n"


def short(value):
    return f"{value:.0f}" if value >= 100 else f"{value:.1f}" if value >= 1 else f"{value:.2f}"


def bar_panels(title, panels, columns=3):
    """Panels (heading, [(label, value, floor, aim)]) of horizontal bars. The floor is a full stroke across the bar, the
    aim a dashed one; either may be None. A value of None leaves its row empty. Each panel has its own scale."""
    panel_width, row, left, top = 290, 17, 62, 34
    rows = max(len(bars) for _, bars in panels)
    panel_height = top + rows * row + 14
    lines = math.ceil(len(panels) / columns)
    width, height = columns * panel_width, 26 + lines * panel_height
    parts = [text(10, 18, title, 13, more=' font-weight="bold"')]
    for number, (heading, bars) in enumerate(panels):
        x0 = number % columns * panel_width
        y0 = 26 + number // columns * panel_height
        most = max([v for bar in bars for v in bar[1:] if v is not None] + [1e-9])
        room = panel_width - left - 48
        parts.append(text(x0 + left, y0 + 18, heading, 12))
        for i, (label, value, floor, aim) in enumerate(bars):
            y = y0 + top + i * row
            parts.append(text(x0 + left - 6, y + 11, label, 11, "end"))
            if value is None:
                continue
            length = room * value / most
            colour = COLOURS[0] if floor is None or value >= floor else COLOURS[1]
            parts.append(f'<rect x="{x0 + left:.1f}" y="{y + 2}" width="{length:.1f}" height="{row - 6}" fill="{colour}"/>')
            for mark, dash in ((floor, ""), (aim, "2 2")):
                if mark is not None:
                    x = x0 + left + room * mark / most
                    parts.append(line(x, y, x, y + row - 2, INK, 1.5, dash))
            parts.append(text(x0 + left + room + 42, y + 11, short(value), 11, "end", FAINT))
    return picture(width, height, title, parts)


def powers(low, high):
    return [10.0**k for k in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)]


def log_lines(title, x_name, y_name, series):
    """Series (name, [(x, y)], dashed) on logarithmic axes."""
    width, height, left, right, top, bottom = 480, 300, 60, 120, 34, 42
    points = [p for _, line_points, _ in series for p in line_points]
    xs, ys = powers(min(p[0] for p in points), max(p[0] for p in points)), powers(
        min(p[1] for p in points), max(p[1] for p in points)
    )

    def at(x, y):
        across = math.log10(x / xs[0]) / max(1e-9, math.log10(xs[-1] / xs[0]))
        up = math.log10(y / ys[0]) / max(1e-9, math.log10(ys[-1] / ys[0]))
        return left + across * (width - left - right), height - bottom - up * (height - top - bottom)

    parts = [text(10, 18, title, 13, more=' font-weight="bold"')]
    for x in xs:
        parts.append(line(at(x, ys[0])[0], top, at(x, ys[0])[0], height - bottom))
        parts.append(text(at(x, ys[0])[0], height - bottom + 15, f"1e{round(math.log10(x))}", 10, "middle", FAINT))
    for y in ys:
        parts.append(line(left, at(xs[0], y)[1], width - right, at(xs[0], y)[1]))
        parts.append(text(left - 6, at(xs[0], y)[1] + 4, f"{y:g}", 10, "end", FAINT))
    parts.append(text((left + width - right) / 2, height - 8, x_name, 11, "middle"))
    parts.append(text(left, top - 6, y_name, 11, "start", FAINT))
    for number, (name, line_points, dashed) in enumerate(series):
        colour = FAINT if dashed else COLOURS[number % len(COLOURS)]
        places = [at(x, y) for x, y in line_points]
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
        dashes = ' stroke-dasharray="4 3"' if dashed else ""
        parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"{dashes}/>')
        if not dashed:
            parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>' for x, y in places]
        parts.append(text(places[-1][0] + 8, places[-1][1] + 4, name, 11, "start", colour))
    return picture(width, height, title, parts)
