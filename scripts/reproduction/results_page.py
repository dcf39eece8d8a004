#!/usr/bin/env python3
"""Writes docs/results.md and its plots from docs/data/results.json: what scripts/reproduce measured.
Measures nothing itself. Another folder than docs may be given."""
import json
import pathlib
import statistics
import sys
import tomllib

if __name__ == "__main__":
    sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "performance"))

from measure import ROOT, SYSTEM_PYTHON, capture
from page import table

HEAD = """# Results

<!-- Written by scripts/reproduction/results_page.py from docs/data/results.json; do not edit. -->

Success in percent and reward of agents in worlds not trained on: the mean over the seeds and, in brackets, its 95 %
bootstrap interval. For success it is over seeds and episodes (2,000 draws of the seeds with replacement, and of each rate
anew with the variance of its episodes), for other figures over seeds alone. IQM is the interquartile mean: the mean of the
seeds without the lowest and the highest quarter. *Sampled* draws actions from the policy, *greedy* takes the likeliest.
The metrics of every run, thinned to 200 rows, are in `data/results/`, all figures in `data/results.json`."""


def percent(x):
    return f"{100 * x:.1f}"


def success(spread):
    low, high = spread["ci95"]
    return f"{percent(spread['mean'])} [{percent(low)}, {percent(high)}]"


def seeds(setting):
    return str(len(setting["success"]["seeds"]))


def share(spread):
    return "-" if spread is None else f"{spread['mean']:.3f}"


def of_policy(settings, policy):
    return [s for s in settings or [] if s["policy"] == policy]


def both(settings, figure=success):
    """Sampled and greedy, of the first setting of each."""
    return [figure(found[0]["success"]) if (found := of_policy(settings, policy)) else "-"
            for policy in ("sampled", "greedy")]


def millions(row, level):
    """Median of the frames until training success is as high, and of how many seeds."""
    reached = row.get("reached", {}).get(level, [])
    frames = [r[0] for r in reached if r]
    if not frames:
        return f"- (0 of {len(reached)})"
    some = "" if len(frames) == len(reached) else f" ({len(frames)} of {len(reached)})"
    return f"{statistics.median(frames) / 1e6:.2f}M{some}"


class Results:
    def __init__(self, data):
        self.data, self.rows = data, data["rows"]

    def part(self, name):
        return [row for row in self.rows if row["part"] == name]

    def evaluation(self, row, kind, policy=None):
        found = next((r for r in self.rows if r["name"] == row), {"evaluations": {}})
        settings = found["evaluations"].get(kind, [])
        return of_policy(settings, policy) if policy else settings


def gaze_targets(add, what, gaze):
    """What the attention of one setting should show: in a crowd the target may be overlooked sooner."""
    figures, crowded = gaze["transparency"], (gaze["objects"] or 0) > 4
    m, words, mask = figures["gaze"], figures["words"], figures["mask"]["f1"]
    thousandths, times = "{:.3f}".format, "{:.1f} times".format
    add(f"{what}: M points at a target, 99 %", m["pointing"] and m["pointing"]["mean"], 0.99)
    spotlight = m.get("spotlight", {})
    for name, figure, bound in (("M on the target", m["mass"]["target"], 0.80 if crowded else 0.90),
                                ("s(M) - f on the target", spotlight.get("target"), 0.70 if crowded else 0.80),
                                ("no target in view: M on nowhere", m["nowhere_out_of_view"], 0.80)):
        if figure:
            add(f"{what}: {name}, {bound:.2f} in every seed; the lowest", min(figure["seeds"]), bound,
                thousandths)
    for name, figure in (("M", m["mass"]["distractor"]), ("s(M) - f", spotlight.get("distractor"))):
        if figure:
            bound = 0.10 if crowded else 0.05
            add(f"{what}: {name} not on distractors, {1 - bound:.2f} in every seed; the lowest",
                1 - max(figure["seeds"]), 1 - bound, thousandths)
    if glow := m.get("over_half_out_of_view"):
        add(f"{what}: no target in view: no object brighter than half, in 99.9 % of decisions in every seed; the lowest",
            1 - max(glow["seeds"]), 0.999, lambda x: f"{100 * x:.2f}")
    if words["function_weight"] and words["function_weight"]["mean"]:
        add(f"{what}: weight of content words 3 times that of function words in every seed; the lowest",
            min(c / f for c, f in zip(words["content_weight"]["seeds"], words["function_weight"]["seeds"])),
            3, times)
    add(f"{what}: F1 of the mask 0.98", mask and mask["mean"], 0.98, thousandths)
    if m["deletion"] and m["deletion_others"] and m["deletion_others"]["mean"]:
        add(f"{what}: deleting the brightest cell moves the policy 30 times as far as another",
            m["deletion"]["mean"] / m["deletion_others"]["mean"], 30, times)


