#!/usr/bin/env python3
"""Writes test/data/model/*.json for test/model/reference_test.cpp: the agent once more, in PyTorch.

It follows docs/math.md, not the C++: cells are one-hot images under a convolution, each word has a map
of all 49 cells, PyTorch has its own LSTM and GRU, and the gradients are its autograd's. Nothing is
shared between equal cells, equal words or equal missions. Needs Debian's python3-torch.
"""
import json
import math
import pathlib
import random
import sys

import torch
import torch.nn.functional as F

SEED = 20260102
TYPES, COLORS, STATES, VIEW, ACTIONS, VOCABULARY = 11, 6, 3, 7, 7, 55
FEATURES, TAPS = TYPES + COLORS + STATES, 9
SIZES = {"channels": 3, "word_size": 4, "key_size": 3, "memory_size": 3, "text_size": 3,
         "head_size": 4, "task_size": 5, "task_words": 13, "clauses": 2}
VARIANTS = {
    "baseline": {"attention": False, "encoder_leak": 0},
    "attention_p1": {"attention": True, "gaze_exponent": 1, "entropy_base": math.e},
    "attention_p2": {"attention": True, "gaze_exponent": 2, "gaze_floor": 0.1,
                     "entropy_base": 49},
    "task_attention": {"attention": True, "task_attention": True, "gaze_exponent": 2,
                       "entropy_base": 49},
    "attention_3x3": {"attention": True, "encoder": "3x3"},
    "product": {"attention": True, "gaze": "product", "gaze_floor": 0.1, "entropy_base": math.e},
    "product_focused": {"attention": True, "gaze": "product", "gaze_floor": 0.2, "focus": 1,
                        "entropy_base": 3},
    "product_task_sum": {"attention": True, "gaze": "product", "gaze_floor": 0.1,
                         "task_attention": True},
    "product_task_scan": {"attention": True, "gaze": "product", "gaze_floor": 0.1,
                          "task_attention": True, "task_reader": "scan", "score_cost": 0.02},
    "baseline_3x3": {"attention": False, "encoder": "3x3"},
}
# Ids of the vocabulary: "go to the red ball", "pick up the blue key, then go to the grey box".
MISSIONS = [[18, 47, 45, 40, 7], [36, 50, 45, 9, 24, 1, 46, 18, 47, 45, 21, 10]]
STEPS, LANES = 3, 2
# What can lie in a cell of a room without doors.
OBJECTS = [(kind, color, 0) for kind in range(5, 8) for color in range(COLORS)]
LONGEST = 73  # words, of the mask of a reader that scans


def gaussian(choice, *shape, scale=0.6):
    """Three decimals: short in the file, the same double on both sides."""
    if not shape:
        return round(choice.gauss(0, scale), 3)
    return [gaussian(choice, *shape[1:], scale=scale) for _ in range(shape[0])]


def random_parameters(choice, config):
    c, e, d, h = (config[k] for k in ("channels", "word_size", "key_size", "memory_size"))
    g, hidden, task = config["text_size"], config["head_size"], config["task_size"]
    if config["encoder"] == "3x3":  # a block of columns a tap, taps row by row
        shapes = {"patches.first.weight": (c, TAPS * FEATURES), "patches.first.bias": (c,),
                  "patches.second.weight": (c, TAPS * c), "patches.second.bias": (c,)}
    else:
        shapes = {"visual.weight": (c, FEATURES), "visual.bias": (c,)}
    shapes |= {"words": (e, VOCABULARY)}
    if config.get("completion_input"):
        shapes |= {"completion": (4 * h, config["clauses"])}
    if config["attention"]:
        shapes |= {"attention.query": (d, e), "attention.key": (d, c)}
        if config["gaze"] == "product":
            shapes |= {"attention.silent": (c,), "attention.words": (1, VOCABULARY),
                       "attention.focus": (1,)}
    shapes |= {"memory.input_weight": (4 * h, VIEW * VIEW * c), "memory.hidden_weight": (4 * h, h),
               "memory.bias": (4 * h,), "text.input_weight": (3 * g, e),
               "text.hidden_weight": (3 * g, g), "text.bias": (3 * g,), "text.candidate_bias": (g,)}
    if config["task_attention"] and config["task_reader"] == "scan":
        shapes |= {"task.scan.words": (4, VOCABULARY), "task.scan.rules": (3,)}
    elif config["task_attention"]:
        shapes |= {"task.hidden.weight": (task, e + config["clauses"]), "task.hidden.bias": (task,),
                   "task.output.weight": (config["task_words"], task),
                   "task.output.bias": (config["task_words"],)}
    for head, outputs in (("actor", ACTIONS), ("critic", 1)):
        shapes |= {f"{head}.hidden.weight": (hidden, h + g), f"{head}.hidden.bias": (hidden,),
                   f"{head}.output.weight": (outputs, hidden), f"{head}.output.bias": (outputs,)}
    # Large scores: maps that differ, and word weights with them.
    parameters = {name: gaussian(choice, *shape, scale=1.6 if name.startswith("attention") else 0.6)
                  for name, shape in shapes.items()}
    if "attention.focus" in parameters:
        parameters["attention.focus"] = [float(config["focus"])]
    return parameters


