"""One random stream for the simulator and for whoever asks for `np_random`."""

from __future__ import annotations

import numpy

_LOW = 2**64 - 1

#: As `Environment.random_state` of the core has it.
CoreState = tuple


def to_numpy(state: CoreState) -> dict:
    """Return the state of a PCG64 of NumPy's."""
    state_high, state_low, increment_high, increment_low, has_half, half = state
    return {
        "bit_generator": "PCG64",
        "state": {
            "state": state_high << 64 | state_low,
            "inc": increment_high << 64 | increment_low,
        },
        "has_uint32": int(has_half),
        "uinteger": half,
    }


def from_numpy(generator: numpy.random.Generator) -> CoreState:
    """Return the core's state of the same stream. Raises TypeError for a generator of another kind."""
    state = generator.bit_generator.state
    if state["bit_generator"] != "PCG64":
        raise TypeError(f"np_random: a generator of kind {state['bit_generator']}; expected PCG64")
    value, increment = state["state"]["state"], state["state"]["inc"]
    return (
        value >> 64,
        value & _LOW,
        increment >> 64,
        increment & _LOW,
        bool(state["has_uint32"]),
        state["uinteger"],
    )
