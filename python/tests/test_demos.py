"""`wordgaze.demos`: demonstrations of the expert."""

import numpy
import pytest
from conftest import make_reference, quietly

import wordgaze

ID = "BabyAI-PutNextLocal-v0"


def test_demonstrations_are_episodes_that_succeed():
    shown = wordgaze.demos(ID, 5, seed=3)
    assert len(shown) == 5 and shown.starts[-1] == len(shown.actions)
    reference = make_reference(ID)
    for episode in range(len(shown)):
        at = shown.steps(episode)
        observation, _ = quietly(reference.reset, seed=shown.seeds[episode])
        assert observation["mission"] == shown.missions[episode]
        for t in range(at.start, at.stop):
            numpy.testing.assert_array_equal(observation["image"], shown.images[t])
            assert observation["direction"] == shown.directions[t]
            observation, *rest, _ = reference.step(shown.actions[t])
            assert rest == [shown.rewards[t], shown.terminated[t], shown.truncated[t]]
        assert shown.terminated[at.stop - 1] and shown.rewards[at.stop - 1] > 0
        numpy.testing.assert_array_equal(observation["image"], shown.final_images[episode])


def test_other_rooms():
    assert wordgaze.demos("BabyAI-GoToLocal-v0", 2, room_size=12, max_steps=100).settings == {
        "max_steps": 100
    }


def test_a_level_without_instructions_is_refused():
    with pytest.raises(ValueError):
        wordgaze.demos("MiniGrid-Empty-5x5-v0", 1)


def test_minari(tmp_path, monkeypatch):
    pytest.importorskip("minari")
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path))
    shown = wordgaze.demos(ID, 3)
    dataset = shown.to_minari("wordgaze/put-next-local-v0", algorithm_name="expert")
    assert dataset.total_episodes == 3 and dataset.total_steps == len(shown.actions)
    for k, episode in enumerate(dataset.iterate_episodes()):
        numpy.testing.assert_array_equal(episode.actions, shown.actions[shown.steps(k)])
        numpy.testing.assert_array_equal(episode.observations["image"][:-1], shown.images[shown.steps(k)])
        assert episode.observations["mission"][0] == shown.missions[k]
