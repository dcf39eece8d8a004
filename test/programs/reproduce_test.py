#!/usr/bin/env python3
"""scripts/reproduce as a user runs it, on one row with two updates and five episodes.
Usage: reproduce_test.py BUILD, where train and eval are in BUILD/bin."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts" / folder) for folder in ("reproduction", "performance")]
import agreement
import summary
from rows import ROWS

BUILD = pathlib.Path(sys.argv.pop()).resolve()


class Reproduce(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.out = self.folder / "out"

    def reproduce(self, *options, frames=5120):
        return subprocess.run([ROOT / "scripts/reproduce", "--build", BUILD, "--out", self.out,
                               "--seeds", "1", "--frames", str(frames), "--episodes", "5", "--only",
                               "structured", *options], capture_output=True, text=True)

    def succeed(self, *options):
        done = self.reproduce(*options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def times(self):
        return {path: path.stat().st_mtime_ns for path in self.out.rglob("*/1/*")}

    def test_does_nothing_the_second_time(self):
        first = self.succeed()
        self.assertIn("structured, seed 1: train", first)
        self.assertIn("single, seed 1: train", first)  # whose weights it starts from
        self.assertNotIn("single, seed 1: grid", first)  # but nobody asked how it does
        page = (self.out / "docs/results.md").read_text()
        self.assertIn("| structured |", page)
        self.assertTrue((self.out / "docs/data/results/structured.csv.gz").exists())
        for name in re.findall(r"\]\((images/[^)]*)\)", page):
            self.assertLess((self.out / "docs" / name).stat().st_size, 60_000)
        before = self.times()
        self.assertIn("everything is done already", self.succeed())
        self.assertEqual(self.times(), before)
        self.assertEqual((self.out / "docs/results.md").read_text(), page)

        self.succeed("--models")
        evaluated = subprocess.run([BUILD / "bin/eval", "--checkpoint",
                                    self.out / "models/structured.safetensors", "--episodes", "5",
                                    "--json", self.folder / "again.json"],
                                   capture_output=True, text=True)
        self.assertEqual(evaluated.returncode, 0, evaluated.stderr)
        again, full = ((folder / name).read_text().split('"settings"')[1] for folder, name in
                       ((self.folder, "again.json"), (self.out / "structured/1", "own.json")))
        self.assertEqual(again, full)

    def test_begins_again_where_a_step_is_missing(self):
        self.succeed()
        before = self.times()
        missing = self.out / "structured/1/own.json"
        missing.unlink()
        self.succeed()
        changed = {path.name for path, time in self.times().items() if before.get(path) != time}
        self.assertEqual(changed, {"own.json", "own.done.json", "own.log"})

    def test_says_how_a_program_failed(self):
        self.succeed()
        (self.out / "structured/1/checkpoint.safetensors").write_text("spoiled")
        (self.out / "structured/1/own.json").unlink()
        failed = self.reproduce()
        self.assertEqual(failed.returncode, 1)
        self.assertIn("structured, seed 1: own: exit code 1", failed.stderr)
        self.assertIn("not a safetensors file", failed.stderr)

    def test_refuses_folders_of_others_and_other_scales(self):
        self.succeed()
        self.assertIn("another scale", self.reproduce(frames=7680).stderr)
        (self.folder / "mine").mkdir()
        (self.folder / "mine/letter.txt").touch()
        self.out = self.folder / "mine"
        self.assertIn("not of scripts/reproduce", self.reproduce().stderr)

    def test_refuses_a_row_that_does_not_exist_and_a_missing_build(self):
        self.assertIn("no such row", self.reproduce("--only", "singel").stderr)
        self.assertIn("build it first", self.reproduce("--build", self.folder).stderr)


class Rows(unittest.TestCase):
    def test_refer_to_earlier_rows_and_existing_configurations(self):
        seen = set()
        for row in ROWS:
            self.assertNotIn(row.name, seen)
            self.assertTrue((ROOT / "configs" / row.config).exists(), row.config)
            self.assertLessEqual({row.init, row.of} - {""}, seen, row.name)
            seen.add(row.name)


class Statistics(unittest.TestCase):
    def test_interquartile_mean_leaves_out_the_outer_quarters(self):
        self.assertEqual(summary.interquartile_mean([0, 2, 3, 4, 100]), 3)
        self.assertEqual(summary.interquartile_mean([5]), 5)

    def test_interval_holds_the_mean_and_grows_with_few_episodes(self):
        def width(*arguments):
            low, high = summary.interval([0.8, 0.9, 0.85, 0.9, 0.8], *arguments)
            self.assertLess(low, 0.85)
            self.assertGreater(high, 0.85)
            return high - low
        self.assertGreater(width(50), width(1000))
        self.assertGreater(width(1000), width() - 0.005)
        self.assertEqual(summary.interval([0.5], None), [0.5, 0.5])

    def test_kinds_held_out_are_told_from_the_others(self):
        record = {"by_object": {"red ball": {"episodes": 100, "success_rate": 0.5},
                                "blue key": {"episodes": 300, "success_rate": 0.7},
                                "grey box": {"episodes": 50, "success_rate": 0.8}}}
        figures = summary.by_kinds([record], {"red ball", "blue key"})
        self.assertAlmostEqual(figures["held_out"]["mean"], 0.65)
        self.assertAlmostEqual(figures["seen"]["mean"], 0.8)
        self.assertAlmostEqual(figures["ratio"]["mean"], 0.65 / 0.8)
        row = next(row for row in ROWS if row.name == "held-out")
        self.assertEqual(len(summary.held_out(row)), 5)
        self.assertEqual(summary.held_out(ROWS[0]), set())

    def test_thinned_keeps_the_last_row(self):
        rows = summary.thinned(list(range(1001)))
        self.assertLessEqual(len(rows), summary.LARGEST_LOG)
        self.assertEqual(rows[-1], 1000)

    def test_reached_waits_for_enough_episodes(self):
        log = [{"frames": 1000.0 * k, "mean_length": 2.0, "success_rate": 1.0} for k in range(1, 5)]
        self.assertEqual(summary.reached(log, 0.9), [2000, 1000])
        self.assertIsNone(summary.reached(log[:1], 0.9))


class Agreement(unittest.TestCase):
    def data(self, rates):
        setting = {"env": "E", "policy": "greedy", "episodes": 1000, "success": {"seeds": rates}}
        return {"rows": [{"name": "row", "evaluations": {"own": [setting]}}]}

    def test_another_seed_is_expected_near_the_others(self):
        published = self.data([0.90, 0.92, 0.91, 0.93, 0.89])
        self.assertEqual(agreement.compare(self.data([0.95]), published), (1, []))
        compared, outside = agreement.compare(self.data([0.80]), published)
        self.assertEqual((compared, len(outside)), (1, 1))
        self.assertIn("row, E, greedy: 80.0 %", outside[0])
        self.assertEqual(agreement.compare({"rows": []}, published), (0, []))

    def test_seeds_that_are_all_perfect_leave_room_for_chance(self):
        low, high = agreement.expected([1.0] * 5, 1000)
        self.assertTrue(0.99 < low < 0.9985 and high == 1, low)


if __name__ == "__main__":
    unittest.main()
