# SPDX-License-Identifier: MIT
"""Moving boxes against the double loop, step by step."""

import copy
import pickle
import threading

import allpairs
import numpy as np
import pytest
from conftest import every_pair


def rows_of(pairs):
    return set(map(tuple, pairs.tolist()))


def assert_step(step, before, now):
    """`now` and `before` are the oracle's pairs of this step and of the last one, ascending."""
    np.testing.assert_array_equal(step.pairs, now)
    old, new = rows_of(before), rows_of(now)
    for found, expected in ((step.began, new - old), (step.persisted, new & old), (step.ended, old - new)):
        assert found.dtype == np.uint32
        assert found.shape == (len(expected), 2)
        assert found.tolist() == sorted(map(list, expected))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("threads", [1, 2])
def test_steps_are_those_of_the_double_loop(dtype, threads):
    rng = np.random.default_rng(6)
    world = allpairs.World(distance=1, threads=threads)
    lower = rng.integers(0, 30, (300, 3)).astype(dtype)
    upper = lower + rng.integers(0, 4, (300, 3)).astype(dtype)
    ids = world.add(lower, upper)
    assert ids.dtype == np.uint32
    np.testing.assert_array_equal(ids, np.arange(300))
    before = np.zeros((0, 2), np.uint32)
    for _ in range(12):
        now = every_pair(lower, upper, distance=1)
        assert_step(world.step(), before, now)
        before = now
        some = rng.choice(300, 40, replace=False)
        lower[some] = rng.integers(0, 30, (40, 3))
        upper[some] = lower[some] + 2
        world.move(some, np.hstack([lower[some], upper[some]]))
    assert len(before) > 20


def test_boxes_are_added_removed_and_asked_for():
    world = allpairs.World()
    ids = world.add(np.zeros((3, 6)))
    assert len(world) == 3
    world.remove(ids[:1])
    assert (0 in world, 1 in world, len(world)) == (False, True, 2)
    assert world.step().pairs.tolist() == [[1, 2]]
    world.move_swept([1], np.zeros((1, 6)), ([[4, 0, 0]], [[5, 1, 1]]))
    np.testing.assert_array_equal(world.boxes([1, 2]), [[0, 0, 0, 5, 1, 1], [0] * 6])


def test_what_a_step_gave_stays_when_the_world_goes_on():
    world = allpairs.World()
    ids = world.add(np.zeros((3, 6)))
    first = world.step()
    world.remove(ids)
    world.step()
    assert first.pairs.tolist() == [[0, 1], [0, 2], [1, 2]]


@pytest.mark.parametrize(
    "properties, pairs",
    [
        ({}, [[0, 1], [0, 2], [1, 2]]),
        ({"static": [True, True, False]}, [[0, 2], [1, 2]]),
        ({"static": True}, []),
        ({"group": [5, 5, 0]}, [[0, 2], [1, 2]]),
        ({"category": [1, 2, 4], "mask": [2, 1, 7]}, [[0, 1]]),
        ({"margin": [-1, 0, 0]}, [[1, 2]]),
        ({"margin": -1}, []),
    ],
)
def test_properties_decide_about_pairs(properties, pairs):
    boxes = np.zeros((3, 6)) + [0, 0, 0, 0.5, 0.5, 0.5]
    world = allpairs.World()
    ids = world.add(boxes, **properties)
    assert world.step().pairs.tolist() == pairs
    world.set_properties(ids, static=False, group=0, category=0xFFFFFFFF, mask=0xFFFFFFFF, margin=0)
    assert len(world.step().pairs) == 3
    world.set_properties(ids, **properties)
    assert world.step().pairs.tolist() == pairs


def test_a_property_that_is_not_set_stays():
    given = {"static": [1, 0, 0], "group": [1, 2, 3], "category": [1, 2, 4], "mask": [7, 6, 5], "margin": [0.5, 1, 2], "world": [4, 5, 6]}
    world = allpairs.World()
    ids = world.add(np.zeros((3, 6)), **given)
    changed = {"static": [1, 1], "group": [8, 9], "category": [3, 5], "mask": [2, 1], "margin": [4, 3], "world": [5, 7]}
    for name, values in changed.items():
        world.set_properties(ids[[2, 0]], **{name: values})
        given[name] = [values[1], given[name][1], values[0]]
        state = world.__getstate__()
        assert {key: state[key].tolist() for key in given} == given
    world.set_properties(ids)
    assert {key: world.__getstate__()[key].tolist() for key in given} == given
    with pytest.raises(allpairs.InvalidBox, match="there is no box with the id 3, entry 1 of the ids"):
        world.set_properties([0, 3], margin=9)
    assert world.__getstate__()["margin"].tolist() == given["margin"]


