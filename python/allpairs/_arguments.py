# SPDX-License-Identifier: MIT
"""Converts callers' arguments to those of _core; suitable arrays are not copied."""

from __future__ import annotations

import operator
import os
from collections.abc import Callable, Iterable, Sequence
from decimal import Decimal
from numbers import Real
from typing import Any, Literal, NamedTuple, TypeVar, Union, cast

import numpy as np
import numpy.typing as npt

from . import _core, _masked
from ._errors import InvalidArgument, InvalidBox

#: Boxes as one array of shape (n, 6), or as two of shape (n, 3); with 4 and 2 instead of 6 and 3 in the plane.
BoxesLike = Union[npt.ArrayLike, tuple[npt.ArrayLike, npt.ArrayLike]]

#: What each box may have beside its bounds, in the order of the arguments.
OF_EACH_BOX = ("margin", "group", "category", "mask")

#: The orders of pairs, of the lists of a World, and how pairs are found.
Order = Literal["first", "second", "unordered"]
StepOrder = Literal["first", "second"]
Strategy = Literal["auto", "exhaustive", "bvh"]

Chosen = TypeVar("Chosen")

_UINT32_MAX = 0xFFFFFFFF
_UINT64_MAX = 0xFFFFFFFFFFFFFFFF
_MOST_THREADS = 9999
_EXACT_INTEGERS = 2**53  # up to here float64 holds every integer

_ORDERS = {"first": _core.Order.first, "second": _core.Order.second, "unordered": _core.Order.unordered}
_STRATEGIES = {
    "auto": _core.Strategy.auto,
    "exhaustive": _core.Strategy.exhaustive,
    "bvh": _core.Strategy.bvh,
}


def choice(name: str, value: str, choices: dict[str, Chosen]) -> Chosen:
    try:
        return choices[value]
    except (KeyError, TypeError):
        raise InvalidArgument(f"{name} is {shown(value)}; it can be {', '.join(map(repr, choices))}") from None


def order_of(order: str) -> _core.Order:
    return choice("order", order, _ORDERS)


def strategy_of(strategy: str) -> _core.Strategy:
    return choice("strategy", strategy, _STRATEGIES)


def integer(name: str, value: int) -> int:
    _masked.refuse(name, value)
    try:
        return operator.index(value.item() if isinstance(value, np.bool_) else value)  # as of Python's own bool
    except TypeError:
        raise TypeError(f"{name} is {shown(value)}; it takes an integer") from None


def whole(name: str, value: int, least: int = 0, most: int = _UINT64_MAX) -> int:
    """An argument that counts something."""
    number = integer(name, value)
    if number < least:
        raise InvalidArgument(f"{name} is {shown(number)}; it is at least {least}")
    if number > most:
        raise InvalidArgument(f"{name} is {shown(number)}; it is at most {most}")
    return number


def threads_of(threads: int) -> int:
    """A number of threads; 0 means as many as the machine has."""
    return whole("threads", threads, most=_MOST_THREADS)


def bits(name: str, value: int) -> int:
    """A bit set."""
    return whole(name, value, most=_UINT32_MAX)


def number(name: str, value: float) -> float:
    """A single number; what is wrong with its value is for the engine to say."""
    _masked.refuse(name, value)
    if not isinstance(value, (str, bytes, bytearray)) and not is_time(value):
        try:
            return float(value)
        except OverflowError:
            raise InvalidArgument(f"{name} is {shown(value)}, which float64 does not hold") from None
        except (TypeError, ValueError):
            pass
    raise TypeError(f"{name} is {shown(value)}; it takes a number")


def shown(value: object) -> str:
    """A value as messages show it: on one line, and not all of it if it is long."""
    text = " ".join(repr(value).split()) if not isinstance(value, int) or abs(value) < _UINT64_MAX**2 else "a large integer"
    return text if len(text) <= 80 else text[:77] + "..."


def path_of(name: str, value: str | bytes | os.PathLike[Any]) -> str:
    """A path of a file or folder."""
    try:
        path = os.fsdecode(value)
        encoded = os.fsencode(path)
    except TypeError:
        raise TypeError(f"{name} is {shown(value)}; it takes a path") from None
    except UnicodeError:
        raise InvalidArgument(f"{name} is {shown(value)}, which no file can be called") from None
    if b"\0" in encoded:
        raise InvalidArgument(f"{name} is {shown(value)}, which no file can be called")
    return path


