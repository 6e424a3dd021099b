# SPDX-License-Identifier: MIT
"""What a World can be asked."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from . import _arguments, _core
from ._search import Pairs

#: Boxes of a World by number: shape (n,).
Ids = npt.NDArray[np.uint32]

#: The id that no box has.
NO_BOX: int = _core.NO_BOX


def _query_filter(values: dict[str, Any]) -> _core.QueryFilter:
    query = _core.QueryFilter()
    query.category = _arguments.bits("category", values["category"])
    query.mask = _arguments.bits("mask", values["mask"])
    query.static, query.moving = (_arguments.flag(name, values[name]) for name in ("static", "moving"))
    if values["world"] is not None:
        query.world = _arguments.whole("world", values["world"], most=_core.EVERY_WORLD - 1)
    return query


class WorldQueries:
    """The queries of a `World`."""

    _core: _core.World

    def overlapping(
        self,
        lower: npt.ArrayLike,
        upper: npt.ArrayLike | None = None,
        *,
        category: int = 0xFFFFFFFF,
        mask: int = 0xFFFFFFFF,
        static: bool = True,
        moving: bool = True,
        world: int | None = None,
    ) -> Pairs:
        """The boxes of the world that overlap each of the given boxes.

        Each box of the world extends by its margin, and the distance of the world does not count.

        Parameters
        ----------
        lower, upper : array_like, shape (k, 3), or one of shape (k, 6); (3,) or (6,) for one box
            With 2 and 4 instead of 3 and 6 in the plane.
        category, mask : int
            Only boxes whose category shares a bit with ``mask`` and whose mask with ``category``.
        static, moving : bool
            Whether to consider static boxes, and others.
        world : int, optional
            Only boxes of this world and those of every world; not EVERY_WORLD. Without it, all worlds are searched one
            after the other.

        Returns
        -------
        ndarray, shape (m, 2), uint32
            In each row the index of a query and the id of a box, in ascending order.
        """
        query = _query_filter(locals())
        return np.asarray(self._core.overlapping(_arguments.world_boxes(lower, upper), query))

    def first_hits(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        length: npt.ArrayLike = np.inf,
        *,
        category: int = 0xFFFFFFFF,
        mask: int = 0xFFFFFFFF,
        static: bool = True,
        moving: bool = True,
        world: int | None = None,
    ) -> tuple[Ids, npt.NDArray[np.float64]]:
        """The first box that each ray hits, or each box that moves; of several at the same t, the one with the smallest id.

        Each box of the world extends by its margin, and the distance of the world does not count.

        Parameters
        ----------
        origins : array_like, shape (k, 3) or (3,); in the plane (k, 2) or (2,)
            Where rays begin. Or boxes that move, shape (k, 6) or (6,); in the plane (k, 4) or (4,).
        directions : array_like, shape (k, 3) or (3,); in the plane (k, 2) or (2,)
            Of one of the two, origins and directions, there may be one for all of the other.
        length : float or array_like, shape (k,)
            Rays end at ``origin + length * direction``, and so do boxes: it is 1 if the direction is the whole motion.

        The others are those of `overlapping`.

        Returns
        -------
        ids : ndarray, shape (k,), uint32
            NO_BOX for a ray without a hit.
        t : ndarray, shape (k,), float64
            The parameter of the hit, in units of the direction; infinity without a hit.
        """
        query = _query_filter(locals())
        ids, t = self._core.first_hits(_arguments.sweeps(origins, directions, length), query)
        return np.asarray(ids), np.asarray(t)

    def all_hits(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        length: npt.ArrayLike = np.inf,
        *,
        category: int = 0xFFFFFFFF,
        mask: int = 0xFFFFFFFF,
        static: bool = True,
        moving: bool = True,
        world: int | None = None,
    ) -> tuple[npt.NDArray[np.int64], Ids, npt.NDArray[np.float64]]:
        """All boxes that each ray hits, or each box that moves, by ascending (t, id).

        Those of ray i are ``ids[indptr[i]:indptr[i + 1]]``, hit at ``t[indptr[i]:indptr[i + 1]]``.

        The parameters are those of `first_hits`.

        Returns
        -------
        indptr : ndarray, shape (k + 1,), int64
        ids : ndarray, shape (m,), uint32
        t : ndarray, shape (m,), float64
            In units of the direction; 0 for a box that is hit where the ray begins.
        """
        query = _query_filter(locals())
        indptr, ids, t = self._core.all_hits(_arguments.sweeps(origins, directions, length), query)
        return np.asarray(indptr).view(np.int64), np.asarray(ids), np.asarray(t)

    def nearest(
        self,
        points: npt.ArrayLike,
        k: int = 1,
        *,
        category: int = 0xFFFFFFFF,
        mask: int = 0xFFFFFFFF,
        static: bool = True,
        moving: bool = True,
        world: int | None = None,
    ) -> tuple[Ids, npt.NDArray[np.float64]]:
        """The boxes nearest to each point, or to each box, by Euclidean distance; 0 inside of a box, or where two overlap.

        Each box extends by its margin, and the distance of the world does not count.

        Parameters
        ----------
        points : array_like, shape (n, 3) or (3,); in the plane (n, 2) or (2,)
            Or boxes, shape (n, 6) or (6,); in the plane (n, 4) or (4,). An empty box is near nothing.
        k : int
            The arrays have as many columns, and take 12 bytes for each entry, however few boxes there are.

        The others are those of `overlapping`.

        Returns
        -------
        ids : ndarray, shape (n, k), uint32
            NO_BOX for missing entries, if there are fewer than k boxes.
        distances : ndarray, shape (n, k), float64
        """
        query = _query_filter(locals())
        count = _arguments.whole("k", k, least=1, most=NO_BOX)
        places = _arguments.places("points", _arguments.array_of("points", points))
        ids, distances = self._core.nearest(_arguments.contiguous(places), count, query)
        return np.asarray(ids), np.asarray(distances)

    def overlaps_between(self, other: WorldQueries) -> Pairs:
        """All pairs of a box of this world and one of another that overlap.

        They overlap at the mean of the distances of the two worlds, with the margins of both boxes. Masks, groups and world
        numbers decide about them as within a world; two static boxes are a pair, too. With itself, a world has each box with
        each that it overlaps, which it does itself.

        Parameters
        ----------
        other : World

        Returns
        -------
        ndarray, shape (m, 2), uint32
            In each row the id of a box of this world and that of one of the other, in the order of this world.
        """
        if not isinstance(other, WorldQueries):
            raise TypeError(f"other is {_arguments.shown(other)}; it takes a World")
        return np.asarray(self._core.between(other._core))
