#!/usr/bin/env python3
"""Draws docs/images/growth.png from docs/data/performance.json. Needs matplotlib."""
import json
import statistics

from drawing import COLORS, pyplot, save
from measure import DATA, ROOT

PANELS = {"environments": "environments", "room": "side of the room",
          "objects": "objects in an 8x8 room"}
UNITS = {"steps": ("simulator: million steps", 1e6), "frames": ("training: thousand frames", 1e3)}


def main():
    results = json.loads(DATA.read_text())["growth"]["results"]
    figure, rows = pyplot.subplots(2, 3, figsize=(9, 4.6), sharey="row", sharex="col",
                                   constrained_layout=True)
    for row, color, (unit, (label, scale)) in zip(rows, COLORS, UNITS.items()):
        for axes, group in zip(row, PANELS):
            points = [(r["x"], [v / scale for v in r["cpu"]]) for r in results
                      if r["group"] == group and r["unit"] == unit]
            x = [p[0] for p in points]
            axes.fill_between(x, [min(p[1]) for p in points], [max(p[1]) for p in points],
                              color=color, alpha=0.2, linewidth=0)
            axes.plot(x, [statistics.median(p[1]) for p in points], color=color, marker="o",
                      markersize=3.5)
            if group == "environments":
                axes.set_xscale("log")
            else:
                axes.locator_params(axis="x", integer=True)
        row[0].set_ylim(bottom=0)  # of all panels of the row
        row[0].set_ylabel(f"{label}\nper CPU-second")
    for axes, name in zip(rows[-1], PANELS.values()):
        axes.set_xlabel(name)
    target = ROOT / "docs/images/growth.png"
    save(figure, target)
    print(target)


if __name__ == "__main__":
    main()