def random_frame(choice, config, step, lane):
    """One observation: mostly empty cells, walls and unseen ones, as in a room."""
    common = [(1, 0, 0), (2, 5, 0), (0, 0, 0)]
    image = [choice.choice(common) if choice.random() < 0.8 else
             (choice.randrange(5, 8), choice.randrange(COLORS), 0) for _ in range(VIEW * VIEW)]
    return {"image": image, "mission": (step + lane) % len(MISSIONS),
            "keep": 0 if (step, lane) == (1, 1) else 1,
            "completion": [choice.randrange(2) for _ in range(config["clauses"])]}


def one_hot(image):
    """[1, 20, 7, 7]"""
    hot = torch.zeros(FEATURES, VIEW * VIEW)
    for cell, (kind, color, state) in enumerate(image):
        hot[kind, cell] = hot[TYPES + color, cell] = hot[TYPES + COLORS + state, cell] = 1
    return hot.view(1, -1, VIEW, VIEW)


def encode_view(p, config, image):
    """O~ [C, 49]"""
    view, leak = one_hot(image), config["encoder_leak"]
    if config["encoder"] == "3x3":
        for layer in ("patches.first", "patches.second"):
            weight, bias = p[f"{layer}.weight"], p[f"{layer}.bias"]
            kernels = weight.view(len(bias), 3, 3, -1).permute(0, 3, 1, 2)
            view = F.leaky_relu(F.conv2d(view, kernels, bias, padding=1), leak)
    else:
        kernels = p["visual.weight"][:, :, None, None]
        view = F.leaky_relu(F.conv2d(view, kernels, p["visual.bias"]), leak)
    return view.flatten(2)[0]


def encode_text(p, mission, mask):
    """The state of the GRU, changed by each word as far as it is bright."""
    size = len(p["text.candidate_bias"])
    h = torch.zeros(1, size)
    bias = torch.cat([torch.zeros(2 * size), p["text.candidate_bias"]])
    for word, bright in zip(F.embedding(torch.tensor(mission), p["words"].T), mask):
        read = torch.gru_cell(word[None], h, p["text.input_weight"], p["text.hidden_weight"],
                              p["text.bias"], bias)
        h = h + bright * (read - h)
    return h[0]


def look_of_objects(p, config):
    """O~ of each object [C, objects]"""
    objects = config.get("objects", OBJECTS)
    return torch.cat([encode_view(p, config, [code] * VIEW * VIEW)[:, :1] for code in objects], dim=1)


def effects_of(p, config):
    """What each word of the vocabulary says of the type and of the color of each object, two of
    [objects, V]: the mean over the objects that share it, less the mean over all."""
    objects, codes = config.get("objects", OBJECTS), look_of_objects(p, config)
    queries = p["attention.query"] @ p["words"]
    raw = (p["attention.key"] @ codes).T @ queries / math.sqrt(config["key_size"])
    alike = [torch.tensor([[float(a[k] == b[k]) for b in objects] for a in objects], dtype=raw.dtype)
             for k in (0, 1)]
    return [a @ raw / a.sum(1, keepdim=True) - raw.mean(0) for a in alike]


def geometric(start, end, focus):
    return start * (end / start) ** focus


def say(p, config):
    """What each word of the vocabulary says of each object [objects, V], and the scores of nowhere [V]."""
    types, colors = effects_of(p, config)
    slope = geometric(config["word_choice_start"], config["word_choice"], config["focus"])
    of_type = torch.sigmoid(slope * p["attention.words"][0])
    said = of_type * types + (1 - of_type) * colors
    return said, config["nowhere"] * said.max(0).values


