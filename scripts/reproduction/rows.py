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
KINDS = Evaluation("kinds", "", 2, 4000)  # of which some 1,100 name what was held out


@dataclasses.dataclass(frozen=True)
class Row:
    name: str
    part: str                 # of the page
    config: str               # in configs/
    init: str = ""            # row whose weights of the same seed to start from
    of: str = ""              # row whose agents are evaluated: nothing is trained
    seeds: tuple = SEEDS
    evaluations: tuple = (OWN,)
    about: str = ""
    model: str = ""           # name in models/
    main: bool = False        # part of --quick


ROWS = [
    Row("single", "grounding", "single.toml", evaluations=(GRID, GAZE, LARGE), main=True,
        model="single-attention", about="attention"),
    Row("baseline", "grounding", "baseline.toml", evaluations=(GRID, GAZE, LARGE), main=True,
        model="single-baseline", about="no attention"),

    Row("structured", "task", "structured.toml", init="single", evaluations=(OWN, GAZE), main=True,
        model="structured", about="attention and task attention"),
    Row("structured-attention", "task", "structured-attention.toml", init="single", main=True,
        about="attention only"),
    Row("structured-baseline", "task", "structured-baseline.toml", init="baseline", main=True,
        about="no attention"),
    Row("structured-places", "task", "structured-places.toml", init="single", evaluations=(OWN, GAZE),
        about="the module reads words place by place"),
    *(Row(name, "task", f"ablations/{name}.toml", init="single", about=about)
      for name, about in {
          "no-mask-loss": "without L_TA",
          "completion-input": "c_t as an input of the memory, no mask",
          "one-rate": "one learning rate",
          "mask-completed": "mask silences completed clauses: the paper's wording",
          "mask-not-enabled": "mask silences also those whose turn has not come",
          "no-half-done": "no half-done starts"}.items()),
    Row("no-pretraining", "task", "ablations/no-pretraining.toml", about="from fresh weights"),

    Row("three-zero-shot", "beyond", "structured-places.toml", of="structured-places",
        evaluations=(THREE, FOUR), about="trained with two clauses"),
    Row("three", "beyond", "three.toml", init="structured-places", evaluations=(THREE, FOUR, GAZE),
        model="three", about="trained with three, from `structured-places`"),
    Row("four", "beyond", "four.toml", init="three", evaluations=(FOUR,),
        about="trained with four, from `three`"),

    Row("held-out", "kinds", "held-out.toml", evaluations=(KINDS,), about="attention"),
    Row("held-out-baseline", "kinds", "held-out-baseline.toml", evaluations=(KINDS,),
        about="no attention"),
    Row("held-out-partial", "kinds", "held-out-partial.toml", evaluations=(KINDS,),
        about="attention, half of the missions by one word"),
    Row("held-out-partial-baseline", "kinds", "held-out-partial-baseline.toml", evaluations=(KINDS,),
        about="no attention, half of the missions by one word"),

    *(Row(level, "babyai", f"babyai/{level}.toml", about=level)
      for level in ("GoToRedBallGrey", "GoToRedBall", "GoToLocal", "PickupLoc")),
    Row("PutNextLocal", "babyai", "babyai/PutNextLocal.toml", model="put-next",
        about="PutNextLocal with the Task Attention Module"),

    *(Row(name, "ablation", f"ablations/{name}.toml", evaluations=(GRID,), about=about)
      for name, about in {
          "single-short": "as it is",
          "no-object-prior": "no prior that words look at objects",
          "no-pickup-first": "both verbs from the start",
          "no-balance": "verbs not balanced",
          "no-stretch": "no rooms that seem larger",
          "no-huddle": "no objects huddled around the target",
          "no-gaze-floor": "s(M) = (M / max M)^2, no floor",
          "entropy-base-e": "natural logarithm in the entropies",
          "gaze-exponent-1": "s(M) with p = 1",
          "leaky-encoder": "leaky ReLU in the encoder (0.1)",
          "relu-encoder": "plain ReLU in the encoder"}.items()),
    Row("single-3x3", "ablation", "single-3x3.toml", evaluations=(GRID, GAZE),
        about="encoder of two 3x3 convolutions, 2M frames"),
]