def targets(results):
    """[target, measured, met], as far as there are data."""
    lines = []

    def add(what, value, bound, show=percent):
        if value is not None:
            lines.append([what, show(value), "met" if value >= bound else "**not met**"])

    for policy in ("sampled", "greedy"):
        grid = results.evaluation("single", "grid", policy)
        home = next((s for s in grid if (s["room"], s["objects"]) == (8, 4)), None)
        if home:
            add(f"attention, 8x8 with 4 objects, {policy}: success 99 %", home["success"]["mean"], 0.99)
            add(f"attention, 8x8 with 4 objects, {policy}: reward 0.88", home["reward"]["mean"], 0.88,
                lambda x: f"{x:.3f}")
            add(f"attention, every setting, {policy}: success 95 %; the lowest",
                min(s["success"]["mean"] for s in grid), 0.95)
            add(f"attention, every setting and seed, {policy}: success 90 %; the lowest",
                min(min(s["success"]["seeds"]) for s in grid), 0.90)
    for policy in ("sampled", "greedy"):
        for own in results.evaluation("structured", "own", policy)[:1]:
            add(f"two clauses, {policy}: success 95 %", own["success"]["mean"], 0.95)
            if "by_join" in own:
                add(f"two clauses, {policy}: 95 % for each join; the lowest",
                    min(own["by_join"].values()), 0.95)
        for kind, bound in (("three", 0.95), ("four", 0.95), ("six", 0.85), ("eight", 0.85)):
            for own in results.evaluation("more-clauses", kind, policy)[:1]:
                add(f"{kind} clauses after training on two, {policy}: success {100 * bound:.0f} %",
                    own["success"]["mean"], bound)
    for row in results.part("kinds"):
        for kinds in row["evaluations"].get("kinds", []) if "baseline" not in row["name"] else []:
            add(f"kinds never named, `{row['name']}`, {kinds['policy']}: 98 % of the success on the others",
                kinds["ratio"]["mean"], 0.98)
            add(f"kinds never named, `{row['name']}`, {kinds['policy']}: 95 % in every seed; the lowest",
                min(kinds["ratio"]["seeds"]), 0.95)
    for row in results.part("babyai"):
        best = [s["success"]["mean"] for s in row["evaluations"].get("own", [])]
        add(f"{row['name']}, better of both policies: success 99 %", max(best, default=None), 0.99)
    for name, clauses in (("single", "one clause"), ("structured", "two clauses")):
        for gaze in results.evaluation(name, "gaze"):
            gaze_targets(add, f"{clauses}, {gaze['objects']} objects, {gaze['policy']}", gaze)
    return lines


def grid_tables(results):
    """A table a row of the grid."""
    for row in results.part("grounding"):
        grid = row["evaluations"].get("grid")
        if not grid:
            continue
        lines = []
        for sampled, greedy in zip(of_policy(grid, "sampled"), of_policy(grid, "greedy")):
            line = [f"{sampled['room']}x{sampled['room']}, {sampled['objects']}"]
            for s in (sampled, greedy):
                line += [success(s["success"]), percent(s["success"]["iqm"]),
                         percent(min(s["success"]["seeds"])), f"{s['reward']['mean']:.3f}"]
            lines.append(line)
        yield f"### {row['about'].capitalize()}: `{row['name']}`"
        yield table(["room, objects", "sampled", "IQM", "lowest seed", "reward",
                     "greedy", "IQM", "lowest seed", "reward"], lines)


ABLATED_AT = [(8, 4), (8, 12), (10, 8), (12, 4), (12, 12)]


def ablation_table(results):
    lines = []
    for row in results.part("ablation"):
        grid = row["evaluations"].get("grid")
        if not grid:
            continue
        for policy in ("sampled", "greedy"):
            settings = of_policy(grid, policy)
            at = {(s["room"], s["objects"]): s["success"] for s in settings}
            sampled = policy == "sampled"
            lines.append([row["about"] if sampled else "", policy, seeds(settings[0]),
                          *(success(at[place]) if place in at else "-" for place in ABLATED_AT),
                          percent(statistics.fmean(s["success"]["mean"] for s in settings)),
                          percent(statistics.fmean(s["success"]["iqm"] for s in settings)),
                          millions(row, "0.95") if sampled else ""])
    return table(["variant", "policy", "seeds", *(f"{n}x{n}, {k}" for n, k in ABLATED_AT), "all settings",
                  "IQM of all", "95 % after"], lines) if lines else ""


