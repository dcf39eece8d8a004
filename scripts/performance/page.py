#!/usr/bin/env python3
"""Writes docs/performance.md from docs/data/performance.json: what scripts/peers and scripts/growth
measured. Measures nothing itself."""
import json
from statistics import median

from measure import DATA, ROOT

NOTES = DATA.with_name("performance_notes.md")  # by hand: why a target is not met, what was tried
PROTOTYPE = 11_300  # frames per CPU-second of the prototype that the recipe was found with
HEAD = """# Performance

<!-- Written by scripts/performance/page.py from docs/data/performance.json; do not edit. -->

Rates are per CPU-second, of all threads together: they suffer less from a busy machine than those per second
of wall time. All programs take their turn in each round, so that what disturbs one disturbs all; tables give
the smallest, the median and the largest of the rounds, and ratios are of medians."""


def number(x):
    """Three digits: 1.23M, 45.6k, 789."""
    for limit, unit in ((1e6, "M"), (1e3, "k")):
        if x >= 0.9995 * limit:
            return f"{number(x / limit)}{unit}"
    return f"{x:.0f}" if x >= 99.95 else f"{x:.1f}" if x >= 9.995 else f"{x:.2f}"


def spread(values):
    return " / ".join(number(f(values)) for f in (min, median, max))


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def find(results, **wanted):
    return next((r for r in results if all(r[k] == v for k, v in wanted.items())), None)


def ratio(results, work, who, key="cpu"):
    """How many times faster we are, or None."""
    ours, theirs = (find(results, work=work, who=w) for w in ("Wordgaze", who))
    if ours is None or theirs is None:
        return None
    if "median_us" in ours:
        return median(theirs["median_us"]) / median(ours["median_us"])
    return median(ours[key]) / median(theirs[key])


def times(x):
    return "" if x is None else f"{x:,.0f}x" if x >= 99.5 else f"{number(x)}x"


def peer_table(results):
    if "median_us" in results[0]:
        head = ["configuration", "who", "median, us: min / median / max", "99th percentile, us", "we are"]
        return table(head, [[r["work"], r["who"], spread(r["median_us"]), spread(r["p99_us"]),
                             times(ratio(results, r["work"], r["who"])) if r["who"] != "Wordgaze"
                             else ""] for r in results])
    unit = results[0]["unit"]
    rows = []
    for r in results:
        peer = r["who"] != "Wordgaze"
        rows.append([r["work"], r["who"], spread(r["cpu"]),
                     times(ratio(results, r["work"], r["who"])) if peer else "", spread(r["wall"]),
                     times(ratio(results, r["work"], r["who"], "wall")) if peer else ""])
    return table(["work", "who", f"{unit} per CPU-second: min / median / max", "we are",
                  f"{unit} per second", "we are"], rows)


def targets(data):
    """[target, figure, met], of issue 4."""
    peers, growth = (data.get(k, {"results": []}) for k in ("peers", "growth"))
    results, rows = peers["results"], []

    def add(text, value, met, show=number):
        rows.append([text, show(value), "met" if met else "**not met**"])

    def at_least(text, value, bound, show=number):
        if value is not None:
            add(text, value, value >= bound, show)

    def at_most(text, value, bound, show):
        if value is not None:
            add(text, value, value <= bound, show)

    def ours(work, key="cpu"):
        found = find(results, work=work, who="Wordgaze")
        return found and median(found[key])

    for env, bound in (("BabyAI-GoToLocal-v0", 5e6), ("Wordgaze-One-N8-K4-v0", 5e6),
                       ("BabyAI-BossLevel-v0", 3e6)):
        at_least(f"{env}: {bound / 1e6:g} million steps per CPU-second", ours(env), bound)
    for who, bound in (("EnvPool", 50), ("Python minigrid", 1000)):
        for env in ("BabyAI-GoToLocal-v0", "BabyAI-BossLevel-v0", "MiniGrid-Empty-8x8-v0"):
            at_least(f"{env}: {bound} times {who}", ratio(results, env, who), bound, times)
    resets = ours("BabyAI-GoToLocal-v0, resets")
    at_most("BabyAI-GoToLocal-v0: a reset in 2 us", resets and 1e6 / resets, 2,
            lambda x: f"{number(x)} us")
    single = "configs/single.toml, 1 thread"
    peers = (("configs/single.toml", 10), ("configs/single-3x3.toml", 2.5))
    for config, bound in peers:
        for threads in ("2 threads", "1 thread"):
            work = f"{config}, {threads}"
            at_least(f"{work}: {bound} times PyTorch", ratio(results, work, "PyTorch"), bound, times)
    rate = ours(single)
    at_least(f"configs/single.toml: twice the prototype's {number(PROTOTYPE)} frames per CPU-second",
             rate and rate / PROTOTYPE, 2, times)
    acting = find(results, work="configs/single.toml", who="Wordgaze")
    at_most("acting for one robot: a decision in 30 us, median", acting and median(acting["median_us"]),
            30, lambda x: f"{number(x)} us")
    for unit, what in (("frames", "training"), ("steps", "simulator")):
        one, two = (find(growth["results"], group="threads", x=n, unit=unit) for n in (1, 2))
        at_least(f"{what}: 2 threads 1.8 times as fast as 1 (wall time)",
                 one and median(two["wall"]) / median(one["wall"]), 1.8, times)
    reached = growth.get("time_to_result", {})
    if reached:
        slowest = max(r["seconds"] for r in reached.values())
        at_most(f"configs/single.toml to 95 % success in 1 minute, 2 threads, slowest of "
                f"{len(reached)} seeds", slowest, 60, lambda x: f"{number(x)} s")
    for env in ("Wordgaze-One-N8-K4-v0", "BabyAI-GoToLocal-v0"):  # rooms of 8x8
        at_most(f"{env}: 1024 bytes an environment", growth.get("memory", {}).get(env), 1024,
                lambda x: f"{x} bytes")
    return rows