def test_a_world_says_what_its_last_step_did():
    world = allpairs.World()
    assert world.statistics == (0, 0, 0, 0, False, 0)
    ids = world.add(np.zeros((20, 6)))
    assert world.statistics.changed == 0  # no step yet
    world.step()
    assert isinstance(world.statistics, allpairs.WorldStatistics)
    assert (world.statistics.changed, world.statistics.joined_all) == (20, True)
    assert world.statistics.box_tests >= 190
    world.move(ids[:3], np.ones((3, 6)))
    world.remove(ids[10:])
    world.step()
    assert world.statistics.changed == 13
    world.step()
    assert world.statistics[:4] == (0, 0, 0, 0)
    assert world.statistics._fields == ("box_tests", "group_tests", "exact_tests", "changed", "joined_all", "rebuilds")
    with pytest.raises(AttributeError):
        world.statistics = None


def test_a_world_that_is_shrunk_or_has_room_gives_the_same():
    rng = np.random.default_rng(7)
    lower = rng.integers(0, 30, (500, 3)).astype(np.float64)
    boxes = np.hstack([lower, lower + 3])
    world, other = allpairs.World(), allpairs.World()
    other.reserve(2000)
    assert len(other) == 0
    for each in (world, other):
        each.add(boxes)
    for step in range(6):
        some = rng.choice(300, 50, replace=False)
        for each in (world, other):
            each.move(some, boxes[some[::-1]])
        if step % 2:
            other.shrink()
        elif step == 4:
            other.reserve(0)
        for found, expected in zip(other.step(), world.step()):
            np.testing.assert_array_equal(found, expected)
        if step == 2:
            kept = other.step().pairs
            before = kept.copy()
            other.shrink()
            np.testing.assert_array_equal(kept, before)
            np.testing.assert_array_equal(other.result(0).pairs, world.step().pairs)
    # Ids above the highest one in use are free at once.
    world.remove(np.arange(100, 500))
    world.step()
    world.shrink()
    assert world.add(np.zeros((2, 6))).tolist() == [100, 101]


@pytest.mark.parametrize(
    "boxes, error, message",
    [
        (-1, allpairs.InvalidArgument, "boxes is -1; it is at least 0"),
        (2**32, allpairs.InvalidArgument, "boxes is 4294967296; it is at most 4294967295"),
        (2**70, allpairs.InvalidArgument, "boxes is 1180591620717411303424; it is at most 4294967295"),
        (1.5, TypeError, "boxes is 1.5; it takes an integer"),
        ("3", TypeError, "boxes is '3'; it takes an integer"),
        (None, TypeError, "boxes is None; it takes an integer"),
    ],
)
def test_room_is_a_number_of_boxes(boxes, error, message):
    world = allpairs.World()
    with pytest.raises(error, match=message):
        world.reserve(boxes)


def test_a_world_lists_its_boxes():
    world = allpairs.World()
    assert world.ids().tolist() == []
    boxes = np.arange(30.0).reshape(5, 6)
    world.add(boxes)
    world.remove([1, 3])
    for each in (world, copy.copy(world), pickle.loads(pickle.dumps(world))):
        assert each.ids().dtype == np.uint32
        assert each.ids().tolist() == [0, 2, 4]
        assert each.boxes(each.ids()).tolist() == boxes[::2].tolist()


