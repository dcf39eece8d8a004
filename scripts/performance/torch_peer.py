#!/usr/bin/env python3
"""Our network and recurrent PPO in PyTorch, measured as `bench --train` and `bench --act` measure us.

It is what one would write with PyTorch's own layers and autograd, with what costs nothing to write:
views become one-hot images once a frame, the encoder sees a whole minibatch at once, text is encoded
once a distinct mission. Its environment is free: views, missions, rewards and ends are replayed from
a trace that `trace` recorded, whatever it decides. Needs Debian's python3-torch.

  torch_peer.py train|act --config config.toml --trace trace.jsonl [--seconds S] [--threads T]
  torch_peer.py check test/data/model/attention_p2.json     that it computes what ours computes
  torch_peer.py about                                       versions, and the BLAS in use
"""
import argparse
import ctypes
import json
import math
import os
import pathlib
import re
import time
import tomllib

import torch
import torch.nn.functional as F
from torch import nn

import clock

TYPES, COLORS, STATES, CELLS, ACTIONS, VOCABULARY = 11, 6, 3, 49, 7, 55
FEATURES = TYPES + COLORS + STATES


class Network(nn.Module):
    def __init__(self, c):
        super().__init__()
        self.entropy_base, self.exponent = c["entropy_base"], c["gaze_exponent"]
        self.floor = c["gaze_floor"]
        relu, channels = nn.LeakyReLU(c["encoder_leak"]), c["channels"]
        if c.get("encoder", "1x1") == "3x3":
            self.encoder = nn.Sequential(nn.Conv2d(FEATURES, channels, 3, padding=1), relu,
                                         nn.Conv2d(channels, channels, 3, padding=1), relu)
        else:
            self.encoder = nn.Sequential(nn.Conv2d(FEATURES, channels, 1), relu)
        self.words = nn.Embedding(VOCABULARY, c["word_size"], padding_idx=0)
        self.query = nn.Linear(c["word_size"], c["key_size"], bias=False)
        self.key = nn.Linear(channels, c["key_size"], bias=False)
        self.memory = nn.LSTMCell(CELLS * channels, c["memory_size"])
        self.text = nn.GRU(c["word_size"], c["text_size"], batch_first=True)
        self.actor, self.critic = (
            nn.Sequential(nn.Linear(c["memory_size"] + c["text_size"], c["head_size"]), nn.Tanh(),
                          nn.Linear(c["head_size"], outputs)) for outputs in (ACTIONS, 1))

    def encode_text(self, missions):
        """[M, L] word ids, 0 behind the end -> queries [M, L, d], what is a word [M, L], text [M, G]."""
        words = self.words(missions)
        states, _ = self.text(words)
        is_word = missions > 0
        last = is_word.sum(1) - 1
        return self.query(words), is_word, states[torch.arange(len(missions)), last]

    def filter_view(self, images, queries, is_word):
        """[N, 20, 7, 7], [N, L, d], [N, L] -> the filtered view [N, C * 49]."""
        view = self.encoder(images).flatten(2)
        keys = self.key(view.transpose(1, 2))
        scores = queries @ keys.transpose(1, 2) / math.sqrt(keys.shape[-1])
        log_maps = scores.log_softmax(2)
        maps = log_maps.exp()
        entropy = -(maps * log_maps).sum(2) / math.log(self.entropy_base)
        weights = (-entropy).masked_fill(~is_word, -math.inf).softmax(1)
        gaze = (weights[:, None] @ maps)[:, 0]
        scale = (gaze / (gaze.max(1, keepdim=True).values + 1e-6)) ** self.exponent
        scale = self.floor + (1 - self.floor) * scale
        return (view * scale[:, None]).flatten(1)

    def forward(self, images, mission_of, text, keep, memory):
        """[T * B, ...] frames, step by step from `memory`; logits, values, and the last memory."""
        queries, is_word, features = text
        inputs = self.filter_view(images, queries[mission_of], is_word[mission_of])
        hidden = []
        steps = zip(inputs.view(-1, len(memory[0]), inputs.shape[1]), keep.view(-1, len(memory[0]), 1))
        for x, alive in steps:
            memory = self.memory(x, (memory[0] * alive, memory[1] * alive))
            hidden.append(memory[0])
        x = torch.cat([torch.cat(hidden), features[mission_of]], 1)
        return self.actor(x), self.critic(x)[:, 0], memory


ONE_HOT = torch.zeros(TYPES * COLORS * STATES, FEATURES)
for code in range(len(ONE_HOT)):
    for entry in (code // (COLORS * STATES), TYPES + code // STATES % COLORS,
                  TYPES + COLORS + code % STATES):
        ONE_HOT[code, entry] = 1


def one_hot(images):
    """[N, 49, 3] bytes -> [N, 20, 7, 7]."""
    codes = images.long() @ torch.tensor([COLORS * STATES, STATES, 1])
    return ONE_HOT[codes].transpose(1, 2).reshape(-1, FEATURES, 7, 7)


