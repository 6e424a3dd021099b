# SPDX-License-Identifier: MIT
"""Scenes, meshes and box arrays from files."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple, Union

import numpy as np
import numpy.typing as npt

from . import _arguments
from ._errors import file_error
from ._search import Pairs

if TYPE_CHECKING:
    from . import _files

Path = Union[str, "os.PathLike[str]"]


class Model(NamedTuple):
    """The record of one collision model in a scene."""

    name: str
    type: str
    elements: int
    active: bool
    simulated: bool
    moving: bool
    self_collision: bool
    groups: tuple[int, ...]
    contact_distance: float


class Remark(NamedTuple):
    """A part of the input that was skipped, and why; ``line`` counts from 1 and is 0 if unknown."""

    file: str
    line: int
    subject: str
    reason: str
    is_partial: bool


class Scene:
    """The result of `load`: n collision models and their intersection method.

    Attributes
    ----------
    boxes : ndarray, shape (n, 6), read-only
        The root box of each model: float64. Of a file of boxes, the boxes as they are there, float32 or float64.
    method : str
        The intersection method.
    alarm_distance : float
        The largest gap on each axis at which two models are reported.
    region : ndarray, shape (2, 3), or None
        Models outside it are excluded.
    remarks : list of Remark
        The parts of the input that were skipped.
    warnings : list of Remark
        Where the result may not be what is expected, though no part was skipped: a scene without a collision pipeline,
        boxes with min above max.
    """

    def __init__(self, core: _files.Scene) -> None:
        self._core = core
        self.boxes: npt.NDArray[np.float32] | npt.NDArray[np.float64] = np.asarray(core)
        self.boxes.setflags(write=False)  # of no boxes NumPy makes memory of its own
        self.method = core.method()
        self.alarm_distance = core.alarm_distance()
        bounds = core.region()
        self.region = None if bounds is None else np.array(bounds).reshape(2, 3)
        self.remarks = [Remark(*fields) for fields in core.remarks()]
        self.warnings = [Remark(*fields) for fields in core.warnings()]

    def __len__(self) -> int:
        return len(self._core)

    def __getitem__(self, index: int) -> Model:
        """The model with this index."""
        number = _arguments.integer("index", index)
        if not -len(self) <= number < len(self):
            raise IndexError(f"there is no model {number if abs(number) < 2**64 else 'of that number'}; the scene has {len(self)}")
        return Model(*self._core.model(number % len(self)))

    def __iter__(self) -> Iterator[Model]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        return f"<Scene of {len(self)} models, {self.method}, alarm distance {self.alarm_distance:g}>"

    @property
    def names(self) -> list[str]:
        """The name of each model."""
        return [model.name for model in self]

    def detect(
        self,
        *,
        distance: float | None = None,
        region: npt.ArrayLike | None = None,
        strategy: _arguments.Strategy = "auto",
        threads: int = 1,
        verify: bool = False,
    ) -> Pairs:
        """The pairs of models that may touch, by their root boxes and by the rules of the scene.

        Parameters
        ----------
        distance : float, optional
            In place of the scene's alarm distance.
        region : array_like, shape (2, 3) or (6,), optional
            In place of the scene's region.
        strategy, threads
            As in `allpairs.overlaps`.
        verify : bool
            Also test all pairs one by one, and raise Error if the two lists differ.

        Returns
        -------
        ndarray, shape (m, 2), uint32
            In the orientation and the order of the double loop: newer model first, (1, 0) (2, 0) (2, 1) (3, 0) ...
        """
        from . import _reading

        options = _reading.DetectionOptions()
        options.distance = None if distance is None else _arguments.number("distance", distance)
        options.strategy = _arguments.strategy_of(strategy)
        options.threads = _arguments.threads_of(threads)
        options.verify = _arguments.flag("verify", verify)
        if region is not None:
            options.set_region(_arguments.region_of(region))
        return np.asarray(self._core.detect(options))


class Detection(NamedTuple):
    """The result of `detect`: the scene, and the pairs of its models that may touch."""

    scene: Scene
    pairs: Pairs

    @property
    def names(self) -> list[tuple[str, str]]:
        """The names of each pair, in the order of ``pairs``."""
        names = self.scene.names
        return [(names[first], names[second]) for first, second in self.pairs.tolist()]


def _search_roots_of(search_roots: Iterable[Path]) -> list[str]:
    """Folders, all of which exist."""
    roots = _arguments.paths_of("search_roots", search_roots)
    for root in roots:
        if not os.path.isdir(root):
            raise file_error(root, "is not a folder; search_roots takes folders")
    return roots


def load(
    path: Path,
    *,
    search_roots: Iterable[Path] = (),
    partial: bool = False,
    sofa: str = "",
    allow_outside: bool = False,
    max_memory: int = 0,
    recursive: bool = False,
) -> Scene:
    """Reads a SOFA scene (.scn, .xml), a mesh file, a folder of mesh files, or boxes (.npy, .csv).

    Parameters
    ----------
    path : str or path
    search_roots : str or path, or several
        Folders to search for files that a scene names, after its own folder.
    partial : bool
        Skip models that cannot be placed, with a remark, instead of raising.
    sofa : str
        Read a scene as this version of SOFA does, such as "24.06": up to "20.06", or from "22.06" to "26.12". By
        default the one that knows the scene's components.
    allow_outside : bool
        Read files that the input names in any folder, not only in its own folder and the search roots.
    max_memory : int
        The most bytes that reading may take; by default, 0, half of the machine's memory and no more than 256 MiB plus
        256 bytes for each byte of the files that are read.
    recursive : bool
        Of a folder, read the mesh files of the folders within it as well.

    Raises
    ------
    FileError
        With the file, line and column; it is a ValueError and an OSError.
    ImportError
        Of a build without readers of files.
    """
    from . import _reading

    options = _reading.ReadOptions()
    options.search_roots = _search_roots_of(search_roots)
    if not isinstance(sofa, str):
        raise TypeError(f"sofa is {_arguments.shown(sofa)}; it takes a str")
    if sofa:
        options.sofa = _reading.sofa_version(sofa)
    options.max_memory = _arguments.whole("max_memory", max_memory)
    options.partial = _arguments.flag("partial", partial)
    options.allow_outside = _arguments.flag("allow_outside", allow_outside)
    options.recursive = _arguments.flag("recursive", recursive)
    return Scene(_reading.load(_arguments.path_of("path", path), options))


def detect(
    path: Path,
    *,
    search_roots: Iterable[Path] = (),
    partial: bool = False,
    sofa: str = "",
    allow_outside: bool = False,
    max_memory: int = 0,
    recursive: bool = False,
    distance: float | None = None,
    region: npt.ArrayLike | None = None,
    strategy: _arguments.Strategy = "auto",
    threads: int = 1,
    verify: bool = False,
) -> Detection:
    """Reads a file or folder as `load` does and finds the pairs that may touch, as `Scene.detect` does.

    Raises
    ------
    FileError
        As `load`; and if ``partial`` leaves no model, since the result would say nothing of the file.

    Examples
    --------
    >>> import allpairs
    >>> detection = allpairs.detect("examples/boxes.csv")
    >>> detection.names
    [('lamp', 'table'), ('chair', 'table')]
    >>> detection.pairs
    array([[1, 0],
           [2, 0]], dtype=uint32)
    """
    scene = load(
        path,
        search_roots=search_roots,
        partial=partial,
        sofa=sofa,
        allow_outside=allow_outside,
        max_memory=max_memory,
        recursive=recursive,
    )
    if not len(scene) and any(remark.is_partial for remark in scene.remarks):
        problem = "no model of it can be placed or read; load(..., partial=True).remarks says why"
        raise file_error(os.fsdecode(path), problem)
    pairs = scene.detect(distance=distance, region=region, strategy=strategy, threads=threads, verify=verify)
    return Detection(scene, pairs)
