# SPDX-License-Identifier: MIT
"""Bad input is a ValueError that names what is wrong."""

import copy
import errno
import os
import pickle

import allpairs
import numpy as np
import pytest

BOXES = np.zeros((4, 6))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_a_nan_names_its_box(dtype):
    lower, upper = np.zeros((5, 3), dtype), np.ones((5, 3), dtype)
    upper[3, 1] = np.nan
    with pytest.raises(ValueError, match="^box 3: max y") as caught:
        allpairs.overlaps(lower, upper)
    assert isinstance(caught.value, allpairs.InvalidBox)
    assert caught.value.index == 3


def test_a_nan_of_one_of_two_sets_names_the_set():
    bad = BOXES.copy()
    bad[2, 0] = np.nan
    with pytest.raises(allpairs.InvalidBox, match="^second set: box 2") as caught:
        allpairs.overlaps_between(BOXES, bad)
    assert caught.value.index == 2


def test_corners_in_a_list_are_told_to_be_a_tuple():
    corners = [np.zeros((4, 3)), np.ones((4, 3))]
    with pytest.raises(allpairs.InvalidArgument, match=r"^second set: boxes are a list of two arrays; .* a tuple \(lower, upper\)"):
        allpairs.overlaps_between(BOXES, corners)
    assert allpairs.count_between(BOXES[:2], [np.zeros(6), np.ones(6)]) == 2  # rows are rows, in a list too


def test_fields_are_told_how_to_become_rows():
    from numpy.lib.recfunctions import structured_to_unstructured

    table = np.ones(3, dtype=[(name, np.float32) for name in ("minx", "miny", "minz", "maxx", "maxy", "maxz")])
    with pytest.raises(allpairs.InvalidArgument, match="^lower has fields, minx, miny, .*structured_to_unstructured"):
        allpairs.overlaps(table)
    assert allpairs.count(structured_to_unstructured(table)) == 3


@pytest.mark.parametrize("count", [0, 3])
def test_records_are_no_integers(count):
    records, boxes = np.zeros(count, "i4,i4"), BOXES[:count]
    for name, call in {
        "group": lambda: allpairs.overlaps(boxes, group=records),
        "ignore": lambda: allpairs.overlaps(boxes, ignore=records),
        "ids": lambda: WORLD.remove(records),
        "offsets": lambda: allpairs.overlaps_in_worlds(boxes, offsets=records),
    }.items():
        with pytest.raises(allpairs.InvalidArgument, match=f"^{name} has dtype .*; it takes integers$"):
            call()


def test_a_margin_that_is_none_names_its_box():
    with pytest.raises(allpairs.InvalidBox) as caught:
        allpairs.overlaps(BOXES, margin=[0, 1, np.nan, 0])
    assert caught.value.index == 2


def test_a_label_that_does_not_fit_names_its_box():
    with pytest.raises(allpairs.InvalidBox, match=r"group\[1\] is -1") as caught:
        allpairs.overlaps(BOXES, group=[0, -1, 0, 0])
    assert caught.value.index == 1
    with pytest.raises(allpairs.InvalidBox, match="4294967296"):
        allpairs.overlaps(BOXES, mask=[0, 0, 0, 2**32])


