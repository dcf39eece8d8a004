"""Many environments that step together."""

from __future__ import annotations

from typing import Any, Sequence

import gymnasium
import numpy
from gymnasium import spaces
from gymnasium.vector import AutoresetMode
from gymnasium.vector.utils import batch_space

from wordgaze._core import MAX_MISSION_WORDS, VOCABULARY, Batch, Level
from wordgaze.env import TILE_PIXELS, tile_renderer
from wordgaze.registration import level_id


class VectorEnv(gymnasium.vector.VectorEnv):
    """Environments of one level that step together, in C++ and without Python's lock.

    An environment whose episode ends starts the next one in the same step; the last observation of
    the episode is in ``infos["final_obs"]`` (Gymnasium's mode ``SAME_STEP``). The simulator writes
    into the memory of the arrays that are returned, and each step returns new ones: nobody else
    changes them. Only the missions are shared between steps in which none of them changes, and can
    therefore not be written to.

    Observations are ``image`` [num_envs, 7, 7, 3], ``direction`` [num_envs] and ``mission``
    [num_envs, max_words]: the ids of its words in ``wordgaze.VOCABULARY``, 0 behind the last one.

    Parameters
    ----------
    level
        Its id, with or without ``wordgaze/`` before it.
    num_envs
        How many environments.
    num_threads
        How many threads step them; what comes out does not depend on it.
    max_words
        Columns of ``mission``. A longer mission raises ValueError.
    render_mode
        None or ``"rgb_array"``.
    **settings
        ``room_size``, ``objects``, ``max_steps`` and ``see_through_walls``, as of `wordgaze.Env`.
    """

    metadata = {
        "render_modes": ["rgb_array"],
        "render_fps": 10,
        "autoreset_mode": AutoresetMode.SAME_STEP,
    }
    vocabulary = VOCABULARY

    def __init__(
        self,
        level: str,
        num_envs: int = 1,
        num_threads: int = 1,
        *,
        max_words: int = MAX_MISSION_WORDS,
        render_mode: str | None = None,
        **settings: Any,
    ):
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise ValueError(f"render_mode = {render_mode!r}; expected None or 'rgb_array'")
        self.level = Level(level_id(level), **settings)
        self._level = {"level": level_id(level), **settings}
        self.num_envs = num_envs
        self.num_threads = num_threads
        self.max_words = max_words
        self.render_mode = render_mode
        self._batch = Batch(self.level, num_envs, num_threads)
        self.single_observation_space = spaces.Dict(
            {
                "image": spaces.Box(0, 255, (7, 7, 3), numpy.uint8),
                "direction": spaces.Discrete(4),
                "mission": spaces.Box(0, len(VOCABULARY) - 1, (max_words,), numpy.uint8),
            }
        )
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.single_action_space = spaces.Discrete(self.level.actions)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._final_images = numpy.zeros((num_envs, 7, 7, 3), numpy.uint8)
        self._final_directions = numpy.zeros(num_envs, numpy.uint8)
        self._tokens = numpy.zeros((num_envs, max_words), numpy.uint8)
        self._lengths = numpy.zeros(num_envs, numpy.uint8)

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[dict[str, numpy.ndarray], dict[str, Any]]:
        """Start an episode in each environment.

        Parameters
        ----------
        seed
            Environment k starts from ``seed + k``, or from entry k of a sequence; where there is
            none, its random stream goes on.
        options
            ``reset_mask``, an array of bool: start these environments alone.
        """
        if seed is None:
            seeds = [None] * self.num_envs
        elif isinstance(seed, (int, numpy.integer)):
            seeds = [str(seed + k) for k in range(self.num_envs)]
        else:
            seeds = [None if one is None else str(one) for one in seed]
        chosen = None if options is None else options.get("reset_mask")
        if chosen is not None:
            chosen = self._checked_mask(chosen)
        images = numpy.empty((self.num_envs, 7, 7, 3), numpy.uint8)
        directions = numpy.empty(self.num_envs, numpy.uint8)
        self._batch.reset(seeds, chosen, images, directions)
        if chosen is not None:
            self._batch.observe(images, directions)
        self._take_missions(chosen)
        return self._observations(images, directions), {}

    def step(
        self, actions: numpy.ndarray
    ) -> tuple[
        dict[str, numpy.ndarray], numpy.ndarray, numpy.ndarray, numpy.ndarray, dict[str, Any]
    ]:
        """Take an action in each environment.

        Parameters
        ----------
        actions
            [num_envs] integers. Raises ValueError, and steps none, for one that the level does not
            have.
        """
        actions = numpy.asarray(actions)
        if actions.dtype != numpy.int64:
            if actions.dtype.kind not in "iu":
                raise TypeError(f"step: actions of type {actions.dtype}; expected integers")
            actions = actions.astype(numpy.int64)
        n = self.num_envs
        images = numpy.empty((n, 7, 7, 3), numpy.uint8)
        directions = numpy.empty(n, numpy.uint8)
        rewards = numpy.empty(n)
        terminated = numpy.empty(n, bool)
        truncated = numpy.empty(n, bool)
        some_ended = self._batch.step(
            numpy.ascontiguousarray(actions),
            images,
            directions,
            rewards,
            terminated,
            truncated,
            self._final_images,
            self._final_directions,
        )
        infos = self._end_episodes(terminated | truncated) if some_ended else {}
        return self._observations(images, directions), rewards, terminated, truncated, infos

    def render(self) -> tuple[numpy.ndarray, ...] | None:
        """Return a frame of each environment; None without a render mode."""
        if self.render_mode is None:
            return None
        renderer = tile_renderer(TILE_PIXELS)
        return tuple(self._batch.frame(k, renderer) for k in range(self.num_envs))

    def action_masks(self) -> numpy.ndarray:
        """Return [num_envs, actions] bool: whether an action would do more now than let time pass."""
        masks = numpy.empty((self.num_envs, self.level.actions), bool)
        self._batch.write_masks(masks)
        return masks

    def missions(self) -> list[str]:
        """Return the missions as text."""
        return [self._batch.mission(k) for k in range(self.num_envs)]

    @property
    def mission_lengths(self) -> numpy.ndarray:
        """Words of each mission."""
        return self._lengths.copy()

    def observe(self) -> dict[str, numpy.ndarray]:
        """Return what the agents observe now."""
        images = numpy.empty((self.num_envs, 7, 7, 3), numpy.uint8)
        directions = numpy.empty(self.num_envs, numpy.uint8)
        self._batch.observe(images, directions)
        return self._observations(images, directions)

    def get_state(self) -> list[bytes]:
        """Return all there is to each environment, its random stream included."""
        return [self._batch.serialize(k) for k in range(self.num_envs)]

    def set_state(self, states: Sequence[bytes]) -> None:
        """Go on from states of environments of the same level. Raises RuntimeError for any other."""
        if len(states) != self.num_envs:
            raise ValueError(f"set_state: {len(states)} states for {self.num_envs} environments")
        for k, state in enumerate(states):
            self._batch.restore(k, state)
        self._take_missions(None)

    def __reduce__(self) -> tuple:
        settings = {
            "num_envs": self.num_envs,
            "num_threads": self.num_threads,
            "max_words": self.max_words,
            "render_mode": self.render_mode,
            **self._level,
        }
        return _restored, (settings, self.get_state())

    def _observations(
        self, images: numpy.ndarray, directions: numpy.ndarray
    ) -> dict[str, numpy.ndarray]:
        return {
            "image": images,
            "direction": directions.astype(numpy.int64),
            "mission": self._tokens,
        }

    def _take_missions(self, chosen: numpy.ndarray | None) -> None:
        """Missions have changed: another tensor, as the former one is in the hands of others."""
        tokens = self._tokens.copy()
        self._batch.write_missions(tokens, self._lengths, chosen)
        tokens.flags.writeable = False
        self._tokens = tokens

    def _end_episodes(self, ended: numpy.ndarray) -> dict[str, Any]:
        which = numpy.flatnonzero(ended)
        final_obs = numpy.full(self.num_envs, None, object)
        for k, image, direction, mission in zip(
            which.tolist(),
            self._final_images[which],
            self._final_directions[which].tolist(),
            self._tokens[which],
        ):
            final_obs[k] = {"image": image, "direction": direction, "mission": mission}
        self._take_missions(ended)
        return {
            "final_obs": final_obs,
            "_final_obs": ended,
            "final_info": {},
            "_final_info": ended.copy(),
        }

    def _checked_mask(self, mask: numpy.ndarray) -> numpy.ndarray:
        mask = numpy.ascontiguousarray(mask)
        if mask.dtype != bool or mask.shape != (self.num_envs,) or not mask.any():
            raise ValueError(
                f"reset_mask: {mask.dtype} of shape {mask.shape}; expected bool of shape "
                f"({self.num_envs},), at least one of them true"
            )
        return mask


def _restored(settings: dict[str, Any], states: list[bytes]) -> VectorEnv:
    envs = VectorEnv(**settings)
    envs.set_state(states)
    return envs


def make_vec(level: str, num_envs: int = 1, num_threads: int = 1, **settings: Any) -> VectorEnv:
    """Make environments of a level that step together; see `VectorEnv` for the parameters.

    Examples
    --------
    >>> envs = wordgaze.make_vec("BabyAI-GoToLocal-v0", num_envs=4)
    >>> observations, infos = envs.reset(seed=7)
    >>> observations, rewards, terminated, truncated, infos = envs.step([2, 2, 0, 1])
    """
    return VectorEnv(level, num_envs, num_threads, **settings)
