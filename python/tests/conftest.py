"""What the tests share: the reference, and comparisons with it."""

import contextlib
import io
import pathlib
import warnings

import gymnasium
import numpy
import pytest

import wordgaze

warnings.filterwarnings("ignore", module="pygame")
MODELS = pathlib.Path(__file__).resolve().parents[2] / "models"

with contextlib.redirect_stdout(io.StringIO()):
    import minigrid  # noqa: F401  registers its ids


def reference_ids():
    """The ids that both know."""
    return [id for id in wordgaze.level_ids() if id in gymnasium.registry]


def quietly(call, *args, **kwargs):
    """The reference prints a line for each layout that it rejects."""
    with contextlib.redirect_stdout(io.StringIO()):
        return call(*args, **kwargs)


def make_reference(id, **settings):
    return quietly(gymnasium.make, id, disable_env_checker=True, **settings).unwrapped


def assert_same_observation(ours, reference):
    assert ours.keys() == reference.keys()
    for key, theirs in reference.items():
        mine = ours[key]
        if isinstance(theirs, numpy.ndarray):
            assert mine.dtype == theirs.dtype
            numpy.testing.assert_array_equal(mine, theirs, err_msg=key)
        else:
            assert mine == theirs, key


@pytest.fixture
def model():
    """The file of an agent that follows one instruction in a room."""
    return MODELS / "single-attention.safetensors"
