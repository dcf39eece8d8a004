"""What of Minigrid's suite cannot apply to our environments, and why."""

WAVE_FUNCTION_COLLAPSE = "-WFC-"

#: Of a test, by its name with or without parameters.
REASONS: dict[str, str] = {}
