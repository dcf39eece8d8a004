#!/usr/bin/env python3
"""Records traces of the reference simulator as JSON Lines; docs/formats.md describes the records.

One stream of episodes a seed: the first reset is seeded, the others continue the random stream.
"""
import argparse
import contextlib
import io
import json
import os
import platform
import sys
import warnings
import zlib


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--env", required=True,
                        help="ids, separated by commas; BabyAI, MiniGrid or Wordgaze for all of a kind")
    parser.add_argument("--seeds", default="0:4", help="A:B, the seeds A to B - 1")
    parser.add_argument("--seed-list", help="seeds of any size, instead of --seeds")
    parser.add_argument("--steps", type=int, default=100, help="for each seed")
    parser.add_argument("--more-resets", type=int, default=0, help="behind the steps of each seed")
    parser.add_argument("--policy", choices=["random", "bot", "mixed"], default="random",
                        help="mixed: the bot for even seeds")
    parser.add_argument("--policy-seed", type=int, default=0)
    parser.add_argument("--done-actions", action="store_true", help="the reference's done mode")
    parser.add_argument("--enum-actions", action="store_true",
                        help="pass actions as members of the enum")
    parser.add_argument("--compact", action="store_true",
                        help="checksums instead of images and grids, no instructions")
    parser.add_argument("--out", default="-", help="file, or - for standard output")
    return parser.parse_args()


ARGS = parse_arguments()
# The reference reads this when it is imported.
os.environ.pop("BABYAI_DONE_ACTIONS", None)
if ARGS.done_actions:
    os.environ["BABYAI_DONE_ACTIONS"] = "1"
warnings.filterwarnings("ignore")

import gymnasium as gym  # noqa: E402
import minigrid  # noqa: E402
import numpy  # noqa: E402

import policy as policies  # noqa: E402
import wordgaze_tasks  # noqa: E402

gym.logger.min_level = gym.logger.ERROR
WORDGAZE_IDS = [f"Wordgaze-{count}-N{size}-K{objects}{auto}-v0"
                for counts, sizes in ((("One", "Two"), ((5, 2), (8, 4), (8, 12), (12, 8))),
                                      (("Three", "Four"), ((5, 4),)), (("Six", "Eight"), ((8, 8),)))
                for count in counts for size, objects in sizes for auto in ("", "-auto")]


def quietly(function, *args, **kwargs):
    """The reference prints a line for each rejected layout."""
    with contextlib.redirect_stdout(io.StringIO()):
        return function(*args, **kwargs)


def ints(values):
    return [int(v) for v in values]


def object_record(o):
    return None if o is None else [o.type, o.color, object_record(getattr(o, "contains", None))]


def description_record(d):
    return {"type": d.type, "color": d.color, "loc": d.loc, "n": len(d.obj_set),
            "poss": [ints(p) for p in d.obj_poss]}


def instruction_record(instruction):
    if instruction is None:
        return None
    record = {"k": type(instruction).__name__.removesuffix("Instr")}
    if hasattr(instruction, "strict"):
        record["strict"] = bool(instruction.strict)
    if hasattr(instruction, "instr_a"):
        record["a"] = instruction_record(instruction.instr_a)
        record["b"] = instruction_record(instruction.instr_b)
    elif hasattr(instruction, "desc_move"):
        record["move"] = description_record(instruction.desc_move)
        record["fixed"] = description_record(instruction.desc_fixed)
    else:
        record["desc"] = description_record(instruction.desc)
    return record


