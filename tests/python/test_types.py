# SPDX-License-Identifier: MIT
"""The package's types, as a type checker reads them."""

import pathlib
import subprocess
import sys

import allpairs
import pytest

PACKAGE = pathlib.Path(allpairs.__file__).parent

USE = """
import numpy as np, numpy.typing as npt
import allpairs
pairs: npt.NDArray[np.uint32] = allpairs.overlaps(np.zeros((2, 3)), np.ones((2, 3)), margin=0.5, threads=0)
number: int = allpairs.count([[0.0] * 6])
for batch in allpairs.batches_between(np.zeros((2, 6)), ([[0, 0, 0]], [[1, 1, 1]]), group=([1, 1], None)):
    print(batch.shape)
name: str = allpairs.load("a.scn")[0].name
wrong: str = allpairs.count([])
"""


def test_the_package_says_that_it_has_types():
    assert (PACKAGE / "py.typed").exists()


def test_a_type_checker_finds_one_error_in_a_program_that_has_one(tmp_path):
    pytest.importorskip("mypy")
    (tmp_path / "use.py").write_text(USE)
    command = [sys.executable, "-m", "mypy", "--strict", f"--cache-dir={PACKAGE.parent}/.mypy_cache", str(tmp_path / "use.py")]
    result = subprocess.run(command, capture_output=True, text=True, check=False, cwd=PACKAGE.parent)
    errors = [line for line in result.stdout.splitlines() if ": error: " in line]
    assert len(errors) == 1, result.stdout  # errors within the package would be here too
    assert "use.py:9: error: Incompatible types" in errors[0]


def test_what_the_package_exports_is_there_and_documented():
    for name in allpairs.__all__:
        assert getattr(allpairs, name).__doc__, name
