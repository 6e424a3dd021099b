"""Tests adapters/sofa/tools/compare-reader with programs that print what a SOFA and the reader would.

Usage: compare_reader_test.py COMPARE_READER
"""
import json
import os
import stat
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = sys.argv.pop(1)

MODEL = {"name": "/A/model", "type": "TriangleCollisionModel", "elements": 2, "active": True, "moving": True,
         "simulated": True, "selfCollision": False, "groups": [], "contactDistance": 0.1,
         "box": [[0, 0, 0], [1, 1, 1]]}
POINTS = {**MODEL, "name": "/B/points", "type": "PointCollisionModel"}


def sofa_prints(models, pairs, bounded=True):
    found = {"models": [{**model, "bounded": bounded} for model in models], "pipelines": int(bounded),
             "broadPhases": [{"name": "/phase", "pairs": pairs}]}
    return "[INFO] hello\n" + json.dumps(found) + "\n[INFO] goodbye"


def reader_prints(models, pairs, **more):
    former = {"TriangleCollisionModel": "TTriangleModel", "PointCollisionModel": "TPointModel"}
    models = [{**model, "type": former.get(model["type"], model["type"])} for model in models]
    return json.dumps({"models": models, "pairs": pairs, **more})


class CompareReader(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name)
        (self.path / "scenes" / "deep").mkdir(parents=True)

    def program(self, name, outputs):
        """A program that prints what belongs to the scene that it is given, and ends with that status."""
        file = self.path / name
        file.write_text(f"#!{sys.executable}\nimport os, sys, time\nfrom pathlib import Path\n"
                        f"scene = next(Path(a).name for a in sys.argv[1:] if a.endswith('.scn'))\n"
                        f"out, err, status = {outputs!r}[scene]\n"
                        "if out == 'hang': time.sleep(600)\n"
                        "if status < 0: os.kill(os.getpid(), -status)\n"
                        "print(out)\nprint(err, file=sys.stderr)\nsys.exit(status)\n")
        os.chmod(file, file.stat().st_mode | stat.S_IXUSR)
        return file

    @staticmethod
    def parsed(printed):
        return json.loads(printed.splitlines()[1])

    def compare(self, sofa, reader, *options):
        for scene in (self.path / "scenes" / "deep").iterdir():
            scene.unlink()
        for scene in sofa:
            (self.path / "scenes" / "deep" / scene).write_text("<Node/>")
        done = subprocess.run([SCRIPT, "--list-models", self.program("sofa", sofa), "--allpairs",
                               self.program("reader", reader), *options, self.path / "scenes"],
                              capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        return done.returncode, done.stdout

    def verdict(self, sofa, reader):
        status, text = self.compare({"a.scn": (sofa, "", 0)}, {"a.scn": (reader, "", 0)})
        return status, text.splitlines()[2].split(" | ")[-1].removesuffix(" |")

    def test_equal_scenes_are_the_same(self):
        both = [MODEL, POINTS]
        self.assertEqual(self.verdict(sofa_prints(both, [[1, 0]]), reader_prints(both, [[1, 0]])), (0, "same"))

    def test_each_kind_of_difference_is_named(self):
        both, pairs = [MODEL, POINTS], [[1, 0]]
        for key, value, said in (
                ("name", "/A/other", "name `/A/model`, `/A/other`"),
                ("type", "LineCollisionModel", "type `TriangleCollisionModel`, `LineCollisionModel`"),
                ("elements", 3, "`/A/model`: elements 2, 3"),
                ("simulated", False, "`/A/model`: simulated True, False"),
                ("groups", [1], "`/A/model`: groups [], [1]"),
                ("contactDistance", 0.2, "`/A/model`: contactDistance 0.1, 0.2"),
                ("box", [[0, 0, 0], [1, 1, 2]], "`/A/model`: box [0, 0, 0] to [1, 1, 1], [0, 0, 0] to [1, 1, 2]"),
                ("box", None, "`/A/model`: box [0, 0, 0] to [1, 1, 1], none")):
            with self.subTest(key=key):
                changed = [{**MODEL, key: value}, POINTS]
                self.assertEqual(self.verdict(sofa_prints(both, pairs), reader_prints(changed, pairs)),
                                 (1, "DIFFERS in " + said))
        self.assertEqual(self.verdict(sofa_prints(both, pairs), reader_prints([MODEL], [])),
                         (1, "DIFFERS in models 2, 1"))
        self.assertEqual(self.verdict(sofa_prints(both, pairs), reader_prints(both, [[0, 1]])),
                         (1, "DIFFERS in pairs 1, 1"))

    def test_the_last_digits_of_a_box_do_not_count(self):
        close = {**MODEL, "box": [[0, 0, 0], [1, 1, 1.0000000000000002]]}
        self.assertEqual(self.verdict(sofa_prints([MODEL], []), reader_prints([close], [])), (0, "same"))
        empty = {**MODEL, "elements": 0, "box": [["inf"] * 3, ["-inf"] * 3]}
        none = {**MODEL, "elements": 0, "box": None}
        self.assertEqual(self.verdict(sofa_prints([none], []), reader_prints([empty], [])), (0, "same"))

    def test_boxes_may_hold_infinities_and_nans(self):
        odd = {**MODEL, "box": [["nan", 0, "-inf"], ["nan", 1, "inf"]]}
        other = {**MODEL, "box": [["nan", 0, 0], ["nan", 1, "inf"]]}
        self.assertEqual(self.verdict(sofa_prints([odd], []), reader_prints([odd], [])), (0, "same"))
        self.assertEqual(self.verdict(sofa_prints([odd], []), reader_prints([other], [])),
                         (1, "DIFFERS in `/A/model`: box [nan, 0, -inf] to [nan, 1, inf], [nan, 0, 0] to [nan, 1, inf]"))
        self.assertEqual(self.verdict(sofa_prints([odd], []), reader_prints([MODEL], []))[0], 1)

    def test_what_is_no_json_is_said_and_the_table_goes_on(self):
        sofa = {"a.scn": ('{"models": [{"box": [[-nan, 0, 0]]}]}', "", 0), "b.scn": (sofa_prints([MODEL], []), "", 0),
                "c.scn": (sofa_prints([MODEL], []), "", 0)}
        ours = (reader_prints([MODEL], []), "", 0)
        status, text = self.compare(sofa, {"a.scn": ours, "b.scn": ours, "c.scn": ("{", "", 0)})
        self.assertEqual(status, 1)
        self.assertIn("/a.scn |  |  | cannot load: what is listed is no JSON: ", text)
        self.assertIn("/b.scn | 1 | 0 | same |", text)
        self.assertIn("/c.scn | 1 | 0 | FAILS: what the reader prints is no JSON: ", text)

    def test_a_reader_that_neither_reads_nor_refuses_fails(self):
        sofa = (sofa_prints([MODEL], []), "", 0)
        status, text = self.compare({"a.scn": sofa, "b.scn": sofa}, {"a.scn": ("", "usage", 2), "b.scn": ("", "", -11)})
        self.assertEqual(status, 1)
        self.assertIn("/a.scn | 1 | 0 | FAILS: the reader ends with 2: usage |", text)
        self.assertIn("/b.scn | 1 | 0 | FAILS: the reader ends with signal 11 |", text)
        self.assertIn("0 are refused by the reader, and of 2 it fails.", text)
        status, text = self.compare({"a.scn": sofa}, {"a.scn": ("hang", "", 0)}, "--timeout", "5")
        self.assertEqual(status, 1)
        self.assertIn("/a.scn | 1 | 0 | FAILS: more than 5 s |", text)

    def test_nothing_compared_is_an_error_of_its_own(self):
        self.assertEqual(self.compare({"a.scn": ("", "no luck", 1)}, {"a.scn": ("", "", 0)})[0], 2)
        self.assertEqual(self.compare({}, {})[0], 2)

    def test_what_differs_with_a_warning_says_so(self):
        warned = reader_prints([MODEL], [], warnings=[{"reason": "a device moves it"}])
        self.assertEqual(self.verdict(sofa_prints([POINTS], []), warned)[1],
                         "DIFFERS in name `/B/points`, `/A/model` (warned: a device moves it)")

    def test_pairs_without_a_pipeline_and_models_outside_of_all_are_not_compared(self):
        self.assertEqual(self.verdict(sofa_prints([MODEL, POINTS], [], bounded=False),
                                      reader_prints([MODEL, POINTS], [[1, 0]])), (0, "same"))
        found = self.parsed(sofa_prints([MODEL, POINTS], [[1, 1]]))
        found["models"][0]["bounded"] = False
        self.assertEqual(self.verdict(json.dumps(found), reader_prints([POINTS], [[0, 0]])), (0, "same"))

    def test_the_lists_of_several_pipelines_are_compared_one_by_one(self):
        found = self.parsed(sofa_prints([MODEL, POINTS], [[1, 0]]))
        found["broadPhases"].append({"name": "/other", "pairs": [[1, 1], [0, 0]]})
        pipelines = [{"pairs": 2}, {"pairs": 1}]
        models = [MODEL, POINTS]
        same = reader_prints(models, [[1, 1], [0, 0], [1, 0]], pipelines=pipelines)
        self.assertEqual(self.verdict(json.dumps(found), same), (0, "same"))
        other = reader_prints(models, [[0, 0], [1, 1], [1, 0]], pipelines=pipelines)
        self.assertEqual(self.verdict(json.dumps(found), other), (1, "DIFFERS in pairs 3, 3"))

    def test_scenes_that_cannot_be_compared_are_no_difference(self):
        unknown = "[ERROR] Object type {0}<> was not created\nThe component '{0}' cannot be found in the factory."
        sofa = {"drawn.scn": (sofa_prints([MODEL], []), unknown.format("OglModel"), 0),
                "loader.scn": (sofa_prints([], []), unknown.format("MeshOBJLoader"), 0),
                "less.scn": (sofa_prints([MODEL], []), unknown.format("MagicEngine"), 0),
                "none.scn": ("", "list-models: SOFA can't load it", 2),
                "refused.scn": (sofa_prints([MODEL], []), "", 0)}
        ours = (reader_prints([MODEL], []), "", 0)
        reader = {"drawn.scn": ours, "less.scn": ours, "loader.scn": ours, "none.scn": ours,
                  "refused.scn": ("", "allpairs: refused.scn:3: no such mesh", 3)}
        status, text = self.compare(sofa, reader)
        self.assertEqual(status, 0)
        scenes = self.path / "scenes" / "deep"
        self.assertEqual(text, f"""| scene | models | pairs | SOFA, reader |
|---|---|---|---|
| {scenes}/drawn.scn | 1 | 0 | same |
| {scenes}/less.scn | 1 | 0 | same; without MagicEngine |
| {scenes}/loader.scn |  |  | cannot load: this SOFA has no MeshOBJLoader |
| {scenes}/none.scn |  |  | cannot load: list-models: SOFA can't load it |
| {scenes}/refused.scn | 1 | 0 | refused: allpairs: refused.scn:3: no such mesh |

Of 5 scenes this SOFA loads 3; of these 2 are the same, 0 differ, 1 are refused by the reader.
""")

    def test_lists_stand_side_by_side(self):
        status, text = self.compare({"a.scn": (sofa_prints([MODEL], []), "", 0)},
                                    {"a.scn": (reader_prints([MODEL, POINTS], []), "", 0)})
        self.assertEqual(status, 1)
        self.assertIn("| `/A/model` | 2 | 2 | [0, 0, 0] to [1, 1, 1] | [0, 0, 0] to [1, 1, 1] |\n"
                      "| `/B/points` | none | 2 | none | [0, 0, 0] to [1, 1, 1] |", text)


unittest.main()
