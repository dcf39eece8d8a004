#!/usr/bin/env python3
"""Draws docs/images/growth.png from docs/data/performance.json. Needs matplotlib."""
import json
import statistics

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

from measure import DATA, ROOT

PANELS = {"environments": ("environments", "log"), "room": ("side of the room", "linear"),
          "objects": ("objects in an 8x8 room", "linear")}
UNITS = {"steps": ("simulator: million steps", 1e6, "#1f5fa8"),
         "frames": ("training: thousand frames", 1e3, "#b5482a")}


def main():
    results = json.loads(DATA.read_text())["growth"]["results"]
    pyplot.rcParams.update({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False})
    figure, rows = pyplot.subplots(2, 3, figsize=(9, 4.6), sharey="row", sharex="col")
    for row, (unit, (label, scale, color)) in zip(rows, UNITS.items()):
        for axes, (group, (name, kind)) in zip(row, PANELS.items()):
            points = [(r["x"], [v / scale for v in r["cpu"]]) for r in results
                      if r["group"] == group and r["unit"] == unit]
            x = [p[0] for p in points]
            axes.fill_between(x, [min(p[1]) for p in points], [max(p[1]) for p in points],
                              color=color, alpha=0.2, linewidth=0)
            axes.plot(x, [statistics.median(p[1]) for p in points], color=color, marker="o",
                      markersize=3.5)
            axes.set_xscale(kind)
            axes.grid(alpha=0.25)
            rows[-1, list(PANELS).index(group)].set_xlabel(name)
        row[0].set_ylim(bottom=0)  # of all panels of the row
        row[0].set_ylabel(f"{label}\nper CPU-second")
    figure.tight_layout()
    target = ROOT / "docs/images/growth.png"
    figure.savefig(target, dpi=90)
    print(target)


if __name__ == "__main__":
    main()