def look(p, config, image, view, mission):
    """Log maps [words, 50] over cells and nowhere, and what the silent word says of them [50]."""
    objects = config.get("objects", OBJECTS)
    said, nowhere = say(p, config)
    scores = torch.zeros(len(mission), VIEW * VIEW + 1)
    for i, word in enumerate(mission):
        for cell, code in enumerate(image):
            if tuple(code) in objects:
                scores[i, cell] = said[objects.index(tuple(code)), word]
        scores[i, -1] = nowhere[word]
    beta = geometric(config["sharpness_start"], config["sharpness"], config["focus"])
    silent = p["attention.silent"] @ torch.cat([view, look_of_objects(p, config).mean(1, True)], dim=1)
    return torch.log_softmax(beta * scores, dim=1), silent


def scan(p, mission, completion):
    """Logits of the mask, word by word in both directions."""
    gates = p["task.scan.words"][:, mission]
    move, wait, turn = gates[:3].sigmoid()
    places = torch.eye(len(completion) + 1)[0]
    undone, held = [], []
    before = waits = torch.zeros(())
    for j in range(len(mission)):
        shifted = torch.cat([torch.zeros(1), places[:-1]])
        places = places + move[j] * (shifted - places)
        left = undone[-1] if undone else torch.zeros(())
        before = (1 - turn[j]) * (1 - (1 - before) * (1 - move[j] * left))
        waits = (1 - turn[j]) * (waits + wait[j] * (before - waits))
        undone.append(1 - places[:-1] @ torch.tensor(completion, dtype=torch.float64))
        held.append(waits)
    turned, behind, first = torch.zeros(()), torch.zeros(()), []
    for j in reversed(range(len(mission))):
        first.insert(0, turned)
        behind = 1 - (1 - behind) * (1 - undone[j])
        turned = 1 - (1 - turned) * (1 - turn[j] * behind)
    facts = torch.stack([1 - torch.stack(undone), torch.stack(held), torch.stack(first)])
    return gates[3] - p["task.scan.rules"] @ facts


def filter_view(p, config, image, view, mission, completion):
    """The filtered view F [C, 49], and what made it; view is O~ [C, 49]."""
    if not config["attention"]:
        return view, {}
    product = config["gaze"] == "product"
    words = F.embedding(torch.tensor(mission), p["words"].T)
    queries = F.linear(words, p["attention.query"])
    keys = F.linear(view.T, p["attention.key"])
    logs = torch.log_softmax(queries @ keys.T / math.sqrt(config["key_size"]), dim=1)
    if product:
        logs, silent = look(p, config, image, view, mission)
    maps = logs.exp()
    entropy = -(maps * logs).sum(1) / math.log(config["entropy_base"])
    weights = torch.softmax(-entropy, dim=0)
    seen = {"maps": maps[:, :VIEW * VIEW], "entropy": entropy, "weights": weights}
    if config["task_attention"] and config["task_reader"] == "scan":
        logits = scan(p, mission, completion)
        seen["alpha"] = logits.sigmoid()
        # Behind the end of the mission nothing is asked.
        seen["mask_logits"] = torch.cat([logits, torch.zeros(LONGEST - len(mission))])
    elif config["task_attention"]:
        x = torch.cat([weights @ words, torch.tensor(completion, dtype=torch.float64)])
        x = F.linear(x, p["task.hidden.weight"], p["task.hidden.bias"]).relu()
        seen["mask_logits"] = F.linear(x, p["task.output.weight"], p["task.output.bias"])
        seen["alpha"] = seen["mask_logits"].sigmoid()[:len(mission)]
    if config["task_attention"]:
        weights = seen["alpha"] * weights
    floor = config["gaze_floor"]
    if product:
        gaze = torch.softmax(weights @ logs / (weights.sum() + 1e-6) + silent, dim=0)
        cells, nowhere = gaze[:-1], gaze[-1]
        scale = floor + (1 - floor) * cells / (cells + nowhere)
        return view * scale, seen | {"gaze": cells, "scale": scale}
    gaze = weights @ maps
    scale = floor + (1 - floor) * (gaze / (gaze.max() + 1e-6)) ** config["gaze_exponent"]
    return view * scale, seen | {"gaze": gaze, "scale": scale}


def head(p, name, x):
    x = F.linear(x, p[f"{name}.hidden.weight"], p[f"{name}.hidden.bias"]).tanh()
    return F.linear(x, p[f"{name}.output.weight"], p[f"{name}.output.bias"])


