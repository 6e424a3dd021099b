# SPDX-License-Identifier: MIT
"""Candidates of deforming meshes against the double loop."""

import allpairs
import numpy as np
import pytest


def sheet(n):
    """A grid of n by n vertices and its triangles."""
    x, y = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    vertices = np.column_stack([x.ravel(), y.ravel(), np.zeros(n * n)])
    a = np.arange(n * n).reshape(n, n)[:-1, :-1].ravel()
    return vertices, np.vstack([np.column_stack([a, a + 1, a + n]), np.column_stack([a + 1, a + n + 1, a + n])])


def candidates(first, second, start, end, same):
    """Every pair of elements, given by their vertices, whose boxes meet and that share no vertex."""
    both = np.stack([start, end])
    pairs = []
    for i, a in enumerate(first):
        for j, b in enumerate(second):
            if (same and j <= i) or set(a) & set(b):
                continue
            low, high = both[:, a].min((0, 1)), both[:, a].max((0, 1))
            if (low <= both[:, b].max((0, 1))).all() and (both[:, b].min((0, 1)) <= high).all():
                pairs.append([i, j])
    return pairs


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_candidates_are_those_of_the_double_loop(dtype):
    rng = np.random.default_rng(3)
    vertices, triangles = sheet(6)
    start = (vertices * 0.4 + rng.normal(0, 0.2, vertices.shape)).astype(dtype)
    end = (start + rng.normal(0, 0.1, vertices.shape)).astype(dtype)
    mesh = allpairs.MeshCandidates(triangles, len(vertices))
    mesh.set_positions(np.asfortranarray(start), end)
    edges = np.unique(np.sort(np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])), axis=0)
    np.testing.assert_array_equal(mesh.edges, edges)
    np.testing.assert_array_equal(mesh.triangles, triangles)
    points = np.arange(len(vertices))[:, None]
    for kind, first, second, same in (
        ("vertex-face", points, triangles, False),
        ("edge-edge", edges, edges, True),
        ("face-face", triangles, triangles, True),
    ):
        expected = candidates(first, second, start, end, same)
        found = mesh.find(kind)
        mesh.shrink()
        assert found.tolist() == mesh.find(kind).tolist() == expected
        assert mesh.count(kind) == len(expected) > 0


def test_two_meshes_meet_each_other_only_where_asked():
    vertices, triangles = sheet(3)
    meshes = allpairs.MeshCandidates([triangles, triangles], [9, 9], within=False, distance=0.5, threads=2)
    meshes.set_positions(vertices)
    meshes.set_positions(vertices + [0, 0, 0.5], mesh=1)
    found = meshes.find("face-face")
    assert len(found) > 0
    assert (found[:, 0] < 8).all()
    assert (found[:, 1] >= 8).all()
    meshes.set_positions(vertices + [0, 0, 0.75], mesh=1)
    assert meshes.find("face-face").shape == (0, 2)


def test_bad_input_is_named():
    with pytest.raises(allpairs.InvalidArgument, match="triangle"):
        allpairs.MeshCandidates([[0, 1, 9]], 3)
    with pytest.raises(allpairs.InvalidArgument, match=r"shape \(1, 4\)"):
        allpairs.MeshCandidates([[0, 1, 2, 3]], 4)
    with pytest.raises(allpairs.InvalidArgument, match="2 meshes and vertex_count of 1"):
        allpairs.MeshCandidates([[[0, 1, 2]], [[0, 1, 2]]], [3])
    mesh = allpairs.MeshCandidates([[0, 1, 2]], 3)
    with pytest.raises(ValueError, match="vertex 1"):
        mesh.set_positions([[0, 0, 0], [0, np.nan, 0], [0, 0, 0]])
    with pytest.raises(allpairs.InvalidArgument):
        mesh.set_positions(np.zeros((2, 3)))
    with pytest.raises(allpairs.InvalidArgument, match="'vertex-face', 'edge-edge', 'face-face'"):
        mesh.find("faces")


def test_meshes_without_positions_are_named():
    meshes = allpairs.MeshCandidates([[[0, 1, 2]], [[0, 1, 2]], np.empty((0, 3), int)], [3, 3, 0])
    assert repr(meshes) == "MeshCandidates(2 triangles, 6 edges)"
    meshes.set_positions(np.eye(3), mesh=0)
    for search in (meshes.find, meshes.count):
        with pytest.raises(allpairs.InvalidArgument, match="mesh 1 has no positions"):
            search("face-face")
    meshes.set_positions(np.eye(3), mesh=1)
    assert meshes.count("face-face") == 1


def test_what_is_no_list_of_meshes_is_named():
    with pytest.raises(TypeError, match="^vertex_count is of type NoneType; it takes one for each mesh$"):
        allpairs.MeshCandidates([[0, 1, 2]], None)
    with pytest.raises(TypeError, match="^triangles is of type int; it takes one for each mesh$"):
        allpairs.MeshCandidates(5, [3])
    with pytest.raises(allpairs.InvalidArgument, match=r"^triangles of mesh 0\[0, 2\] is -1; it takes 0 to 4294967295$"):
        allpairs.MeshCandidates([[0, 1, -1]], 4)
