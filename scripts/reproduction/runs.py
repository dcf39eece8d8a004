"""What has to be done for the rows, what is done already, and doing the rest: a step is one training or one
evaluation of one seed, in the folder of that seed, and its record says how it was made."""
import dataclasses
import json
import pathlib
import shlex
import subprocess
import sys
import time
import tomllib

from measure import ROOT, Failure
from rows import Row

STAMP = "reproduce.json"
FRAMES_PER_SECOND, EPISODES_PER_SECOND = 15_000, 2500  # until something was measured
LAST_LINES = 8


@dataclasses.dataclass(frozen=True)
class Scale:
    """How much of the full work is done; None leaves what the row says."""
    seeds: int | None = None
    frames: int | None = None
    episodes: int | None = None

    @property
    def full(self):
        return self == Scale()


@dataclasses.dataclass(frozen=True)
class Step:
    row: Row
    seed: int
    kind: str        # "train", or the name of the evaluation
    folder: pathlib.Path
    arguments: tuple  # of the program, without --threads
    needs: tuple      # records of other steps
    work: float       # frames or weighted episodes

    @property
    def program(self):
        return "train" if self.kind == "train" else "eval"

    @property
    def title(self):
        return f"{self.row.name}, seed {self.seed}: {self.kind}"

    @property
    def record(self):
        return self.folder / f"{self.kind}.done.json"

    @property
    def result(self):
        return self.folder / ("checkpoint.safetensors" if self.kind == "train" else f"{self.kind}.json")

    def finished(self):
        """The record of the finished step, or None."""
        if not (self.record.exists() and self.result.exists()):
            return None
        made = self.record.stat().st_mtime_ns
        if self.program == "eval" and any(n.exists() and n.stat().st_mtime_ns > made
                                          for n in self.needs):
            return None  # the agent was trained anew
        record = json.loads(self.record.read_text())
        if record["arguments"] != list(self.arguments):
            raise Failure(f"{self.record} was made with other settings:\n"
                          f"  there  {self.program} {shlex.join(record['arguments'])}\n"
                          f"  here   {self.program} {shlex.join(self.arguments)}\n"
                          f"delete {self.folder} to make it anew, or give another --out")
        return record

    def state(self):
        if self.finished():
            return "done"
        return "begun" if self.kind == "train" and self.result.exists() else "to do"

    def seconds(self, pace):
        return self.work / pace[self.program]

    def command(self, build, threads):
        command = [build / "bin" / self.program, *self.arguments, "--threads", threads]
        if self.state() == "begun":
            command.append("--resume")
        return [str(c) for c in command]


def frames_of(row):
    """What the row trains for."""
    return tomllib.loads((ROOT / "configs" / row.config).read_text())["frames"]


def seeds_of(row, scale):
    return row.seeds[:scale.seeds]


def relative(path):
    """From the root of the repository, if it lies there: records name no folder of one machine."""
    path = path.resolve()
    return str(path.relative_to(ROOT)) if path.is_relative_to(ROOT) else str(path)


def steps_of(row, seed, out, scale):
    folder = out / row.name / str(seed)
    agent = out / (row.of or row.name) / str(seed)
    steps = []
    if not row.of:
        arguments = ["--config", f"configs/{row.config}"]
        frames, needs = frames_of(row), ()
        arguments += ["--out", relative(folder), "--seed", str(seed)]
        if scale.frames:
            frames = min(frames, scale.frames)
            arguments += ["--frames", str(frames)]
        if row.init:
            arguments += ["--init", relative(out / row.init / str(seed) / "checkpoint.safetensors")]
            needs = (out / row.init / str(seed) / "train.done.json",)
        steps.append(Step(row, seed, "train", folder, tuple(arguments), needs, frames))
    for evaluation in row.evaluations:
        episodes = min(evaluation.episodes, scale.episodes or evaluation.episodes)
        arguments = ("--checkpoint", relative(agent / "checkpoint.safetensors"),
                     *evaluation.options.split(), "--episodes", str(episodes), "--json",
                     relative(folder / f"{evaluation.name}.json"))
        steps.append(Step(row, seed, evaluation.name, folder, arguments, (agent / "train.done.json",),
                          episodes * evaluation.settings * evaluation.cost))
    return steps


def plan(rows, out, scale):
    return [step for row in rows for seed in seeds_of(row, scale)
            for step in steps_of(row, seed, out, scale)]


def with_needed(chosen, rows):
    """The chosen rows and those whose weights they start from, in the order of the table."""
    names, table = set(), {row.name: row for row in rows}

    def add(name):
        if name not in names:
            names.add(name)
            for other in (table[name].init, table[name].of):
                if other:
                    add(other)
    for row in chosen:
        add(row.name)
    return [row for row in rows if row.name in names]


