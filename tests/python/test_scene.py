# SPDX-License-Identifier: MIT
"""Files: scenes, meshes, folders and box arrays."""

import errno
import json
import os
import pathlib

import allpairs
import numpy as np
import pytest
from conftest import every_pair, random_boxes

EXAMPLES = pathlib.Path(__file__).parents[2] / "examples"
SCENE = EXAMPLES / "scenes" / "demo.scn"
DATA = pathlib.Path(os.environ.get("ALLPAIRS_DATA", pathlib.Path(__file__).parents[3] / "shared" / "data"))
assert "ALLPAIRS_DATA" not in os.environ or DATA.is_dir(), f"ALLPAIRS_DATA is no folder: {DATA}"


def test_a_scene_has_models_with_boxes_and_flags():
    scene = allpairs.load(SCENE)
    assert scene.boxes.shape == (len(scene), 6)
    assert scene.boxes.dtype == np.float64
    assert scene[0] == allpairs.Model("/Hall/Floor/Concrete", "TTriangleModel", 2, True, False, False, False, (), 0.0)
    assert scene[-1].name == scene.names[-1]
    assert scene.method == "MinProximityIntersection"
    assert scene.region.shape == (2, 3)
    with pytest.raises(IndexError):
        scene[len(scene)]


def test_a_scene_s_pairs_are_verified_and_come_newest_first():
    scene = allpairs.load(SCENE)
    pairs = scene.detect(verify=True)
    assert len(pairs) == 40
    assert (pairs[:, 0] >= pairs[:, 1]).all()
    assert (np.diff(pairs[:, 0].astype(int)) >= 0).all()
    np.testing.assert_array_equal(scene.detect(strategy="exhaustive"), pairs)
    np.testing.assert_array_equal(scene.detect(threads=2), pairs)


def test_a_distance_and_a_region_hold_for_one_detection():
    scene = allpairs.load(SCENE)
    before = scene.detect()
    assert len(scene.detect(distance=1.0)) > len(before)
    assert len(scene.detect(region=[[-1, -1, -1], [0, 0, 0]])) < len(before)
    np.testing.assert_array_equal(scene.detect(), before)


@pytest.mark.parametrize("region", [[0, 0, 0, 0, 1, 1], [[2, 0, 0], [1, 1, 1]], [0, 0, 0, 1, 1, np.nan]])
def test_a_region_has_min_below_max_whatever_the_file_holds(tmp_path, region):
    np.save(tmp_path / "boxes.npy", np.array([[0.0, 0, 0, 1, 1, 1]]))
    messages = set()
    for path in (SCENE, tmp_path / "boxes.npy"):
        with pytest.raises(allpairs.InvalidArgument, match="the region box does not have min < max on the .") as raised:
            allpairs.load(path).detect(region=region)
        messages.add(str(raised.value))
    assert len(messages) == 1


def test_boxes_with_min_above_max_are_warned_of(tmp_path):
    (tmp_path / "boxes.csv").write_text("a,0,0,0,1,1,1\nb,0,2,0,1,1,1\n3,0,2,0,1,1,1\nd,inf,0,0,-inf,1,1\n")
    warning = allpairs.Remark(
        str(tmp_path / "boxes.csv"), 0, "box 1 'b'", "min above max on y (and 1 other box): empty, in no pair", False
    )
    scene = allpairs.load(tmp_path / "boxes.csv")
    assert (scene.warnings, scene.remarks) == ([warning], [])
    np.save(tmp_path / "boxes.npy", np.array([[0.0, 0, 0, 1, 1, 1]]))
    assert allpairs.load(tmp_path / "boxes.npy").warnings == []


def test_search_roots_are_folders(tmp_path):
    for root in (tmp_path / "none", SCENE):
        with pytest.raises(allpairs.FileError, match="is not a folder; search_roots takes folders") as raised:
            allpairs.load(SCENE, search_roots=[tmp_path, root])
        assert raised.value.filename == str(root)
    assert len(allpairs.load(SCENE, search_roots=tmp_path)) > 0


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("order", ["C", "F"])
def test_a_file_of_boxes_is_its_array(tmp_path, dtype, order):
    lower, upper = random_boxes(200, dtype=dtype)
    rows = np.hstack([lower, upper])
    np.save(tmp_path / "boxes.npy", np.asarray(rows, order=order))
    scene = allpairs.load(tmp_path / "boxes.npy")
    assert scene.boxes.dtype == dtype
    np.testing.assert_array_equal(scene.boxes, rows)
    expected = every_pair(lower, upper)
    expected = expected[np.lexsort((expected[:, 0], expected[:, 1]))][:, ::-1]
    for threads in (1, 2):
        np.testing.assert_array_equal(scene.detect(threads=threads), expected)
        np.testing.assert_array_equal(scene.detect(threads=threads, verify=True), expected)


