"""One environment, as Minigrid's are."""

from __future__ import annotations

import copy
import functools
import operator
from enum import IntEnum
from typing import Any

import gymnasium
import numpy
from gymnasium import spaces
from gymnasium.utils import seeding

from wordgaze import random
from wordgaze._core import ACTIONS, Environment, Level, TileRenderer
from wordgaze.registration import level_id
from wordgaze.spaces import MissionSpace

Actions = IntEnum("Actions", {name: k for k, name in enumerate(ACTIONS)})
Actions.__doc__ = "The actions, with Minigrid's integers."

#: Of a tile in the frames of `render()`, as in Minigrid.
TILE_PIXELS = 32


@functools.lru_cache(maxsize=16)
def tile_renderer(tile_size: int) -> TileRenderer:
    """Return the renderer of a size of tiles, which remembers the tiles that it has drawn."""
    return TileRenderer(tile_size)


@functools.lru_cache(maxsize=None)
def grid_size(id: str) -> tuple[int, int]:
    """Return width and height of a level's grid in cells."""
    environment = Environment(Level(id))
    environment.reset("0")
    return environment.size


class Env(gymnasium.Env):
    """A level of MiniGrid or BabyAI: worlds, views, rewards and random draws are those of the reference.

    What Minigrid's environments have beside Gymnasium's interface (``grid``, ``carrying``,
    ``gen_obs_grid()`` and so on) is here too, to be read, where the package ``minigrid`` is
    installed; its wrappers may be put around this environment.

    Parameters
    ----------
    level
        Its id, with or without ``wordgaze/`` before it; see ``wordgaze.level_ids()``.
    render_mode
        None or ``"rgb_array"``.
    room_size
        Of a room, walls included, where the level can have another one.
    objects
        How many the level scatters, where it scatters any.
    max_steps
        Steps until an episode is cut off, instead of the level's own number.
    see_through_walls
        Whether the agent sees what is behind walls, instead of what the level says.
    highlight
        Whether `render()` shows what the agent sees.
    tile_size
        Of a cell in pixels.
    agent_pov
        Whether `render()` draws what the agent sees instead of the world.

    Raises
    ------
    ValueError
        For a level that is not known or cannot be so.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 10}
    reward_range = (0, 1)
    actions = Actions
    agent_view_size = 7

    def __init__(
        self,
        level: str,
        *,
        render_mode: str | None = None,
        room_size: int | None = None,
        objects: int | None = None,
        max_steps: int | None = None,
        see_through_walls: bool | None = None,
        highlight: bool = True,
        tile_size: int = TILE_PIXELS,
        agent_pov: bool = False,
    ):
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise ValueError(f"render_mode = {render_mode!r}; expected None or 'rgb_array'")
        self.level = Level(
            level_id(level),
            room_size=room_size,
            objects=objects,
            max_steps=max_steps,
            see_through_walls=see_through_walls,
        )
        self.render_mode = render_mode
        self.highlight = highlight
        self.tile_size = tile_size
        self.agent_pov = agent_pov
        self.width, self.height = grid_size(self.level.id)
        self.see_through_walls = self.level.see_through_walls
        size = self.agent_view_size
        self.observation_space = spaces.Dict(
            {
                "image": spaces.Box(0, 255, (size, size, 3), numpy.uint8),
                "direction": spaces.Discrete(4),
                "mission": MissionSpace(self.level),
            }
        )
        self.action_space = spaces.Discrete(self.level.actions)
        self._core = Environment(self.level)
        self._generator = None  # lent to whoever has asked for np_random
        self._seed = None
        self._minigrid = None  # made when it is asked for

    # --- Gymnasium ---

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Any], dict[str, Any]]:
        """Start an episode.

        Parameters
        ----------
        seed
            A non-negative integer of any size; without one the random stream goes on.
        options
            Not used.
        """
        if seed is None and self._seed is None and self._generator is None:
            _, seed = seeding.np_random()
        if seed is not None:
            seed = operator.index(seed)
            self._core.reset(str(seed))
            self._seed, self._generator = seed, None
        elif self._generator is not None:
            self._core.reset_from(random.from_numpy(self._generator))
            self._follow()
        else:
            self._core.reset_from(self._core.random_state)
        self._forget_view()
        return self.gen_obs(), {}

    def step(self, action: int) -> tuple[dict[str, Any], float, bool, bool, dict[str, Any]]:
        """Take an action. Raises ValueError for one that the level does not have."""
        if self._generator is not None:
            self._core.random_state = random.from_numpy(self._generator)
        reward, terminated, truncated = self._core.step(operator.index(action))
        self._follow()
        if self._minigrid is not None:
            self._minigrid.stale = True
        return self.gen_obs(), reward, terminated, truncated, {}

    def render(self) -> numpy.ndarray | None:
        """Return the frame that Minigrid renders, [height, width, 3]; None without a render mode."""
        if self.render_mode is None:
            gymnasium.logger.warn(
                "render() without a render_mode draws nothing; make the environment with "
                'render_mode="rgb_array"'
            )
            return None
        return self.get_frame(self.highlight, self.tile_size, self.agent_pov)

    @property
    def np_random(self) -> numpy.random.Generator:
        """The random stream of the level: who draws from it changes the worlds to come."""
        if self._generator is None:
            if self._seed is None:
                self._generator, self._seed = seeding.np_random()
            else:
                self._generator = numpy.random.Generator(numpy.random.PCG64(0))
                self._follow()
        return self._generator

    @np_random.setter
    def np_random(self, value: numpy.random.Generator) -> None:
        state = random.from_numpy(value)
        self._core.random_state = state
        self._generator, self._seed = value, -1

    # Gymnasium's own name of it, at which its checks look.
    _np_random = np_random

    @property
    def np_random_seed(self) -> int:
        """The seed of the random stream; -1 if it is not known."""
        if self._seed is None:
            self.np_random  # noqa: B018  chooses one
        return self._seed

    # --- More than Gymnasium asks for ---

    def action_masks(self) -> numpy.ndarray:
        """Return one bool an action: whether it would do more now than let time pass."""
        return numpy.array(self._core.effective_actions(), dtype=bool)

    def bot_action(self) -> int | None:
        """Return what BabyAI's expert would do now; None when it has given up.

        It is to be asked after `reset()` for the first time; who does something else is told later
        how to go on from there. Raises RuntimeError when it is first asked in mid-episode, and
        ValueError for a level of MiniGrid, which it does not know.
        """
        return self._core.bot_action()

    def get_state(self) -> bytes:
        """Return all there is to the environment, its random stream included."""
        if self._generator is not None:
            self._core.random_state = random.from_numpy(self._generator)
        return self._core.serialize()

    def set_state(self, state: bytes) -> None:
        """Go on from a state of an environment of the same level. Raises RuntimeError for any other."""
        self._core.restore(state)
        self._seed = -1
        self._follow()
        self._forget_view()

    @property
    def completion(self) -> numpy.ndarray:
        """One 0/1 a sub-task of the mission, in its order: what is done of it."""
        return numpy.array(self._core.completion, dtype=numpy.uint8)

    # --- What Minigrid's environments have ---

    @property
    def mission(self) -> str:
        """What the agent is asked to do."""
        return self._core.mission

    @property
    def max_steps(self) -> int:
        """Steps until the episode is cut off."""
        return self._core.max_steps

    @property
    def step_count(self) -> int:
        """Steps since the episode began."""
        return self._core.step_count

    @property
    def steps_remaining(self) -> int:
        """Steps until the episode is cut off, from now on."""
        return self.max_steps - self.step_count

    @property
    def agent_pos(self) -> tuple[int, int]:
        """Column and row of the agent."""
        return self._core.agent

    @property
    def agent_dir(self) -> int:
        """Where the agent looks: 0 right, 1 down, 2 left, 3 up."""
        return self._core.direction

    def gen_obs(self) -> dict[str, Any]:
        """Return what the agent observes now."""
        image = numpy.empty(self.observation_space["image"].shape, numpy.uint8)
        self._core.observe(image)
        return {"image": image, "direction": self.agent_dir, "mission": self.mission}

    def get_frame(
        self, highlight: bool = True, tile_size: int = TILE_PIXELS, agent_pov: bool = False
    ) -> numpy.ndarray:
        """Return the world, or what the agent sees of it, in pixels: [height, width, 3]."""
        renderer = tile_renderer(tile_size)
        if not agent_pov:
            return renderer.world(self._core, highlight)
        return renderer.view(self.gen_obs()["image"])

    def get_full_render(self, highlight: bool, tile_size: int) -> numpy.ndarray:
        """Return the world in pixels."""
        return self.get_frame(highlight, tile_size)

    def get_pov_render(self, tile_size: int) -> numpy.ndarray:
        """Return what the agent sees in pixels."""
        return self.get_frame(tile_size=tile_size, agent_pov=True)

    def __getattr__(self, name: str) -> Any:
        """Return what Minigrid's environments have and this one has not, of a view of the world."""
        if name.startswith("_"):
            raise AttributeError(f"'{type(self).__name__}' has no attribute '{name}'")
        return getattr(self._view(), name)

    def _view(self) -> Any:
        if self._minigrid is None:
            try:
                from wordgaze.minigrid_view import MinigridView
            except ImportError as error:
                raise AttributeError(
                    "what Minigrid's environments have beside Gymnasium's interface needs the "
                    "package minigrid: pip install minigrid"
                ) from error
            self._minigrid = MinigridView(self)
        if self._minigrid.stale:
            self._minigrid.refresh(self._core)
        return self._minigrid

    def _forget_view(self) -> None:
        if self._minigrid is not None:
            self._minigrid.forget()

    def _follow(self) -> None:
        """Bring the lent generator to where the random stream is."""
        if self._generator is not None:
            self._generator.bit_generator.state = random.to_numpy(self._core.random_state)

    def __copy__(self) -> Env:
        """Environments share nothing."""
        return copy.deepcopy(self)

    def __getstate__(self) -> dict[str, Any]:
        if self._generator is not None:
            self._core.random_state = random.from_numpy(self._generator)
        return {**self.__dict__, "_minigrid": None}