def pace_of(steps):
    """Work a second of each program, from what is done."""
    pace = {"train": FRAMES_PER_SECOND, "eval": EPISODES_PER_SECOND}
    for program in pace:
        done = [(s.work, r["seconds"]) for s in steps
                if s.program == program and (r := s.finished())]
        if done:
            pace[program] = sum(w for w, _ in done) / max(1e-9, sum(s for _, s in done))
    return pace


def claim(out, scale):
    """Makes the folder ours; refuses one that holds something else, or work of another scale."""
    stamp, mine = out / STAMP, dataclasses.asdict(scale)
    if stamp.exists():
        theirs = json.loads(stamp.read_text())
        if theirs != mine:
            raise Failure(f"{out} holds runs of another scale ({theirs}, here {mine}); give another --out")
        return
    if out.exists() and (not out.is_dir() or any(out.iterdir())):
        raise Failure(f"{out} holds files that are not of scripts/reproduce; give another --out")
    out.mkdir(parents=True, exist_ok=True)
    stamp.write_text(json.dumps(mine) + "\n")


def duration(seconds):
    minutes = round(seconds / 60)
    return f"{minutes // 60} h {minutes % 60:02} min" if minutes >= 60 else \
        f"{minutes} min" if seconds >= 90 else f"{seconds:.0f} s"


class Failed(Exception):
    """A program ended with an error."""


class Runner:
    def __init__(self, build, threads, jobs):
        self.build, self.threads, self.jobs = build, threads, jobs
        self.running = {}  # process -> (step, when it began, seconds of interrupted attempts)

    def start(self, step):
        step.folder.mkdir(parents=True, exist_ok=True)
        command = step.command(self.build, self.threads)
        spent = step.folder / f"{step.kind}.spent"  # seconds of interrupted attempts
        before = float(spent.read_text()) if spent.exists() and "--resume" in command else 0.0
        with open(step.folder / f"{step.kind}.log", "a" if "--resume" in command else "w") as log:
            process = subprocess.Popen(command, cwd=ROOT, stdout=log, stderr=log,
                                       stdin=subprocess.DEVNULL)
        self.running[process] = (step, time.monotonic(), before)

    def finish(self, process):
        """The step that the process was, recorded if it went well."""
        step, began, before = self.running.pop(process)
        seconds = before + time.monotonic() - began
        if process.returncode != 0 or not step.result.exists():
            (step.folder / f"{step.kind}.spent").write_text(f"{seconds:.1f}")
            log = step.folder / f"{step.kind}.log"
            # Progress rewrites its line: only what is left of each on a terminal is worth showing.
            lines = [line.split("\r")[-1] for line in log.read_text(errors="replace").split("\n")]
            last = "\n".join(f"    {line}" for line in [l for l in lines if l.strip()][-LAST_LINES:])
            raise Failed(f"{step.title}: exit code {process.returncode}; {log} ends with\n{last}")
        step.record.write_text(json.dumps({"arguments": step.arguments, "threads": self.threads,
                                           "seconds": round(seconds, 1)}) + "\n")
        return step

    def stop(self):
        """train saves what it has when it is asked to end."""
        for process in self.running:
            process.terminate()
        for process in list(self.running):
            process.wait()
            try:
                self.finish(process)
            except Failed:
                pass

    def run(self, steps):
        """Runs what is not done, in order, each when what it needs is; returns the failures."""
        pending = [step for step in steps if not step.finished()]
        total, failures = len(pending), []
        if not total:
            print("everything is done already", flush=True)
        try:
            while pending or self.running:
                ready = [s for s in pending if all(n.exists() for n in s.needs)]
                for step in ready[:self.jobs - len(self.running)]:
                    pending.remove(step)
                    self.start(step)
                if not self.running:  # what is left waits for something that failed
                    break
                ended = [p for p in self.running if p.poll() is not None]
                for process in ended:
                    try:
                        step = self.finish(process)
                    except Failed as failure:
                        failures.append(str(failure))
                        print(f"failed: {failure}", file=sys.stderr, flush=True)
                        continue
                    seconds = json.loads(step.record.read_text())["seconds"]
                    left = [*pending, *(s for s, _, _ in self.running.values())]
                    pace = pace_of(steps)
                    rest = sum(s.seconds(pace) for s in left) / self.jobs
                    print(f"[{total - len(left)}/{total}] {step.title}, {duration(seconds)}; "
                          f"about {duration(rest)} left", flush=True)
                if not ended:
                    time.sleep(0.05)
        except KeyboardInterrupt:
            self.stop()
            raise
        return failures + [f"{s.title}: not begun, for it needs {n}" for s in pending
                           for n in s.needs if not n.exists()]
