#!/usr/bin/env python3
"""Writes test/data/training/update_*.json for test/training/update_test.cpp: whole updates of recurrent PPO,
in PyTorch.

A rollout of several lanes, whose episodes end in success or by time within sequences, from weights that
are not those that learn; then advantages, epochs over shuffled minibatches, the whole loss, clipping
and Adam, twice. The network is that of agent.py and the parts of the loss are those of ppo.py; nothing
is taken from the C++. Needs Debian's python3-torch and python3-numpy.
"""
import json
import pathlib
import random
import statistics
import sys

import numpy
import torch
import torch.nn.functional as F

import agent
import ppo

SEED = 20260113
LANES, STEPS, CHUNK, EPOCHS, MINIBATCHES = 3, 8, 4, 2, 3
# What can lie in a cell of a room without doors, in the order of the alphabet.
CODES = [(0, 0, 0), (1, 0, 0), (2, 5, 0)] + agent.OBJECTS
MISSIONS = agent.MISSIONS + [[34, 45, 52, 11]]  # "open the yellow door"
# The sub-task of each word; -1 for the words between them.
SUB_TASK_OF = [[0] * 5, [0] * 5 + [-1, -1] + [1] * 5, [0] * 4]
BASE = agent.SIZES | {
    "channels": 2, "head_size": 3, "attention": True, "task_attention": False,
    "completion_input": False, "gaze": "product", "gaze_exponent": 2, "gaze_floor": 0.1,
    "entropy_base": 3, "encoder_leak": 0.1, "encoder": "1x1", "task_reader": "sum", "focus": 0.6,
    "sharpness_start": 1, "sharpness": 3, "nowhere": 0.45, "word_choice_start": 0.5,
    "word_choice": 3, "score_cost_start": 2e-4, "score_cost": 5e-5}
VARIANTS = {
    "grounding": {},
    "task": {"task_attention": True, "task_reader": "scan"},
    "paper": {"gaze": "sum", "task_attention": True, "completion_input": True, "score_cost": 0},
}
PPO = {"discount": 0.9, "gae_lambda": 0.8, "clip": 0.2, "value_coefficient": 0.3,
       "mask_coefficient": 0.7, "advantage_floor": 0.65}
GRADIENT_NORM = {"grounding": 0.75, "task": 4, "paper": 0.5}
RATES = [{"learning_rate": 0.01, "task_learning_rate": 0.03, "entropy_coefficient": 0.05},
         {"learning_rate": 0.004, "task_learning_rate": 0.012, "entropy_coefficient": 0.02}]


def single(value):
    """As single precision has it: rollouts hold such numbers."""
    return numpy.asarray(value, dtype=numpy.float32).astype(float).tolist()


def draw_view(choice):
    return [choice.randrange(3) if choice.random() < 0.75 else choice.randrange(len(CODES))
            for _ in range(agent.VIEW ** 2)]


class Lane:
    """What a lane of the world shows: views, missions, what is done of them, ends of episodes."""

    def __init__(self, choice, number):
        self.choice, self.begins, self.mission = choice, number == 1, None
        self.new_mission()

    def new_mission(self):
        self.mission = self.choice.choice([k for k in range(len(MISSIONS)) if k != self.mission])
        self.done = [0, 0]

    def look(self):
        codes = draw_view(self.choice)
        return {"codes": codes, "image": [CODES[k] for k in codes], "mission": self.mission,
                "keep": 0 if self.begins else 1, "completion": list(self.done)}

    def step(self):
        """What came of an action: reward, ended, truncated."""
        self.begins = False
        draw, reward = self.choice.random(), self.choice.randint(-8, 8) / 8
        if draw < 0.3:
            return reward + 1, True, draw < 0.15
        if draw < 0.6:
            self.done[self.choice.randrange(2)] = 1
        return reward, False, False

    def restart(self):
        self.begins = True
        self.new_mission()


