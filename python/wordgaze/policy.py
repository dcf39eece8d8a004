"""A trained agent."""

from __future__ import annotations

import os
import re
from typing import Sequence

import numpy

from wordgaze._core import ACTIONS, Agent, Decision, Level, configuration
from wordgaze.registration import level_id

__all__ = ["Decision", "Policy"]


class Policy:
    """A trained agent at work: a mission, then a decision for each view.

    Parameters
    ----------
    checkpoint
        A file of ``train``, or any other of our files of weights (``models/*.safetensors``).
    level
        The id of a level with the kinds of objects that the agent will meet; by default the one
        that it was trained in. An agent of rooms without doors knows none.
    seed
        Of the actions that are drawn.

    Raises
    ------
    RuntimeError
        For a file that is not one; the message names it and what is wrong.

    Examples
    --------
    >>> policy = wordgaze.Policy("models/single-attention.safetensors")
    >>> env = gymnasium.make("wordgaze/BabyAI-GoToLocal-v0")
    >>> observation, info = env.reset(seed=1)
    >>> policy.begin(observation["mission"])
    >>> decision = policy.act(observation["image"])
    >>> decision.action, decision.gaze.shape
    (2, (7, 7))
    """

    def __init__(
        self, checkpoint: str | os.PathLike[str], level: str | None = None, seed: int = 0
    ):
        path = os.fspath(checkpoint)
        self._agent = Agent(path, Level(level_id(level)) if level else training_level(path), seed)

    @property
    def has_attention(self) -> bool:
        """Whether decisions come with maps."""
        return self._agent.has_attention

    def begin(self, mission: str, actions: int = len(ACTIONS)) -> None:
        """Begin an episode: the memory is empty.

        Parameters
        ----------
        mission
            What the agent is asked to do. Raises ValueError for words that are not in the
            vocabulary, and for more sub-tasks than the agent was made for.
        actions
            The first so many are possible.
        """
        self._agent.begin(mission, actions)

    def act(
        self,
        image: numpy.ndarray,
        completion: Sequence[int] | None = None,
        *,
        sample: bool = False,
    ) -> Decision:
        """Decide on what the agent sees; the memory goes on with it.

        Parameters
        ----------
        image
            [7, 7, 3] uint8, the view as in observations.
        completion
            One 0/1 a sub-task, in the order of the mission: what is done of it. Agents with a Task
            Attention Module read it. Without it nothing is done yet.
        sample
            Whether the action is drawn from the policy, instead of the likeliest one.

        Returns
        -------
        Decision
            ``action``, ``probabilities`` [actions], ``value``, ``entropy``, ``log_prob``; where the
            agent looked: ``words``, ``weights`` and ``mask`` [words], ``maps`` [words, 7, 7],
            ``gaze`` and ``filter`` [7, 7], ``nowhere``.
        """
        done = None if completion is None else [int(one) for one in completion]
        return self._agent.act(numpy.ascontiguousarray(image, numpy.uint8), done, sample)


def training_level(checkpoint: str | os.PathLike[str]) -> Level | None:
    """Return the level in which an agent was trained; None if it is not known here."""
    found = re.search(r'^env = "(.*)"$', configuration(os.fspath(checkpoint)), re.MULTILINE)
    try:
        return Level(found[1]) if found else None
    except ValueError:
        return None
