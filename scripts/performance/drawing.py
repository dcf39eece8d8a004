"""What the plots of the documentation have in common. Needs matplotlib: Debian's python3-matplotlib."""
import re

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

COLORS = ["#1f5fa8", "#b5482a", "#3a8a4d", "#8057a5", "#b08a1e", "#4a9aa8", "#a8517e", "#777777",
          "#2b2b2b", "#d98cb3", "#7f8f1f"]
pyplot.rcParams.update({
    "font.size": 9, "axes.titlesize": 9, "legend.fontsize": 9, "legend.frameon": False,
    "lines.linewidth": 1.4, "axes.prop_cycle": matplotlib.cycler(color=COLORS),
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.alpha": 0.25,
    "savefig.bbox": "tight", "savefig.dpi": 90,
    "svg.fonttype": "none", "svg.hashsalt": "wordgaze"})  # letters as text; the same file every time


def save(figure, path):
    """As the suffix says."""
    svg = path.suffix == ".svg"
    figure.savefig(path, metadata={"Date": None} if svg else None)
    pyplot.close(figure)
    if svg:
        path.write_text(re.sub(r' d="[^"]*"', short, path.read_text()))


def short(outline):
    """The outline of a shape in tenths of a point, on one line."""
    words = re.sub(r"\d+\.\d+", lambda number: f"{float(number[0]):.1f}", outline[0]).split()
    return " " + " ".join(words)
