"""Stable-Baselines3's vector of environments, with missions as tokens and with action masks."""

from __future__ import annotations

from typing import Any, Sequence

import numpy
from gymnasium import spaces
from stable_baselines3.common import vec_env

from wordgaze._core import MAX_MISSION_WORDS, OBJECT_TYPES, VOCABULARY
from wordgaze.vector import make_vec


class VecEnv(vec_env.VecEnv):
    """Environments of one level that step together in C++, for the algorithms of Stable-Baselines3.

    Observations are ``image``, [7, 7, 3] of small integers that Stable-Baselines3 does not take for a
    photograph, ``direction``, and ``mission``, the words of which it makes one-hot. Use the policy
    ``"MultiInputPolicy"``; ``MaskablePPO`` and ``RecurrentPPO`` of sb3-contrib work too. The number of
    the last step of an episode and its reward come with ``VecMonitor``.

    Parameters
    ----------
    level
        Its id, with or without ``wordgaze/`` before it.
    num_envs
        How many environments.
    num_threads
        How many threads step them.
    max_words
        Of the longest mission; fewer make smaller networks. 0 leaves the mission out.
    seed
        Environment k starts from ``seed + k``; without it, from an unpredictable one.
    **settings
        As of `wordgaze.VectorEnv`.
    """

    def __init__(
        self,
        level: str,
        num_envs: int,
        num_threads: int = 1,
        *,
        max_words: int = MAX_MISSION_WORDS,
        seed: int | None = None,
        **settings: Any,
    ):
        self._with_mission = max_words > 0
        self.envs = make_vec(
            level, num_envs, num_threads, max_words=max_words or MAX_MISSION_WORDS, **settings
        )
        parts: dict[str, spaces.Space] = {
            "image": spaces.Box(0, len(OBJECT_TYPES) - 1, (7, 7, 3), numpy.uint8),
            "direction": spaces.Discrete(4),
        }
        if self._with_mission:
            parts["mission"] = spaces.MultiDiscrete([len(VOCABULARY)] * max_words)
        self.render_mode = settings.get("render_mode")
        super().__init__(num_envs, spaces.Dict(parts), self.envs.single_action_space)
        self.seed(seed)
        self._actions = numpy.zeros(num_envs, numpy.int64)

    def reset(self) -> dict[str, numpy.ndarray]:
        """Start an episode in each environment, from the seeds that were given since the last time."""
        observations, _ = self.envs.reset(seed=self._seeds)
        self._reset_seeds()
        return self._chosen(observations)

    def step_async(self, actions: numpy.ndarray) -> None:
        """Take actions with the next `step_wait()`."""
        self._actions = actions

    def step_wait(self) -> tuple[dict[str, numpy.ndarray], numpy.ndarray, numpy.ndarray, list[dict]]:
        """Take the actions of `step_async()`; where an episode ends, the next one starts."""
        observations, rewards, terminated, truncated, ends = self.envs.step(self._actions)
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for k in numpy.flatnonzero(ends.get("_final_obs", ())).tolist():
            infos[k]["terminal_observation"] = self._chosen(ends["final_obs"][k])
            infos[k]["TimeLimit.truncated"] = bool(truncated[k] and not terminated[k])
        return (
            self._chosen(observations),
            rewards.astype(numpy.float32),
            terminated | truncated,
            infos,
        )

    def close(self) -> None:
        """Let go of the environments."""
        self.envs.close()

    def get_images(self) -> Sequence[numpy.ndarray | None]:
        """Return a frame of each environment."""
        return self.envs.render() or [None] * self.num_envs

    def action_masks(self) -> numpy.ndarray:
        """Return [num_envs, actions] bool: whether an action would do more now than let time pass."""
        return self.envs.action_masks()

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """Return an attribute of all environments, once for each of those that are asked for."""
        count = len(list(self._get_indices(indices)))
        if attr_name == "render_mode":
            return [self.render_mode] * count
        if attr_name == "action_masks":
            return [self.action_masks] * count
        return [getattr(self.envs, attr_name)] * count

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """Refuse: the environments are in C++."""
        raise AttributeError(f"set_attr: '{attr_name}' of these environments cannot be set")

    def env_method(
        self, method_name: str, *method_args: Any, indices: Any = None, **method_kwargs: Any
    ) -> list[Any]:
        """Call ``action_masks``, which is all that can be called of a single environment."""
        if method_name != "action_masks":
            raise AttributeError(f"env_method: '{method_name}'; expected 'action_masks'")
        masks = self.action_masks()
        return [masks[k] for k in self._get_indices(indices)]

    def env_is_wrapped(self, wrapper_class: type, indices: Any = None) -> list[bool]:
        """Return that no environment is wrapped."""
        return [False for _ in self._get_indices(indices)]

    def _chosen(self, observation: dict[str, Any]) -> dict[str, Any]:
        chosen = {key: observation[key] for key in self.observation_space.spaces}
        if self._with_mission:
            chosen["mission"] = chosen["mission"].copy()  # PyTorch warns of what it may not write to
        return chosen