class Replay:
    """The lanes of a recorded trace, [steps + 1, lanes] of what precedes each step and follows it."""

    def __init__(self, path, steps, lanes):
        self.images = torch.zeros(steps + 1, lanes, CELLS, 3, dtype=torch.uint8)
        self.mission_of = torch.zeros(steps + 1, lanes, dtype=torch.long)
        self.keep = torch.ones(steps + 1, lanes)
        self.reward, self.ended = torch.zeros(steps, lanes), torch.zeros(steps, lanes)
        words, missions, lane, t = {}, [], -1, 0
        with open(path) as lines:
            for record in map(json.loads, lines):
                if record["t"] == "reset":
                    if record["ep"] == 0:
                        lane, t = lane + 1, 0
                    mission = [words.setdefault(w, len(words) + 1) for w in record["mission"].split()]
                    if mission not in missions:
                        missions.append(mission)
                    self.keep[t, lane] = 0
                elif record["t"] == "step":
                    self.reward[t, lane] = record["r"]
                    self.ended[t, lane] = record["term"] or record["trunc"]
                    t += 1
                if "image" in record:
                    image = torch.frombuffer(bytearray.fromhex(record["image"]), dtype=torch.uint8)
                    self.images[t, lane] = image.view(CELLS, 3)
                    self.mission_of[t, lane] = missions.index(mission)
        self.missions = nn.utils.rnn.pad_sequence([torch.tensor(m) for m in missions], True)


def train(config, replay, seconds):
    ppo = config["ppo"]
    steps, lanes = ppo["steps"], ppo["lanes"]
    net = Network(config["model"])
    optimizer = torch.optim.Adam(net.parameters(), lr=ppo["learning_rate"], eps=1e-5)
    size = config["model"]["memory_size"]
    memory = torch.zeros(lanes, size), torch.zeros(lanes, size)

    def update():
        nonlocal memory
        start, images, actions, log_probs, values = memory, [], [], [], []
        with torch.no_grad():
            text = net.encode_text(replay.missions)
            for t in range(steps + 1):
                image = one_hot(replay.images[t])
                logits, value, after = net(image, replay.mission_of[t], text, replay.keep[t], memory)
                values.append(value)
                if t == steps:  # the value of what comes next; its memory waits for its step
                    break
                policy = torch.distributions.Categorical(logits=logits)
                action = policy.sample()
                images.append(image)
                actions.append(action)
                log_probs.append(policy.log_prob(action))
                memory = after
            advantages, advantage = torch.zeros(steps, lanes), torch.zeros(lanes)
            for t in reversed(range(steps)):
                going_on = 1 - replay.ended[t]
                delta = replay.reward[t] + ppo["discount"] * going_on * values[t + 1] - values[t]
                advantage = delta + ppo["discount"] * ppo["gae_lambda"] * going_on * advantage
                advantages[t] = advantage
            returns = advantages + torch.stack(values[:-1])
        images, actions, log_probs = map(torch.stack, (images, actions, log_probs))
        for _ in range(ppo["epochs"]):
            for part in torch.randperm(lanes).chunk(ppo["minibatches"]):
                def columns(x):
                    return x[:steps, part].flatten(0, 1)
                logits, value, _ = net(columns(images), columns(replay.mission_of),
                                       net.encode_text(replay.missions), columns(replay.keep),
                                       (start[0][part], start[1][part]))
                policy = torch.distributions.Categorical(logits=logits)
                ratio = (policy.log_prob(columns(actions)) - columns(log_probs)).exp()
                a = columns(advantages)
                a = (a - a.mean()) / a.std(unbiased=False).clamp(min=ppo["advantage_floor"])
                clipped = ratio.clamp(1 - ppo["clip"], 1 + ppo["clip"])
                loss = (-torch.min(ratio * a, clipped * a).mean()
                        + ppo["value_coefficient"] * F.mse_loss(value, columns(returns))
                        - ppo["entropy_start"] * policy.entropy().mean())
                optimizer.zero_grad()
                loss.backward()
                nn.utils.clip_grad_norm_(net.parameters(), ppo["gradient_norm"])
                optimizer.step()
        return steps * lanes

    update()
    clock.run("frames", update, seconds)