def paths_of(name: str, value: Any) -> list[str]:
    """One path or several."""
    if isinstance(value, (str, bytes, os.PathLike)):
        return [path_of(name, value)]
    try:
        each = list(value)
    except TypeError:
        raise TypeError(f"{name} is {shown(value)}; it takes a path or several") from None
    return [path_of(name, path) for path in each]


def flag(name: str, value: object) -> bool:
    """Whether a value is true, as Python has it; an array of several has no truth."""
    _masked.refuse(name, value)
    try:
        return bool(value)
    except ValueError:
        raise InvalidArgument(f"{name} is {shown(value)}; it takes True or False") from None


def is_one(value: object) -> bool:
    """Whether it is a single value, and no array."""
    return bool(np.isscalar(value)) or (isinstance(value, np.ndarray) and value.ndim == 0)


def is_time(value: object) -> bool:
    """Whether NumPy has it as a date or as a duration: float() and item() make plain numbers of some units."""
    return getattr(getattr(value, "dtype", None), "kind", None) in ("m", "M")


def array_of(name: str, value: npt.ArrayLike) -> npt.NDArray[Any]:
    """The value as an array."""
    if type(value) is np.ndarray:
        return value
    _masked.refuse(name, value)
    is_exchanged = hasattr(value, "__dlpack__") and not hasattr(value, "__array__")  # NumPy takes it for an object
    try:
        array: npt.NDArray[Any] = np.from_dlpack(value) if is_exchanged else np.asarray(value)
    except MemoryError:
        raise
    except Exception as error:  # rows of several lengths, or what another library refuses: memory of a GPU, say
        _masked.refuse(name, value, among_numbers=True)  # of which NumPy makes no integers
        reason = " ".join(str(error).split())
        raise InvalidArgument(f"{name} cannot be read as an array: {reason[:140]}") from error
    if isinstance(value, (list, tuple)) and _masked.may_be_among(array):
        _masked.refuse(name, value, among_numbers=True)
    return array


def _has_large_integers(array: npt.NDArray[Any]) -> bool:
    """Whether there are integers beyond those that float64 holds all of; NumPy makes objects of those beyond 64 bits."""
    if array.dtype.kind == "O":
        are_numbers = all(isinstance(entry, (Real, np.bool_)) for entry in array.flat)
        return are_numbers and any(isinstance(entry, int) and abs(entry) > _EXACT_INTEGERS for entry in array.flat)
    is_wide = array.dtype.kind in "iu" and array.dtype.itemsize == 8
    return is_wide and bool((array > _EXACT_INTEGERS).any() or (array < -_EXACT_INTEGERS).any())


def floats(name: str, value: npt.ArrayLike) -> npt.NDArray[Any]:
    """An array of float32 or float64 in this machine's byte order; other numbers become one of them, exactly. A single
    number is one that number() takes."""
    array = array_of(name, value)
    if array.ndim == 0 and not is_time(array) and isinstance(array.item(), (Real, Decimal)):
        return np.array(number(name, array.item()))
    native = array.dtype.newbyteorder("=")
    if native == np.float32 or native == np.float64:
        plain = array.astype(native, copy=False)
        # One whose type names this machine's order, "<", is left as it is, and its buffer names the order too.
        return plain if plain.dtype.byteorder == "=" else plain.view(native)
    if native == np.float16:
        return array.astype(np.float32)
    if array.dtype.names is not None:
        rows = "numpy.lib.recfunctions.structured_to_unstructured()"
        raise InvalidArgument(f"{name} has fields, {', '.join(array.dtype.names)}; {rows} makes rows of numbers of them")
    if array.size == 0 and array.dtype.kind in "OV":
        return array.astype(np.float64)
    if array.dtype.kind in "OSU" and array.ndim == 0:  # of what is no array, such as None, a path or a generator
        raise InvalidArgument(f"{name} is {shown(value)}; it takes numbers")
    if _has_large_integers(array):
        raise InvalidArgument(f"{name} has integers beyond 2**53, which float64 does not hold")
    if array.dtype.kind not in "iub":
        raise InvalidArgument(f"{name} has dtype {array.dtype}; it takes numbers that float32 or float64 holds")
    return array.astype(np.float64)


def contiguous(array: npt.ArrayLike, dtype: npt.DTypeLike = None) -> npt.NDArray[Any]:
    """The numbers one after the other and aligned; NumPy's ascontiguousarray leaves what lies at an odd address there."""
    return np.require(array, dtype, ["C", "A"])