@pytest.mark.parametrize(
    "arguments, message",
    [
        ({"lower": np.zeros((2, 3))}, r"lower has shape \(2, 3\); alone it takes \(n, 6\)"),
        ({"lower": np.zeros((2, 6)), "upper": np.zeros((2, 3))}, r"lower has shape \(2, 6\)"),
        ({"lower": np.zeros((2, 3)), "upper": np.zeros((3, 3))}, "lower has 2 rows and upper 3"),
        ({"lower": np.zeros(6)}, r"lower has shape \(6,\)"),
        ({"lower": np.zeros((2, 6), complex)}, "complex128"),
        ({"lower": [["a"] * 6]}, "dtype"),
        ({"lower": None}, "^lower is None; it takes numbers$"),
        ({"lower": "boxes.npy"}, "^lower is 'boxes.npy'; it takes numbers$"),
        ({"lower": BOXES[:, :3], "upper": (row for row in BOXES)}, "^upper is <generator .*; it takes numbers$"),
        ({"lower": BOXES, "margin": [1, 2]}, r"margin has shape \(2,\); for 4 boxes"),
        ({"lower": BOXES, "margin": np.nan}, "margin"),
        ({"lower": BOXES, "group": [1, 2, 3]}, r"group has shape \(3,\)"),
        ({"lower": BOXES, "group": [0.5] * 4}, "group has dtype float64"),
        ({"lower": BOXES, "ignore": [1, 2, 3]}, r"ignore has shape \(3,\)"),
        ({"lower": BOXES, "ignore": [[0, 1], [0, -1]]}, r"ignore\[1, 1\] is -1"),
        ({"lower": BOXES, "ignore": [[0, 1], [7, 0]]}, r"ignore row 1 is \(7, 0\); the number of boxes is %d" % len(BOXES)),
        ({"lower": BOXES, "region": [1, 2, 3]}, r"region has shape \(3,\)"),
        ({"lower": BOXES, "region": [[1, 1, 1], [0, 0, 0]]}, "region"),
        ({"lower": BOXES, "region": [1, 2, 3, 4]}, r"for boxes of 3 axes it takes \(2, 3\) or \(6,\)"),
        ({"lower": BOXES[:, :4], "region": range(6)}, r"for boxes of 2 axes it takes \(2, 2\) or \(4,\)"),
        ({"lower": np.zeros((2, 2)), "upper": np.zeros((2, 3))}, r"upper has shape \(2, 3\); it takes \(n, 2\)"),
        ({"lower": BOXES, "distance": np.nan}, "distance"),
        ({"lower": BOXES, "order": "third"}, "'first', 'second', 'unordered'"),
        ({"lower": BOXES, "strategy": []}, "strategy"),
        ({"lower": BOXES, "threads": -1}, "threads is -1"),
        ({"lower": BOXES, "max_pairs": -1}, "max_pairs is -1"),
    ],
)
def test_arguments_that_make_no_sense_are_named(arguments, message):
    with pytest.raises(allpairs.InvalidArgument, match=message):
        allpairs.overlaps(**arguments)


def nested(depth):
    """A list in a list in a list."""
    rows = [0.0]
    for _ in range(depth):
        rows = [rows, rows]
    return rows


def holds_itself():
    rows = []
    rows.append(rows)
    return rows


