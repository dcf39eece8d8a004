"""From the folders of runs to docs/data/results.json: what the page needs, and the metrics thinned."""
import csv
import gzip
import io
import json
import math
import random
import statistics
import tomllib

from measure import ROOT

RESAMPLES = 2000
LARGEST_LOG = 200  # rows of metrics kept of a run
COLUMNS = ["frames", "seconds", "success_rate", "mean_return", "mean_length", "value_loss", "mask_loss",
           "entropy", "kl", "hit", "hit_12", "success_go_to", "success_pickup", "done_wrong", "truncated"]
WINDOW = 1000  # episodes over which metrics.csv means: before that its rates say little


def interquartile_mean(values):
    """The mean without the lowest and the highest quarter."""
    cut = len(values) // 4
    return statistics.fmean(sorted(values)[cut:len(values) - cut])


def deviation(p, episodes):
    """Of a rate over so many episodes; a success and a failure are added, so that 100 % has one too."""
    p = (p * episodes + 1) / (episodes + 2)
    return math.sqrt(p * (1 - p) / episodes)


def interval(rates, episodes=None):
    """95 % bootstrap interval of the mean: seeds are drawn with replacement and, given the number of
    episodes behind each rate of success, the rate anew (a normal draw with the binomial's variance)."""
    rng, means = random.Random(1), []
    for _ in range(RESAMPLES):
        drawn = rng.choices(rates, k=len(rates))
        if episodes:
            drawn = [min(1.0, max(0.0, rng.gauss(p, deviation(p, episodes)))) for p in drawn]
        means.append(statistics.fmean(drawn))
    means.sort()
    return [means[int(0.025 * RESAMPLES)], means[int(0.975 * RESAMPLES)]]


def spread(values, episodes=None):
    return {"mean": statistics.fmean(values), "iqm": interquartile_mean(values),
            "ci95": interval(values, episodes), "seeds": values}


def read_metrics(path):
    with open(path) as file:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]


def thinned(rows):
    """At most LARGEST_LOG, evenly, the last among them."""
    step = math.ceil(len(rows) / LARGEST_LOG)
    return rows[::-1][::step][::-1] if rows else rows


def reached(rows, success):
    """[frames, episodes, about] at the first update whose success is as high, or None."""
    episodes = frames = 0
    for row in rows:
        if row["mean_length"] > 0:
            episodes += (row["frames"] - frames) / row["mean_length"]
        frames = row["frames"]
        if row["success_rate"] >= success and episodes >= WINDOW:
            return [int(frames), round(episodes)]
    return None


def curve(logs):
    """[frames, mean, smallest, largest success of the seeds], at the frames that all have."""
    points = zip(*(thinned(log) for log in logs))
    lines = []
    for point in points:
        values = [row["success_rate"] for row in point if not math.isnan(row["success_rate"])]
        if values:
            lines.append([int(point[0]["frames"]), statistics.fmean(values), min(values), max(values)])
    return lines


def held_out(row):
    """The kinds of objects that the missions of a row's training never named."""
    config = tomllib.loads((ROOT / "configs" / row.config).read_text())
    kinds = config.get("curriculum", {}).get("held_out", "")
    return {kind.strip() for kind in kinds.split(",") if kind.strip()}


def by_kinds(records, kinds):
    """Success on missions that name what was held out, on the others, and the ratio of both."""
    def rate(record, wanted):
        counts = [c for kind, c in record["by_object"].items() if (kind in kinds) == wanted]
        episodes = sum(c["episodes"] for c in counts)
        return sum(c["success_rate"] * c["episodes"] for c in counts) / episodes, episodes
    unseen, seen = ([rate(r, wanted) for r in records] for wanted in (True, False))
    return {"held_out": spread([r for r, _ in unseen], unseen[0][1]),
            "seen": spread([r for r, _ in seen], seen[0][1]),
            "ratio": spread([u / s if s else 0.0 for (u, _), (s, _) in zip(unseen, seen)])}


def combined(reports, kinds):
    """Records of the same setting, one a seed, as means and intervals."""
    settings = []
    for records in zip(*(report["settings"] for report in reports)):
        first = records[0]
        episodes = first["episodes"]
        joins = {join: statistics.fmean(r["by_join"][join]["success_rate"] for r in records)
                 for join in first["by_join"] if all(join in r["by_join"] for r in records)}
        setting = {key: first[key] for key in ("env", "room", "objects", "policy", "episodes", "seed")}
        setting |= {"success": spread([r["success_rate"] for r in records], episodes),
                    "reward": spread([r["mean_reward"] for r in records])}
        if len(joins) > 1:
            setting["by_join"] = joins
        if kinds:
            setting |= by_kinds(records, kinds)
        if "transparency" in first:
            setting["transparency"] = transparency([r["transparency"] for r in records])
        settings.append(setting)
    return settings


