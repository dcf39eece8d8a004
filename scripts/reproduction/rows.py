"""The experiments of docs/results.md, as data: a row is one configuration, trained with each seed and
evaluated. To add one, add a line."""
import dataclasses

SEEDS = (1, 2, 3, 4, 5)
FEW = SEEDS[:3]  # of what is compared, not claimed


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
CROWDED = Evaluation("gaze", "--rooms 8 --objects 4,12 --transparency", 4, 300, 20)
THREE = Evaluation("three", "--env Wordgaze-Three-N10-K4-v0", 2, cost=3)
FOUR = Evaluation("four", "--env Wordgaze-Four-N10-K4-v0", 2, cost=4)
SIX = Evaluation("six", "--env Wordgaze-Six-N10-K8-v0", 2, cost=8)
EIGHT = Evaluation("eight", "--env Wordgaze-Eight-N10-K8-v0", 2, cost=12)
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
    Row("single", "grounding", "single.toml", evaluations=(GRID, CROWDED, LARGE), main=True,
        model="single-attention", about="attention"),
    Row("baseline", "grounding", "baseline.toml", evaluations=(GRID, GAZE, LARGE), main=True,
        model="single-baseline", about="no attention"),

    Row("paper", "grounding", "paper.toml", evaluations=(GRID, GAZE),
        about="attention as the paper has it"),

    Row("structured", "task", "structured.toml", init="single", evaluations=(OWN, GAZE), main=True,
        model="structured", about="attention and task attention"),
    Row("structured-attention", "task", "structured-attention.toml", init="single", main=True,
        about="attention only"),
    Row("structured-baseline", "task", "structured-baseline.toml", init="baseline", main=True,
        about="no attention"),
    Row("task-reader-sum", "task", "ablations/task-reader-sum.toml", init="single",
        evaluations=(OWN, GAZE), about="the module reads the sum of the words: the paper's"),
    *(Row(name, "task", f"ablations/{name}.toml", init="single", seeds=FEW, about=about)
      for name, about in {
          "no-mask-loss": "without L_TA",
          "completion-input": "c_t as an input of the memory, no mask",
          "one-rate": "one learning rate",
          "mask-completed": "mask silences completed clauses: the paper's wording",
          "mask-not-enabled": "mask silences also those whose turn has not come",
          "no-half-done": "no half-done starts"}.items()),
    Row("no-pretraining", "task", "ablations/no-pretraining.toml", seeds=FEW, about="from fresh weights"),

    Row("more-clauses", "beyond", "structured.toml", of="structured",
        evaluations=(THREE, FOUR, SIX, EIGHT), about="trained with one and two clauses"),

    *(Row(name, "kinds", f"{name}.toml", evaluations=(KINDS,), about=about)
      for name, about in {
          "held-out": "attention",
          "held-out-b": "attention, five other kinds",
          "held-out-c": "attention, five other kinds",
          "held-out-d": "attention, five other kinds",
          "held-out-types": "attention, red balls and red boxes",
          "held-out-colors": "attention, red, green and blue balls",
          "held-out-baseline": "no attention"}.items()),

    *(Row(level, "babyai", f"babyai/{level}.toml", about=level)
      for level in ("GoToRedBallGrey", "GoToRedBall", "GoToLocal", "PickupLoc")),
    Row("PutNextLocal", "babyai", "babyai/PutNextLocal.toml", seeds=FEW, model="put-next",
        about="PutNextLocal with the Task Attention Module"),

    *(Row(name, "ablation", f"ablations/{name}.toml", evaluations=(GRID,), seeds=FEW, about=about)
      for name, about in {
          "single-short": "as it is",
          "no-object-prior": "no prior that objects are looked at",
          "no-pickup-first": "both verbs from the start",
          "no-balance": "verbs not balanced",
          "no-stretch": "no rooms that seem larger",
          "no-huddle": "no objects huddled around the target",
          "gaze-sum": "the paper's sum of maps",
          "no-focus": "a gaze that stays soft",
          "no-word-choice": "words of type and color at the same time",
          "no-score-cost": "scores that cost nothing",
          "no-gaze-floor": "no floor of s(M)",
          "leaky-encoder": "leaky ReLU in the encoder (0.1)",
          "relu-encoder": "plain ReLU in the encoder"}.items()),
    Row("single-3x3", "ablation", "single-3x3.toml", evaluations=(GRID, GAZE),
        about="encoder of two 3x3 convolutions, sum of maps, 2M frames"),
]