def act(config, replay, seconds):
    """One lane after the other; a decision begins with the bytes of a view and ends with an action."""
    net = Network(config["model"])
    size = config["model"]["memory_size"]
    micros = []
    cpu, wall = time.process_time(), time.perf_counter()
    with torch.inference_mode():
        text = net.encode_text(replay.missions)
        memory = torch.zeros(1, size), torch.zeros(1, size)
        while time.perf_counter() - wall < seconds:
            t, lane = divmod(len(micros), replay.keep.shape[1])
            t %= len(replay.keep)
            begin = time.perf_counter()
            logits, _, memory = net(one_hot(replay.images[t, lane:lane + 1]),
                                    replay.mission_of[t, lane:lane + 1], text,
                                    replay.keep[t, lane:lane + 1], memory)
            int(torch.multinomial(logits.softmax(1), 1))
            micros.append(1e6 * (time.perf_counter() - begin))
    cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
    micros.sort()
    print(json.dumps({"decisions": len(micros), "median_us": micros[len(micros) // 2],
                      "p99_us": micros[len(micros) * 99 // 100], "cpu_seconds": cpu,
                      "wall_seconds": wall}))


def check(path):
    """Logits and values of our reference data, whose LSTM takes the view cell by cell."""
    with open(path) as file:
        data = json.load(file)
    torch.set_default_dtype(torch.float64)
    global ONE_HOT
    ONE_HOT = ONE_HOT.double()
    c, p = data["config"], {k: torch.tensor(v) for k, v in data["parameters"].items()}
    net = Network(c)
    by_channel = p["memory.input_weight"].view(-1, CELLS, c["channels"]).transpose(1, 2).flatten(1)
    candidate = F.pad(p["text.candidate_bias"], (2 * c["text_size"], 0))
    if c["encoder"] == "3x3":  # a block of columns a tap
        values = {f"encoder.{2 * k}.{leaf}": p[f"patches.{layer}.{leaf}"]
                  for k, layer in enumerate(("first", "second")) for leaf in ("weight", "bias")}
        for k in (0, 2):
            taps = values[f"encoder.{k}.weight"].view(c["channels"], 3, 3, -1)
            values[f"encoder.{k}.weight"] = taps.permute(0, 3, 1, 2)
    else:
        values = {"encoder.0.weight": p["visual.weight"][:, :, None, None],
                  "encoder.0.bias": p["visual.bias"]}
    values |= {"words.weight": p["words"].T,
              "query.weight": p["attention.query"], "key.weight": p["attention.key"],
              "memory.weight_ih": by_channel, "memory.weight_hh": p["memory.hidden_weight"],
              "memory.bias_ih": p["memory.bias"], "memory.bias_hh": 0 * p["memory.bias"],
              "text.weight_ih_l0": p["text.input_weight"],
              "text.weight_hh_l0": p["text.hidden_weight"], "text.bias_ih_l0": p["text.bias"],
              "text.bias_hh_l0": candidate}
    for head in ("actor", "critic"):
        for layer, name in (("0", "hidden"), ("2", "output")):
            for leaf in ("weight", "bias"):
                values[f"{head}.{layer}.{leaf}"] = p[f"{head}.{name}.{leaf}"]
    net.load_state_dict(values)
    frames = data["frames"]
    missions = nn.utils.rnn.pad_sequence([torch.tensor(m) for m in data["missions"]], True)
    logits, value, _ = net(
        one_hot(torch.tensor([f["image"] for f in frames], dtype=torch.uint8)),
        torch.tensor([f["mission"] for f in frames]), net.encode_text(missions),
        torch.tensor([float(f["keep"]) for f in frames]),
        tuple(torch.tensor(data["start"][k]) for k in "hc"))
    ours = [torch.tensor([r[k] for r in data["results"]]) for k in ("logits", "value")]
    error = max((logits - ours[0]).abs().max(), (value - ours[1]).abs().max()).item()
    print(f"largest difference of logits and values: {error:.1e}")
    if error > 1e-9:
        raise SystemExit("torch_peer.py: this is not the network of the reference data")


def about():
    """Versions, and the BLAS that a product has loaded."""
    torch.randn(64, 64) @ torch.randn(64, 64)
    with open("/proc/self/maps") as maps:
        loaded = set(re.findall(r"/\S*blas\S*", maps.read()))
    library = next((p for p in loaded if "openblasp" in p or "openblas." in p), min(loaded, default=""))
    kernel = "unknown"
    if "openblas" in library:
        corename = ctypes.CDLL(library).openblas_get_corename
        corename.restype = ctypes.c_char_p
        kernel = corename().decode()
    print(json.dumps({"torch": torch.__version__, "blas": pathlib.Path(library).name,
                      "kernel": kernel, "OPENBLAS_CORETYPE": os.environ.get("OPENBLAS_CORETYPE"),
                      "onednn": torch.backends.mkldnn.is_available()}))


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    for name in ("train", "act"):
        command = commands.add_parser(name)
        command.add_argument("--config", required=True, help="with every setting, as `train` writes it")
        command.add_argument("--trace", required=True)
        command.add_argument("--seconds", type=float, default=3)
        command.add_argument("--threads", type=int, default=1)
    commands.add_parser("check").add_argument("data")
    commands.add_parser("about")
    options = parser.parse_args()
    if options.command == "check":
        check(options.data)
        return
    if options.command == "about":
        about()
        return
    torch.set_num_threads(options.threads)
    torch.manual_seed(1)
    with open(options.config, "rb") as file:
        config = tomllib.load(file)
    replay = Replay(options.trace, config["ppo"]["steps"], config["ppo"]["lanes"])
    {"train": train, "act": act}[options.command](config, replay, options.seconds)


if __name__ == "__main__":
    main()