def setting(section, torch=None):
    m, rounds = section["machine"], section["rounds"]
    parts = [f"`{section['command']}`: {rounds} round{'s' if rounds > 1 else ''} of "
             f"{section['seconds']:g} s, on {m['cores']} cores of {m['processor']}",
             f"commit {m['commit']}, {m['compiler']}, `{m['flags']}`"]
    if torch:
        forced = torch["OPENBLAS_CORETYPE"]
        parts.append(f"PyTorch {torch['torch']} {'with' if torch['onednn'] else 'without'} oneDNN, BLAS "
                     f"{torch['blas']} with kernels for {torch['kernel']} (OPENBLAS_CORETYPE "
                     f"{'= ' + forced if forced else 'is not set'})")
    return ";\n".join(parts) + "."


def peers_section(peers):
    by_group = {g: [r for r in peers["results"] if r["group"] == g]
                for g in ("simulator", "learner", "acting")}
    steps = [r for r in by_group["simulator"] if r["unit"] == "steps"]
    resets = [r for r in by_group["simulator"] if r["unit"] == "resets"]
    batches = ", ".join(f"{n} in {env}" for env, n in peers["envpool_batch"].items())
    return f"""## Against the peers

{setting(peers, peers["torch"])}

### Simulator

Uniformly random actions, one thread; every view is written, and an ended episode is followed by the next. Python
minigrid 3.2.0 without gymnasium's wrappers. EnvPool 1.2.5 with the number of environments that suits it best
({batches}); ours is 256.

{peer_table(steps)}

New episodes alone:

{peer_table(resets)}

### Learner

The whole loop of recurrent PPO with the same network, batch and settings.
[torch_peer.py](../scripts/performance/torch_peer.py) has PyTorch's own layers and autograd, and its `check` computes
the numbers of our reference data. PyTorch's environments are free, recorded and replayed from memory; ours
include the simulator. PyTorch's threads sleep while they wait (OMP_WAIT_POLICY=PASSIVE), which suits it better here than
spinning. The configurations ask for two threads.

{peer_table(by_group["learner"])}

### Acting

One decision for one robot on one thread, from the view to the action; the mission is encoded once an episode. Ours
includes drawing the view.

{peer_table(by_group["acting"])}"""


def growth_section(growth):
    def rates(group, names=None, key="cpu"):
        rows = []
        for r in growth["results"]:
            if r["group"] == group and r["unit"] == "steps":
                frames = find(growth["results"], group=group, x=r["x"], unit="frames")
                name = f"{r['x']:g}" if names is None else names(r)
                rows.append([name, spread(r[key]), spread(frames[key])])
        return rows

    def mission(r):
        return f"{r['work']}: {growth['missions'][r['work']]}"

    memory = "\n".join(f"* {env}: {size} bytes" for env, size in growth["memory"].items())
    units = ["steps: min / median / max", "frames: min / median / max"]
    text = f"""## How it grows

{setting(growth)}
One thread; steps of the simulator (256 environments) and frames of training (the settings of configs/single.toml;
minibatches of 32 sequences at every number of environments) per CPU-second.

![Rates against environments, room size and objects](images/growth.png)

{table(["environments", *units], rates("environments"))}

{table(["side of the room", *units], rates("room"))}

{table(["objects", *units], rates("objects"))}

{table(["mission", *units], rates("mission", mission))}

{table(["threads (simulator: 4096 environments), per second of wall time", *units], rates("threads", key="wall"))}

Memory of one environment, the growth of the resident size from 16,384 to 262,144 of them, without the caller's
buffers and with all that the program keeps of each:

{memory}"""
    if growth["profile"]:
        shares = [[phase, f"{100 * share:.1f} %"] for phase, share in growth["profile"].items()]
        text += f"""

## Where the time of training goes

Shares of the samples that `perf` took of `bench --train configs/single.toml --threads 1`. Acting and forward
are the same code, with the 128 lanes of one step and with a minibatch; tables: rebuilt after each change of the
weights, and their gradients; the rest: losses, sampling, copying frames.

{table(["phase", "share"], shares)}"""
    if growth["time_to_result"]:
        rows = [[seed, f"{r['seconds']:g} s", number(r["frames"])]
                for seed, r in growth["time_to_result"].items()]
        text += f"""

## Time to result

`train --config configs/single.toml --threads 2` until 95 % of the last 1000 episodes succeed:

{table(["seed", "time", "frames"], rows)}"""
    return text


def main():
    data = json.loads(DATA.read_text())
    parts = [HEAD, "## Targets\n\n" + table(["target", "measured", ""], targets(data))]
    if NOTES.exists():
        parts.append(NOTES.read_text().strip())
    if "peers" in data:
        parts.append(peers_section(data["peers"]))
    if "growth" in data:
        parts.append(growth_section(data["growth"]))
    parts.append("""## To repeat it

    cmake --preset release && cmake --build --preset release
    scripts/peers && scripts/growth""")
    (ROOT / "docs/performance.md").write_text("\n\n".join(parts) + "\n")


if __name__ == "__main__":
    main()