WORLD = allpairs.World()
MESH = {"triangles": [[0, 1, 2]], "vertex_count": 3}


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: allpairs.overlaps(BOXES, max_pairs=2**70), "max_pairs is 1180591620717411303424; it is at most 18446744073709551615"),
        (lambda: allpairs.overlaps(BOXES, threads=2**70), "threads is 1180591620717411303424; it is at most"),
        (lambda: allpairs.overlaps(BOXES, threads=2**40), "threads is 1099511627776; it is at most 9999"),
        (lambda: allpairs.overlaps(BOXES, max_pairs=10**5000), "max_pairs is a large integer; it is at most"),
        (lambda: allpairs.overlaps(BOXES, distance=10**400), "distance is .*, which float64 does not hold"),
        (lambda: allpairs.batches(BOXES, batch_size=0), "batch_size is 0; it is at least 1"),
        (lambda: allpairs.batches(BOXES, batch_size=2**64), "batch_size is 18446744073709551616; it is at most"),
        (lambda: WORLD.overlapping(BOXES, mask=2**40), "mask is 1099511627776; it is at most 4294967295"),
        (lambda: WORLD.overlapping(BOXES, category=-1), "category is -1; it is at least 0"),
        (lambda: WORLD.nearest([0, 0, 0], k=2**63), "k is 9223372036854775808; it is at most 4294967295"),
        (lambda: WORLD.nearest([0, 0, 0], k=0), "k is 0; it is at least 1"),
        (lambda: allpairs.World(threads=-1), "threads is -1; it is at least 0"),
        (lambda: WORLD.add(BOXES, mask=2**40), "mask is 1099511627776; it is at most 4294967295"),
        (lambda: allpairs.overlaps(np.full((4, 6), 2**64)), r"lower has integers beyond 2\*\*53"),
        (lambda: allpairs.overlaps([[0, 0, 0, 1, 1, -(10**20)]]), r"lower has integers beyond 2\*\*53"),
        (lambda: allpairs.overlaps(BOXES, margin=[10**20] * 4), r"margin has integers beyond 2\*\*53"),
        (lambda: allpairs.overlaps(BOXES, margin=[1.0, np.True_, 10**20, 1]), r"margin has integers beyond 2\*\*53"),
        (lambda: allpairs.overlaps(BOXES, margin=[1.0, "x", 10**20, 1]), "margin has dtype object; it takes numbers that"),
        (lambda: allpairs.overlaps(BOXES, margin=[None] * 4), "margin has dtype object"),
        (lambda: allpairs.overlaps(BOXES, margin=10**400), "margin is .*, which float64 does not hold"),
        (lambda: allpairs.overlaps(BOXES, margin=1j), "margin has dtype complex128"),
        (lambda: WORLD.add(BOXES, margin="x"), "margin is 'x'; it takes numbers$"),
        (lambda: WORLD.first_hits([0, 0, 0], [1, 0, 0], "far"), "length is .far.; it takes numbers"),
        (lambda: allpairs.overlaps(BOXES, region=["a"] * 6), "region has dtype <U1"),
        (lambda: allpairs.MeshCandidates([[0, 1, 2]], 2**70), "vertex_count is 1180591620717411303424"),
        (lambda: allpairs.MeshCandidates(**MESH).set_positions(np.zeros((3, 3)), mesh=-1), "mesh is -1"),
        (lambda: allpairs.MeshCandidates(**MESH).set_positions(np.zeros((3, 3)), mesh=1), "there is no mesh 1 among 1"),
        (lambda: allpairs.load("a.scn", max_memory=-1), "max_memory is -1; it is at least 0"),
        (lambda: allpairs.load("a.scn", sofa="21.06"), "sofa: '21.06' is neither a version up to 20.06 nor one from 22.06"),
        (lambda: allpairs.load("a.scn", sofa="22.13"), "sofa: '22.13' is no version of SOFA"),
        (lambda: allpairs.overlaps(BOXES, order="x" * 1000), "order is 'xxx.*; it can be 'first'"),
        (lambda: WORLD.remove(-1), "ids is -1; it takes 0 to"),
        (lambda: WORLD.remove(np.array([False])), "ids has dtype bool"),
        (lambda: allpairs.overlaps(BOXES, group=np.full((3, 1000), -1)), r"group\[0, 0\] is -1"),
        (lambda: allpairs.overlaps(BOXES, threads=-(10**5000)), "threads is a large integer; it is at least 0"),
        (lambda: WORLD.first_hits(np.zeros((2, 3)), np.ones((3, 3))), "origins has 2 rows and directions 3"),
        (lambda: WORLD.first_hits([0, 0, 0], [1, 0, 0], [1.0, 2.0]), r"length has shape \(2,\)"),
        (lambda: WORLD.first_hits([[1, 2], [3]], [1, 0, 0]), "origins cannot be read as an array"),
        (lambda: WORLD.first_hits([0, 0, 0], [[1, 2], [3]]), "directions cannot be read as an array"),
        (lambda: WORLD.overlapping(BOXES, world=allpairs.EVERY_WORLD), "world is 4294967295; it is at most 4294967294"),
        (lambda: allpairs.overlaps([[1, 2], [3]]), "lower cannot be read as an array"),
        (lambda: allpairs.overlaps(nested(5000)), "lower cannot be read as an array: it is nested too deeply"),
        (lambda: allpairs.overlaps(holds_itself()), "lower cannot be read as an array"),
        (lambda: WORLD.boxes(nested(5000)), "ids cannot be read as an array: it is nested too deeply"),
        (lambda: allpairs.overlaps_in_worlds([[np.ma.masked_less(BOXES, 2)] * 2]), ".* has masked entries"),
        (lambda: allpairs.Partition(BOXES, cells=2, distance=np.nan), "the distance is NaN"),
        (lambda: allpairs.Partition(BOXES, cells=2).cells_of(BOXES, distance=np.nan), "distance is nan"),
        (lambda: allpairs.Partition(BOXES, cells=2).cells_of(BOXES, max_margin=np.nan), "max_margin is nan"),
        (lambda: allpairs.overlaps_in_cell(BOXES, None, [0] * len(BOXES), [[0, 0, np.nan], [1, 1, 1]]), "the cell has a NaN"),
        (lambda: allpairs.MeshCandidates(**MESH, distance=np.nan), "the distance is NaN"),
        (lambda: allpairs.load("a\0b.csv"), "path is 'a.*which no file can be called"),
        (lambda: allpairs.load("\ud800.csv"), "path is .*which no file can be called"),
    ],
)
def test_numbers_out_of_range_are_named_on_one_line(call, message):
    with pytest.raises(allpairs.Error, match="^" + message) as caught:
        call()
    assert len(str(caught.value)) < 200
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: allpairs.overlaps(BOXES, threads=1.5), "threads is 1.5; it takes an integer"),
        (lambda: allpairs.overlaps(BOXES, max_pairs="many"), "max_pairs is 'many'; it takes an integer"),
        (lambda: allpairs.overlaps(BOXES, distance="0.5"), "distance is '0.5'; it takes a number"),
        (lambda: allpairs.overlaps(BOXES, distance=BOXES), r"distance is array\(.*; it takes a number"),
        (lambda: allpairs.World(distance=None), "distance is None; it takes a number"),
        (lambda: WORLD.nearest([0, 0, 0], k=1.0), "k is 1.0; it takes an integer"),
        (lambda: WORLD.overlapping(BOXES, mask=0.5), "mask is 0.5; it takes an integer"),
        (lambda: allpairs.MeshCandidates(**MESH, distance=[]), r"distance is \[\]; it takes a number"),
        (lambda: allpairs.load("a.scn", max_memory="1G"), "max_memory is '1G'; it takes an integer"),
        (lambda: allpairs.join(5), "inputs is 5; it takes a path or several"),
        (lambda: allpairs.load(5), "path is 5; it takes a path"),
        (lambda: allpairs.load("a.scn", sofa=24.06), "sofa is 24.06; it takes a str$"),
        (lambda: allpairs.detect("a.scn", sofa=None), "sofa is None; it takes a str$"),
    ],
)
def test_values_of_another_type_are_named_on_one_line(call, message):
    with pytest.raises(TypeError, match="^" + message) as caught:
        call()
    assert len(str(caught.value)) < 200
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("unit", ["ns", "s", "Y"])  # float() and item() make plain numbers of the first and the last
@pytest.mark.parametrize("kind", [np.datetime64, np.timedelta64])
def test_dates_and_durations_are_no_numbers(kind, unit):
    world = allpairs.World()
    world.add(np.zeros((10, 6)))
    worlds = np.zeros((2, 4, 6))
    for time in (kind(5, unit), np.array(kind(5, unit))):
        for name, call in {
            "margin": [
                lambda: allpairs.overlaps(BOXES, margin=time),
                lambda: allpairs.overlaps_in_worlds(worlds, margin=time),
                lambda: world.add(BOXES, margin=time),
            ],
            "length": [lambda: world.first_hits([0, 0, 0], [1, 0, 0], time)],
        }.items():
            for each in call:
                with pytest.raises(allpairs.InvalidArgument, match=rf"^{name} has dtype {kind.__name__}\[{unit}\]; it takes"):
                    each()
        for name, takes, call in (
            ("distance", "a number", lambda: allpairs.overlaps(BOXES, distance=time)),
            ("distance", "a number", lambda: allpairs.World(distance=time)),
            ("max_margin", "a number", lambda: allpairs.Partition(BOXES, cells=2).cells_of(BOXES, max_margin=time)),
            ("group", "an integer", lambda: allpairs.overlaps(BOXES, group=time)),
            ("mask", "an integer", lambda: allpairs.overlaps_in_worlds(worlds, mask=time)),
            ("static", "an integer", lambda: world.add(BOXES, static=time)),
            ("category", "an integer", lambda: world.overlapping(BOXES, category=time)),
        ):
            with pytest.raises(TypeError, match=rf"^{name} is .*; it takes {takes}$"):
                call()
        assert time not in world
    assert 5 in world and len(world) == 10