class Stream:
    """The episodes of one seed."""

    def __init__(self, env, env_id, seed, write):
        self.env, self.world, self.id, self.seed, self.write = env, env.unwrapped, env_id, seed, write
        self.episode = 0
        declares = ARGS.done_actions or hasattr(self.world, "declare")
        self.policy = policies.make(ARGS.policy, env_id, seed, ARGS.policy_seed, declares)

    def run(self):
        self.reset(self.seed)
        for _ in range(ARGS.steps):
            if self.step():
                self.episode += 1
                self.reset(None)
        for _ in range(ARGS.more_resets):
            self.episode += 1
            self.reset(None)

    def image(self, observation):
        image = observation["image"].tobytes()
        return {"image_crc": zlib.crc32(image)} if ARGS.compact else {"image": image.hex()}

    def reset(self, seed):
        observation, _ = quietly(self.env.reset, seed=seed)
        w = self.world
        cells = w.grid.encode().tobytes()
        random_state = w.np_random.bit_generator.state
        contents = []
        for x in range(w.width):
            for y in range(w.height):
                inside = getattr(w.grid.get(x, y), "contains", None)
                if inside is not None:
                    contents.append([x, y, object_record(inside)])
        record = {"t": "reset", "env": self.id,
                  # Larger integers than JSON's readers take are written as digits.
                  "seed": str(seed) if seed is not None and seed >= 2**64 else seed,
                  "chain": self.seed if self.seed < 2**64 else str(self.seed), "ep": self.episode,
                  "mission": observation["mission"], "width": w.width, "height": w.height,
                  "agent_pos": ints(w.agent_pos), "agent_dir": int(w.agent_dir),
                  "max_steps": int(w.max_steps)}
        record |= {"grid_crc": zlib.crc32(cells)} if ARGS.compact else {"grid": cells.hex()}
        record |= {"carrying": object_record(w.carrying)} | self.image(observation)
        record |= {"direction": int(observation["direction"]), "contents": contents}
        if not ARGS.compact:
            record["instr"] = instruction_record(getattr(w, "instrs", None))
        record |= {"rng": {"state": "%032x" % random_state["state"]["state"],
                           "inc": "%032x" % random_state["state"]["inc"],
                           "has32": int(random_state["has_uint32"]),
                           "buf32": int(random_state["uinteger"])},
                   "done_actions": ARGS.done_actions, "n_actions": int(w.action_space.n),
                   "see_through": bool(w.see_through_walls), "view": int(w.agent_view_size)}
        self.write(record)
        self.policy.reset(w)

    def step(self):
        w = self.world
        action = self.policy(w)
        observation, reward, terminated, truncated, _ = quietly(
            self.env.step, w.actions(action) if ARGS.enum_actions else action)
        record = {"t": "step", "a": action} | self.image(observation)
        record |= {"direction": int(observation["direction"]), "r": float(reward),
                   "term": bool(terminated), "trunc": bool(truncated),
                   "agent_pos": ints(w.agent_pos), "carrying": object_record(w.carrying),
                   "crc": zlib.crc32(w.grid.encode().tobytes())}
        if hasattr(w, "completion"):
            record["c"] = w.completion
        self.write(record)
        return terminated or truncated


def selected_ids():
    if ARGS.env == "Wordgaze":
        return WORDGAZE_IDS
    if ARGS.env in ("BabyAI", "MiniGrid"):
        # The patterns of the WFC levels are missing from the package.
        return [i for i in gym.registry if i.startswith(ARGS.env + "-") and "WFC" not in i]
    return ARGS.env.split(",")


def main():
    if ARGS.seed_list:
        seeds = [int(s) for s in ARGS.seed_list.split(",")]
    else:
        first, end = ARGS.seeds.split(":")
        seeds = range(int(first), int(end))
    out = sys.stdout if ARGS.out == "-" else open(ARGS.out, "w", encoding="ascii")
    real_out = out  # quietly() redirects sys.stdout

    def write(record):
        real_out.write(json.dumps(record, separators=(",", ":")) + "\n")

    write({"t": "meta", "minigrid": minigrid.__version__, "gymnasium": gym.__version__,
           "numpy": numpy.__version__, "python": platform.python_version(),
           "policy": ARGS.policy, "policy_seed": ARGS.policy_seed, "steps": ARGS.steps,
           "seeds": [str(s) for s in seeds] if ARGS.seed_list else [seeds.start, seeds.stop],
           "done_actions": ARGS.done_actions, "enum_actions": ARGS.enum_actions})
    for env_id in selected_ids():
        env = wordgaze_tasks.make(env_id) or gym.make(env_id, disable_env_checker=True)
        for seed in seeds:
            Stream(env, env_id, seed, write).run()
        env.close()
    if out is not sys.stdout:
        out.close()


if __name__ == "__main__":
    main()
