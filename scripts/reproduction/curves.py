#!/usr/bin/env python3
"""Draws the plots of docs/results.md from docs/data/results.json and prints their names. Needs
matplotlib. Another folder than docs may be given."""
import json
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "performance"))

from drawing import pyplot, save
from measure import ROOT
from results_page import Results, of_policy

PANEL = (3.2, 2.4)  # inches


def lines_and_bands(axes, series):
    """Series are (name, points [x, y, low, high]), y in 0-1."""
    for name, points in series:
        x, y, low, high = zip(*points)
        line, = axes.plot(x, [100 * v for v in y], label=name, clip_on=False)
        axes.fill_between(x, [100 * v for v in low], [100 * v for v in high], color=line.get_color(),
                          alpha=0.15, linewidth=0)
    axes.set_ylim(0, 100)
    axes.margins(x=0)


def grid_chart(rows):
    """Success by the number of objects, a panel a room."""
    lines = {f"{row['about']}, {policy}": of_policy(row["evaluations"]["grid"], policy)
             for row in rows if "grid" in row["evaluations"] for policy in ("sampled", "greedy")}
    rooms = sorted({s["room"] for settings in lines.values() for s in settings})
    if not rooms:
        return None
    figure, panels = pyplot.subplots(1, len(rooms), figsize=(PANEL[0] * len(rooms), PANEL[1]),
                                     sharey=True, squeeze=False, constrained_layout=True)
    for room, axes in zip(rooms, panels[0]):
        series = [(name, [(s["objects"], s["success"]["mean"], *s["success"]["ci95"])
                          for s in settings if s["room"] == room]) for name, settings in lines.items()]
        lines_and_bands(axes, series)
        axes.set(title=f"{room}x{room}", xlabel="objects", xticks=[p[0] for p in series[0][1]])
    panels[0][0].set_ylabel("success, %")
    figure.legend(*panels[0][0].get_legend_handles_labels(), loc="upper center",
                  bbox_to_anchor=(0.5, 0), ncol=len(lines))
    return figure


def learning_chart(rows):
    """Success in training by frames."""
    rows = [row for row in rows if row.get("curve")]
    if not rows:
        return None
    figure, axes = pyplot.subplots(figsize=(1.6 * PANEL[0], 1.2 * PANEL[1]), constrained_layout=True)
    lines_and_bands(axes, [((row["about"] or row["name"]).replace("`", ""),
                            [(x / 1e6, *ys) for x, *ys in row["curve"][::3]]) for row in rows])
    axes.set(xlim=(0, None), xlabel="million frames", ylabel="training success, %")
    figure.legend(loc="center left", bbox_to_anchor=(1, 0.5))
    return figure


def charts(results):
    ablations, task = results.part("ablation"), results.part("task")
    return {
        "grid": grid_chart(results.part("grounding")),
        "grounding": learning_chart(results.part("grounding")),
        "ablations": learning_chart([r for r in ablations if r["config"].startswith("ablations/")]),
        "task": learning_chart([r for r in task if r["name"].startswith("structured")]),
        "task-ablations": learning_chart([r for r in task
                                          if not r["name"].startswith("structured-")]),
        "babyai": learning_chart(results.part("babyai"))}


def main(folder):
    results = Results(json.loads((folder / "data/results.json").read_text()))
    images = folder / "images/results"
    for name, figure in charts(results).items():
        if figure:
            images.mkdir(parents=True, exist_ok=True)
            save(figure, images / f"{name}.svg")
            print(name)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs")
