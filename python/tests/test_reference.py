"""Worlds, views, missions, rewards and frames are those of minigrid 3.2.0."""

import gymnasium
import numpy
import pytest
from conftest import assert_same_observation, make_reference, quietly, reference_ids

import wordgaze

STEPS = 40


def follow(ours, reference, seed, steps=STEPS):
    """The same actions in both, over the ends of episodes; half of them go on."""
    draw = numpy.random.default_rng(seed)
    mine, theirs = ours.reset(seed=seed), quietly(reference.reset, seed=seed)
    assert_same_observation(mine[0], theirs[0])
    assert mine[1] == theirs[1] == {}
    for _ in range(steps):
        action = int(draw.choice([2, draw.integers(ours.action_space.n)]))
        mine, theirs = ours.step(action), quietly(reference.step, action)
        assert_same_observation(mine[0], theirs[0])
        assert mine[1:] == theirs[1:]
        if mine[2] or mine[3]:
            assert_same_observation(ours.reset()[0], quietly(reference.reset)[0])


def test_all_levels_of_the_reference_are_here_but_those_of_wave_function_collapse():
    theirs = {i for i in gymnasium.registry if i.startswith(("BabyAI-", "MiniGrid-"))}
    assert {i for i in theirs - set(wordgaze.level_ids()) if "WFC" not in i} == set()
    assert len(reference_ids()) == 172


@pytest.mark.parametrize("id", reference_ids())
def test_episodes(id):
    ours, reference = wordgaze.Env(id), make_reference(id)
    assert ours.action_space == reference.action_space
    assert (ours.width, ours.height) == (reference.width, reference.height)
    follow(ours, reference, seed=11)
    numpy.testing.assert_array_equal(ours.get_frame(tile_size=8), reference.get_frame(tile_size=8))


@pytest.mark.parametrize("seed", [0, 2**32, 2**63 + 5, 2**200 + 1])
def test_seeds_of_any_size(seed):
    follow(wordgaze.Env("BabyAI-GoToLocal-v0"), make_reference("BabyAI-GoToLocal-v0"), seed)


@pytest.mark.parametrize(
    ("id", "settings"),
    [
        ("BabyAI-PickupLoc-v0", {"max_steps": 13}),
        ("MiniGrid-DoorKey-6x6-v0", {"max_steps": 13, "see_through_walls": True}),
    ],
)
def test_other_step_limits_and_sight_through_walls(id, settings):
    ours, reference = wordgaze.Env(id, **settings), make_reference(id, **settings)
    follow(ours, reference, seed=3)
    assert ours.max_steps == reference.max_steps == 13


@pytest.mark.parametrize("id", ["BabyAI-UnlockPickup-v0", "MiniGrid-LavaCrossingS9N2-v0"])
@pytest.mark.parametrize(
    "frame",
    [
        {},
        {"highlight": False},
        {"tile_size": 9},
        {"agent_pov": True},
        {"agent_pov": True, "tile_size": 8},
    ],
)
def test_render(id, frame):
    ours = wordgaze.Env(id, render_mode="rgb_array", **frame)
    reference = make_reference(id, render_mode="rgb_array", **frame)
    follow(ours, reference, seed=5, steps=7)
    numpy.testing.assert_array_equal(ours.render(), reference.render())


@pytest.mark.parametrize("id", ["BabyAI-BossLevel-v0", "MiniGrid-Dynamic-Obstacles-6x6-v0"])
def test_np_random_is_the_stream_of_the_level(id):
    ours, reference = wordgaze.Env(id), make_reference(id)
    ours.reset(seed=5), quietly(reference.reset, seed=5)
    mine, theirs = ours.np_random, reference.np_random
    for _ in range(3):
        for _ in range(3):  # one draw leaves half of a word for the next
            assert mine.integers(1000) == theirs.integers(1000)
            assert_same_observation(ours.step(2)[0], reference.step(2)[0])
        assert ours.np_random is mine
        assert_same_observation(ours.reset()[0], quietly(reference.reset)[0])


def test_the_expert_does_what_the_reference_s_does():
    from minigrid.utils.baby_ai_bot import BabyAIBot

    id = "BabyAI-BossLevel-v0"
    ours, reference = wordgaze.Env(id), make_reference(id)
    ours.reset(seed=8), quietly(reference.reset, seed=8)
    bot, action, done = BabyAIBot(reference), None, False
    while not done:
        action = int(bot.replan(action))
        assert ours.bot_action() == action
        _, reward, terminated, truncated, _ = ours.step(action)
        reference.step(action)
        done = terminated or truncated
    assert reward > 0