def test_a_truth_value_of_numpy_counts_as_python_s(recwarn):
    assert allpairs.overlaps(BOXES, threads=np.True_).tolist() == allpairs.overlaps(BOXES, threads=True).tolist()
    assert not recwarn.list


def test_what_is_no_id_is_in_no_world():
    world = allpairs.World()
    (id,) = world.add([[0, 0, 0, 1, 1, 1]])
    assert id in world and int(id) in world and np.array(id) in world
    assert np.array(float(id)) not in world and np.array([id]) not in world
    for other in (1, -1, 2**32 - 1, 2**40, 10**400, 0.0, "0", None, False, np.False_, np.array(False)):
        assert other not in world


def test_a_query_that_is_refused_takes_no_memory_for_its_result():
    world = allpairs.World()
    with pytest.raises(allpairs.InvalidArgument, match="point 1 is not finite"):
        world.nearest([[0, 0, 0], [np.nan, 0, 0]], 2**31)


def test_a_batch_may_be_of_any_size():
    assert [len(batch) for batch in allpairs.batches(BOXES, batch_size=2**64 - 1)] == [6]


def test_two_sets_take_their_settings_in_pairs():
    with pytest.raises(allpairs.InvalidArgument, match="group takes a number or a tuple of two"):
        allpairs.overlaps_between(BOXES, BOXES, group=[1, 2, 3, 4])
    with pytest.raises(allpairs.InvalidArgument, match="second set: group has shape"):
        allpairs.overlaps_between(BOXES, BOXES, group=(None, [1]))
    with pytest.raises(allpairs.InvalidArgument, match="a tuple of 3"):
        allpairs.overlaps_between((1, 2, 3), BOXES)
    with pytest.raises(allpairs.InvalidArgument, match="the first set have 3 axes and those of the second 2"):
        allpairs.overlaps_between(BOXES, BOXES[:, :4])