def test_boxes_of_a_file_live_as_long_as_their_array(tmp_path):
    np.save(tmp_path / "boxes.npy", np.arange(12.0).reshape(2, 6))
    boxes = allpairs.load(str(tmp_path / "boxes.npy")).boxes
    np.testing.assert_array_equal(boxes, np.arange(12.0).reshape(2, 6))
    with pytest.raises(ValueError):
        boxes[0, 0] = 1
    np.save(tmp_path / "none.npy", np.empty((0, 6)))
    assert not allpairs.load(tmp_path / "none.npy").boxes.flags.writeable


def test_detect_names_the_pairs():
    detection = allpairs.detect(EXAMPLES / "boxes.csv")
    assert detection.names == [("lamp", "table"), ("chair", "table")]


def test_a_folder_of_meshes_is_a_scene():
    scene = allpairs.load(EXAMPLES / "scenes" / "meshes")
    assert len(scene) > 1
    assert len(set(scene.names)) == len(scene)


def test_a_missing_file_is_named():
    with pytest.raises(allpairs.FileError) as caught:
        allpairs.load("no/such/thing.scn")
    assert caught.value.path == caught.value.filename == "no/such/thing.scn"
    assert (caught.value.errno, caught.value.strerror) == (errno.ENOENT, os.strerror(errno.ENOENT))
    assert str(caught.value) == "no/such/thing.scn: no such file or folder"


def test_a_file_that_the_system_does_not_open_has_its_number(tmp_path):
    (tmp_path / "loop.csv").symlink_to("loop.csv")
    (tmp_path / "nowhere.csv").symlink_to("nothing.csv")
    (tmp_path / "file").write_text("")
    (tmp_path / "folder.npy").mkdir()
    for name, number in (
        ("loop.csv", errno.ELOOP),
        ("nowhere.csv", errno.ENOENT),
        ("file/boxes.csv", errno.ENOENT),
        ("x" * 300 + ".csv", errno.ENAMETOOLONG),
    ):
        with pytest.raises(OSError) as caught:
            allpairs.load(tmp_path / name)
        assert (type(caught.value), caught.value.errno) == (allpairs.FileError, number), name
    with pytest.raises(allpairs.FileError, match="is a folder") as caught:
        allpairs.join(tmp_path / "folder.npy")
    assert caught.value.errno == errno.EISDIR
    (tmp_path / "bad.csv").write_text("1,2,3\n")
    with pytest.raises(allpairs.FileError) as caught:
        allpairs.load(tmp_path / "bad.csv")
    assert (caught.value.errno, caught.value.filename) == (None, str(tmp_path / "bad.csv"))


def test_a_malformed_scene_names_its_line(tmp_path):
    (tmp_path / "bad.scn").write_text('<Node>\n<Node name="a" name=b/>\n</Node>\n')
    with pytest.raises(OSError, match="bad.scn:2") as caught:
        allpairs.detect(tmp_path / "bad.scn")
    assert caught.value.line == 2


@pytest.mark.skipif(not DATA.is_dir(), reason=f"no data in {DATA}")
def test_scenes_of_sofa_give_the_pairs_that_sofa_printed():
    checked = 0
    for answer in sorted((DATA / "scenes" / "expected").glob("*.json")):
        expected = json.loads(answer.read_text())
        path = next((DATA / "scenes").rglob(answer.stem + ".scn"))
        scene = allpairs.load(path, search_roots=[DATA / "scenes", DATA / "scenes" / "examples"])
        assert scene.detect().tolist() == expected["pairs"], answer.stem
        checked += 1
    assert checked


@pytest.mark.skipif(not DATA.is_dir(), reason=f"no data in {DATA}")
def test_box_arrays_give_the_pairs_of_the_double_loop():
    checked = 0
    for answer in sorted((DATA / "boxes").glob("*.pairs.npy")):
        boxes = np.load(answer.with_name(answer.name.replace(".pairs.npy", ".npy")))
        np.testing.assert_array_equal(allpairs.overlaps(boxes), np.load(answer))
        checked += 1
    assert checked


def spheres(node, *places):
    return f"<Node name='{node}'><CollisionPipeline/><BruteForceDetection/>" + "".join(
        f"<Node><MechanicalObject position='{x} 0 0'/><SphereCollisionModel name='s'/></Node>" for x in places
    ) + "</Node>"


def test_each_pipeline_of_a_scene_pairs_its_own_models(tmp_path):
    path = tmp_path / "two.scn"
    path.write_text(f"<Node name='root'>{spheres('a', 0, 1)}{spheres('b', 0, 1, 2)}</Node>")
    scene = allpairs.load(path)
    assert scene.warnings == []
    assert scene.boxes.shape == (5, 6)
    assert np.isfinite(scene.boxes).all()
    assert scene.detect(verify=True).tolist() == [[1, 0], [3, 2], [4, 2], [4, 3]]
    assert scene.detect(distance=-0.5).tolist() == [[1, 0], [3, 2], [4, 3]]


