# SPDX-License-Identifier: MIT
"""The package's types, as a type checker reads them, its documentation, and what its extension module is bound to."""

import ast
import inspect
import pathlib
import subprocess
import sys

import allpairs
import pytest
from allpairs import _core
from conftest import READS_FILES

EXTENSIONS = [_core]
if READS_FILES:
    from allpairs import _files

    EXTENSIONS.append(_files)

PACKAGE = pathlib.Path(allpairs.__file__).parent

USE = """
import numpy as np, numpy.typing as npt
import allpairs
pairs: npt.NDArray[np.uint32] = allpairs.overlaps(np.zeros((2, 3)), np.ones((2, 3)), margin=0.5, threads=0)
number: int = allpairs.count([[0.0] * 6])
for batch in allpairs.batches_between(np.zeros((2, 6)), ([[0, 0, 0]], [[1, 1, 1]]), group=([1, 1], None)):
    print(batch.shape)
name: str = allpairs.load("a.scn")[0].name
world = allpairs.World(order="second")
inside: bool = 3 in world
world.set_properties([0], **world.properties([1]))
plain = allpairs.count_between(np.zeros((2, 4)), np.zeros((2, 4)), mask=1, strategy="bvh")
wrong: str = allpairs.count([])
allpairs.overlaps([], order="third")
allpairs.count([], strategy="brute")
allpairs.World(order="unordered")
allpairs.MeshCandidates([], 0).find("edge-face")
"""

WITHOUT_NUMPY = """
import array, importlib.machinery, importlib.util, sys
sys.modules["numpy"] = None  # an import of it fails
loader = importlib.machinery.ExtensionFileLoader("_core", sys.argv[1])
core = importlib.util.module_from_spec(importlib.util.spec_from_loader("_core", loader))
corners = [memoryview(array.array("d", values)).cast("B").cast("d", (2, 3)) for values in ([0, 0, 0, 1, 1, 1], [1] * 6)]
print(memoryview(core.overlaps(core.Boxes(*corners, ""), core.Options())).tolist())
"""


def test_the_package_says_that_it_has_types():
    assert (PACKAGE / "py.typed").exists()


def test_a_type_checker_finds_the_errors_of_a_program_and_no_others(tmp_path):
    pytest.importorskip("mypy")
    (tmp_path / "use.py").write_text(USE)
    command = [sys.executable, "-m", "mypy", "--strict", f"--cache-dir={PACKAGE.parent}/.mypy_cache", str(tmp_path / "use.py")]
    result = subprocess.run(command, capture_output=True, text=True, check=False, cwd=PACKAGE.parent)
    errors = [line for line in result.stdout.splitlines() if ": error: " in line]
    assert len(errors) == 5, result.stdout  # errors within the package would be here too
    assert "use.py:13: error: Incompatible types" in errors[0]
    for line, error in enumerate(errors[1:], start=14):
        assert f"use.py:{line}: error: Argument" in error
        assert "expected \"Literal[" in error or "Union[Literal[" in error


def test_what_the_package_exports_is_there_and_documented():
    for name in allpairs.__all__:
        assert getattr(allpairs, name).__doc__, name


def public(names):
    return {name for name in names if not name.startswith("_") or name in ("__init__", "__len__")}


def members(node):
    """The names that a class of a stub has."""
    fields = {part.target.id for part in node.body if isinstance(part, ast.AnnAssign)}
    return public(fields | {part.name for part in node.body if isinstance(part, ast.FunctionDef)})


@pytest.mark.parametrize("extension", EXTENSIONS)
def test_the_stub_of_the_extension_names_what_is_in_it_and_nothing_else(extension):
    stub = ast.parse((PACKAGE / f"{extension.__name__.rsplit('.')[-1]}.pyi").read_text())
    classes = {node.name: members(node) for node in stub.body if isinstance(node, ast.ClassDef)}
    functions = {node.name for node in stub.body if isinstance(node, ast.FunctionDef)}
    values = {node.target.id for node in stub.body if isinstance(node, ast.AnnAssign)}
    assert public(vars(extension)) == set(classes) | functions | values
    for name, stubbed in classes.items():
        there = public(vars(getattr(extension, name)))
        enumeration = {"name", "value"} if "name" in there else set()  # pybind11's own
        constructor = {"__init__"} - stubbed  # of what is made by the extension only, or takes nothing
        assert there - enumeration - constructor == stubbed - ({"__init__"} - there), name


def documented(kind):
    return [name for name, member in inspect.getmembers(kind, inspect.isfunction) if not name.startswith("_")]


def test_every_method_is_documented_and_every_array_has_a_shape():
    for kind in (allpairs.World, allpairs.Scene, allpairs.MeshCandidates):
        for name in documented(kind):
            text = inspect.getdoc(getattr(kind, name))
            assert text, f"{kind.__name__}.{name}"
            assert text.count("ndarray") + text.count("array_like") <= text.count("shape"), f"{kind.__name__}.{name}"
    for name in ("overlaps", "overlaps_between", "batches"):
        text = inspect.getdoc(getattr(allpairs, name))
        assert "ndarray, shape (m, 2), uint32" in text, name
    assert "shape (n, 3), float32 or float64" in inspect.getdoc(allpairs.overlaps)


def test_the_extension_is_bound_to_no_numpy():
    content = pathlib.Path(_core.__file__).read_bytes()
    for word in (b"_ARRAY_API", b"multiarray", b"numpy.core", b"numpy._core"):  # by which the C interface is found
        assert word not in content, word
    command = [sys.executable, "-c", WITHOUT_NUMPY, _core.__file__]
    result = subprocess.run(command, capture_output=True, text=True, check=True)
    assert result.stdout == "[[0, 1]]\n"