def task_table(results):
    lines = []
    for row in results.part("task"):
        own = row["evaluations"].get("own")
        if not own:
            continue
        sampled = of_policy(own, "sampled")[0]
        joins = sampled.get("by_join", {})
        lines.append([row["name"], row["about"], seeds(sampled), *both(own), percent(sampled["success"]["iqm"]),
                      percent(min(sampled["success"]["seeds"])),
                      *(percent(joins[j]) if j in joins else "-" for j in ("and", "then", "after")),
                      millions(row, "0.9"), millions(row, "0.95")])
    return table(["row", "variant", "seeds", "sampled", "greedy", "IQM", "lowest seed", "and", "then", "after",
                  "90 % after", "95 % after"], lines) if lines else ""


def beyond_table(results):
    lines = []
    for row in results.rows:
        for kind, settings in row["evaluations"].items():
            if kind in ("three", "four", "six", "eight", "large"):
                sampled = of_policy(settings, "sampled")[0]
                joins = sampled.get("by_join")
                # With many joins each form is too rare to tell.
                hardest = min(joins, key=joins.get) if joins and len(joins) < 8 else None
                lines.append([settings[0]["env"], row["name"], row["about"], seeds(sampled),
                              *both(settings),
                              percent(sampled["success"]["iqm"]),
                              f"{hardest}: {percent(joins[hardest])}" if hardest else ""])
    return table(["environment", "row", "agent", "seeds", "sampled", "greedy", "IQM", "hardest joins, sampled"],
                 sorted(lines)) if lines else ""


def kinds_table(results):
    lines = []
    for row in results.part("kinds"):
        for s in row["evaluations"].get("kinds", []):
            lines.append([row["name"], row["about"], seeds(s), s["policy"], success(s["seen"]),
                          success(s["held_out"]), success(s["ratio"]),
                          percent(min(s["ratio"]["seeds"]))])
    return table(["row", "agent", "seeds", "policy", "named in training", "held out", "ratio", "lowest seed"],
                 lines) if lines else ""


def babyai_table(results):
    lines = []
    for row in results.part("babyai"):
        reached = [r for r in row["reached"]["0.99"] if r]
        episodes = f"{statistics.median(r[1] for r in reached):,.0f}" if reached else "-"
        lines.append([row["name"], f"{row['frames'] / 1e6:.1f}M", str(len(row["trained"])), *both(row["evaluations"].get("own")),
                      millions(row, "0.99"), episodes,
                      f"{row['seconds'] / len(row['trained']) / 60:.1f}"])
    return table(["level", "trained for", "seeds", "sampled", "greedy", "99 % after", "that is, episodes, about",
                  "minutes a seed"],
                 lines) if lines else ""


def transparency_tables(results):
    maps, words = [], []
    for row in results.rows:
        for gaze in row["evaluations"].get("gaze", []):
            figures = gaze["transparency"]
            for kind, name in (("gaze", "M"), ("gradient", "gradient"),
                               ("gradient_times_input", "gradient x input")):
                m = figures[kind]
                if m["pointing"] is not None:
                    maps.append([row["name"], str(gaze["objects"]), gaze["policy"], name, share(m["pointing"]), share(m["chance"]),
                                 *(share(v) for v in m["mass"].values()),
                                 share(m.get("spotlight", {}).get("target")),
                                 share(m["nowhere_out_of_view"]), share(m["deletion"]),
                                 share(m["deletion_others"]), share(m["insertion"]),
                                 share(m["insertion_others"])])
            if figures["words"]["content_weight"]:
                words.append([row["name"], str(gaze["objects"]), gaze["policy"], *(share(v) for v in figures["words"].values()),
                              *(share(v) for v in figures["mask"].values())])
    if maps:
        yield table(["row", "objects", "policy", "map", "points at a target", "chance", "mass: target", "distractors",
                     "empty", "walls", "nowhere", "s(M) - f: target", "no target in view: nowhere",
                     "deletion: brightest", "another", "insertion: brightest",
                     "another"], maps)
    if words:
        yield table(["row", "objects", "policy", "word points at its color", "its type", "weight: content words",
                     "function words", "mask F1", "steps after c_t changes", "alpha of words that matter",
                     "of silent words"], words)


def held_out_kinds():
    config = tomllib.loads((ROOT / "configs/held-out.toml").read_text())
    return config["curriculum"]["held_out"]


def commands(results):
    lines = ["One seed of each row; `--threads` is left out. Weights of a first phase are those of the same seed.", ""]
    for row in results.rows:
        what = f"the agents of `{row['of']}`" if row["of"] else \
            ", ".join(filter(None, [row["config"] and f"`configs/{row['config']}`",
                                    row["init"] and f"from `{row['init']}`"]))
        lines += [f"* **{row['name']}**: {what}; seeds {', '.join(map(str, row['seeds']))}; "
                  f"{row['seconds'] / 3600:.2f} h", "", *(f"      {c}" for c in row["commands"]), ""]
    return "\n".join(lines).rstrip()