def collect(p, config, choice):
    """A rollout: lists of [lane][step], and the memory before each sequence [chunk][lane]."""
    rollout = {key: [] for key in ("frames", "action", "bright", "log_prob", "value", "reward",
                                   "ended", "next_value")}
    starts = [[None] * LANES for _ in range(STEPS // CHUNK)]
    truncations = 0
    for b in range(LANES):
        lane = Lane(choice, b)
        memory = [torch.tensor(single(agent.gaussian(choice, config["memory_size"])))
                  for _ in range(2)]
        for key in rollout:
            rollout[key].append([])
        for t in range(STEPS):
            memory = [torch.tensor(single(m.tolist())) for m in memory]
            if t % CHUNK == 0:
                starts[t // CHUNK][b] = {"h": memory[0].tolist(), "c": memory[1].tolist()}
            frame = lane.look()
            seen = next(agent.run_lane(p, config, [frame], *memory, MISSIONS))
            memory = [seen["h"], seen["c"]]
            action = choice.choices(range(agent.ACTIONS), seen["logits"].softmax(0).tolist())[0]
            reward, ended, truncated = lane.step()
            if truncated:  # not an end of the task: what would have followed is worth its value
                last = lane.look()
                value = next(agent.run_lane(p, config, [last], *memory, MISSIONS))["value"].item()
                reward += PPO["discount"] * value
                truncations += 1
            for key, item in {"frames": frame, "action": action, "bright": choice.randrange(4),
                              "log_prob": seen["logits"].log_softmax(0)[action].item(),
                              "value": seen["value"].item(), "reward": reward,
                              "ended": int(ended)}.items():
                rollout[key][b].append(single(item) if isinstance(item, float) else item)
            if ended:
                lane.restart()
        following = next(agent.run_lane(p, config, [lane.look()], *memory, MISSIONS))
        rollout["next_value"][b] = single(following["value"].item())
    kept = [[f["keep"] for f in lane] for lane in rollout["frames"]]
    assert truncations > 0 and any(0 in lane[1:CHUNK] + lane[CHUNK + 1:] for lane in kept)
    assert all(len({f["mission"] for f in lane}) > 1 for lane in rollout["frames"])
    return rollout | {"starts": starts}


def sequence_results(p, config, rollout, sequence):
    """The network again over one training sequence; its frames as (lane, step)."""
    lane, first = sequence % LANES, sequence // LANES * CHUNK
    start = rollout["starts"][sequence // LANES][lane]
    frames = rollout["frames"][lane][first:first + CHUNK]
    results = agent.run_lane(p, config, frames, torch.tensor(start["h"]), torch.tensor(start["c"]),
                             MISSIONS)
    return [((lane, first + t), r) for t, r in enumerate(results)]


def mask_loss(frame, bright, logits):
    sub_tasks = SUB_TASK_OF[frame["mission"]]
    truth = torch.tensor([float(k >= 0 and bright >> k & 1) for k in sub_tasks])
    return F.binary_cross_entropy_with_logits(logits[:len(sub_tasks)], truth)


def minibatch_loss(p, config, rollout, sequences, rates, facts):
    results = [r for s in sequences for r in sequence_results(p, config, rollout, s)]

    def recorded(key):
        return torch.tensor([rollout[key][b][t] for (b, t), _ in results])

    advantage = recorded("advantage")
    deviation = advantage.std(unbiased=False).item()
    facts["deviation"].append(deviation)
    parts = ppo.objective(
        torch.distributions.Categorical(logits=torch.stack([r["logits"] for _, r in results])),
        torch.stack([r["value"] for _, r in results]), recorded("action"), recorded("log_prob"),
        (advantage - advantage.mean()) / max(deviation, PPO["advantage_floor"]),
        advantage + recorded("value"), PPO["clip"])
    loss = (parts["policy"] + PPO["value_coefficient"] * parts["value"]
            - rates["entropy_coefficient"] * parts["entropy"])
    if config["task_attention"]:
        parts["mask"] = torch.stack(
            [mask_loss(rollout["frames"][b][t], rollout["bright"][b][t], r["mask_logits"])
             for (b, t), r in results]).mean()
        loss = loss + PPO["mask_coefficient"] * parts["mask"]
    if config["score_cost"] > 0:
        loss = loss + agent.score_price(p, config)
    return loss, parts


def update(p, config, rollout, rates, optimizer, largest, shuffler, facts):
    """All epochs; the means of what they report."""
    order, reports = list(range(STEPS // CHUNK * LANES)), []
    size = len(order) // MINIBATCHES
    for _ in range(EPOCHS):
        shuffler.shuffle(order)
        for k in range(MINIBATCHES):
            optimizer.zero_grad()
            loss, parts = minibatch_loss(p, config, rollout, order[k * size:(k + 1) * size], rates,
                                         facts)
            loss.backward()
            grads = [leaf.grad for leaf in p.values() if leaf.grad is not None]
            norm = sum(g.square().sum() for g in grads).sqrt().item()
            facts["norm"].append(norm)
            for g in grads:
                g *= min(1, largest / norm)
            optimizer.step()
            reports.append({key: part.item() for key, part in parts.items()} | {"norm": norm})
    return {key: statistics.fmean(r[key] for r in reports) for key in reports[0]}


def both_sides(values, border):
    return min(values) < border < max(values)


def digits(value, count):
    if isinstance(value, list):
        return [digits(v, count) for v in value]
    return float(f"%.{count}g" % value)


def make(name):
    config = BASE | VARIANTS[name]
    choice = random.Random(f"{SEED} {name}")
    given = agent.random_parameters(choice, config)
    acting = {key: torch.tensor(value) + 0.15 * torch.tensor(agent.gaussian(choice, *numpy.shape(value)))
              for key, value in given.items()}
    if "attention.focus" in given:
        acting["attention.focus"] = torch.tensor(given["attention.focus"])
    with torch.no_grad():
        rollout = collect(acting, config, choice)
    rollout["advantage"] = [
        ppo.lane_advantages(*lane, PPO["discount"], PPO["gae_lambda"])
        for lane in zip(rollout["reward"], rollout["value"], rollout["ended"], rollout["next_value"])]

    p = {key: torch.tensor(value, requires_grad=key != "attention.focus")
         for key, value in given.items()}
    groups = [[leaf for key, leaf in p.items() if key.startswith("task.") == of_task]
              for of_task in (False, True)]
    optimizer = torch.optim.Adam([{"params": g} for g in groups if g], betas=(0.9, 0.999), eps=1e-5)
    shuffler, facts, reports = numpy.random.default_rng(SEED), {"deviation": [], "norm": []}, []
    for rates in RATES:
        for group, rate in zip(optimizer.param_groups, ("learning_rate", "task_learning_rate")):
            group["lr"] = rates[rate]
        reports.append(update(p, config, rollout, rates, optimizer, GRADIENT_NORM[name], shuffler,
                              facts))
    # What it is to exercise: floor, bound and clip each on both sides.
    assert both_sides(facts["deviation"], PPO["advantage_floor"])
    assert both_sides(facts["norm"], GRADIENT_NORM[name])
    assert all(0.05 < r["clipped"] < 0.9 for r in reports)

    for lane in rollout["frames"]:
        for frame in lane:
            frame.pop("image")
    for start in (s for chunk in rollout["starts"] for s in chunk):
        start.update({key: digits(value, 9) for key, value in start.items()})
    # Nine digits tell every number of single precision.
    for key in ("log_prob", "value", "reward", "advantage", "next_value"):
        rollout[key] = digits(rollout[key], 9)
    return {"torch": torch.__version__, "python": sys.version.split()[0], "seed": SEED,
            "config": config, "ppo": PPO | {"lanes": LANES, "steps": STEPS, "chunk": CHUNK,
                                            "epochs": EPOCHS, "minibatches": MINIBATCHES,
                                            "gradient_norm": GRADIENT_NORM[name]},
            "rates": RATES, "missions": MISSIONS, "sub_task_of": SUB_TASK_OF, "rollout": rollout,
            "parameters": given, "reports": [{k: digits(v, 12) for k, v in r.items()} for r in reports],
            "changes": {key: digits((leaf.detach() - torch.tensor(given[key])).tolist(), 9)
                        for key, leaf in p.items()}}


def main():
    torch.set_default_dtype(torch.float64)
    folder = pathlib.Path(sys.argv[1])
    for name in VARIANTS:
        entries = ",\n".join(f"{json.dumps(key)}:{json.dumps(value, separators=(',', ':'))}"
                             for key, value in make(name).items())
        (folder / f"update_{name}.json").write_text("{" + entries + "}\n")


if __name__ == "__main__":
    main()