def test_boxes_of_different_worlds_are_no_pairs():
    boxes = np.zeros((5, 6)) + [0, 0, 0, 1, 1, 1]
    world = allpairs.World()
    ids = world.add(boxes, world=[4, 7, 4, 7, allpairs.EVERY_WORLD])
    assert world.step().pairs.tolist() == [[0, 2], [0, 4], [1, 3], [1, 4], [2, 4], [3, 4]]
    assert world.result(7).began.tolist() == [[1, 3], [1, 4], [3, 4]]
    assert world.result(8).pairs.shape == (0, 2)
    assert world.overlapping([[0, 0, 0, 1, 1, 1]], world=4).tolist() == [[0, 0], [0, 2], [0, 4]]
    assert world.first_hits([-1, 0.5, 0.5], [1, 0, 0], world=7)[0].tolist() == [1]
    assert world.nearest([0, 0, 0], k=2, world=8)[0].tolist() == [[4, allpairs.NO_BOX]]
    for twin in (copy.deepcopy(world), pickle.loads(pickle.dumps(world))):
        np.testing.assert_array_equal(twin.step().pairs, world.step().pairs)
        assert twin.result(4).pairs.tolist() == [[0, 2], [0, 4], [2, 4]]
    world.set_properties(ids, world=7)
    assert len(world.step().pairs) == 10
    with pytest.raises(allpairs.InvalidArgument, match="world is -1"):
        world.result(-1)


def test_a_state_of_an_earlier_version_has_no_worlds():
    world = allpairs.World()
    world.add(np.zeros((2, 6)))
    state = world.__getstate__()
    del state["world"]
    again = allpairs.World.__new__(allpairs.World)
    again.__setstate__(state)
    assert again.step().pairs.tolist() == [[0, 1]]


def test_queries_find_what_a_loop_finds():
    rng = np.random.default_rng(9)
    lower = rng.integers(0, 20, (200, 3)).astype(float)
    upper = lower + rng.integers(1, 4, (200, 3))
    world = allpairs.World()
    world.add(lower, upper, static=np.arange(200) % 2 == 0)
    asked = np.hstack([lower[:5], upper[:5]]) + 0.5
    meet = ((asked[:, None, :3] <= upper) & (lower <= asked[:, None, 3:])).all(axis=2)
    np.testing.assert_array_equal(world.overlapping(asked), np.argwhere(meet))
    meet[:, ::2] = False
    np.testing.assert_array_equal(world.overlapping(asked, static=False), np.argwhere(meet))

    points = rng.uniform(-5, 25, (7, 3))
    gaps = np.linalg.norm(np.maximum(np.maximum(lower - points[:, None], points[:, None] - upper), 0), axis=2)
    ids, distances = world.nearest(points, k=4)
    np.testing.assert_allclose(distances, np.sort(gaps, axis=1)[:, :4])
    np.testing.assert_allclose(np.take_along_axis(gaps, ids.astype(int), axis=1), distances)

    gaps = np.maximum(np.maximum(lower - asked[:, None, 3:], asked[:, None, :3] - upper), 0)
    apart = np.linalg.norm(gaps, axis=2)
    ids, distances = world.nearest(asked, k=4)
    order = np.lexsort([np.broadcast_to(np.arange(200), apart.shape), apart])[:, :4]
    np.testing.assert_array_equal(ids, order)
    np.testing.assert_allclose(distances, np.take_along_axis(apart, order, axis=1))
    assert world.nearest(asked[0], k=4)[0].tolist() == order[:1].tolist()

    origins = np.column_stack([lower[:9, :2] + 0.5, np.full(9, -3.0)])
    ids, t = world.first_hits(origins, [0, 0, 2])
    pierced = ((lower[:, :2] <= origins[:, None, :2]) & (origins[:, None, :2] <= upper[:, :2])).all(axis=2)
    first = np.where(pierced, lower[:, 2], np.inf)
    np.testing.assert_array_equal(ids, first.argmin(axis=1))
    np.testing.assert_array_equal(t, (first.min(axis=1) + 3) / 2)


def test_queries_that_find_nothing_say_so():
    world = allpairs.World()
    world.add([[0, 0, 0, 1, 1, 1]])
    ids, t = world.first_hits([[5, 5, 5]], [[1, 0, 0]], length=3)
    assert (ids.tolist(), t.tolist()) == ([allpairs.NO_BOX], [np.inf])
    ids, distances = world.nearest([3, 0, 0], k=2)
    assert (ids.tolist(), distances.tolist()) == ([[0, allpairs.NO_BOX]], [[2, np.inf]])
    ids, distances = world.nearest([[3, 4, 0, 4, 4, 0], [1, 0, 0, 0, 0, 0]])
    assert (ids.tolist(), distances.tolist()) == ([[0], [allpairs.NO_BOX]], [[13**0.5], [np.inf]])
    assert world.overlapping([[5, 5, 5, 6, 6, 6]]).shape == (0, 2)


