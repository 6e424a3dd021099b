# SPDX-License-Identifier: MIT
"""Pairs that the ranks of MPI find are those of one process."""

import os
import pathlib
import subprocess
import sys

import pytest

pytest.importorskip("mpi4py")
MPIRUN = os.environ.get("ALLPAIRS_MPIRUN", "")
pytestmark = pytest.mark.skipif(not MPIRUN, reason="needs a build with MPI")


@pytest.mark.parametrize("ranks", [1, 2, 5])
def test_ranks(ranks):
    script = pathlib.Path(__file__).with_name("mpi_ranks.py")
    command = [MPIRUN, "-n", str(ranks), sys.executable, str(script)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout == "all of it\n"
