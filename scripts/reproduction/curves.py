"""Charts of lines with bands as SVG, by hand."""
import html

COLORS = ["#1f5fa8", "#b5482a", "#3a8a4d", "#8057a5", "#b08a1e", "#4a9aa8", "#a8517e", "#777777",
          "#2b2b2b", "#d98cb3", "#7f8f1f"]
WIDTH, HEIGHT = 270, 200  # of a panel's axes
LEFT, TOP, GAP, BOTTOM, LINE = 48, 26, 40, 42, 16
LEGEND, LETTER = 330, 7  # widths of a legend's column, and of a letter at most


def text(x, y, words, anchor="middle", more=""):
    return f'<text x="{x:.0f}" y="{y:.0f}" text-anchor="{anchor}"{more}>{html.escape(words)}</text>'


def path(points):
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in points)


def panel(left, title, series, x_label, ticks):
    """One pair of axes; series are (color, [[x, y, low, high]...]), y in 0-1."""
    low, high = ticks[0][0], ticks[-1][0]

    def x_of(x):
        return left + (x - low) / ((high - low) or 1) * WIDTH

    def y_of(y):
        return TOP + (1 - y) * HEIGHT
    parts = [text(left + WIDTH / 2, TOP - 9, title),
             text(left + WIDTH / 2, TOP + HEIGHT + 34, x_label)]
    for tenth in range(0, 11, 2):
        y = y_of(tenth / 10)
        parts += [f'<path class="grid" d="M{left} {y:.1f}h{WIDTH}"/>',
                  text(left - 6, y + 4, f"{10 * tenth}", "end")]
    parts += [text(x_of(x), TOP + HEIGHT + 17, label) for x, label in ticks]
    for color, points in series:
        band = [(x_of(x), y_of(top)) for x, _, _, top in points]
        band += [(x_of(x), y_of(bottom)) for x, _, bottom, _ in reversed(points)]
        parts += [f'<polygon points="{path(band)}" fill="{color}" fill-opacity="0.18"/>',
                  f'<polyline points="{path((x_of(x), y_of(y)) for x, y, _, _ in points)}" '
                  f'fill="none" stroke="{color}" stroke-width="1.6"/>']
    return parts


def chart(panels, names, x_label):
    """panels: (title, [points of each name or None], ticks)."""
    width = max(LEFT + len(panels) * (WIDTH + GAP), LEFT + 24 + LETTER * max(map(len, names)))
    columns = max(1, (width - LEFT) // LEGEND)
    rows = -(-len(names) // columns)
    height = TOP + HEIGHT + BOTTOM + rows * LINE + 6
    parts = []
    for k, (title, series, ticks) in enumerate(panels):
        drawn = [(COLORS[i % len(COLORS)], points) for i, points in enumerate(series) if points]
        parts += panel(LEFT + k * (WIDTH + GAP), title, drawn, x_label, ticks)
    parts.append(text(0, 0, "success, %", more=f' transform="translate(13 {TOP + HEIGHT / 2:.0f}) '
                                               'rotate(-90)"'))
    for i, name in enumerate(names):
        x, y = LEFT + i % columns * LEGEND, TOP + HEIGHT + BOTTOM + i // columns * LINE + 8
        parts += [f'<path d="M{x} {y - 4}h18" stroke="{COLORS[i % len(COLORS)]}" stroke-width="3"/>',
                  text(x + 24, y, name, "start")]
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
            f'viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="12">\n'
            '<style>.grid{stroke:#ddd;fill:none}</style>\n'
            f'<rect width="{width}" height="{height}" fill="#fff"/>\n' + "\n".join(parts) + "\n</svg>\n")


def frame_ticks(frames):
    """0, and a few round numbers of frames; runs end a little behind the last."""
    million = frames / 1e6
    step = next((s for s in (0.01, 0.05, 0.1, 0.5, 1, 2, 3, 5) if million / s <= 5.1), 10)
    return [(1e6 * step * k, f"{step * k:g}M") for k in range(int(million / step + 0.95) + 1)]