def run_lane(p, config, frames, h, c, missions=MISSIONS):
    """Frames of one lane in turn, from the memory (h, c)."""
    for frame in frames:
        h, c = h * frame["keep"], c * frame["keep"]
        mission = missions[frame["mission"]]
        told = torch.zeros_like(p["memory.bias"])  # of what is done, past the attention
        if config.get("completion_input"):
            told = p["completion"] @ torch.tensor(frame["completion"], dtype=told.dtype)
        view = encode_view(p, config, frame["image"])
        filtered, seen = filter_view(p, config, frame["image"], view, mission, frame["completion"])
        h, c = (s[0] for s in torch.lstm_cell(
            filtered.T.reshape(1, -1), (h[None], c[None]), p["memory.input_weight"],
            p["memory.hidden_weight"], p["memory.bias"], told))
        masked = config["task_attention"] and config["task_reader"] == "scan"
        mask = seen["alpha"] if masked else torch.ones(len(mission))
        features = torch.cat([h, encode_text(p, mission, mask)])
        yield {"logits": head(p, "actor", features), "value": head(p, "critic", features)[0],
               "h": h, "c": c} | seen


def score_price(p, config):
    """What all that words could say costs."""
    beta = geometric(config["sharpness_start"], config["sharpness"], config["focus"])
    price = geometric(config.get("score_cost_start", config["score_cost"]), config["score_cost"],
                      config["focus"])
    return price * beta ** 2 / 2 * sum(e.square().sum() for e in effects_of(p, config))


def numbers(value):
    """Nested lists with 13 digits."""
    if isinstance(value, torch.Tensor):
        value = value.tolist()
    if isinstance(value, list):
        return [numbers(v) for v in value]
    return float("%.13g" % value)


def make(name, variant):
    config = SIZES | {"task_attention": False, "gaze_exponent": 2, "gaze_floor": 0,
                      "entropy_base": 49, "encoder_leak": 0.1, "encoder": "1x1", "gaze": "sum",
                      "task_reader": "sum", "focus": 0.6, "sharpness_start": 1, "sharpness": 3,
                      "nowhere": 0.45, "word_choice_start": 0.5, "word_choice": 3,
                      "score_cost": 0} | variant
    choice = random.Random(f"{SEED} {name}")
    given = random_parameters(choice, config)
    frames = [random_frame(choice, config, t, b) for t in range(STEPS) for b in range(LANES)]
    start = {k: gaussian(choice, LANES, config["memory_size"]) for k in ("h", "c")}
    asked = {"logits": gaussian(choice, len(frames), ACTIONS), "value": gaussian(choice, len(frames))}
    if config["task_attention"]:
        words = LONGEST if config["task_reader"] == "scan" else config["task_words"]
        asked["mask_logits"] = gaussian(choice, len(frames), words)
        if config["task_reader"] == "scan":
            for row, frame in zip(asked["mask_logits"], frames):
                length = len(MISSIONS[frame["mission"]])
                row[length:] = [0] * (words - length)

    p = {key: torch.tensor(value, requires_grad=True) for key, value in given.items()}
    results = [None] * len(frames)  # time-major, like the frames
    for b in range(LANES):
        h, c = (torch.tensor(start[k][b]) for k in ("h", "c"))
        results[b::LANES] = run_lane(p, config, frames[b::LANES], h, c)
    loss = sum((torch.stack([r[key] for r in results]) * torch.tensor(weight)).sum()
               for key, weight in asked.items())
    if config["score_cost"] > 0:
        loss = loss + score_price(p, config)
    loss.backward()
    for r in results:
        r.pop("mask_logits", None)
    return {"torch": torch.__version__, "python": sys.version.split()[0], "seed": SEED,
            "config": config, "steps": STEPS, "lanes": LANES, "missions": MISSIONS,
            "parameters": given, "frames": frames, "start": start, "asked": asked,
            "loss": numbers(loss.item()),
            "results": [{k: numbers(v) for k, v in r.items()} for r in results],
            "gradients": {key: numbers(leaf.grad) for key, leaf in p.items()
                          if leaf.grad is not None}}


def main():
    torch.set_default_dtype(torch.float64)
    folder = pathlib.Path(sys.argv[1])
    for name, variant in VARIANTS.items():
        entries = ",\n".join(f"{json.dumps(key)}:{json.dumps(value, separators=(',', ':'))}"
                             for key, value in make(name, variant).items())
        (folder / f"{name}.json").write_text("{" + entries + "}\n")


if __name__ == "__main__":
    main()
