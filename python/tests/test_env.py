"""`wordgaze.Env`: Gymnasium's interface, states, the expert, errors."""

import copy
import pickle
import subprocess
import sys
import warnings

import gymnasium
import numpy
import pytest
from conftest import assert_same_observation
from gymnasium.utils.env_checker import check_env

import wordgaze

ID = "BabyAI-GoToLocal-v0"
wordgaze.register(["Wordgaze-Two-N8-K4-v0"])  # one of a family, which level_ids() does not list
OTHERS = ["MiniGrid-Dynamic-Obstacles-6x6-v0", "MiniGrid-MultiRoom-N2-S4-v0", "Wordgaze-Two-N8-K4-v0"]


def play(env, steps=30, seed=0):
    """What random actions bring, over the ends of episodes."""
    draw, seen = numpy.random.default_rng(seed), []
    for _ in range(steps):
        observation, reward, terminated, truncated, _ = env.step(draw.integers(env.action_space.n))
        seen.append((observation, reward, terminated, truncated))
        if terminated or truncated:
            seen.append((env.reset()[0], 0, False, False))
    return seen


def assert_same_play(one, other):
    for (mine, *rest), (theirs, *others) in zip(one, other, strict=True):
        assert_same_observation(mine, theirs)
        assert rest == others


@pytest.mark.parametrize("id", [ID, *OTHERS])
def test_passes_the_checks_of_gymnasium_without_a_warning(id):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(gymnasium.make(f"wordgaze/{id}").unwrapped)


def test_every_level_is_registered_and_can_be_vectorized_by_gymnasium():
    assert {f"wordgaze/{id}" for id in wordgaze.level_ids()} <= set(gymnasium.registry)
    envs = gymnasium.make_vec(f"wordgaze/{ID}", num_envs=3)
    assert isinstance(envs.unwrapped, wordgaze.VectorEnv)
    assert envs.reset(seed=1)[0]["image"].shape == (3, 7, 7, 3)
    envs = gymnasium.make_vec(f"wordgaze/{ID}", num_envs=3, vectorization_mode="sync")
    assert envs.reset(seed=1)[0]["image"].shape == (3, 7, 7, 3)