def test_more_pairs_than_allowed_say_how_many():
    for call in (allpairs.overlaps, allpairs.count):
        with pytest.raises(allpairs.LimitExceeded) as caught:
            call(BOXES, max_pairs=5)
        assert caught.value.count == 6
    assert len(allpairs.overlaps(BOXES, max_pairs=6)) == allpairs.count(BOXES, max_pairs=6) == 6
    expected = allpairs.count_between(BOXES, BOXES)
    assert allpairs.count_between(BOXES, BOXES, max_pairs=expected) == expected
    with pytest.raises(allpairs.LimitExceeded):
        allpairs.count_between(BOXES, BOXES, max_pairs=expected - 1)


def test_wrong_types_are_type_errors():
    with pytest.raises(TypeError):
        allpairs.overlaps(BOXES, threads=1.5)
    with pytest.raises(TypeError):
        allpairs.overlaps()


def test_errors_survive_being_sent_to_another_process():
    for error in (
        allpairs.InvalidBox("box 3", 3),
        allpairs.LimitExceeded("many", 7),
        allpairs.FileError("a.scn:1: bad", "a.scn", 1, 0),
        allpairs.FileError("a.scn: no such file", "a.scn", 0, 0, errno.ENOENT),
    ):
        twin = pickle.loads(pickle.dumps(error))
        assert (type(twin), str(twin), vars(twin)) == (type(error), str(error), vars(error))
        for name in ("errno", "strerror", "filename"):
            assert getattr(twin, name, None) == getattr(error, name, None)


def test_errors_of_files_say_what_other_errors_of_the_system_do():
    error = allpairs.FileError("a.scn: is not there", "a.scn", 0, 0, errno.ENOENT)
    assert (error.filename, error.errno, error.strerror) == ("a.scn", errno.ENOENT, os.strerror(errno.ENOENT))
    assert (str(error), error.args) == ("a.scn: is not there", ("a.scn: is not there",))
    error = allpairs.FileError("a.scn:1: bad", "a.scn", 1, 0)
    assert (error.filename, error.errno, error.strerror, str(error)) == ("a.scn", None, None, "a.scn:1: bad")


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_what_cannot_be_pickled_is_a_type_error(protocol, tmp_path):
    (tmp_path / "part.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n")
    objects = [allpairs.MeshCandidates(**MESH), allpairs.World()._core, allpairs._core.Order.__members__["first"]]
    if hasattr(allpairs, "load"):
        objects.append(allpairs.load(tmp_path / "part.obj"))
    for each in objects:
        with pytest.raises(TypeError, match="cannot pickle 'allpairs"):
            pickle.dumps(each, protocol)
        with pytest.raises(TypeError, match="cannot pickle 'allpairs"):
            copy.deepcopy(each)
    with pytest.raises(TypeError, match="cannot pickle 'allpairs"):
        copy.copy(objects[0])  # two would move together


def test_errors_are_value_errors_and_those_of_files_os_errors():
    assert issubclass(allpairs.Error, ValueError)
    for kind in (allpairs.InvalidArgument, allpairs.InvalidBox, allpairs.LimitExceeded, allpairs.FileError):
        assert issubclass(kind, allpairs.Error)
    assert issubclass(allpairs.FileError, OSError)


@pytest.mark.parametrize(
    "name, call",
    [
        ("static", lambda flags: allpairs.World().overlapping([[0, 0, 0, 1, 1, 1]], static=flags)),
        ("moving", lambda flags: allpairs.World().overlapping([[0, 0, 0, 1, 1, 1]], moving=flags)),
        ("partial", lambda flags: allpairs.load("missing.obj", partial=flags)),
        ("allow_outside", lambda flags: allpairs.load("missing.obj", allow_outside=flags)),
        ("recursive", lambda flags: allpairs.load("missing.obj", recursive=flags)),
        ("within", lambda flags: allpairs.MeshCandidates([[0, 1, 2]], 3, within=flags)),
        ("between", lambda flags: allpairs.MeshCandidates([[0, 1, 2]], 3, between=flags)),
    ],
)
def test_an_array_is_neither_true_nor_false(name, call):
    with pytest.raises(allpairs.InvalidArgument, match=rf"^{name} is .*; it takes True or False$"):
        call(np.array([True, False]))
