#!/usr/bin/env python3
"""Prints what the reference's bot does in one episode of each level and seed, one line each:

    id seed outcome actions

The outcome is success, failure, time_up, finished (the bot has nothing left to do, the episode goes
on), gave_up (it raised, or planned without end) or cut (by --steps). The actions are the letters of
LETTERS; a capital stands for what was done although the bot had said otherwise.
"""
import argparse
import contextlib
import io
import warnings

warnings.filterwarnings("ignore")

import gymnasium as gym  # noqa: E402
import minigrid  # noqa: E402, F401
from minigrid.core.actions import Actions  # noqa: E402
from minigrid.utils.baby_ai_bot import BabyAIBot  # noqa: E402

from policy import BOT_LOOKS, BoundedStack  # noqa: E402

LETTERS = "lrfpdtx"  # left, right, forward, pickup, drop, toggle, done
gym.logger.min_level = gym.logger.ERROR


def play(env, seed, meddle, steps):
    """The outcome of an episode, and the letters of its actions."""
    env.reset(seed=seed)
    letters, action = "", None
    bot = BabyAIBot(env.unwrapped)
    bot.stack = BoundedStack(bot.stack)
    while len(letters) < steps:
        try:
            bot.stack.looks = 0
            action = Actions(bot.replan(action))
        except Exception:
            return "gave_up", letters
        if action == Actions.done:
            return "finished", letters
        letter = LETTERS[action]
        if meddle and len(letters) % meddle == meddle - 1:
            # Any action but this one and done.
            action = Actions((action + 1 + (seed + len(letters)) % 5) % 6)
            letter = LETTERS[action].upper()
        letters += letter
        _, reward, terminated, truncated, _ = env.step(action)
        if terminated:
            return ("success" if reward > 0 else "failure"), letters
        if truncated:
            return "time_up", letters
    return "cut", letters


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--env", help="ids, separated by commas (default: all of BabyAI)")
    parser.add_argument("--seeds", default="0:20", help="A:B, the seeds A to B - 1")
    parser.add_argument("--meddle", type=int, metavar="N",
                        help="do something else than the bot says at every N-th action")
    parser.add_argument("--steps", type=int, default=10**6, help="at most, in an episode")
    arguments = parser.parse_args()
    first, end = map(int, arguments.seeds.split(":"))
    ids = arguments.env.split(",") if arguments.env else [
        i for i in gym.registry if i.startswith("BabyAI-")]
    print(f"# minigrid {minigrid.__version__}, bot bounded to {BOT_LOOKS} looks at its stack")
    for env_id in ids:
        env = gym.make(env_id, disable_env_checker=True)
        for seed in range(first, end):
            with contextlib.redirect_stdout(io.StringIO()):
                outcome, letters = play(env, seed, arguments.meddle, arguments.steps)
            print(env_id, seed, outcome, letters, flush=True)


if __name__ == "__main__":
    main()
