#!/usr/bin/env python3
"""Programs in the documents are those that are built: a block of code below a comment with the name of a
file is that file."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^<!-- ([\w./-]+) -->\n```\w*\n(.*?)^```$", re.M | re.S)


class Docs(unittest.TestCase):
    def test_programs_are_those_that_are_built(self):
        blocks = 0
        for page in sorted((ROOT / "docs").glob("*.md")):
            for name, code in BLOCK.findall(page.read_text(encoding="utf-8")):
                blocks += 1
                with self.subTest(page=page.name, file=name):
                    self.assertEqual(code, (ROOT / name).read_text(encoding="utf-8"))
        self.assertGreaterEqual(blocks, 1)


if __name__ == "__main__":
    unittest.main()
