# SPDX-License-Identifier: MIT
"""What is alive when Python ends neither stops nor kills the process."""

import subprocess
import sys

import pytest

SCRIPTS = {
    "batches": "found = allpairs.batches(boxes, batch_size=3); next(found)",
    "batches of two sets": "found = allpairs.batches_between(boxes, boxes, batch_size=3); next(found)",
    "batches that nobody asked for": "found = allpairs.batches(boxes, batch_size=3)",
    "world": "world = allpairs.World(); world.add(boxes); world.step()",
    "meshes": "meshes = allpairs.MeshCandidates([[0, 1, 2]], 3)",
    "search": """
class Searches:
    def __del__(self, search=allpairs.overlaps, boxes=np.arange(1_200_000.0).reshape(-1, 6)):
        print(len(search(boxes)), flush=True)
searches = Searches()
""",
    "search of few": """
class Searches:
    def __del__(self, search=allpairs.overlaps, boxes=boxes):
        print(len(search(boxes)), flush=True)
searches = Searches()
""",
}


@pytest.mark.parametrize("script", SCRIPTS.values(), ids=SCRIPTS.keys())
@pytest.mark.parametrize("end", ["", "\nsys.exit(0)", "\nimport threading; threading.Timer(0.01, sys.exit).start()"])
def test_python_ends(script, end):
    code = "import sys\nimport numpy as np\nimport allpairs\nboxes = np.zeros((9, 6))\n" + script + end
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stderr) == (0, "")
    assert len(done.stdout.splitlines()) == script.count("print")


def test_an_exception_among_batches_ends_python_as_others_do():
    code = "import numpy as np, allpairs\nfor batch in allpairs.batches(np.zeros((9, 6)), batch_size=3): raise ValueError(len(batch))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 1 and done.stderr.endswith("ValueError: 3\n")


def test_searches_of_daemon_threads_end_with_python():
    code = """
import threading, time
import numpy as np
import allpairs

boxes = np.random.default_rng(1).random((3000, 6))
boxes[:, 3:] += boxes[:, :3]

def search():
    while True:
        allpairs.overlaps(boxes)
        for batch in allpairs.batches(boxes[:50], batch_size=10):
            pass

for _ in range(4):
    threading.Thread(target=search, daemon=True).start()
time.sleep(0.1)
"""
    for _ in range(10):
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
        assert (done.returncode, done.stderr) == (0, "")


def test_a_sub_interpreter_is_told_that_it_cannot():
    interpreters = pytest.importorskip("_xxsubinterpreters")
    if not hasattr(interpreters, "run_string"):
        pytest.skip("this Python runs no code in a sub-interpreter")
    code = "import _xxsubinterpreters as i\ni.run_string(i.create(), 'import allpairs')"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 1
    assert "allpairs works in the main interpreter of a process only" in done.stderr
