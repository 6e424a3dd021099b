# SPDX-License-Identifier: MIT
"""Moving boxes: their pairs step by step, and queries."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _arguments, _core
from ._queries import NO_BOX, Ids, WorldQueries
from ._search import Pairs

#: The world number of a box that every world has, such as the ground.
EVERY_WORLD: int = _core.EVERY_WORLD


class Step(NamedTuple):
    """The pairs of a step, each array of shape (m, 2), uint32, in ascending order, with ``first < second``."""

    pairs: Pairs
    """All pairs."""
    began: Pairs
    """Pairs that did not exist in the last step."""
    persisted: Pairs
    """Pairs that also existed in the last step."""
    ended: Pairs
    """Pairs of the last step that no longer exist; their boxes may have been removed."""


class WorldStatistics(NamedTuple):
    """What the last step of a `World` did, and all its steps."""

    box_tests: int
    """Tests of two boxes."""
    group_tests: int
    """Tests of the bounds of two groups, or of a box and a group."""
    exact_tests: int
    """Candidates of the test in float32 that were tested again in float64."""
    changed: int
    """Boxes that were added, moved, removed or given other properties."""
    joined_all: bool
    """Whether the step joined all boxes, instead of only the changed ones with all."""
    rebuilds: int
    """Full rebuilds of a hierarchy up to the last step, by steps and queries; with world numbers, how often a world's
    boxes were put in order."""


#: The properties that are integers, in the order in which _core.World.state() has them.
_LABELS = ("category", "mask", "group", "static", "world")


def _properties(size: int, values: dict[str, Any]) -> _core.Properties:
    """Fields of boxes from numbers or arrays; what is None is not set."""
    properties = _core.Properties(size)
    for name in _LABELS:
        if values[name] is not None:
            getattr(properties, "set_" + name)(_arguments.labels(name, values[name], size))
    if values["margin"] is not None:
        given = _arguments.floats("margin", values["margin"])
        margins = np.broadcast_to(given, (size,)) if given.ndim == 0 else _arguments.of_length("margin", given, size)
        properties.set_margin(_arguments.contiguous(margins, dtype=np.float64))
    return properties


def _columns(labels: npt.NDArray[np.uint32]) -> dict[str, npt.NDArray[Any]]:
    """Properties that are integers by their names, from rows of them."""
    columns: dict[str, npt.NDArray[Any]] = {name: labels[:, i].copy() for i, name in enumerate(_LABELS)}
    return {**columns, "static": columns["static"].astype(bool)}


class World(WorldQueries):
    """Boxes that are added, moved and removed by id, their overlapping pairs step by step, and queries.

    Each step costs what has changed since the last one. Boxes are closed.

    Boxes may be in the plane, of two axes: they are unbounded in depth, so that pairs and queries depend on the two axes
    alone. Points, rays and boxes of queries may be in the plane too: points and rays there have depth 0. Boxes of two and
    of three axes may be in one world.

    Boxes may be of many worlds, such as the copies of a scene that robots learn in: those of different worlds are never
    pairs and are not tested against each other, wherever they are. A step then searches the worlds in which a box has
    changed.

    A world can be copied and pickled. The copy has the settings and all boxes, with their `ids`, bounds and properties. It
    has no last step: its next one lists all pairs among those that began. New boxes may get other ids.

    Calls of several threads wait for each other; the arrays that a call is given must not change before it returns. A
    world that another thread uses while the process forks is not to be used in the child, where that call never ends.

    Parameters
    ----------
    distance : float
        Boxes that are at most this far apart on every axis are a pair.
    order : {"first", "second"}
        The order of the lists of a step: ascending by (first, second), or by (second, first).
    threads : int
        The maximum number of threads; 0 means one per hardware thread. It never changes a result.

    Examples
    --------
    >>> import allpairs
    >>> world = allpairs.World()
    >>> ids = world.add([[0, 0, 0], [2, 0, 0], [9, 0, 0]], [[1, 1, 1], [3, 1, 1], [10, 1, 1]])
    >>> ids
    array([0, 1, 2], dtype=uint32)
    >>> world.step().pairs
    array([], shape=(0, 2), dtype=uint32)
    >>> world.move(ids[1:2], [[8, 0, 0, 9, 1, 1]])
    >>> world.step().began
    array([[1, 2]], dtype=uint32)
    >>> world.remove([2])
    >>> world.step().ended
    array([[1, 2]], dtype=uint32)
    """

    def __init__(self, *, distance: float = 0.0, order: _arguments.StepOrder = "first", threads: int = 1) -> None:
        self._settings = (_arguments.number("distance", distance), order, _arguments.threads_of(threads))
        self._core = self._empty()

    def _empty(self) -> _core.World:
        distance, order, threads = self._settings
        return _core.World(distance, _arguments.order_of(order), threads)

    def __getstate__(self) -> dict[str, Any]:
        """The settings, and ids, bounds and properties of all boxes; and the attributes that others have set."""
        ids, boxes, properties, margin = map(np.asarray, self._core.state())
        columns = _columns(properties)
        own = {name: value for name, value in vars(self).items() if name not in ("_settings", "_core")}
        return {"settings": self._settings, "ids": ids, "boxes": boxes, "margin": margin, **columns, "attributes": own}

    def __setstate__(self, state: dict[str, Any]) -> None:
        vars(self).update(state.get("attributes", {}))
        self._settings = state["settings"]
        self._core = self._empty()
        ids = state["ids"]
        if len(ids) == 0:
            return
        # The ids of a new world are consecutive; those of empty boxes that go before the first step are free after it.
        bound = int(ids[-1]) + 1
        # Not by methods of a derived class, which may count calls or take other arguments.
        World.add(self, np.tile([1.0, 0, 0, 0, 0, 0], (bound, 1)))
        World.remove(self, np.setdiff1d(np.arange(bound, dtype=np.uint32), ids, assume_unique=True))
        World.step(self)
        World.move(self, ids, state["boxes"])
        # States of earlier versions have no worlds.
        World.set_properties(self, ids, **{name: state[name] for name in (*_LABELS, "margin") if name in state})

    def add(
        self,
        lower: npt.ArrayLike,
        upper: npt.ArrayLike | None = None,
        *,
        category: npt.ArrayLike | None = None,
        mask: npt.ArrayLike | None = None,
        group: npt.ArrayLike | None = None,
        margin: npt.ArrayLike | None = None,
        static: npt.ArrayLike | None = None,
        world: npt.ArrayLike | None = None,
    ) -> Ids:
        """Adds boxes.

        Parameters
        ----------
        lower, upper : array_like, shape (n, 3), or one of shape (n, 6)
            As in `allpairs.overlaps`; in the plane (n, 2) or (n, 4). One box may have shape (3,) or (6,), in the plane
            (2,) or (4,). They are copied.
        category, mask : int or array_like, shape (n,)
            Bits: a pair is kept if each box's mask shares a bit with the other's category. All bits are set by default.
        group : int or array_like, shape (n,)
            Boxes of the same group are never paired, unless it is 0.
        margin : float or array_like, shape (n,)
            How far each box extends beyond its bounds.
        static : bool or array_like, shape (n,)
            Static boxes are never paired with each other. They may still be moved.
        world : int or array_like, shape (n,)
            The number of the world that a box is of, 0 by default; EVERY_WORLD for a box that all worlds have.

        Returns
        -------
        ndarray, shape (n,), uint32
            The ids of the boxes, small numbers. Those of removed boxes are reused, but only after the step that reports
            that their pairs have ended.
        """
        boxes = _arguments.world_boxes(lower, upper)
        return np.asarray(self._core.add(boxes, _properties(len(boxes), locals())))

    def move(self, ids: npt.ArrayLike, lower: npt.ArrayLike, upper: npt.ArrayLike | None = None) -> None:
        """Sets the bounds of boxes.

        Parameters
        ----------
        ids : int or array_like, shape (k,), integers
        lower, upper : array_like, shape (k, 3), or one of shape (k, 6); (3,) or (6,) for one box
            With 2 and 4 instead of 3 and 6 in the plane.
        """
        self._core.move(_arguments.ids(ids), _arguments.world_boxes(lower, upper))

    def move_swept(
        self, ids: npt.ArrayLike, starts: _arguments.BoxesLike, ends: _arguments.BoxesLike
    ) -> None:
        """Sets the bounds of boxes to the union of their start and end in a step.

        Parameters
        ----------
        ids : array_like, shape (k,), integers
        starts, ends : array_like, shape (k, 6), or tuple of two array_like of shape (k, 3)
            With 4 and 2 instead of 6 and 3 in the plane.
        """
        begin = _arguments.world_boxes(*_arguments.two_corners(starts, "starts: "), "starts: ")
        end = _arguments.world_boxes(*_arguments.two_corners(ends, "ends: "), "ends: ")
        self._core.move_swept(_arguments.ids(ids), begin, end)

    def remove(self, ids: npt.ArrayLike) -> None:
        """Removes boxes; the next step lists their pairs among those that ended.

        Parameters
        ----------
        ids : array_like, shape (k,), integers
        """
        self._core.remove(_arguments.ids(ids))

    def clear(self) -> None:
        """Removes all boxes; the next step lists their pairs among those that ended."""
        self._core.clear()

    def set_properties(
        self,
        ids: npt.ArrayLike,
        *,
        category: npt.ArrayLike | None = None,
        mask: npt.ArrayLike | None = None,
        group: npt.ArrayLike | None = None,
        margin: npt.ArrayLike | None = None,
        static: npt.ArrayLike | None = None,
        world: npt.ArrayLike | None = None,
    ) -> None:
        """Sets properties of boxes, those of `add`; an omitted one stays as it is."""
        chosen = _arguments.ids(ids)
        self._core.set_properties(chosen, _properties(len(chosen), locals()))

    def reserve(self, boxes: int) -> None:
        """Reserves memory for that many boxes in all, so that adding them allocates little.

        Parameters
        ----------
        boxes : int
        """
        self._core.reserve(_arguments.whole("boxes", boxes, most=NO_BOX))

    def shrink(self) -> None:
        """Releases the memory that neither the boxes nor the pairs of the last step need.

        The next step or query rebuilds the hierarchy of the boxes. Arrays that calls have returned are not concerned.
        """
        self._core.shrink()

    def __repr__(self) -> str:
        return f"World({len(self)} boxes)"

    def __len__(self) -> int:
        return self._core.size()

    def __contains__(self, id: object) -> bool:
        single = id.item() if type(id) is np.ndarray and id.ndim == 0 else id  # no masked one, whose number is hidden
        is_id = isinstance(single, (int, np.integer)) and not isinstance(single, bool) and not _arguments.is_time(id)
        number = int(single) if is_id else -1
        return 0 <= number < NO_BOX and self._core.contains(number)

    def ids(self) -> Ids:
        """The ids of all boxes, in ascending order; ``world.boxes(world.ids())`` are all bounds."""
        return np.asarray(self._core.ids())

    def boxes(self, ids: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The bounds of boxes.

        Parameters
        ----------
        ids : array_like, shape (k,), integers

        Returns
        -------
        ndarray, shape (k, 6), float64
            A box in the plane reaches from minus infinity to infinity in depth.
        """
        return np.asarray(self._core.boxes(_arguments.ids(ids)))

    def properties(self, ids: npt.ArrayLike) -> dict[str, npt.NDArray[Any]]:
        """The properties of boxes, by the names that `add` and `set_properties` have for them.

        ``world.set_properties(ids, **world.properties(others))`` makes boxes what others are.

        Parameters
        ----------
        ids : array_like, shape (k,), integers

        Returns
        -------
        dict
            Of "category", "mask", "group" and "world" to ndarray, shape (k,), uint32; of "static" to ndarray, shape (k,), bool;
            of "margin" to ndarray, shape (k,), float64.
        """
        labels, margin = map(np.asarray, self._core.properties(_arguments.ids(ids)))
        return {**_columns(labels), "margin": margin}

    def step(self) -> Step:
        """The current pairs of the boxes, and the changes since the last step."""
        return Step(*map(np.asarray, self._core.step()))

    @property
    def statistics(self) -> WorldStatistics:
        """What the last step tested, all 0 in a new world; it depends on the processor.

        Those of a step that was interrupted or failed mean nothing, nor do those of a copy before its first step.
        """
        last = self._core.statistics()
        return WorldStatistics(*(getattr(last, name) for name in WorldStatistics._fields))

    def result(self, world: int) -> Step:
        """The lists of the last step for one world.

        Parameters
        ----------
        world : int
            The pairs of its boxes with each other and with those of every world; with EVERY_WORLD, the pairs of two boxes
            of every world. A number that no box has gives empty lists.

        A pair whose boxes are given another world is among those that ended in the one and began in the other, while
        `step` has it among those that persisted.
        """
        return Step(*map(np.asarray, self._core.result_of(_arguments.bits("world", world))))