def test_bad_input_is_named_and_changes_nothing():
    world = allpairs.World()
    ids = world.add(np.zeros((2, 6)))
    with pytest.raises(allpairs.InvalidBox, match="7") as caught:
        world.remove([0, 7])
    assert caught.value.index == 1
    assert len(world) == 2
    with pytest.raises(allpairs.InvalidBox):
        world.move(ids, np.full((2, 6), np.nan))
    with pytest.raises(allpairs.InvalidBox, match=r"group\[1\] is -1"):
        world.add(np.zeros((2, 6)), group=[0, -1])
    with pytest.raises(allpairs.InvalidArgument, match=r"margin has shape \(3,\)"):
        world.add(np.zeros((2, 6)), margin=[0, 0, 0])
    with pytest.raises(allpairs.InvalidArgument):
        world.move([0, 1], np.zeros((1, 6)))
    with pytest.raises(allpairs.InvalidArgument, match="ids has shape"):
        world.remove([[0, 1]])
    with pytest.raises(allpairs.InvalidArgument, match="k is 0"):
        world.nearest([0, 0, 0], k=0)
    assert world.step().pairs.tolist() == [[0, 1]]


def test_threads_that_share_a_world_wait_for_each_other():
    world = allpairs.World()

    def work():
        for _ in range(50):
            ids = world.add(np.zeros((5, 6)))
            world.step()
            world.remove(ids)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(world) == 0
    assert len(world.step().pairs) == 0


def test_one_box_needs_no_list():
    world = allpairs.World()
    first = world.add([0, 0, 0, 1, 1, 1])
    second = world.add([1, 1, 1], [2, 2, 2], mask=3, group=np.uint32(5))
    assert (first.tolist(), second.tolist()) == ([0], [1])
    assert world.step().pairs.tolist() == [[0, 1]]
    world.move(first, np.array([5.0, 5, 5, 6, 6, 6], np.float32))
    assert world.step().ended.tolist() == [[0, 1]]
    assert world.overlapping([0, 0, 0, 9, 9, 9]).tolist() == [[0, 0], [0, 1]]
    assert world.overlapping((2, 2, 2), (4, 4, 4)).tolist() == [[0, 1]]
    with pytest.raises(allpairs.InvalidArgument, match=r"lower has shape \(5,\)"):
        world.overlapping([0, 0, 1, 1, 1])


def crowd(n, rng):
    lower = rng.integers(0, 12, (n, 3)).astype(float)
    return np.hstack([lower, lower + rng.integers(0, 4, (n, 3))])


@pytest.mark.parametrize(
    "copied", [copy.copy, copy.deepcopy, *(lambda w, p=p: pickle.loads(pickle.dumps(w, p)) for p in range(2, pickle.HIGHEST_PROTOCOL + 1))]
)
@pytest.mark.parametrize("order", ["first", "second"])
def test_a_copy_has_the_same_boxes_and_pairs(copied, order):
    rng = np.random.default_rng(8)
    world = allpairs.World(distance=0.5, order=order, threads=2)
    ids = world.add(crowd(200, rng), mask=rng.integers(0, 8, 200), category=rng.integers(0, 8, 200))
    world.add(crowd(80, rng), static=rng.integers(0, 2, 80), group=rng.integers(0, 4, 80), margin=rng.random(80) - 0.5)
    world.add([[-np.inf] * 3 + [np.inf] * 3, [5, 5, 5, 4, 4, 4]])
    world.step()
    world.remove(ids[20:50])
    world.step()
    world.move(ids[:5], crowd(5, rng))  # not stepped yet
    world.remove(ids[190:])
    twin = copied(world)
    assert len(twin) == len(world)
    for id in range(300):
        assert (id in twin) == (id in world)
    there = [id for id in range(300) if id in world]
    np.testing.assert_array_equal(twin.boxes(there), world.boxes(there))
    step = twin.step()
    assert len(step.pairs) > 100
    np.testing.assert_array_equal(step.pairs, world.step().pairs)
    np.testing.assert_array_equal(step.began, step.pairs)
    assert (len(step.persisted), len(step.ended)) == (0, 0)
    # Neither knows of the other.
    world.move(there, crowd(len(there), rng))
    np.testing.assert_array_equal(twin.step().persisted, step.pairs)
    twin.move(there, world.boxes(there))
    np.testing.assert_array_equal(twin.step().pairs, world.step().pairs)
    assert set(twin.add(crowd(40, rng)).tolist()) == {*range(20, 50), *range(190, 200)}


