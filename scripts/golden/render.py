#!/usr/bin/env python3
"""Checksums (CRC-32 of the bytes) of what the reference renders.

tiles   one line a tile: type color state agent highlight size checksum (agent -1: none)
frames  one line a frame: id seed actions, then the checksums of the whole grid with 8 and 32 pixels
        a tile, the grid without highlight, the agent's view with 8 and 32 pixels
"""
import argparse
import contextlib
import io
import random
import warnings
import zlib

warnings.filterwarnings("ignore")

import gymnasium as gym  # noqa: E402
import minigrid  # noqa: E402
import numpy  # noqa: E402
from minigrid.core.constants import COLOR_NAMES  # noqa: E402
from minigrid.core.grid import Grid  # noqa: E402
from minigrid.core.world_object import Ball, Box, Door, Floor, Goal, Key, Lava, Wall  # noqa: E402

gym.logger.min_level = gym.logger.ERROR
TILE_SIZES = (5, 8, 32)


def crc(image):
    return zlib.crc32(image.astype(numpy.uint8).tobytes())


def tiles():
    walkable = [None, Goal(), Lava()] + [Floor(c) for c in COLOR_NAMES]
    walkable += [Door(c, is_open=True) for c in COLOR_NAMES]
    solid = [Wall()] + [kind(c) for kind in (Key, Ball, Box) for c in COLOR_NAMES]
    solid += [Door(c, is_locked=locked) for c in COLOR_NAMES for locked in (False, True)]
    looks = [(o, d) for o in walkable for d in (None, 0, 1, 2, 3)] + [(o, None) for o in solid]
    for size in TILE_SIZES:
        for thing, direction in looks:
            for highlight in (False, True):
                image = Grid.render_tile(thing, direction, highlight, size)
                code = (1, 0, 0) if thing is None else thing.encode()
                print(*code, -1 if direction is None else direction, int(highlight), size, crc(image))


def frames(per_id, first_seed, steps):
    ids = [i for i in gym.registry if i.startswith(("BabyAI-", "MiniGrid-")) and "WFC" not in i]
    for env_id in sorted(ids):
        with contextlib.redirect_stdout(io.StringIO()):  # it prints each rejected layout
            env = gym.make(env_id, disable_env_checker=True).unwrapped
        for seed in range(first_seed, first_seed + per_id):
            with contextlib.redirect_stdout(io.StringIO()):
                env.reset(seed=seed)
            draw = random.Random(f"{env_id} {seed}")
            actions = ""
            for _ in range(draw.randrange(steps)):
                # Half of the steps go on: turning on the spot shows little.
                action = draw.choice([2, draw.randrange(env.action_space.n)])
                actions += str(action)
                _, _, terminated, truncated, _ = env.step(action)
                if terminated or truncated:
                    break
            images = [env.get_frame(True, 8), env.get_frame(True, 32), env.get_frame(False, 8),
                      env.get_frame(True, 8, True), env.get_frame(True, 32, True)]
            print(env_id, seed, actions or "-", *map(crc, images))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=["tiles", "frames"])
    parser.add_argument("--per-id", type=int, default=1, help="frames of each environment")
    parser.add_argument("--seed", type=int, default=50, help="the first")
    parser.add_argument("--steps", type=int, default=40, help="fewer than this before the frame")
    arguments = parser.parse_args()
    print(f"# minigrid {minigrid.__version__} numpy {numpy.__version__}")
    if arguments.what == "tiles":
        tiles()
    else:
        frames(arguments.per_id, arguments.seed, arguments.steps)


main()