def _plain(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """The array itself where its strides are whole elements, else a copy."""
    size = array.itemsize
    if array.flags.aligned and all(stride % size == 0 for stride in array.strides):
        return array
    return contiguous(array)


def _table(name: str, value: npt.ArrayLike, columns: Sequence[int], kind: str = "it", single: bool = False) -> npt.NDArray[Any]:
    """Rows of so many numbers; nothing at all is no row, and a list of them is one where that makes sense."""
    array = floats(name, value)
    given = array.shape
    if array.ndim == 1 and array.size == 0:
        array = array.reshape(0, columns[0])
    elif array.ndim == 1 and single:
        array = array.reshape(1, -1)
    if array.ndim != 2 or array.shape[1] not in columns:
        takes = " or ".join(f"(n, {count})" for count in columns)
        raise InvalidArgument(f"{name} has shape {given}; {kind} takes {takes}")
    return _plain(array)


def corner_pair(
    low_name: str,
    lower: npt.ArrayLike,
    high_name: str,
    upper: npt.ArrayLike,
    columns: Sequence[int] = (3,),
    single: bool = False,
) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
    """Two arrays of shape (n, 3), or of what else is allowed, and of one type."""
    low = _table(low_name, lower, columns, single=single)
    high = _table(high_name, upper, columns if low.size == 0 else (low.shape[1],), single=single)
    if len(low) != len(high):
        raise InvalidArgument(f"{low_name} has {len(low)} rows and {high_name} {len(high)}")
    if len(low) == 0:
        low = low.reshape(high.shape)  # of whatever axes nothing was given
    if low.dtype != high.dtype:
        low, high = low.astype(np.float64, copy=False), high.astype(np.float64, copy=False)
    return low, high


def _corners(
    lower: npt.ArrayLike, upper: npt.ArrayLike | None, prefix: str, axes: Sequence[int], single: bool
) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
    """The corners of boxes with one of these numbers of axes."""
    if upper is not None:
        return corner_pair(prefix + "lower", lower, prefix + "upper", upper, axes, single)
    rows = _table(prefix + "lower", lower, [2 * count for count in axes], "alone it", single)
    half = rows.shape[1] // 2
    return rows[:, :half], rows[:, half:]


def with_margins(boxes: _core.Boxes, margin: npt.ArrayLike | None, prefix: str = "") -> _core.Boxes:
    if margin is not None:
        margins = floats(prefix + "margin", margin).astype(np.float64, copy=False)
        if margins.ndim == 0:
            boxes.set_margin(float(margins))
        else:
            boxes.set_margins(contiguous(of_length(prefix + "margin", margins, len(boxes))))
    return boxes


def boxes_of(lower: npt.ArrayLike, upper: npt.ArrayLike | None, prefix: str = "") -> _core.Boxes:
    """Boxes of three axes; a single one too. ``prefix`` is how errors call them where there are two sets."""
    corners = _corners(lower, upper, prefix, (3,), single=True)
    return _core.Boxes(corners[0], corners[1], prefix)


def world_boxes(lower: npt.ArrayLike, upper: npt.ArrayLike | None, prefix: str = "") -> _core.Boxes:
    """Boxes of a world, or for one; a single one too. Those in the plane are unbounded in depth, so that it decides
    nothing, whatever the margins will be."""
    low, high = _corners(lower, upper, prefix, (3, 2), single=True)
    if low.shape[1] == 2:
        deep = np.full((len(low), 1), np.inf, low.dtype)
        low, high = np.hstack([low, -deep]), np.hstack([high, deep])
    return _core.Boxes(low, high, prefix)


class BoxSet(NamedTuple):
    """A set of boxes to search."""

    boxes: _core.Boxes
    axes: int
    """2 or 3: boxes in the plane have a third one on which all overlap."""


def box_set(
    lower: npt.ArrayLike,
    upper: npt.ArrayLike | None,
    margin: npt.ArrayLike | None,
    depth_of_plane: Callable[[], float],
    prefix: str = "",
    single: bool = False,
    axes_taken: Sequence[int] = (3, 2),
) -> BoxSet:
    """A set of boxes; those in the plane become so deep, up and down."""
    low, high = _corners(lower, upper, prefix, axes_taken, single)
    axes = low.shape[1]
    if axes == 2:
        with np.errstate(over="ignore"):  # more than float32 holds is infinite
            flat = np.full((len(low), 1), depth_of_plane(), low.dtype)
        low, high = np.hstack([low, -flat]), np.hstack([high, flat])
    return BoxSet(with_margins(_core.Boxes(low, high, prefix), margin, prefix), axes)


def depth_of(distance: float, margins: Iterable[npt.ArrayLike | None]) -> float:
    """How deep boxes in the plane have to be for all of them to overlap in depth: a negative distance or margin asks for
    an overlap, of which this is more than enough."""
    depth = max(0.0, -number("distance", distance))
    for margin in margins:
        if margin is not None:
            depth += 2 * max(0.0, -float(floats("margin", margin).min(initial=0)))
    return max(2 * depth, 1.0) if depth else 0.0


def two_corners(value: BoxesLike, name: str) -> tuple[npt.ArrayLike, npt.ArrayLike | None]:
    """One of two sets: an array of shape (n, 6), or a tuple (lower, upper)."""
    if isinstance(value, tuple):
        if len(value) != 2:
            raise InvalidArgument(f"{name}boxes are a tuple of {len(value)}; it takes (lower, upper)")
        return value[0], value[1]
    if isinstance(value, list) and len(value) == 2 and all(isinstance(corner, np.ndarray) and corner.ndim == 2 for corner in value):
        raise InvalidArgument(f"{name}boxes are a list of two arrays; as corners it takes a tuple (lower, upper)")
    return value, None


def of_length(name: str, values: npt.NDArray[Any], length: int) -> npt.NDArray[Any]:
    """The array, if it has one value for each box."""
    if values.ndim != 1 or len(values) != length:
        raise InvalidArgument(f"{name} has shape {values.shape}; for {length} boxes it takes ({length},)")
    return values


def _uint32(name: str, value: npt.ArrayLike) -> npt.NDArray[np.uint32]:
    """Integers as uint32, the same memory where they are."""
    array = array_of(name, value)
    if array.size == 0 and array.dtype.names is None:
        array = array.astype(np.uint32)
    if array.dtype.kind not in "iub":
        raise InvalidArgument(f"{name} has dtype {array.dtype}; it takes integers")
    if array.dtype.kind == "i" or array.dtype.itemsize > 4:
        outside = (array < 0) | (array > _UINT32_MAX)
        if outside.any():
            place = tuple(int(i) for i in np.argwhere(outside)[0])
            where = f"{name}[{', '.join(map(str, place))}]" if place else name
            message = f"{where} is {array[place]}; it takes 0 to {_UINT32_MAX}"
            if len(place) > 1:  # a row of pairs or triangles, which is no box
                raise InvalidArgument(message)
            raise InvalidBox(message, place[0] if place else 0)
    return contiguous(array, np.uint32)


def uint64(name: str, array: npt.NDArray[Any]) -> npt.NDArray[np.uint64]:
    """A row of integers as uint64, the same memory where they are of 64 bits."""
    if array.size == 0 and array.dtype.names is None:
        array = array.astype(np.uint64)
    if array.dtype.kind not in "iu":
        raise InvalidArgument(f"{name} has dtype {array.dtype}; it takes integers")
    if array.dtype.kind == "i" and (array < 0).any():
        place = int(np.argmax(array < 0))
        raise InvalidArgument(f"{name}[{place}] is {array[place]}; it is at least 0")
    native = contiguous(array, dtype=array.dtype.newbyteorder("="))
    return native.view(np.uint64) if native.dtype == np.int64 else native.astype(np.uint64, copy=False)


def labels(name: str, value: npt.ArrayLike, length: int) -> npt.NDArray[np.uint32]:
    """A filter's array: one number for each box, from an array or from a number for all."""
    if not is_one(value) or _masked.hides(value):  # the latter is refused
        return of_length(name, _uint32(name, value), length)
    single = value.item() if isinstance(value, (np.generic, np.ndarray)) and not is_time(value) else value
    return np.full(length, bits(name, cast(int, single)), np.uint32)


def ids(value: npt.ArrayLike) -> npt.NDArray[np.uint32]:
    """Boxes of a world by number, or one. Booleans, which choose entries of an array elsewhere, are none."""
    given = array_of("ids", value)
    if given.dtype.kind == "b":
        raise InvalidArgument("ids has dtype bool; it takes the numbers of boxes")
    array = _uint32("ids", given)
    if array.ndim > 1:
        raise InvalidArgument(f"ids has shape {array.shape}; it takes (k,)")
    return array.reshape(-1)


def points(name: str, value: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Points or directions as rows of three; those in the plane have no depth. An empty list is no points."""
    array: npt.NDArray[np.float64] = np.atleast_2d(floats(name, value)).astype(np.float64, copy=False)
    if array.shape == (1, 0):
        return np.empty((0, 3))
    if array.ndim != 2 or array.shape[1] not in (3, 2):
        raise InvalidArgument(f"{name} has shape {array.shape}; it takes (k, 3) or (k, 2)")
    return array if array.shape[1] == 3 else np.pad(array, ((0, 0), (0, 1)))


def places(name: str, value: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
    """Points as rows of three, or boxes as rows of six; boxes in the plane are unbounded in depth."""
    columns = value.shape[-1] if value.ndim in (1, 2) else 0
    if columns in (6, 4):
        rows: npt.NDArray[np.float64] = np.atleast_2d(floats(name, value)).astype(np.float64, copy=False)
        deep = np.full((len(rows), 1), np.inf)
        return rows if columns == 6 else np.hstack([rows[:, :2], -deep, rows[:, 2:], deep])
    if value.size and columns not in (3, 2):
        raise InvalidArgument(f"{name} has shape {value.shape}; it takes (k, 3) or (k, 2), and for boxes (k, 6) or (k, 4)")
    return points(name, value)


def sweeps(origins: npt.ArrayLike, directions: npt.ArrayLike, length: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Rays, or boxes that move, all in space or all in the plane: in each row origin or box, direction and length."""
    given, ways = array_of("origins", origins), array_of("directions", directions)
    start, way = places("origins", given), points("directions", ways)
    axes = given.shape[-1:] if start.shape[1] == 3 else (given.shape[-1] // 2,)
    if given.size and axes != ways.shape[-1:]:
        raise InvalidArgument(f"origins has shape {given.shape}, directions {ways.shape}: not of the same axes")
    if len(start) != len(way) and 1 not in (len(start), len(way)):
        raise InvalidArgument(f"origins has {len(start)} rows and directions {len(way)}")
    count = len(start) if len(way) == 1 else len(way)
    end = floats("length", length).astype(np.float64)
    if end.shape not in ((), (1,), (count,)):
        raise InvalidArgument(f"length has shape {end.shape}; for {count} rays it takes ({count},)")
    rows = np.empty((count, start.shape[1] + 4))
    rows[:, :-4], rows[:, -4:-1], rows[:, -1] = start, way, end
    return rows


def index_rows(name: str, value: npt.ArrayLike, columns: int) -> npt.NDArray[np.uint32]:
    """Rows of indices: pairs of boxes, triangles."""
    array = _uint32(name, value)
    if array.size == 0:
        array = array.reshape(0, columns)
    if array.ndim != 2 or array.shape[1] != columns:
        raise InvalidArgument(f"{name} has shape {array.shape}; it takes (k, {columns})")
    return array


def pairs_of_boxes(name: str, value: npt.ArrayLike, first: int, second: int) -> npt.NDArray[np.uint32]:
    """Pairs by index, of sets of so many boxes."""
    rows = index_rows(name, value, 2)
    absent = np.flatnonzero((rows >= np.array([first, second], dtype=np.uint64)).any(axis=1))
    if len(absent):
        row = int(absent[0])
        sizes = str(first) if first == second else f"{first} and {second}"
        raise InvalidArgument(f"{name} row {row} is ({rows[row, 0]}, {rows[row, 1]}); the number of boxes is {sizes}")
    return rows


def _six_numbers(name: str, value: npt.ArrayLike, axes: int = 3, kind: str = "it") -> list[float]:
    """A box, from two corners or from one row; one in the plane is flat."""
    bounds = floats(name, value)
    if bounds.shape not in ((2 * axes,), (2, axes)):
        raise InvalidArgument(f"{name} has shape {bounds.shape}; {kind} takes (2, {axes}) or ({2 * axes},)")
    corners = bounds.reshape(2, axes)
    return [float(bound) for bound in np.hstack([corners, np.zeros((2, 3 - axes))]).ravel()]


def region_of(region: npt.ArrayLike, axes: int = 3) -> list[float]:
    """A region as six numbers, for boxes of so many axes."""
    return _six_numbers("region", region, axes, f"for boxes of {axes} axes it")


def cell_of(cell: npt.ArrayLike) -> list[float]:
    """A cell as six numbers."""
    return _six_numbers("cell", cell)


def two_of(name: str, value: Any, takes: str) -> tuple[Any, Any]:
    """A tuple of two; an error says what it takes."""
    if not isinstance(value, tuple) or len(value) != 2:
        raise InvalidArgument(f"{name} takes {takes}")
    first, second = value
    return first, second


def both(name: str, value: Any) -> tuple[Any, Any]:
    """An argument for each of two sets: a tuple of two, a number for all boxes, or None for neither."""
    if value is None or is_one(value):
        return value, value
    return two_of(name, value, "a number or a tuple of two here: one for each set, or None")
