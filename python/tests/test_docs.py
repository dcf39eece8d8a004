"""What docs/python.md shows is what happens."""

import doctest
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]


def test_the_page_for_users_of_python(monkeypatch):
    monkeypatch.chdir(ROOT)
    failed, tried = doctest.testfile(str(ROOT / "docs/python.md"), module_relative=False)
    assert tried > 20 and failed == 0