def unfinished(results):
    """The rows with fewer seeds than they should have."""
    missing = {}
    for row in results.rows:
        if not row["of"] and len(row["trained"]) < len(row["seeds"]):
            missing.setdefault(f"{len(row['trained'])} of {len(row['seeds'])} seeds", []).append(row)
    return "\n".join(f"**Not finished**, {seeds}: {', '.join(row['name'] for row in rows)}."
                     for seeds, rows in missing.items())


def write_page(folder):
    results = Results(json.loads((folder / "data/results.json").read_text()))
    drawn = capture([SYSTEM_PYTHON, pathlib.Path(__file__).with_name("curves.py"), folder]).split()
    sections = [HEAD]

    def plot(name, title):
        if name in drawn:
            sections.append(f"![{title}](images/results/{name}.svg)")

    def section(title, *blocks):
        blocks = [block for block in blocks if block]
        if blocks:
            sections.extend([f"## {title}", *blocks])

    data = results.data
    machine = data["machine"]
    hours = sum(row["seconds"] for row in results.rows) / 3600
    smaller = ", ".join(f"{key} at most {value:,}" for key, value in data["scale"].items())
    sections.append(
        f"Made by `scripts/reproduce` in {hours:.1f} hours of one program (threads: {data['threads']}, "
        f"programs at a time: {data['jobs']}) on {machine['cores']} cores of {machine['processor']}; "
        f"commit {machine['commit']}, {machine['compiler']}, `{machine['flags']}`."
        + (f" **Smaller than the full run: {smaller}.**" if smaller else ""))
    sections.append(unfinished(results))
    reached = targets(results)
    section("Targets", reached and table(["target", "measured", ""], reached))
    section("Grounding", "One clause, trained in 8x8 with four objects only (`Wordgaze-One-N8-K4-v0`). The paper reports, "
            "without seeds or intervals, 90-100 % and reward 0.8-0.9 in all of these rooms with attention; "
            "without it 90-96 % and 0.8-0.85 with four objects, falling to 55-70 % and 0.5-0.6 with "
            "twelve.",
            *grid_tables(results))
    plot("grid", "Success by room and objects; bands: 95 % intervals")
    plot("grounding", "Learning curves; bands: lowest and highest seed")
    section("Ablations of grounding", results.part("ablation") and
            "1.5 million frames, one setting changed in each row but the last.", ablation_table(results))
    plot("ablations", "Learning curves of the ablations; bands: lowest and highest seed")
    section("Two clauses", results.part("task") and
            "10x10 with four objects, from the weights of the first phase with the same seed. Frames are "
            "those of this phase, until the success of training episodes is as high: the median of the "
            "seeds that reach it. The paper reports above 90 % with the module, within two million frames, "
            "and about 70 % without it.", task_table(results))
    plot("task", "Learning curves; bands: lowest and highest seed")
    plot("task-ablations", "Learning curves of the ablations; bands: lowest and highest seed")
    section("Beyond: more clauses, larger rooms", beyond_table(results))
    section("Kinds of objects never named in training", results.part("kinds") and
            "Some of the eighteen kinds (in `held-out`: " + held_out_kinds() + ") lie about in training, but "
            "no mission names them. The ratio is that of the successes; "
            "[reading.md](reading.md#pairs-of-words-never-heard) says why the words of such a pair are "
            "understood together all the same. `held-out` was used for tuning, the others were not.",
            kinds_table(results))
    section("Levels of BabyAI from scratch", results.part("babyai") and
            "The levels of the reference as they are, without done actions. PutNextLocal alone has a "
            "curriculum, at first most episodes start with the object in hand, and the Task Attention "
            "Module, which is told whether it is in hand "
            "([reading.md](reading.md#two-objects-in-one-clause)). The BabyAI 1.1 report "
            "(arXiv 2007.12770) counts episodes to 99 % on such levels as well; its table was not at hand "
            "when this page was made, so no figure of it stands here. What its authors' repository does say "
            "(mila-iqia/babyai, scripts/README.md): five hours of training for 97-99 % on GoToLocal, on "
            "hardware not named; minutes here are of one thread and include the evaluation.", babyai_table(results))
    plot("babyai", "Learning curves of the levels; bands: lowest and highest seed")
    section("Transparency", "[metrics.md](metrics.md) defines the figures; of decisions with a target in "
            "view, one cell for deletion and insertion." if any(
                "gaze" in r["evaluations"] for r in results.rows) else "", *transparency_tables(results))
    section("Commands and configurations", commands(results))
    (folder / "results.md").write_text("\n\n".join(filter(None, sections)) + "\n")


if __name__ == "__main__":
    write_page(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs")
