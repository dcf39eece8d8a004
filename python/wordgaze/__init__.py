"""MiniGrid and BabyAI, seed-exact and at the speed of C++; agents that show where they look.

Importing the package registers every level with Gymnasium, as ``wordgaze/<id>``.

Examples
--------
>>> import gymnasium, wordgaze
>>> env = gymnasium.make("wordgaze/BabyAI-GoToLocal-v0")
>>> observation, info = env.reset(seed=1)
>>> observation["mission"]
'go to the purple box'
>>> envs = wordgaze.make_vec("BabyAI-GoToLocal-v0", num_envs=256)
>>> observations, infos = envs.reset(seed=1)
>>> observations["image"].shape
(256, 7, 7, 3)
"""

from wordgaze._core import (
    ACTIONS,
    COLORS,
    MAX_MISSION_WORDS,
    OBJECT_TYPES,
    VOCABULARY,
    level_ids,
    tokens,
)
from wordgaze.demos import Demonstrations, demos
from wordgaze.env import Env
from wordgaze.policy import Decision, Policy
from wordgaze.registration import register
from wordgaze.vector import VectorEnv, make_vec

__all__ = [
    "ACTIONS",
    "COLORS",
    "MAX_MISSION_WORDS",
    "OBJECT_TYPES",
    "VOCABULARY",
    "Decision",
    "Demonstrations",
    "Env",
    "Policy",
    "VectorEnv",
    "demos",
    "level_ids",
    "make_vec",
    "register",
    "tokens",
]

register()