def test_a_copy_of_a_world_without_boxes_is_one():
    twin = copy.copy(allpairs.World(distance=2))
    assert len(twin) == 0
    assert twin.add([[0, 0, 0, 1, 1, 1], [2, 2, 2, 3, 3, 3]]).tolist() == [0, 1]
    assert twin.step().pairs.tolist() == [[0, 1]]


class Named(allpairs.World):
    def __init__(self, name):
        super().__init__(distance=1)
        self.name = name


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda world: pickle.loads(pickle.dumps(world))])
def test_a_copy_keeps_what_others_have_added(copied):
    world = Named(["mine"])
    world.add([0, 0, 0, 1, 1, 1])
    twin = copied(world)
    assert type(twin) is Named and twin.name == ["mine"] and len(twin) == 1
    assert (twin.name is world.name) == (copied is copy.copy)


class Logged(allpairs.World):
    """All that changes it is of another form, and is written down."""

    def __init__(self):
        super().__init__()
        self.calls = []

    def add(self, label, *boxes):
        self.calls.append(label)
        return super().add(*boxes)

    def move(self, label, *boxes):
        self.calls.append(label)
        super().move(*boxes)

    def remove(self, label, ids):
        self.calls.append(label)
        super().remove(ids)

    def set_properties(self, label, ids, **properties):
        self.calls.append(label)
        super().set_properties(ids, **properties)

    def step(self, label):
        self.calls.append(label)
        return super().step()


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda world: pickle.loads(pickle.dumps(world))])
def test_a_copy_calls_no_methods_of_a_class_derived_from_world(copied):
    world = Logged()
    world.add("three", np.tile([0.0, 0, 0, 1, 1, 1], (3, 1)))
    world.remove("the first", [0])
    world.move("the last", 2, [1.0, 1, 1, 2, 2, 2])
    world.set_properties("both", [1, 2], margin=1)
    world.step("once")
    calls = list(world.calls)
    twin = copied(world)
    assert world.calls == twin.calls == calls
    assert twin.ids().tolist() == [1, 2] and twin.properties([1, 2])["margin"].tolist() == [1, 1]
    np.testing.assert_array_equal(twin.boxes([1, 2]), world.boxes([1, 2]))
    assert twin.step("again").pairs.tolist() == [[1, 2]]


def test_a_copy_while_others_change_the_world_is_of_one_moment():
    world = allpairs.World()
    fixed = world.add(np.tile([0.0, 0, 0, 1, 1, 1], (50, 1)))
    done = threading.Event()

    def replace():
        while not done.is_set():
            ids = world.add(np.tile([5.0, 5, 5, 6, 6, 6], (300, 1)), group=7)
            world.step()
            world.remove(ids)

    threads = [threading.Thread(target=replace) for _ in range(2)]
    for thread in threads:
        thread.start()
    try:
        for _ in range(30):
            state = copy.copy(world).__getstate__()
            assert set(fixed) <= set(state["ids"])
            assert ((state["group"] == 7) == (state["boxes"][:, 0] == 5)).all()
    finally:
        done.set()
        for thread in threads:
            thread.join()


def test_queries_of_an_empty_list_find_nothing():
    world = allpairs.World()
    world.add(np.zeros((2, 6)))
    ids, distances = world.nearest([], k=2)
    assert (ids.shape, distances.shape) == ((0, 2), (0, 2))
    assert [len(found) for found in world.first_hits([], [])] == [0, 0]
    assert [len(found) for found in world.first_hits([], [1, 0, 0])] == [0, 0]


def test_one_box_may_be_named_by_its_number():
    world = allpairs.World()
    world.add(np.tile([0, 0, 0, 1, 1, 1], (3, 1)))
    assert repr(world) == "World(3 boxes)"
    world.move(2, [5, 5, 5], [6, 6, 6])
    assert world.step().pairs.tolist() == [[0, 1]]
    world.remove(np.int64(0))
    assert world.step().ended.tolist() == [[0, 1]]
    with pytest.raises(allpairs.InvalidArgument, match=r"ids has shape \(1, 1\)"):
        world.remove([[1]])
