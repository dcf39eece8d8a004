#!/usr/bin/env python3
"""scripts/check_includes on small files."""
import pathlib
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts/check_includes"


class CheckIncludes(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name) / "module"
        self.folder.mkdir()

    def check(self, text, name="a.hpp", *options):
        """What the script says of a file with this text, without the file's name."""
        path = self.folder / name
        path.write_text(text)
        done = subprocess.run([SCRIPT, path, *options], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1 if done.stdout else 0, done.stderr)
        return [line.removeprefix(f"{path}:") for line in done.stdout.splitlines()]

    def test_tells_each_name_once_with_its_first_line_and_its_header(self):
        self.assertEqual(self.check("#include <vector>\n\nstd::vector<int> a{std::max(1, 2)};\n"
                                    "int b = std::max(3, 4);\nIndex c;\n"),
                         ["3: std::max: algorithm", "5: Index: wordgaze/core/types.hpp"])

    def test_any_header_that_declares_the_name_will_do(self):
        for header in ("cstddef", "cstring", "cstdlib"):
            self.assertEqual(self.check(f"#include <{header}>\nstd::size_t n;\n"), [])

    def test_does_not_read_comments_and_text(self):
        self.assertEqual(self.check("// std::vector\n/* std::map\n std::set */ int a = 10'000;\n"
                                    "auto b = \"std::array \\\" std::span\"; char c = '\"';\n"
                                    "auto d = R\"x(std::list \")x\";\nint e = 1'0;\n"), [])

    def test_reads_on_behind_comments_and_text(self):
        self.assertEqual(self.check("char a = '\"'; int b = 10'000; /* \" */ std::map<int, int> c;\n"),
                         ["1: std::map: map"])

    def test_a_source_has_what_its_own_header_includes(self):
        use = "std::string a; std::vector<int> b;\n"
        (self.folder / "a.hpp").write_text("#include <string>\n")
        self.assertEqual(self.check('#include "a.hpp"\n' + use, "a.cpp"), ["2: std::vector: vector"])
        self.assertEqual(len(self.check('#include "a.hpp"\n' + use, "b.cpp")), 2)


if __name__ == "__main__":
    unittest.main()
