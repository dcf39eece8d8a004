"""The levels in Gymnasium's registry."""

from __future__ import annotations

from typing import Iterable

import gymnasium

from wordgaze._core import level_ids

NAMESPACE = "wordgaze"


def level_id(name: str) -> str:
    """Return the id of a level from its name in Gymnasium's registry, or from its id."""
    return name[len(NAMESPACE) + 1 :] if name.startswith(f"{NAMESPACE}/") else name


def register(ids: Iterable[str] | None = None) -> None:
    """Register levels with Gymnasium as ``wordgaze/<id>``; what is registered stays as it is.

    Parameters
    ----------
    ids
        Of levels; by default all that are known.
    """
    for name in level_ids() if ids is None else ids:
        full_name = f"{NAMESPACE}/{name}"
        if full_name not in gymnasium.registry:
            gymnasium.register(
                id=full_name,
                entry_point="wordgaze.env:Env",
                vector_entry_point="wordgaze.vector:make_vec",
                kwargs={"level": name},
            )
