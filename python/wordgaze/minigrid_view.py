"""The world as Minigrid has it, for its wrappers and for code written for it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from minigrid.core.grid import Grid
from minigrid.core.world_object import Goal, WorldObj
from minigrid.minigrid_env import MiniGridEnv

if TYPE_CHECKING:
    from wordgaze._core import Environment
    from wordgaze.env import Env


class MinigridView(MiniGridEnv):
    """An environment of Minigrid's in the state of one of ours. To be read: changes do not go back."""

    def __init__(self, env: Env):
        super().__init__(
            mission_space=env.observation_space["mission"],
            width=env.width,
            height=env.height,
            max_steps=env.max_steps,
            see_through_walls=env.see_through_walls,
            agent_view_size=env.agent_view_size,
            highlight=env.highlight,
            tile_size=env.tile_size,
            agent_pov=env.agent_pov,
        )
        self.stale = True
        self._objects: dict[int, WorldObj] = {}

    def _gen_grid(self, width: int, height: int) -> None:
        raise RuntimeError("this view of a world is to be read; reset the environment itself")

    @property
    def goal_pos(self) -> tuple[int, int]:
        """Where the goal is; the first one, row by row."""
        number = next(k for k, thing in enumerate(self.grid.grid) if isinstance(thing, Goal))
        return number % self.width, number // self.width

    goal_position = goal_pos

    def forget(self) -> None:
        """Another world: its objects are others."""
        self.stale = True
        self._objects = {}

    def refresh(self, core: Environment) -> None:
        """Take over the state of an environment. Objects stay the same Python objects."""
        self.mission = core.mission
        self.max_steps = core.max_steps
        self.step_count = core.step_count
        self.stale = False
        if core.max_steps == 0:  # before the first reset
            return
        self.agent_pos = core.agent
        self.agent_dir = core.direction
        self.grid = Grid(self.width, self.height)
        for (x, y), description in core.objects():
            thing = self._object(description)
            thing.cur_pos = (x, y)
            if thing.init_pos is None:
                thing.init_pos = (x, y)
            self.grid.set(x, y, thing)
        self.carrying = self._object(core.carrying)
        if self.carrying is not None:
            self.carrying.cur_pos = (-1, -1)

    def _object(self, description: tuple[int, int, int, int, Any] | None) -> WorldObj | None:
        if description is None:
            return None
        number, kind, color, state, contents = description
        now = WorldObj.decode(kind, color, state)
        thing = self._objects.setdefault(number, now)
        thing.color = now.color
        if thing.type == "door":
            thing.is_open, thing.is_locked = now.is_open, now.is_locked
        if thing.type == "box":
            thing.contains = self._object(contents)
        return thing