def test_a_scene_without_a_pipeline_warns(tmp_path):
    path = tmp_path / "none.scn"
    path.write_text("<Node name='root'><MechanicalObject/><Point/></Node>")
    scene = allpairs.load(path)
    assert [(warning.file, warning.line) for warning in scene.warnings] == [(str(path), 1)]
    assert scene.remarks == []
    assert scene.names == ["/tPointModel1"]
    for version in ("26.12", "22.06", "24.12.00", "v25.06"):
        assert allpairs.load(path, sofa=version).names == ["/PointCollisionModel1"]
    for version in ("20.06", "19.12", "v17.06"):
        assert allpairs.load(path, sofa=version).names == ["/tPointModel1"]
    with pytest.raises(ValueError, match="26.12"):
        allpairs.load(path, sofa="27.06")


def test_errors_name_arguments_and_not_options_of_the_command(tmp_path):
    path = tmp_path / "gone.scn"
    loader = "<MeshOBJLoader name='l' filename='gone.obj'/><MechanicalObject src='@l'/><PointCollisionModel/>"
    path.write_text(f"<Node name='root'>{loader}</Node>")
    with pytest.raises(allpairs.FileError, match="nowhere to be found; search_roots says where else to look"):
        allpairs.load(path)
    with pytest.raises(allpairs.FileError, match="which is what max_memory allows"):
        allpairs.load(path, max_memory=1)
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (tmp_path / "gear.step").write_text("")
    with pytest.raises(allpairs.FileError, match="glTF, STL or OBJ; partial leaves it out$"):
        allpairs.load(tmp_path)
    (tmp_path / "more").mkdir()
    reasons = [remark.reason for remark in allpairs.load(tmp_path, partial=True).remarks]
    assert "is a folder; folders within a folder are not searched without recursive" in reasons
    assert not any("--" in reason for reason in reasons)


def test_names_and_errors_of_files_that_are_no_utf8_show_their_bytes(tmp_path):
    row = b"Tor\xe9,0,0,0,1,1,1\n"
    path = tmp_path / "boxes.csv"
    path.write_bytes(row + row)
    assert allpairs.load(path).names == ["Tor\\xe9", "Tor\\xe9"]
    path.write_bytes(b"Tor\xe9,0,0,0,1,x,1\n")
    with pytest.raises(allpairs.FileError):
        allpairs.load(path)
    with pytest.raises(allpairs.FileError, match="missing"):
        allpairs.load(bytes(tmp_path) + b"/missing\xff.csv")


UGLY = b"a\n\x1b[31m\x7f\xc2\x85\xe9\xc3\xa9\\"
SHOWN = "a\\x0a\\x1b[31m\\x7f\\xc2\\x85\\xe9é\\"


def test_errors_of_files_show_control_characters_and_bytes_of_names_on_one_line(tmp_path):
    folder = bytes(tmp_path) + b"/" + UGLY
    os.mkdir(folder)
    with open(folder + b"/none.ply", "w") as file:
        file.write("x")
    for call in (
        lambda: allpairs.load(folder + b"/none"),
        lambda: allpairs.load(SCENE, search_roots=[folder + b"/none"]),
        lambda: allpairs.detect(folder, partial=True),
    ):
        with pytest.raises(allpairs.FileError) as caught:
            call()
        assert str(caught.value).startswith(f"{tmp_path}/{SHOWN}")
        assert os.fsencode(caught.value.path).startswith(folder)


def test_a_scene_of_which_nothing_is_left_is_an_error(tmp_path):
    scene = tmp_path / "none.scn"
    scene.write_text(
        '<Node><MeshOBJLoader name="l" filename="none.obj"/><MeshTopology src="@l"/>'
        '<MechanicalObject src="@l"/><TriangleCollisionModel/></Node>'
    )
    with pytest.raises(allpairs.FileError, match="none.scn: no model of it can be placed or read"):
        allpairs.detect(scene, partial=True)
    assert [remark.is_partial for remark in allpairs.load(scene, partial=True).remarks] == [True]


def test_an_index_of_no_model_is_an_index_error():
    scene = allpairs.load(SCENE)
    assert scene[-1] == scene[len(scene) - 1]
    for index in (len(scene), -len(scene) - 1, 2**70):
        with pytest.raises(IndexError, match="there is no model"):
            scene[index]
    with pytest.raises(TypeError, match="index is 1.0"):
        scene[1.0]


def test_a_folder_is_read_with_those_within_it_where_that_is_asked_for(tmp_path):
    (tmp_path / "within").mkdir()
    for name in ("roof.obj", "within/wall.obj"):
        (tmp_path / name).write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert len(allpairs.load(tmp_path)) == 1
    assert len(allpairs.load(tmp_path, recursive=True)) == 2
    assert allpairs.detect(tmp_path, recursive=True).names == [("wall.obj", "roof.obj")]
