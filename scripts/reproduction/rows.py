"""The experiments of docs/results.md, as data: a row is one configuration, trained with each seed and
evaluated. To add one, add a line."""
import dataclasses

SEEDS = (1, 2, 3, 4, 5)


@dataclasses.dataclass(frozen=True)
class Evaluation:
    name: str       # of its file in the folder of the run
    options: str    # of eval
    settings: int   # rooms times policies
    episodes: int = 1000
    cost: float = 1.0  # of an episode, against one of "own"


OWN = Evaluation("own", "", 2)  # where it was trained, sampled and greedy
GRID = Evaluation("grid", "--rooms 8,10,12 --objects 4,6,8,10,12", 30)
GAZE = Evaluation("gaze", "--sample --transparency", 1, 300, 20)
THREE = Evaluation("three", "--env Wordgaze-Three-N10-K4-v0", 2, cost=3)
FOUR = Evaluation("four", "--env Wordgaze-Four-N10-K4-v0", 2, cost=4)
LARGE = Evaluation("large", "--env Wordgaze-One-N16-K16-v0", 2, cost=4)


@dataclasses.dataclass(frozen=True)
class Row:
    name: str
    part: str                 # the section of the page
    config: str               # in configs/, or empty for the defaults
    set: str = ""             # overrides, as for --set
    init: str = ""            # row whose weights of the same seed to start from
    of: str = ""              # row whose agents are evaluated: nothing is trained
    seeds: tuple = SEEDS
    evaluations: tuple = (OWN,)
    about: str = ""
    model: str = ""           # name in models/
    main: bool = False        # part of --quick


# Levels of BabyAI as they are: no done actions, and no curriculum, which would change their missions.
PLAIN = "curriculum.pickup_first=false curriculum.balance=false curriculum.stretch=0 curriculum.huddle=0"


def babyai(level, frames):
    return Row(level, "babyai", "", f"env=BabyAI-{level}-v0 frames={frames} {PLAIN}")


ROWS = [
    Row("single", "grounding", "single.toml", evaluations=(GRID, GAZE, LARGE), main=True,
        model="single-attention", about="attention"),
    Row("baseline", "grounding", "baseline.toml", evaluations=(GRID, GAZE, LARGE), main=True,
        model="single-baseline", about="no attention"),
    Row("single-3x3", "grounding", "single-3x3.toml", evaluations=(GRID, GAZE),
        about="encoder of two 3x3 convolutions"),
    *(Row(name, "grounding", "single.toml", change, evaluations=(GRID,), about=f"`{change}`")
      for name, change in {
          "no-object-prior": "model.object_prior=0",
          "no-pickup-first": "curriculum.pickup_first=false",
          "no-balance": "curriculum.balance=false",
          "no-stretch": "curriculum.stretch=0",
          "no-huddle": "curriculum.huddle=0",
          "no-gaze-floor": "model.gaze_floor=0",
          "entropy-base-e": "model.entropy_base=2.718281828",
          "gaze-exponent-1": "model.gaze_exponent=1",
          "no-encoder-leak": "model.encoder_leak=0"}.items()),

    Row("structured", "task", "structured.toml", init="single", evaluations=(OWN, GAZE), main=True,
        model="structured", about="attention and task attention"),
    Row("structured-attention", "task", "structured-attention.toml", init="single", main=True,
        about="attention only"),
    Row("structured-baseline", "task", "structured-baseline.toml", init="baseline", main=True,
        about="no attention"),
    Row("places", "task", "structured.toml", "model.task_places=true", init="single",
        evaluations=(OWN, GAZE), about="`model.task_places=true`"),
    Row("no-pretraining", "task", "ablations/no-pretraining.toml", about="from fresh weights"),
    *(Row(name, "task", f"ablations/{name}.toml", init="single", about=about)
      for name, about in {
          "no-mask-loss": "without L_TA",
          "completion-input": "c_t as an input of the memory, no mask",
          "one-rate": "one learning rate",
          "mask-completed": "mask silences completed clauses: the paper's wording",
          "mask-not-enabled": "mask silences also those whose turn has not come",
          "no-half-done": "no half-done starts"}.items()),

    Row("three-zero-shot", "beyond", "structured.toml", of="places", evaluations=(THREE, FOUR),
        about="trained with two clauses"),
    Row("three", "beyond", "three.toml", init="places", evaluations=(THREE, FOUR, GAZE), model="three",
        about="trained with three, from `places`"),
    Row("four", "beyond", "four.toml", init="three", evaluations=(FOUR,),
        about="trained with four, from `three`"),

    babyai("GoToRedBallGrey", 2_000_000),
    babyai("GoToRedBall", 2_000_000),
    babyai("GoToLocal", 5_000_000),
    babyai("PickupLoc", 5_000_000),
    babyai("PutNextLocal", 10_000_000),
]
