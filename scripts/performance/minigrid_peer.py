#!/usr/bin/env python3
"""Python minigrid as `bench --sim` and `bench --reset` measure us: random actions, views, resets."""
import argparse
import contextlib
import os
import random

import gymnasium
import minigrid  # noqa: F401  registers the ids

import clock


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--env", required=True)
    parser.add_argument("--seconds", type=float, default=3)
    parser.add_argument("--reset", action="store_true", help="measure resets alone")
    options = parser.parse_args()
    env = gymnasium.make(options.env).unwrapped  # without gymnasium's wrappers: they only check
    env.reset(seed=1)
    actions = [random.randrange(7) for _ in range(4096)]

    def steps():
        for action in actions[:256]:
            _, _, terminated, truncated, _ = env.step(action)
            if terminated or truncated:
                env.reset()
        random.shuffle(actions)
        return 256

    def resets():
        for _ in range(16):
            env.reset()
        return 16

    unit, count_some = ("resets", resets) if options.reset else ("steps", steps)

    def quietly():  # it prints each layout that it rejects
        with contextlib.redirect_stdout(nowhere):
            return count_some()

    with open(os.devnull, "w") as nowhere:
        clock.run(unit, quietly, options.seconds)


if __name__ == "__main__":
    main()