def transparency(reports):
    """The figures of docs/metrics.md that have a target, and those beside them."""
    def mean(*path):
        values = []
        for report in reports:
            for key in path:
                report = report.get(key) if report is not None else None
            if report is not None:
                values.append(report)
        return spread(values) if values else None

    figures = {}
    for name in ("gaze", "gradient", "gradient_times_input"):
        def deletion(cells):
            return mean(name, "faithfulness_in_view", "deletion", "1", cells)
        figures[name] = {"pointing": mean(name, "pointing", "target"),
                         "chance": mean(name, "pointing", "target_chance"),
                         "mass": {role: mean(name, "mass_in_view", role, "share")
                                  for role in ("target", "distractor", "empty", "wall", "nowhere")},
                         "nowhere_out_of_view": mean(name, "mass_out_of_view", "nowhere", "share"),
                         "deletion": deletion("brightest"), "deletion_others": deletion("others"),
                         "insertion": mean(name, "faithfulness_in_view", "insertion", "1", "brightest"),
                         "insertion_others": mean(name, "faithfulness_in_view", "insertion", "1",
                                                  "others")}
    if figures["gaze"]["pointing"]:
        figures["gaze"] |= {"over_half_out_of_view": mean("gaze", "glow_out_of_view", "over_half"),
                            "spotlight": {role: mean("gaze", "spotlight_in_view", role, "share")
                                          for role in ("target", "distractor")}}
    for name, keys in (("words", ("color_pointing", "type_pointing", "content_weight",
                                  "function_weight")), ("mask", ("f1", "delay", "alpha_bright", "alpha_dark"))):
        figures[name] = {key: mean(name, key) for key in keys}
    return figures


def write_log(path, logs):
    """All seeds of a row in one compressed table; the same bytes for the same numbers."""
    text = io.StringIO()
    text.write(",".join(["seed", *COLUMNS]) + "\n")
    for seed, rows in logs.items():
        for row in thinned(rows):
            values = [f"{row[c]:.0f}" if c == "frames" else f"{row[c]:.4g}" for c in COLUMNS]
            text.write(",".join([str(seed), *values]) + "\n")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(gzip.compress(text.getvalue().encode(), mtime=0))


def rounded(value):
    """Four digits behind the point are more than 1,000 episodes can tell."""
    if isinstance(value, float):
        return None if math.isnan(value) else round(value, 4)
    if isinstance(value, dict):
        return {k: rounded(v) for k, v in value.items()}
    return [rounded(v) for v in value] if isinstance(value, (list, tuple)) else value


def summarize(row, steps, logs_folder):
    """What is finished of a row, or None: of each evaluation the seeds that have it."""
    done = [s for s in steps if s.finished()]
    if not done:
        return None
    trained = {s.seed: s for s in done if s.kind == "train"}
    result = {"name": row.name, "part": row.part, "about": row.about, "config": row.config,
              "init": row.init, "of": row.of,
              "seeds": sorted({s.seed for s in steps}), "trained": sorted(trained),
              "seconds": sum(s.finished()["seconds"] for s in done), "evaluations": {},
              "commands": [f"{s.program} {' '.join(s.arguments)}" for s in steps
                           if s.seed == steps[0].seed]}
    if trained:
        logs = {seed: read_metrics(s.folder / "metrics.csv") for seed, s in sorted(trained.items())}
        write_log(logs_folder / f"{row.name}.csv.gz", logs)
        result |= {"frames": int(max(log[-1]["frames"] for log in logs.values())),
                   "curve": curve(list(logs.values())),
                   "reached": {str(level): [reached(log, level) for log in logs.values()]
                               for level in (0.9, 0.95, 0.99)}}
    for kind in dict.fromkeys(s.kind for s in steps if s.kind != "train"):
        of_kind = [s for s in done if s.kind == kind]
        if of_kind:
            result["evaluations"][kind] = combined([json.loads(s.result.read_text()) for s in of_kind],
                                                   held_out(row))
    return rounded(result)


def compact(data):
    """JSON with a line a row: small, and its changes can be read."""
    rows = ",\n  ".join(json.dumps(row, separators=(",", ":")) for row in data["rows"])
    rest = json.dumps({k: v for k, v in data.items() if k != "rows"})
    return rest[:-1] + ',\n "rows": [\n  ' + rows + "\n]}\n"
