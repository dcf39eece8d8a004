#!/usr/bin/env python3
"""sb3-contrib's MaskablePPO: actions that would do nothing are not tried. Missions are read as tokens.

    pip install . sb3-contrib
    python/examples/sb3_maskable_ppo.py --level BabyAI-GoToRedBallNoDists-v0
"""
import argparse
import time

import torch
from sb3_contrib import MaskablePPO
from stable_baselines3.common.vec_env import VecMonitor

from wordgaze.sb3 import VecEnv


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--level", default="BabyAI-GoToLocal-v0")
    parser.add_argument("--frames", type=int, default=200_000)
    parser.add_argument("--max-words", type=int, default=10, help="of a mission")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    torch.set_num_threads(1)
    envs = VecMonitor(VecEnv(options.level, 64, max_words=options.max_words, seed=options.seed))
    model = MaskablePPO("MultiInputPolicy", envs, n_steps=64, batch_size=512, n_epochs=4, ent_coef=0.01,
                        learning_rate=1e-3, seed=options.seed, device="cpu")
    begin = time.process_time()
    model.learn(options.frames)
    cpu = time.process_time() - begin
    returns = [episode["r"] for episode in model.ep_info_buffer]
    print(f"{options.level}: {model.num_timesteps} frames, {model.num_timesteps / cpu:.0f} a CPU-second; "
          f"of the last {len(returns)} episodes {100 * sum(r > 0 for r in returns) / len(returns):.0f} % "
          "succeeded")


if __name__ == "__main__":
    main()
