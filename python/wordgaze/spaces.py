"""The space of missions."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy

from wordgaze._core import Environment, Level, tokens


class MissionSpace(gymnasium.Space[str]):
    """What a level may ask for: texts in the vocabulary. Samples are missions of the level.

    Parameters
    ----------
    level
        The level.
    seed
        Of the samples.
    """

    def __init__(self, level: Level, seed: int | numpy.random.Generator | None = None):
        self.level = level
        super().__init__(dtype=str, seed=seed)

    def sample(self, mask: Any = None, probability: Any = None) -> str:
        """Return the mission of an episode that starts from a random seed."""
        environment = Environment(self.level)
        environment.reset(str(self.np_random.integers(2**32)))
        return environment.mission

    def contains(self, x: Any) -> bool:
        """Return whether `x` is a text of words in the vocabulary."""
        if not isinstance(x, str):
            return False
        try:
            return len(tokens(x)) > 0 or x == ""
        except ValueError:
            return False

    @property
    def is_np_flattenable(self) -> bool:
        """A text is not an array."""
        return False

    def __repr__(self) -> str:
        return f"MissionSpace({self.level.id!r})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, MissionSpace) and self.level.id == other.level.id
