"""What Minigrid's tests import as tests.utils and its source distribution leaves out."""

import gymnasium
import numpy
from not_ours import WAVE_FUNCTION_COLLAPSE

_SPECS = [
    spec
    for id, spec in gymnasium.registry.items()
    if id.startswith(("MiniGrid-", "BabyAI-")) and WAVE_FUNCTION_COLLAPSE not in id
]
all_testing_env_specs = _SPECS
minigrid_testing_env_specs = [spec for spec in _SPECS if spec.id.startswith("MiniGrid-")]


def assert_equals(a, b, prefix=""):
    """Compare two values of observations and infos, and the values in them."""
    assert type(a) is type(b), f"{prefix}types {type(a)} and {type(b)}"
    if isinstance(a, dict):
        assert a.keys() == b.keys(), f"{prefix}keys {a.keys()} and {b.keys()}"
        for key in a:
            assert_equals(a[key], b[key], f"{prefix}{key}: ")
    elif isinstance(a, numpy.ndarray):
        numpy.testing.assert_array_equal(a, b, err_msg=prefix)
    elif isinstance(a, tuple):
        assert len(a) == len(b), f"{prefix}lengths {len(a)} and {len(b)}"
        for one, other in zip(a, b):
            assert_equals(one, other, prefix)
    else:
        assert a == b, f"{prefix}{a} and {b}"
