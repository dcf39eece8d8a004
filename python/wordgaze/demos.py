"""Demonstrations by BabyAI's expert."""

from __future__ import annotations

import dataclasses
from typing import Any, Iterator

import numpy

from wordgaze.env import Env


@dataclasses.dataclass(frozen=True)
class Demonstrations:
    """Episodes one behind the other: T steps in all. An observation is what was seen before the action.

    ``starts`` [episodes + 1] says where each begins, and where the last one ends; the last
    observation of an episode, behind its last action, is in ``final_images`` and
    ``final_directions``. ``missions`` and ``seeds`` are one an episode.
    """

    level: str
    images: numpy.ndarray  #: [T, 7, 7, 3] uint8
    directions: numpy.ndarray  #: [T] int64
    actions: numpy.ndarray  #: [T] int64
    rewards: numpy.ndarray  #: [T] float64
    terminated: numpy.ndarray  #: [T] bool
    truncated: numpy.ndarray  #: [T] bool
    starts: numpy.ndarray  #: [episodes + 1] int64
    final_images: numpy.ndarray  #: [episodes, 7, 7, 3] uint8
    final_directions: numpy.ndarray  #: [episodes] int64
    missions: list[str]
    seeds: list[int]
    settings: dict[str, Any] = dataclasses.field(default_factory=dict)

    def __len__(self) -> int:
        """Return the number of episodes."""
        return len(self.missions)

    def steps(self, episode: int) -> slice:
        """Return where the steps of an episode are."""
        return slice(int(self.starts[episode]), int(self.starts[episode + 1]))

    def to_minari(self, dataset_id: str, **description: Any) -> Any:
        """Make a Minari dataset of them, which Minari keeps; needs the package minari.

        Parameters
        ----------
        dataset_id
            As Minari wants it: ``"wordgaze/go-to-local-v0"``.
        **description
            As of ``minari.create_dataset_from_buffers``: author, algorithm name...
        """
        import minari
        from minari.data_collector import EpisodeBuffer

        def observations(episode: int) -> dict[str, Any]:
            at = self.steps(episode)
            last = slice(episode, episode + 1)
            count = at.stop - at.start + 1
            return {
                "image": numpy.concatenate([self.images[at], self.final_images[last]]),
                "direction": numpy.concatenate([self.directions[at], self.final_directions[last]]),
                "mission": [self.missions[episode]] * count,
            }

        buffers = [
            EpisodeBuffer(
                id=episode,
                seed=self.seeds[episode],
                observations=observations(episode),
                actions=self.actions[self.steps(episode)],
                rewards=self.rewards[self.steps(episode)],
                terminations=self.terminated[self.steps(episode)],
                truncations=self.truncated[self.steps(episode)],
            )
            for episode in range(len(self))
        ]
        env = Env(self.level, **self.settings)
        return minari.create_dataset_from_buffers(
            dataset_id,
            buffer=buffers,
            action_space=env.action_space,
            observation_space=_text_space(env),
            **description,
        )


def demos(level: str, episodes: int, *, seed: int = 0, **settings: Any) -> Demonstrations:
    """Let the expert play episodes until enough of them have succeeded.

    Parameters
    ----------
    level
        Its id; a level of instructions.
    episodes
        How many successful ones; where the expert gives up or fails, the next seed is tried.
    seed
        Of the first episode; the next one is of the next seed.
    **settings
        As of `wordgaze.Env`.

    Raises
    ------
    RuntimeError
        When the expert fails a hundred times in a row.
    """
    env, kept, failed = Env(level, **settings), [], 0
    while len(kept) < episodes:
        mission = env.reset(seed=seed)[0]["mission"]
        steps = list(_play(env))
        if steps and steps[-1][3] > 0:
            kept.append((steps, env.gen_obs(), mission, seed))
            failed = 0
        elif (failed := failed + 1) == 100:
            raise RuntimeError(f"demos: the expert failed 100 times in a row in '{level}'")
        seed += 1
    columns = list(zip(*(step for steps, *_ in kept for step in steps))) or [()] * 6
    kinds = (numpy.uint8, numpy.int64, numpy.int64, numpy.float64, bool, bool)
    arrays = [numpy.array(column, kind) for column, kind in zip(columns, kinds)]
    return Demonstrations(
        env.level.id,
        *arrays,
        starts=numpy.cumsum([0] + [len(steps) for steps, *_ in kept]),
        final_images=numpy.array([last["image"] for _, last, *_ in kept], numpy.uint8),
        final_directions=numpy.array([last["direction"] for _, last, *_ in kept], numpy.int64),
        missions=[mission for *_, mission, _ in kept],
        seeds=[number for *_, number in kept],
        settings={
            key: value for key, value in settings.items() if key not in ("room_size", "objects")
        },  # which are in the level's id
    )


def _play(env: Env) -> Iterator[tuple]:
    """Steps of the expert to the end of an episode; nothing more where it gives up."""
    observation, ended = env.gen_obs(), False
    while not ended:
        action = env.bot_action()
        if action is None:
            return
        seen, (observation, reward, terminated, truncated, _) = observation, env.step(action)
        yield seen["image"], seen["direction"], action, reward, terminated, truncated
        ended = terminated or truncated


def _text_space(env: Env) -> Any:
    """The observations of an environment in spaces that Minari can store."""
    from gymnasium import spaces

    return spaces.Dict(
        {
            **env.observation_space.spaces,
            "mission": spaces.Text(1000, charset="abcdefghijklmnopqrstuvwxyz ,"),
        }
    )
