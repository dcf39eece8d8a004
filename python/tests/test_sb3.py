"""`wordgaze.sb3.VecEnv`, where Stable-Baselines3 is installed."""

import numpy
import pytest

import wordgaze

pytest.importorskip("stable_baselines3")

from stable_baselines3 import PPO  # noqa: E402
from stable_baselines3.common.vec_env import VecMonitor  # noqa: E402

from wordgaze.sb3 import VecEnv  # noqa: E402

ID = "BabyAI-GoToLocal-v0"


def test_steps_as_the_vector_of_gymnasium_and_tells_the_ends():
    ours, plain = VecEnv(ID, 4, max_words=10, max_steps=7, seed=3), wordgaze.make_vec(ID, 4, max_steps=7)
    numpy.testing.assert_array_equal(ours.reset()["image"], plain.reset(seed=3)[0]["image"])
    draw, cut_off = numpy.random.default_rng(0), 0
    for _ in range(30):
        actions = draw.integers(7, size=4)
        observation, rewards, dones, infos = ours.step(actions)
        expected, _, terminated, truncated, ends = plain.step(actions)
        assert observation.keys() == ours.observation_space.spaces.keys()
        numpy.testing.assert_array_equal(observation["image"], expected["image"])
        numpy.testing.assert_array_equal(observation["mission"], expected["mission"][:, :10])
        numpy.testing.assert_array_equal(dones, terminated | truncated)
        for k, info in enumerate(infos):
            assert ("terminal_observation" in info) == dones[k]
            if dones[k]:
                last = info["terminal_observation"]
                numpy.testing.assert_array_equal(last["image"], ends["final_obs"][k]["image"])
                assert last in ours.observation_space
                assert info["TimeLimit.truncated"] == (truncated[k] and not terminated[k])
                cut_off += info["TimeLimit.truncated"]
    assert cut_off > 0


@pytest.mark.parametrize("max_words", [0, 10])
def test_ppo_learns_with_it(max_words):
    envs = VecMonitor(VecEnv("MiniGrid-Empty-5x5-v0", 16, max_words=max_words, seed=1))
    model = PPO("MultiInputPolicy", envs, n_steps=64, batch_size=256, learning_rate=1e-3, seed=1)
    model.learn(15_000)
    assert numpy.mean([episode["r"] for episode in model.ep_info_buffer]) > 0.5


def test_masks():
    contrib = pytest.importorskip("sb3_contrib")
    envs = VecEnv(ID, 3, max_words=10, seed=1)
    envs.reset()
    numpy.testing.assert_array_equal(envs.env_method("action_masks"), envs.action_masks())
    assert len(envs.env_method("action_masks", indices=[1])) == 1
    model = contrib.MaskablePPO("MultiInputPolicy", envs, n_steps=16, batch_size=24)
    model.learn(96)
    with pytest.raises(AttributeError, match="expected 'action_masks'"):
        envs.env_method("fly")
