"""`wordgaze.Policy`: a trained agent from Python."""

import numpy
import pytest
from conftest import MODELS

import wordgaze

ONE_ROOM = "Wordgaze-One-N8-K4-v0"


def episode(policy, env, seed, sample=False):
    """Whether the agent succeeds, and its decisions."""
    observation, _ = env.reset(seed=seed)
    policy.begin(observation["mission"])
    decisions, ended, reward = [], False, 0
    while not ended:
        decisions.append(policy.act(observation["image"], env.completion, sample=sample))
        observation, reward, terminated, truncated, _ = env.step(decisions[-1].action)
        ended = terminated or truncated
    return reward > 0, decisions


@pytest.mark.parametrize(
    ("name", "id"),
    [("single-attention", ONE_ROOM), ("structured", "Wordgaze-Two-N10-K4-v0")],
)
def test_agents_follow_instructions(name, id):
    policy, env = wordgaze.Policy(MODELS / f"{name}.safetensors"), wordgaze.Env(id)
    assert sum(episode(policy, env, seed)[0] for seed in range(40)) >= 39


def test_a_decision_says_where_the_agent_looked(model):
    policy, env = wordgaze.Policy(model), wordgaze.Env(ONE_ROOM)
    assert policy.has_attention
    _, decisions = episode(policy, env, seed=1)
    for decision in decisions:
        words = len(decision.words)
        assert " ".join(decision.words) == env.mission
        assert decision.probabilities.shape == (7,)
        assert decision.action == decision.probabilities.argmax()
        assert decision.log_prob == pytest.approx(numpy.log(decision.probabilities.max()), abs=1e-5)
        p = decision.probabilities[decision.probabilities > 0]
        assert decision.entropy == pytest.approx(-(p * numpy.log(p)).sum(), abs=1e-4)
        assert decision.weights.shape == decision.mask.shape == (words,)
        assert decision.weights.sum() == pytest.approx(1, abs=1e-5)
        assert decision.maps.shape == (words, 7, 7)
        assert decision.gaze.shape == decision.filter.shape == (7, 7)
        assert decision.gaze.sum() + decision.nowhere == pytest.approx(1, abs=1e-4)
        assert 0 <= decision.value <= 1.1


def test_maps_lie_as_the_view(model):
    """While the object that is meant is in view, the agent looks at it."""
    policy, env = wordgaze.Policy(model), wordgaze.Env(ONE_ROOM)
    hits = seen = 0
    for seed in range(30):
        observation, _ = env.reset(seed=seed)
        policy.begin(observation["mission"])
        *_, color, kind = observation["mission"].split()
        if kind not in wordgaze.OBJECT_TYPES or color not in wordgaze.COLORS:
            continue
        meant = [wordgaze.OBJECT_TYPES.index(kind), wordgaze.COLORS.index(color)]
        places = (observation["image"][..., :2] == meant).all(axis=-1)
        if not places.any():
            continue
        seen += 1
        gaze = policy.act(observation["image"]).gaze
        hits += places[numpy.unravel_index(gaze.argmax(), gaze.shape)]
    assert seen >= 5 and hits >= 0.9 * seen


def test_the_memory_goes_on_until_the_next_mission(model):
    policy, env = wordgaze.Policy(model), wordgaze.Env(ONE_ROOM)
    first, again = (
        [d.value for d in episode(policy, env, seed=3)[1]] for _ in range(2)
    )
    assert first == again
    observation, _ = env.reset(seed=3)
    policy.begin(observation["mission"])
    values = {policy.act(observation["image"]).value for _ in range(3)}
    assert len(values) == 3


def test_actions_are_drawn_from_the_seed(model):
    env = wordgaze.Env(ONE_ROOM)
    draws = [
        [d.action for d in episode(wordgaze.Policy(model, seed=s), env, 5, sample=True)[1]]
        for s in (1, 1)
    ]
    assert draws[0] == draws[1]
    policy, drawn = wordgaze.Policy(model), [0] * 7
    for _ in range(2000):
        policy.begin("go to the ball")
        decision = policy.act(numpy.full((7, 7, 3), (1, 0, 0), numpy.uint8), sample=True)
        drawn[decision.action] += 1
    numpy.testing.assert_allclose(numpy.array(drawn) / 2000, decision.probabilities, atol=0.05)


def test_fewer_actions(model):
    policy = wordgaze.Policy(model)
    policy.begin("go to the red ball", actions=3)
    decision = policy.act(numpy.zeros((7, 7, 3), numpy.uint8))
    assert decision.probabilities.shape == (3,) and decision.action < 3


def test_an_agent_without_attention_has_no_maps():
    policy = wordgaze.Policy(MODELS / "single-baseline.safetensors")
    assert not policy.has_attention
    policy.begin("go to the red ball")
    decision = policy.act(numpy.zeros((7, 7, 3), numpy.uint8))
    assert decision.gaze.size == decision.maps.size == decision.weights.size == 0


def test_an_agent_of_rooms_without_doors_is_told_when_it_shall_meet_some(model):
    view = numpy.full((7, 7, 3), (1, 0, 0), numpy.uint8)
    view[3, 2] = wordgaze.OBJECT_TYPES.index("door"), wordgaze.COLORS.index("blue"), 1
    policy = wordgaze.Policy(model)
    policy.begin("go to the red ball")
    with pytest.raises(ValueError, match="not among the 21 codes"):
        policy.act(view)
    policy = wordgaze.Policy(model, level="wordgaze/BabyAI-UnlockLocal-v0")
    policy.begin("go to the red ball")
    assert policy.act(view).action in range(7)


def test_bad_input_is_refused(model, tmp_path):
    with pytest.raises(RuntimeError, match="absent.safetensors"):
        wordgaze.Policy(tmp_path / "absent.safetensors")
    policy = wordgaze.Policy(model)
    view = numpy.zeros((7, 7, 3), numpy.uint8)
    with pytest.raises(ValueError, match="begin"):
        policy.act(view)
    with pytest.raises(ValueError, match="not in the vocabulary: 'pub'"):
        policy.begin("go to the pub")
    policy.begin("go to the red ball")
    with pytest.raises(ValueError, match="cell 0 of the view"):
        policy.act(view + 99)
    with pytest.raises(TypeError):
        policy.act(numpy.zeros((5, 5, 3), numpy.uint8))
    with pytest.raises(ValueError, match=r"completion\[0\] is 2"):
        policy.act(view, [2])
    with pytest.raises(ValueError, match="expected at most"):
        policy.act(view, [0] * 40)
