"""Whether a smaller run agrees with docs/data/results.json: each success against where that of one more seed
is to be expected."""
import math
import statistics

from summary import deviation

# 97.5 % quantiles of Student's t for 1, 2, ... degrees of freedom; behind them the normal one.
STUDENT = [12.71, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262]


def expected(rates, episodes):
    """95 % prediction interval for the success of another seed over so many episodes."""
    k, mean = len(rates), statistics.fmean(rates)
    if k < 2:
        return 0.0, 1.0
    variance = statistics.variance(rates) * (1 + 1 / k) + deviation(mean, episodes) ** 2
    half = (STUDENT[k - 2] if k - 2 < len(STUDENT) else 1.96) * math.sqrt(variance)
    return max(0.0, mean - half), min(1.0, mean + half)


def settings_of(data):
    """(row, evaluation, environment, policy) -> setting."""
    return {(row["name"], kind, s["env"], s["policy"]): s for row in data["rows"]
            for kind, settings in row["evaluations"].items() for s in settings}


def compare(smaller, full):
    """How many successes were compared, and a line for each that is not where it was expected."""
    theirs, compared, outside = settings_of(full), 0, []
    for key, setting in settings_of(smaller).items():
        if key not in theirs:
            continue
        for rate in setting["success"]["seeds"]:
            low, high = expected(theirs[key]["success"]["seeds"], setting["episodes"])
            compared += 1
            if not low <= rate <= high:
                row, kind, env, policy = key
                outside.append(f"{row}, {env}, {policy}: {100 * rate:.1f} %, expected "
                               f"{100 * low:.1f} to {100 * high:.1f}")
    return compared, outside
