"""`wordgaze.VectorEnv`: Gymnasium's vector interface."""

import pickle
import threading
import time

import gymnasium
import numpy
import pytest
from conftest import make_reference, quietly
from gymnasium.vector import AutoresetMode, SyncVectorEnv

import wordgaze

ID = "BabyAI-GoToLocal-v0"
N = 6


def missions_as_tokens(missions, width):
    rows = [wordgaze.tokens(mission) for mission in missions]
    return numpy.array([row + [0] * (width - len(row)) for row in rows], numpy.uint8)


def assert_same_batch(ours, reference):
    numpy.testing.assert_array_equal(ours["image"], reference["image"])
    numpy.testing.assert_array_equal(ours["direction"], reference["direction"])
    tokens = missions_as_tokens(reference["mission"], ours["mission"].shape[1])
    numpy.testing.assert_array_equal(ours["mission"], tokens)


@pytest.mark.parametrize(
    "id", [ID, "BabyAI-GoToSeqS5R2-v0", "MiniGrid-Dynamic-Obstacles-6x6-v0", "MiniGrid-DoorKey-5x5-v0"]
)
@pytest.mark.parametrize("threads", [1, 3])
def test_is_a_sync_vector_env_of_the_reference(id, threads):
    settings = {"max_steps": 17}
    reference = quietly(
        SyncVectorEnv,
        [lambda: make_reference(id, **settings)] * N,
        autoreset_mode=AutoresetMode.SAME_STEP,
    )
    ours = wordgaze.make_vec(id, N, threads, **settings)
    assert ours.metadata["autoreset_mode"] == reference.metadata["autoreset_mode"]
    assert ours.action_space == reference.action_space
    assert ours.observation_space["image"] == reference.observation_space["image"]
    assert ours.observation_space["direction"] == reference.observation_space["direction"]
    assert_same_batch(ours.reset(seed=9)[0], quietly(reference.reset, seed=9)[0])
    draw, ends = numpy.random.default_rng(1), 0
    for _ in range(60):
        actions = draw.integers(ours.single_action_space.n, size=N)
        mine, theirs = ours.step(actions), quietly(reference.step, actions)
        assert_same_batch(mine[0], theirs[0])
        assert mine[0] in ours.observation_space
        for a, b in zip(mine[1:4], theirs[1:4]):
            assert a.dtype == b.dtype
            numpy.testing.assert_array_equal(a, b)
        assert mine[4].keys() == theirs[4].keys()
        if "final_obs" in theirs[4]:
            numpy.testing.assert_array_equal(mine[4]["_final_obs"], theirs[4]["_final_obs"])
            assert mine[4]["final_info"] == theirs[4]["final_info"]
            numpy.testing.assert_array_equal(mine[4]["_final_info"], theirs[4]["_final_info"])
            for a, b in zip(mine[4]["final_obs"], theirs[4]["final_obs"]):
                assert (a is None) == (b is None)
                if b is not None:
                    ends += 1
                    assert a in ours.single_observation_space
                    numpy.testing.assert_array_equal(a["image"], b["image"])
                    assert a["direction"] == b["direction"]
                    tokens = missions_as_tokens([b["mission"]], ours.max_words)[0]
                    numpy.testing.assert_array_equal(a["mission"], tokens)
    assert ends > N


def test_seeds_as_a_list_and_some_environments_alone():
    reference = SyncVectorEnv([lambda: make_reference(ID)] * N, autoreset_mode=AutoresetMode.SAME_STEP)
    ours = wordgaze.make_vec(ID, N)
    seeds = [5, 2**70, 1, 0, 3, 8]
    assert_same_batch(ours.reset(seed=seeds)[0], quietly(reference.reset, seed=seeds)[0])
    mask = numpy.array([True, False, False, True, False, True])
    mine, _ = ours.reset(seed=21, options={"reset_mask": mask})
    theirs, _ = quietly(reference.reset, seed=21, options={"reset_mask": mask})
    assert_same_batch(mine, theirs)
    assert_same_batch(ours.reset()[0], quietly(reference.reset)[0])
    with pytest.raises(ValueError, match="reset_mask"):
        ours.reset(options={"reset_mask": numpy.zeros(N, bool)})
    with pytest.raises(ValueError, match="2 seeds for 6 environments"):
        ours.reset(seed=[1, 2])


def test_arrays_that_were_returned_do_not_change_and_are_the_simulator_s():
    envs = wordgaze.make_vec(ID, N, max_steps=5)
    envs.reset(seed=1)
    kept, copies = [], []
    for _ in range(12):
        observation, rewards, *_ = envs.step(numpy.full(N, 2))
        for array in (*observation.values(), rewards):
            kept.append(array)
            copies.append(array.copy())
    for array, copy in zip(kept, copies):
        numpy.testing.assert_array_equal(array, copy)


