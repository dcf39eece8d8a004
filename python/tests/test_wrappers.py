"""Minigrid's wrappers give the same around our environments as around the reference."""

import numpy
import pytest
from conftest import assert_same_observation, make_reference, quietly
from minigrid import wrappers

import wordgaze

IDS = [
    "BabyAI-BossLevel-v0",
    "BabyAI-KeyInBox-v0",
    "BabyAI-UnlockPickup-v0",
    "MiniGrid-DoorKey-6x6-v0",
    "MiniGrid-DistShift1-v0",
    "MiniGrid-LavaCrossingS9N2-v0",
    "MiniGrid-Dynamic-Obstacles-6x6-v0",
    "MiniGrid-ObstructedMaze-1Dlhb-v0",
    "MiniGrid-Playground-v0",
]
OF_ALL = {
    "ActionBonus": wrappers.ActionBonus,
    "FullyObs": wrappers.FullyObsWrapper,
    "ImgObs": wrappers.ImgObsWrapper,
    "NoDeath": lambda env: wrappers.NoDeath(env, ("lava", "ball"), -0.5),
    "OneHotPartialObs": wrappers.OneHotPartialObsWrapper,
    "PositionBonus": wrappers.PositionBonus,
    "RGBImgObs": wrappers.RGBImgObsWrapper,
    "RGBImgPartialObs": wrappers.RGBImgPartialObsWrapper,
    "StochasticAction": lambda env: wrappers.StochasticActionWrapper(env, prob=0.5),
    "SymbolicObs": wrappers.SymbolicObsWrapper,
    "ViewSize3": lambda env: wrappers.ViewSizeWrapper(env, 3),
    "ViewSize11": lambda env: wrappers.ViewSizeWrapper(env, 11),
}
OF_MINIGRID = {
    "DictObservationSpace": wrappers.DictObservationSpaceWrapper,
    "FlatObs": wrappers.FlatObsWrapper,
}
OF_GOALS = {
    "DirectionObs": lambda env: wrappers.DirectionObsWrapper(env, type="angle_atan2"),
}


def assert_same(ours, reference):
    if isinstance(reference, dict):
        assert_same_observation(ours, reference)
    else:
        numpy.testing.assert_array_equal(ours, reference)


def assert_same_around(wrapper, id, steps=25):
    ours, reference = wrapper(wordgaze.Env(id)), wrapper(make_reference(id))
    mine, theirs = (getattr(env.observation_space, "spaces", {}) for env in (ours, reference))
    assert mine.get("image") == theirs.get("image")
    draw = numpy.random.default_rng(1)
    assert_same(ours.reset(seed=6)[0], quietly(reference.reset, seed=6)[0])
    for _ in range(steps):
        action = int(draw.choice([2, draw.integers(ours.action_space.n)]))
        mine, theirs = ours.step(action), quietly(reference.step, action)
        assert_same(mine[0], theirs[0])
        assert mine[1:] == theirs[1:]
        if mine[2] or mine[3]:
            assert_same(ours.reset()[0], quietly(reference.reset)[0])


@pytest.mark.parametrize("id", IDS)
@pytest.mark.parametrize("wrapper", OF_ALL)
def test_any_level(wrapper, id):
    assert_same_around(OF_ALL[wrapper], id)


@pytest.mark.parametrize("id", [id for id in IDS if id.startswith("MiniGrid")])
@pytest.mark.parametrize("wrapper", OF_MINIGRID)
def test_levels_of_minigrid(wrapper, id):
    assert_same_around(OF_MINIGRID[wrapper], id)


@pytest.mark.parametrize("id", ["MiniGrid-DoorKey-6x6-v0", "MiniGrid-LavaCrossingS9N2-v0"])
@pytest.mark.parametrize("wrapper", OF_GOALS)
def test_levels_with_a_goal(wrapper, id):
    assert_same_around(OF_GOALS[wrapper], id)


def test_reseed():
    ours, reference = (
        wrappers.ReseedWrapper(env, seeds=[3, 8])
        for env in (wordgaze.Env(IDS[0]), make_reference(IDS[0]))
    )
    for _ in range(3):
        assert_same(ours.reset()[0], quietly(reference.reset)[0])


@pytest.mark.parametrize("id", IDS)
def test_what_minigrid_s_environments_have_beside_gymnasium_s_interface(id):
    ours, reference = wordgaze.Env(id), make_reference(id)
    ours.reset(seed=2), quietly(reference.reset, seed=2)
    draw = numpy.random.default_rng(3)
    for _ in range(25):
        assert ours.grid == reference.grid
        assert ours.pprint_grid() == reference.pprint_grid()
        assert ours.steps_remaining == reference.steps_remaining
        assert tuple(ours.front_pos) == tuple(reference.front_pos)
        assert ours.in_view(4, 4) == reference.in_view(4, 4)
        mine, theirs = ours.carrying, reference.carrying
        assert (mine is None) == (theirs is None)
        assert mine is None or mine.encode() == theirs.encode()
        for a, b in zip(ours.grid.grid, reference.grid.grid):
            assert (a is None) == (b is None)
            if b is not None and b.type == "box":
                inside = [getattr(box.contains, "type", None) for box in (a, b)]
                assert inside[0] == inside[1] and tuple(a.cur_pos) == tuple(b.cur_pos)
        action = int(draw.choice([2, draw.integers(ours.action_space.n)]))
        ended = any(ours.step(action)[2:4])
        reference.step(action)
        if ended:
            ours.reset(), quietly(reference.reset)


def test_objects_stay_the_same_python_objects_within_an_episode():
    env = wordgaze.Env("MiniGrid-DoorKey-5x5-v0")
    env.reset(seed=1)
    key = next(o for o in env.grid.grid if o is not None and o.type == "key")
    env.step(0)
    assert key in env.grid
    env.reset()
    assert key not in env.grid
