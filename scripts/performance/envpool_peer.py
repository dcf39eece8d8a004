#!/usr/bin/env python3
"""EnvPool as `bench --sim` measures us: random actions, views, resets; one thread."""
import argparse

import envpool
import numpy

import clock


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--env", required=True)
    parser.add_argument("--seconds", type=float, default=3)
    parser.add_argument("--envs", type=int, default=256)
    options = parser.parse_args()
    pool = envpool.make(options.env, env_type="gymnasium", num_envs=options.envs, num_threads=1,
                        seed=1)
    pool.reset()
    actions = numpy.random.default_rng(1).integers(0, 7, (1024, options.envs), dtype=numpy.int32)
    turn = 0

    def steps():
        nonlocal turn
        for _ in range(16):
            pool.step(actions[turn % len(actions)])  # an ended episode starts anew by itself
            turn += 1
        return 16 * options.envs

    clock.run("steps", steps, options.seconds)


if __name__ == "__main__":
    main()