def test_missions_are_the_same_tensor_until_one_changes():
    envs = wordgaze.make_vec(ID, N, max_steps=5)
    observation, _ = envs.reset(seed=1)
    tensor, text = observation["mission"], envs.missions()
    for _ in range(4):
        observation, _, _, truncated, _ = envs.step(numpy.zeros(N, int))
        assert observation["mission"] is tensor and not truncated.any()
    observation, _, _, truncated, infos = envs.step(numpy.zeros(N, int))
    assert truncated.all() and observation["mission"] is not tensor
    numpy.testing.assert_array_equal(tensor, missions_as_tokens(text, envs.max_words))
    assert envs.missions() != text
    assert envs.mission_lengths.tolist() == [len(wordgaze.tokens(m)) for m in envs.missions()]
    with pytest.raises(ValueError, match="read-only"):
        observation["mission"][0, 0] = 1


def test_a_mission_that_does_not_fit_is_refused():
    with pytest.raises(ValueError, match="more than max_words = 3"):
        wordgaze.make_vec(ID, N, max_words=3).reset(seed=1)


def test_states_and_pickle():
    envs = wordgaze.make_vec("MiniGrid-Dynamic-Obstacles-6x6-v0", N, max_steps=20)
    envs.reset(seed=2)
    twin = pickle.loads(pickle.dumps(envs))
    state = envs.get_state()
    actions = numpy.random.default_rng(1).integers(3, size=(30, N))
    runs = []
    for env in (envs, twin, envs):
        runs.append([env.step(a)[:4] for a in actions])
        envs.set_state(state)
    for run in runs[1:]:
        for (one, *rest), (other, *others) in zip(runs[0], run):
            for key in one:
                numpy.testing.assert_array_equal(one[key], other[key])
            numpy.testing.assert_array_equal(rest, others)
    assert envs.observe()["mission"].any()


def test_masks_are_those_of_the_environments():
    id = "BabyAI-UnlockPickup-v0"
    envs = wordgaze.make_vec(id, N)
    envs.reset(seed=4)
    draw = numpy.random.default_rng(0)
    alone = [wordgaze.Env(id) for _ in range(N)]
    for _ in range(20):
        envs.step(draw.integers(7, size=N))
        for env, state in zip(alone, envs.get_state()):
            env.set_state(state)
        numpy.testing.assert_array_equal(envs.action_masks(), [env.action_masks() for env in alone])


def test_frames_are_those_of_the_environments():
    envs = wordgaze.make_vec(ID, 2, render_mode="rgb_array")
    envs.reset(seed=4)
    for k, frame in enumerate(envs.render()):
        env = wordgaze.Env(ID, render_mode="rgb_array")
        env.reset(seed=4 + k)
        numpy.testing.assert_array_equal(frame, env.render())
    assert wordgaze.make_vec(ID, 2).render() is None


def test_wrappers_of_gymnasium():
    envs = gymnasium.wrappers.vector.RecordEpisodeStatistics(wordgaze.make_vec(ID, N, max_steps=5))
    envs.reset(seed=1)
    for _ in range(5):
        *_, infos = envs.step(envs.action_space.sample() * 0)
    assert infos["episode"]["l"].tolist() == [5] * N


def test_other_threads_of_python_run_meanwhile():
    envs = wordgaze.make_vec("BabyAI-BossLevel-v0", 2000)
    envs.reset(seed=0)
    ticks, stop = [], threading.Event()

    def tick():
        while not stop.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.0005)

    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.perf_counter()
    envs.reset(seed=1)
    end = time.perf_counter()
    stop.set()
    thread.join()
    assert sum(begin < t < end for t in ticks) > 3


@pytest.mark.parametrize(
    ("actions", "error", "message"),
    [
        (numpy.full(N, 7), ValueError, "action 7 of environment 0; expected 0 to 6"),
        (numpy.full(N, -1), ValueError, "action -1 of environment 0"),
        (numpy.zeros(N - 1, int), ValueError, "5 actions for 6 environments"),
        (numpy.zeros(N), TypeError, "float64; expected integers"),
    ],
)
def test_bad_actions_are_refused(actions, error, message):
    envs = wordgaze.make_vec(ID, N)
    before, _ = envs.reset(seed=1)
    with pytest.raises(error, match=message):
        envs.step(actions)
    numpy.testing.assert_array_equal(envs.observe()["image"], before["image"])


@pytest.mark.parametrize("kind", [numpy.int8, numpy.uint8, numpy.int32, numpy.int64, list])
def test_actions_of_any_type_of_integer(kind):
    envs = wordgaze.make_vec(ID, N)
    envs.reset(seed=1)
    actions = [2, 0, 1, 2, 2, 1]
    envs.step(actions if kind is list else numpy.array(actions, kind))


@pytest.mark.parametrize(("size", "threads"), [(0, 1), (-1, 1), (4, 0)])
def test_sizes_that_make_no_sense_are_refused(size, threads):
    with pytest.raises(ValueError):
        wordgaze.make_vec(ID, size, threads)
