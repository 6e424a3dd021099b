# SPDX-License-Identifier: MIT
"""The sets of boxes and the settings of a search, from the arguments of a function by their names."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _arguments, _core
from ._errors import InvalidArgument

#: A setting for each of two sets, or one number for all boxes of both.
Both = Union[None, float, tuple[Optional[npt.ArrayLike], Optional[npt.ArrayLike]]]

#: What a function without these arguments says of them: boxes have three axes.
IN_SPACE: dict[str, Any] = {"ignore": None, "strategy": "auto", "axes_taken": (3,)}

#: Labels of the boxes of a set, from an argument's name and value.
Labels = Callable[[str, npt.ArrayLike], npt.NDArray[np.uint32]]


def set_filter(options: _core.Options, side: _core.Side, values: dict[str, Any], labels: Labels) -> None:
    """Sets what of group, category and mask is given."""
    for name, setter in (
        ("group", options.set_groups),
        ("category", options.set_categories),
        ("mask", options.set_masks),
    ):
        if values[name] is not None:
            setter(side, labels(name, values[name]))


def set_ignored(options: _core.Options, pairs: npt.ArrayLike | None, *sizes: int) -> None:
    """Sets the pairs that are none, of one or two sets of so many boxes."""
    if pairs is not None:
        options.set_ignored(_arguments.pairs_of_boxes("ignore", pairs, sizes[0], sizes[-1]), len(sizes) == 1)


def options_of(values: dict[str, Any], axes: int) -> _core.Options:
    """What is not about single boxes; a function that lacks a setting has no such name among its values."""
    options = _core.Options()
    options.set_distance(_arguments.number("distance", values["distance"]))
    options.set_strategy(_arguments.strategy_of(values["strategy"]))
    options.threads = _arguments.threads_of(values["threads"])
    if values["region"] is not None:
        options.set_region(_arguments.region_of(values["region"], axes))
    if "order" in values:
        options.set_order(_arguments.order_of(values["order"]))
    if values.get("max_pairs") is not None:
        options.set_max_pairs(_arguments.whole("max_pairs", values["max_pairs"]))
    return options


def _taken(values: dict[str, Any]) -> dict[str, Any]:
    """Which boxes a function takes: in the plane too, and a single one as a row of numbers."""
    return {"axes_taken": values.get("axes_taken", (3, 2)), "single": values.get("single", False)}


def _labels_of(boxes: _core.Boxes, prefix: str = "") -> Labels:
    return lambda name, value: _arguments.labels(prefix + name, value, len(boxes))


def one_set(values: dict[str, Any]) -> tuple[_core.Boxes, _core.Options]:
    """The boxes `lower` and `upper`, and the settings of a search of them."""
    margin = values["margin"]
    depth = lambda: _arguments.depth_of(values["distance"], [margin])
    boxes, axes = _arguments.box_set(values["lower"], values["upper"], margin, depth, **_taken(values))
    options = options_of(values, axes)
    set_ignored(options, values["ignore"], len(boxes))
    set_filter(options, _core.Side.FIRST, values, _labels_of(boxes))
    return boxes, options


def common_axes(first: _arguments.BoxSet, second: _arguments.BoxSet, names: tuple[str, str]) -> int:
    """The number of axes of two sets, of which one that is empty has any; `names` is how an error calls them."""
    if first.axes != second.axes and len(first.boxes) and len(second.boxes):
        raise InvalidArgument(f"{names[0]} have {first.axes} axes and {names[1]} {second.axes}")
    return first.axes if len(first.boxes) else second.axes


def two_sets(values: dict[str, Any]) -> tuple[_core.Boxes, _core.Boxes, _core.Options]:
    """The boxes `first` and `second`, and the settings of a search between them."""
    own = {name: _arguments.both(name, values[name]) for name in _arguments.OF_EACH_BOX}
    depth = lambda: _arguments.depth_of(values["distance"], own["margin"])
    prefixes = ("first set: ", "second set: ")
    sets = []
    for name, margin, prefix in zip(("first", "second"), own["margin"], prefixes):
        lower, upper = _arguments.two_corners(values[name], prefix)
        sets.append(_arguments.box_set(lower, upper, margin, depth, prefix, **_taken(values)))
    first, second = sets
    options = options_of(values, common_axes(first, second, ("the boxes of the first set", "those of the second")))
    set_ignored(options, values["ignore"], len(first.boxes), len(second.boxes))
    for i, side in enumerate((_core.Side.FIRST, _core.Side.SECOND)):
        of_side = {name: pair[i] for name, pair in own.items()}
        set_filter(options, side, of_side, _labels_of(sets[i].boxes, prefixes[i]))
    return first.boxes, second.boxes, options