def test_a_plain_import_registers_and_needs_nothing_but_gymnasium():
    code = (
        "import sys; sys.modules['minigrid'] = sys.modules['torch'] = None\n"
        "import gymnasium, wordgaze\n"
        f"env = gymnasium.make('wordgaze/{ID}'); env.reset(seed=1); env.step(2)\n"
        "try: env.unwrapped.grid\n"
        "except AttributeError as error: print(error)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "pip install minigrid" in done.stdout


def test_observations_are_not_reused():
    env = wordgaze.Env(ID)
    first, _ = env.reset(seed=1)
    before = copy.deepcopy(first)
    env.step(0)
    assert_same_observation(first, before)


@pytest.mark.parametrize("id", [ID, *OTHERS])
@pytest.mark.parametrize("twin", [copy.copy, copy.deepcopy, lambda env: pickle.loads(pickle.dumps(env))])
def test_copies_go_on_alike_and_apart(id, twin):
    env = gymnasium.make(f"wordgaze/{id}", max_steps=25).unwrapped
    env.reset(seed=4)
    play(env, 10)
    other = twin(env)
    once = play(other, seed=1)
    assert_same_play(play(env, seed=1), once)
    assert other.max_steps == 25 and other.spec == env.spec


def test_a_copy_before_the_first_reset():
    other = pickle.loads(pickle.dumps(wordgaze.Env(ID)))
    with pytest.raises(RuntimeError, match="before the first reset"):
        other.step(0)
    assert_same_observation(other.reset(seed=2)[0], wordgaze.Env(ID).reset(seed=2)[0])


def test_states_bring_back_the_world_and_its_random_stream():
    env = wordgaze.Env("MiniGrid-Dynamic-Obstacles-6x6-v0")
    env.reset(seed=4)
    play(env, 5)
    state = env.get_state()
    once = play(env)
    env.set_state(state)
    assert_same_play(play(env), once)
    another = wordgaze.Env("MiniGrid-Dynamic-Obstacles-6x6-v0")
    another.set_state(state)
    assert_same_play(play(another), once)
    with pytest.raises(RuntimeError, match="the state belongs to"):
        wordgaze.Env(ID).set_state(state)
    with pytest.raises(RuntimeError, match="not the state"):
        env.set_state(b"something")


def test_a_state_knows_what_was_drawn_from_np_random():
    env = wordgaze.Env(ID)
    env.reset(seed=4)
    env.np_random.integers(10)
    twin = copy.deepcopy(env)
    state = env.get_state()
    expected = env.np_random.integers(1000, size=5)
    numpy.testing.assert_array_equal(twin.np_random.integers(1000, size=5), expected)
    env.set_state(state)
    numpy.testing.assert_array_equal(env.np_random.integers(1000, size=5), expected)


def test_an_unseeded_environment_says_its_seed():
    env = wordgaze.Env(ID)
    observation, _ = env.reset()
    assert_same_observation(wordgaze.Env(ID).reset(seed=env.np_random_seed)[0], observation)
    assert wordgaze.Env(ID).reset()[0]["mission"] in env.observation_space["mission"]


def test_a_generator_of_one_s_own():
    env, other = wordgaze.Env(ID), wordgaze.Env(ID)
    env.np_random = numpy.random.default_rng(7)
    assert env.np_random_seed == -1
    assert_same_observation(env.reset()[0], other.reset(seed=7)[0])
    with pytest.raises(TypeError, match="expected PCG64"):
        env.np_random = numpy.random.Generator(numpy.random.MT19937(1))


def test_missions_are_a_space():
    space = wordgaze.Env(ID).observation_space["mission"]
    space.seed(1)
    samples = {space.sample() for _ in range(20)}
    assert len(samples) > 5 and all(sample in space for sample in samples)
    assert "go to the nearest pub" not in space and 3 not in space
    assert space == wordgaze.Env(ID).observation_space["mission"]
    assert space != wordgaze.Env("BabyAI-BossLevel-v0").observation_space["mission"]


def test_masks_are_of_actions_that_do_something():
    env = wordgaze.Env("MiniGrid-DoorKey-5x5-v0")
    env.reset(seed=0)
    for _ in range(60):
        masks = env.action_masks()
        assert masks.dtype == bool and masks.shape == (7,)
        for action, effective in enumerate(masks):
            trial = copy.deepcopy(env)
            grid, before = trial.grid.encode(), (trial.agent_pos, trial.agent_dir, trial.carrying)
            _, reward, terminated, _, _ = trial.step(action)
            after = (trial.agent_pos, trial.agent_dir, trial.carrying)
            changed = (grid != trial.grid.encode()).any() or before != after
            assert effective == (changed or terminated or reward != 0)
        if any(env.step(int(env.np_random.integers(7)))[2:4]):
            env.reset()
    assert wordgaze.Env("MiniGrid-Dynamic-Obstacles-6x6-v0").action_space.n == 3


@pytest.mark.parametrize("id", [ID, "BabyAI-PutNextS5N2-v0", "BabyAI-Synth-v0"])
def test_the_expert_succeeds_also_after_others_have_acted(id):
    env = wordgaze.Env(id)
    for seed in range(5):
        env.reset(seed=seed)
        for step in range(env.max_steps):
            advice = env.bot_action()
            if advice is None:
                break
            action = 0 if step % 7 == 3 else advice
            _, reward, terminated, truncated, _ = env.step(action)
            if terminated or truncated:
                break
        assert reward > 0


def test_the_expert_wants_to_watch_from_the_start():
    env = wordgaze.Env(ID)
    env.reset(seed=1)
    env.step(0)
    with pytest.raises(RuntimeError, match="from the start of an episode"):
        env.bot_action()
    with pytest.raises(ValueError):
        empty = wordgaze.Env("MiniGrid-Empty-5x5-v0")
        empty.reset(seed=1)
        empty.bot_action()


def test_completion_tells_what_is_done():
    env = wordgaze.Env("BabyAI-PutNextLocal-v0")
    env.reset(seed=1)
    assert env.completion.tolist() == [0, 0]
    while env.carrying is None:
        env.step(env.bot_action())
    assert env.completion.tolist() == [1, 0]


def test_other_rooms_and_objects():
    env = wordgaze.Env(ID, room_size=12, objects=3)
    env.reset(seed=1)
    assert (env.width, env.height) == (12, 12)
    assert sum(kind in (5, 6, 7) for kind in env.grid.encode()[..., 0].flat) == 3


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: wordgaze.Env("BabyAI-GoToLocl-v0"), "BabyAI-GoToLocal-v0"),
        (lambda: wordgaze.Env(ID, room_size=2), "room_size"),
        (lambda: wordgaze.Env(ID, max_steps=0), "max_steps = 0; expected at least 1"),
        (lambda: wordgaze.Env(ID, render_mode="ansi"), "render_mode = 'ansi'"),
        (lambda: wordgaze.Env(ID).reset(seed=-1), "-1"),
    ],
)
def test_bad_values_are_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()


def test_bad_actions_are_refused_and_change_nothing():
    env = wordgaze.Env(ID)
    env.reset(seed=1)
    for action in (7, -1):
        with pytest.raises(ValueError, match=f"action {action}; expected 0 to 6"):
            env.step(action)
    for action in (1.0, "2", None):
        with pytest.raises(TypeError):
            env.step(action)
    assert env.step_count == 0
