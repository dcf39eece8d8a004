#!/usr/bin/env python3
"""How many steps a CPU-second `wordgaze.make_vec` makes with random actions; the median of five."""
import argparse
import statistics
import time

import numpy

import wordgaze


def steps_a_second(envs, actions, seconds):
    begin, steps = time.process_time(), 0
    while time.process_time() - begin < seconds:
        for action in actions:
            envs.step(action)
        steps += len(actions) * envs.num_envs
    return steps / (time.process_time() - begin)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--level", default="BabyAI-GoToLocal-v0")
    parser.add_argument("--envs", type=int, default=256)
    parser.add_argument("--seconds", type=float, default=1)
    options = parser.parse_args()
    envs = wordgaze.make_vec(options.level, options.envs)
    envs.reset(seed=1)
    draw = numpy.random.default_rng(0)
    actions = draw.integers(envs.single_action_space.n, size=(64, options.envs))
    rates = [steps_a_second(envs, actions, options.seconds) for _ in range(5)]
    print(f"{options.level}, {options.envs} environments: {statistics.median(rates) / 1e6:.2f} million "
          f"steps a CPU-second ({min(rates) / 1e6:.2f} to {max(rates) / 1e6:.2f})")


if __name__ == "__main__":
    main()
