"""How scripts/peers and scripts/growth measure: programs in turn, round after round."""
import argparse
import dataclasses
import json
import os
import pathlib
import platform
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = ROOT / "scripts/performance"
DATA = ROOT / "docs/data/performance.json"
SYSTEM_PYTHON = "/usr/bin/python3"  # Debian's, which has Debian's PyTorch and matplotlib
PACKAGES = {"minigrid": "3.2.0", "envpool": "1.2.5"}


class Failure(Exception):
    """What the user is to be told, without a traceback."""


def at_least(kind, least):
    """A type of option."""
    def parse(text):
        value = kind(text)
        if value < least:
            raise argparse.ArgumentTypeError(f"{text}: expected at least {least}")
        return value
    parse.__name__ = kind.__name__
    return parse


def options(description, rounds, seconds):
    parser = argparse.ArgumentParser(description=description,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path,
                        help="where Wordgaze is built (build/release)")
    parser.add_argument("--rounds", default=rounds, type=at_least(int, 1), help=f"({rounds})")
    parser.add_argument("--seconds", default=seconds, type=at_least(float, 0.01),
                        help=f"of one measurement, at least ({seconds})")
    return parser


def main(run):
    try:
        run()
    except Failure as failure:
        sys.exit(f"{pathlib.Path(sys.argv[0]).name}: {failure}")
    except KeyboardInterrupt:
        sys.exit(f"{pathlib.Path(sys.argv[0]).name}: interrupted; nothing was written")


def capture(command, env=None):
    """Standard output of a command that must succeed."""
    command = [str(c) for c in command]
    done = subprocess.run(command, capture_output=True, text=True, env=os.environ | (env or {}))
    if done.returncode != 0:
        raise Failure(f"`{' '.join(command)}` failed:\n{done.stderr.strip() or done.stdout.strip()}")
    return done.stdout


def program(build, name):
    path = build / "bin" / name
    if not path.exists():
        raise Failure(f"{path} is missing; build it first: "
                      "cmake --preset release && cmake --build --preset release")
    return path


def virtual_environment(path):
    """The Python of a virtual environment with PACKAGES."""
    python = path / "bin/python"
    wanted = [f"{name}=={version}" for name, version in PACKAGES.items()]
    missing = "import importlib.metadata as m, sys; " \
              "sys.exit(any(m.version(p.split('==')[0]) != p.split('==')[1] for p in sys.argv[1:]))"
    if not python.exists():
        print(f"making {path}", flush=True)
        capture([SYSTEM_PYTHON, "-m", "venv", path])
    if subprocess.run([python, "-c", missing, *wanted], capture_output=True).returncode != 0:
        print(f"installing {' '.join(wanted)} into {path}", flush=True)
        capture([python, "-m", "pip", "install", "--quiet", *wanted])
    return python


@dataclasses.dataclass
class Task:
    """One program at one piece of work; its last line of output is a JSON object."""
    work: str
    who: str
    unit: str
    command: list
    threads: int = 1
    group: str = ""
    x: float = 0

    def run(self):
        threads = {name: str(self.threads) for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")}
        # Waiting threads sleep: spinning, PyTorch's were two to three times slower in products this small.
        threads["OMP_WAIT_POLICY"] = "PASSIVE"
        return json.loads(capture(self.command, threads).splitlines()[-1])


def progress(text):
    """On the terminal's last line, if there is a terminal."""
    if sys.stdout.isatty():
        print(f"\r\033[K{text}", end="", flush=True)


def measure(tasks, rounds):
    """All tasks in turn, `rounds` times: whatever else the machine does hits all alike."""
    results = [dataclasses.asdict(task) | {"cpu": [], "wall": []} for task in tasks]
    for number in range(rounds):
        for k, (task, result) in enumerate(zip(tasks, results)):
            progress(f"round {number + 1}/{rounds}, {k + 1}/{len(tasks)}: {task.work}, {task.who}")
            line = task.run()
            result["cpu"].append(round(line[task.unit] / line["cpu_seconds"], 1))
            result["wall"].append(round(line[task.unit] / line["wall_seconds"], 1))
            for key in ("median_us", "p99_us"):
                if key in line:
                    result.setdefault(key, []).append(round(line[key], 2))
    progress("")
    for result in results:
        del result["command"]
    return results


def machine(build):
    """What the figures depend on."""
    cpu = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    cache = (build / "CMakeCache.txt").read_text()

    def setting(name):
        found = re.search(rf"^{name}:\w+=(.*)$", cache, re.M)
        return found[1] if found else ""

    flags = [setting("CMAKE_CXX_FLAGS"), setting("CMAKE_CXX_FLAGS_RELEASE"),
             "-march=native" if setting("WORDGAZE_NATIVE") == "ON" else ""]
    try:
        commit = capture(["git", "-C", ROOT, "rev-parse", "--short", "HEAD"]).strip()
        if capture(["git", "-C", ROOT, "status", "--porcelain", "--", ".", ":!docs"]):
            commit += " with changes"
    except Failure:
        commit = "unknown"
    return {"processor": cpu[1] if cpu else platform.processor(),
            "cores": len(os.sched_getaffinity(0)),
            "compiler": capture([setting("CMAKE_CXX_COMPILER"), "--version"]).splitlines()[0],
            "flags": " ".join(f for f in flags if f), "commit": commit}


def command_line():
    return " ".join([f"scripts/{pathlib.Path(sys.argv[0]).name}", *sys.argv[1:]])


def set_up(*packages):
    """Installs Debian's packages of these names where they are missing."""
    print(capture([ROOT / "scripts/setup", *packages]), end="")


def save(section, content):
    """Into docs/data/performance.json; then write the page."""
    data = json.loads(DATA.read_text()) if DATA.exists() else {}
    data[section] = content
    DATA.parent.mkdir(exist_ok=True)
    sections = (f'"{key}": ' + json.dumps(value).replace("}, {", "},\n {")
                for key, value in sorted(data.items()))
    DATA.write_text("{\n" + ",\n".join(sections) + "\n}\n")
    capture([sys.executable, HERE / "page.py"])
