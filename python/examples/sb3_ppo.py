#!/usr/bin/env python3
"""Stable-Baselines3's PPO on a level, and how often the agent succeeds.

    pip install . stable-baselines3
    python/examples/sb3_ppo.py --level MiniGrid-DoorKey-5x5-v0
"""
import argparse
import time

import numpy
import torch
from stable_baselines3 import PPO
from stable_baselines3.common.vec_env import VecMonitor

from wordgaze.sb3 import VecEnv


def success(model, level, episodes, max_words):
    """The part of episodes with a reward, by actions drawn from the policy, on worlds of other seeds."""
    envs = VecEnv(level, 64, max_words=max_words, seed=1_000_000)
    observation, ended, rewarded = envs.reset(), 0, 0
    while ended < episodes:
        actions, _ = model.predict(observation, deterministic=False)
        observation, rewards, dones, _ = envs.step(actions)
        ended += int(dones.sum())
        rewarded += int((rewards[dones] > 0).sum())
    return rewarded / ended


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--level", default="MiniGrid-DoorKey-5x5-v0")
    parser.add_argument("--frames", type=int, default=400_000)
    parser.add_argument("--envs", type=int, default=64)
    parser.add_argument("--max-words", type=int, default=0, help="of a mission; 0: it does not matter")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    torch.set_num_threads(1)
    envs = VecMonitor(VecEnv(options.level, options.envs, max_words=options.max_words, seed=options.seed))
    model = PPO("MultiInputPolicy", envs, n_steps=64, batch_size=512, n_epochs=4, ent_coef=0.01,
                learning_rate=1e-3, gae_lambda=0.95, seed=options.seed, device="cpu")
    begin, cpu = time.monotonic(), time.process_time()
    model.learn(options.frames)
    seconds, cpu = time.monotonic() - begin, time.process_time() - cpu
    part = success(model, options.level, 500, options.max_words)
    print(f"{options.level}: {model.num_timesteps} frames in {seconds:.0f} s, "
          f"{model.num_timesteps / cpu:.0f} a CPU-second; success {100 * part:.1f} %, "
          f"mean return of the last 100 episodes {numpy.mean([e['r'] for e in model.ep_info_buffer]):.2f}")


if __name__ == "__main__":
    main()
