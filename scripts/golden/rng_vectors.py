#!/usr/bin/env python3
"""Writes draws of numpy.random.Generator, as gymnasium seeds it, for test/core/rng_test.cpp.

Each case is a seed, the generator's state behind the seeding, and calls with their results; the flag
behind a result says whether half a 64-bit draw is left over.
"""
import json
import random

import numpy
from gymnasium.utils.seeding import np_random

SEEDS = [0, 1, 42, 2**32 - 1, 2**32, 2**32 + 5, 2**63, 2**64 - 1, 2**64, 2**64 + 7, 2**127 + 9,
         2**128, 2**130 + 3, 3**120]
WIDE = [2**31, 2**32 - 1, 2**32, 2**32 + 1, 3 * 2**30 + 1, 2**40, 3 * 2**61, 2**63 - 1]


def state(generator):
    s = generator.bit_generator.state
    return {"state": "%032x" % s["state"]["state"], "increment": "%032x" % s["state"]["inc"],
            "has_half": bool(s["has_uint32"]),
            "half": int(s["uinteger"]) if s["has_uint32"] else 0}


def call(generator, choice):
    kind = choice.choices(["integers", "wide", "uniform", "shuffle"], [12, 3, 2, 2])[0]
    if kind == "integers":
        low = choice.randrange(-5, 6)
        high = low + choice.choice([1, 2, 3, 4, 6, 7, 20])
        return ["integers", low, high, int(generator.integers(low, high))]
    if kind == "wide":
        high = choice.choice(WIDE)
        return ["integers", 0, high, int(generator.integers(0, high))]
    if kind == "uniform":
        return ["uniform", generator.uniform(0, 1).hex()]
    items = list(range(choice.randrange(0, 12)))
    generator.shuffle(items)
    return ["shuffle", items]


def case(seed):
    choice = random.Random(seed)
    generator, _ = np_random(seed)
    seeded = state(generator)
    calls = []
    for _ in range(60):
        result = call(generator, choice)
        calls.append(result + [int(generator.bit_generator.state["has_uint32"])])
    return {"seed": str(seed), "seeded": seeded, "calls": calls, "end": state(generator)}


def main():
    cases = [json.dumps(case(seed)) for seed in SEEDS]
    print('{"numpy": "%s", "cases": [' % numpy.__version__)
    print(",\n".join(cases))
    print("]}")


if __name__ == "__main__":
    main()
