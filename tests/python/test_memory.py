# SPDX-License-Identifier: MIT
"""Each allocation of the module fails once: an exception, never an end of the process, and all can be used on.

operator new is that of tests/support/FailingNew.cpp, which is preloaded; Python's own memory does not fail.
"""

import ctypes
import os

import allpairs
import numpy as np
import pytest
from conftest import random_boxes
from test_elements import sheet

LIBRARY = os.environ.get("ALLPAIRS_FAILING_NEW")
if LIBRARY is None:
    pytest.skip("ALLPAIRS_FAILING_NEW names no library, which has to be preloaded", allow_module_level=True)

_library = ctypes.CDLL(LIBRARY)
_library.allpairsTestFail.argtypes = [ctypes.c_uint64, ctypes.c_bool, ctypes.c_size_t]
_library.allpairsTestStop.restype = ctypes.c_bool

#: Without the 32 bytes by which it notes a new object, pybind11 ends the process (docs/limits.md).
SMALLEST = 33

BOXES = random_boxes(300)
OTHERS = random_boxes(90, seed=2)


def fails(k, and_later, call):
    """Lets the k-th allocation fail, and calls; returns what came out, or None, and whether an allocation failed."""
    result = None
    _library.allpairsTestFail(k, and_later, SMALLEST)
    try:
        result = call()
    except MemoryError as error:
        assert str(error) == "out of memory"
    except allpairs.Error:
        pass
    finally:
        happened = _library.allpairsTestStop()
    return result, happened


def same(found, wanted):
    if isinstance(wanted, (tuple, list)):
        return len(found) == len(wanted) and all(map(same, found, wanted))
    return np.array_equal(found, wanted)


def check(and_later, make, call):
    """For every k: `call` of what `make` gives is right or an exception, and then right on the same thing again."""
    wanted = call(make())
    k, happened = 1, True
    while happened:
        thing = make()
        found, happened = fails(k, and_later, lambda: call(thing))  # noqa: B023
        assert found is None or same(found, wanted), k
        assert happened or found is not None, k
        assert same(call(thing), wanted), k
        k += 1
    assert k > 2, "nothing allocates"


pytestmark = pytest.mark.parametrize("and_later", [False, True])


@pytest.mark.parametrize("strategy", ["exhaustive", "bvh"])
def test_searches(and_later, strategy):
    for call in (
        lambda _: allpairs.overlaps(*BOXES, strategy=strategy),
        lambda _: allpairs.overlaps(*BOXES, strategy=strategy, order="second", distance=1),
        lambda _: allpairs.neighbors(*BOXES, strategy=strategy),
        lambda _: allpairs.count(*BOXES, strategy=strategy),
        lambda _: allpairs.overlaps_between(BOXES, OTHERS, strategy=strategy),
        lambda _: allpairs.count_between(BOXES, OTHERS, strategy=strategy),
    ):
        check(and_later, lambda: None, call)


def test_searches_of_worlds(and_later):
    rows = np.hstack(BOXES).reshape(10, 30, 6)
    check(and_later, lambda: None, lambda _: allpairs.overlaps_in_worlds(rows))
    check(and_later, lambda: None, lambda _: allpairs.count_in_worlds(rows, shared=np.hstack(OTHERS)))


def test_batches(and_later):
    check(and_later, lambda: None, lambda _: list(allpairs.batches(*BOXES, batch_size=50)))
    check(and_later, lambda: None, lambda _: list(allpairs.batches_between(BOXES, OTHERS, batch_size=50)))


def a_world():
    world = allpairs.World()
    world.add(*BOXES)
    world.step()
    return world


def test_a_world_is_made(and_later):
    check(and_later, lambda: None, lambda _: len(allpairs.World(distance=1)))


def test_a_world_is_asked(and_later):
    rays = np.zeros((20, 3)), np.full((20, 3), 10.0)
    for call in (
        lambda world: world.overlapping(*OTHERS),
        lambda world: world.first_hits(*rays),
        lambda world: world.all_hits(*rays),
        lambda world: world.all_hits(np.hstack(OTHERS)[:20], rays[1], 2),
        lambda world: world.nearest(rays[1], 3),
        lambda world: world.boxes(np.arange(300)),
        lambda world: tuple(world.properties(np.arange(300)).values()),
        lambda world: world.overlaps_between(world),
        lambda world: world.statistics,
    ):
        check(and_later, a_world, call)


def test_a_change_of_a_world_is_made_as_a_whole_or_not_at_all(and_later):
    lower, upper = OTHERS
    some = np.arange(90)
    for change in (
        lambda world: world.add(lower, upper),
        lambda world: world.move(some, np.hstack([lower, upper])),
        lambda world: world.move_swept(some, np.hstack([lower, upper]), (lower + 1, upper + 1)),
        lambda world: world.remove(some),
        lambda world: world.clear(),
        lambda world: world.reserve(1000),
        lambda world: (world.shrink(), world.step()),
    ):
        k, happened = 1, True
        while happened:
            world, other = a_world(), a_world()
            done, happened = fails(k, and_later, lambda: (change(world),))  # noqa: B023
            if done is not None:
                change(other)
            assert len(world) == len(other), k
            assert same(world.step().pairs, other.step().pairs), k
            k += 1
        assert k > 2, "nothing allocates"


def test_a_step_of_a_world_that_failed_is_made_up_for(and_later):
    lower, upper = OTHERS

    def moved():
        world = a_world()
        world.move(np.arange(90), np.hstack([lower, upper]))
        return world

    check(and_later, moved, lambda world: world.step().pairs)


def test_candidates_of_meshes(and_later):
    vertices, triangles = sheet(6)
    moved = vertices + [0.3, 0.2, 0.0]

    def mesh():
        made = allpairs.MeshCandidates(triangles, len(vertices))
        made.set_positions(vertices, moved)
        return made

    check(and_later, lambda: None, lambda _: mesh().edges)
    check(and_later, mesh, lambda made: [made.find(kind) for kind in ("vertex-face", "edge-edge", "face-face")])


def test_scenes(and_later, tmp_path):
    np.save(tmp_path / "boxes.npy", np.hstack(BOXES))
    (tmp_path / "mesh.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\no a\nf 1 2 3\no b\nf 1 2 3\n")
    (tmp_path / "scene.scn").write_text(
        "<Node><Node name='a'><MechanicalObject template='Rigid3d' position='1 1 1 0 0 0 1'/>"
        "<OBBCollisionModel extents='1 1 1'/></Node></Node>"
    )
    for name in ("boxes.npy", "mesh.obj", "scene.scn"):
        check(and_later, lambda: None, lambda _: allpairs.load(tmp_path / name).detect())  # noqa: B023
        check(and_later, lambda: allpairs.load(tmp_path / name), lambda scene: scene.detect())  # noqa: B023
