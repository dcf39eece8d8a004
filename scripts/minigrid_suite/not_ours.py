"""What of Minigrid's suite cannot apply to our environments, and why."""

WAVE_FUNCTION_COLLAPSE = "-WFC-"

_ACTIONS = (
    "it takes an action that the level does not have, which we refuse (the reference takes it for a turn)"
)

#: Of a test, by its name with or without parameters.
REASONS = {
    "test_bot": "Minigrid's expert reads the reference's instructions and rooms; ours, bot_action(), is "
    "compared with it in python/tests/test_reference.py",
    "test_direction_obs_wrapper_directions": "it gives a level the places of agent and goal, which ours do "
    "not take",
    "test_pprint_grid": "it asks for the name of the reference's class; pprint_grid() is compared in "
    "python/tests/test_wrappers.py",
    "test_solvable_env": "it asks for the rooms of the reference's generator, which are not kept",
    **{
        f"test_max_steps_argument[MiniGrid-Dynamic-Obstacles-{size}-v0]": _ACTIONS
        for size in ("5x5", "6x6", "8x8", "16x16", "Random-5x5", "Random-6x6")
    },
}
