"""Tests adapters/sofa/tools/compare-scenes with a program that prints what sofa-trace-scene would.

Usage: compare_scenes_test.py COMPARE_SCENES
"""
import os
import stat
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = sys.argv.pop(1)
OURS, STOCK = "AllpairsBroadPhase", "BruteForceBroadPhase"

# Prints for the given broad phase, or else the scene's own, what `lists` has for it: the pair of each run in turn, or
# the status with which it ends, or "hang".
TRACE = """#!{python}
import sys, time
from pathlib import Path
own, lists = {own!r}, {lists!r}
given = sys.argv[sys.argv.index("--broad-phase") + 1] if "--broad-phase" in sys.argv else own
count = Path({folder!r}) / given
runs = int(count.read_text()) if count.exists() else 0
count.write_text(str(runs + 1))
what = lists[given][min(runs, len(lists[given]) - 1)]
if what == "hang" or isinstance(what, int):
    print("class", given, "/phase", flush=True)
if what == "hang":
    time.sleep(600)
if isinstance(what, int):
    print("no luck", file=sys.stderr)
    sys.exit(what)
if what:
    print("class", {made!r}.get(given, given), "/phase")
    print("step 0 /phase: 1 pairs")
    print("pair", what)
print("models 2")
"""


class CompareScenes(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name)

    def verdict(self, lists, own=STOCK, made=None, timeout=60):
        """The status and the last cell of the table for a scene whose own broad phase is of that class."""
        for count in (OURS, STOCK):
            (self.path / count).unlink(missing_ok=True)
        program = self.path / "trace"
        program.write_text(TRACE.format(python=sys.executable, own=own, lists=lists, folder=str(self.path),
                                        made=made or {}))
        os.chmod(program, program.stat().st_mode | stat.S_IXUSR)
        done = subprocess.run([SCRIPT, "--trace", program, "--timeout", str(timeout), "a.scn"],
                              capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        return done.returncode, done.stdout.splitlines()[2].split(" | ")[-1].removesuffix(" |")

    def test_equal_runs_are_the_same(self):
        self.assertEqual(self.verdict({STOCK: ["/a /b"], OURS: ["/a /b"]}), (0, "same"))

    def test_a_scene_that_has_ours_is_compared_with_the_stock_one(self):
        self.assertEqual(self.verdict({STOCK: ["/a /b"], OURS: ["/a /b"]}, own=OURS),
                         (0, f"same; compared with {STOCK}"))
        self.assertEqual(self.verdict({STOCK: ["/a /b"], OURS: ["/a /c"]}, own=OURS),
                         (1, f"DIFFERS; compared with {STOCK}"))

    def test_a_broad_phase_that_was_not_replaced_fails(self):
        self.assertEqual(self.verdict({STOCK: ["/a /b"], OURS: ["/a /b"]}, made={OURS: STOCK}),
                         (1, "FAILS: its broad phase was not replaced"))

    def test_runs_that_differ_are_repeated_without_ours(self):
        self.assertEqual(self.verdict({STOCK: ["/a /b"], OURS: ["/a /c"]}), (1, "DIFFERS"))
        self.assertEqual(self.verdict({STOCK: ["/a /b", "/a /d"], OURS: ["/a /c"]}),
                         (0, "two runs without it differ as well"))
        self.assertEqual(self.verdict({STOCK: ["/a /b", "hang"], OURS: ["/a /c"]}, timeout=5),
                         (1, "DIFFERS; repeated without it: more than 5 s"))
        self.assertEqual(self.verdict({STOCK: ["/a /b", 3], OURS: ["/a /c"]}),
                         (1, "DIFFERS; repeated without it: no luck"))

    def test_what_ends_without_ours_must_end_with_it(self):
        self.assertEqual(self.verdict({STOCK: ["/a /b"], OURS: [3]}), (1, "FAILS: no luck"))
        self.assertEqual(self.verdict({STOCK: ["/a /b"], OURS: ["hang"]}, timeout=5), (1, "FAILS: more than 5 s"))

    def test_a_scene_that_has_ours_must_end_with_it(self):
        for what, said in ((3, "no luck"), ("hang", "more than 5 s")):
            self.assertEqual(self.verdict({STOCK: ["/a /b"], OURS: [what]}, own=OURS, timeout=5),
                             (1, f"FAILS: {said}; compared with {STOCK}"))

    def test_nothing_compared_is_an_error_of_its_own(self):
        self.assertEqual(self.verdict({STOCK: [3], OURS: ["/a /b"]}), (2, "does not run without it: no luck"))
        self.assertEqual(self.verdict({STOCK: ["hang"], OURS: ["/a /b"]}, timeout=5),
                         (2, "does not run without it: more than 5 s"))
        self.assertEqual(self.verdict({STOCK: [""], OURS: [""]}), (2, "has no broad phase that runs"))


unittest.main()
