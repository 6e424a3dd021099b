# SPDX-License-Identifier: MIT
"""Refuses masked entries: NumPy silently drops the mask of an array, and turns masked entries of a list into NaN."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._errors import InvalidArgument


def may_be_among(array: npt.NDArray[Any]) -> bool:
    """Whether masked entries among the numbers of a list can have become these: NaN, or anything but numbers."""
    return bool(np.isnan(array).any()) if array.dtype.kind == "f" else array.dtype.kind not in "iu"


def refuse(name: str, value: object, among_numbers: bool = False) -> None:
    """NumPy would drop the mask, and what it hides would count."""
    try:
        hidden = hides(value, among_numbers)
    except RecursionError:  # a list that holds itself, say
        raise InvalidArgument(f"{name} cannot be read as an array: it is nested too deeply") from None
    if hidden:
        raise InvalidArgument(f"{name} has masked entries, which cannot be left out; pass rows without any, or filled() ones")


def hides(value: object, among_numbers: bool = False) -> bool:
    """Whether it is a masked array with masked entries, or a list that has one; lists that begin with a number, of which
    there may be many and long ones, are looked through only where that is asked for."""
    nested = (list, tuple, np.ma.MaskedArray)
    if isinstance(value, (list, tuple)):
        if value and isinstance(value[0], (int, float)):
            if not among_numbers or not any(issubclass(kind, nested) for kind in set(map(type, value))):
                return False
        return any(hides(row, among_numbers) for row in value if isinstance(row, nested))
    if not isinstance(value, np.ma.MaskedArray):
        return False
    mask = value.mask
    return bool(mask.any()) if mask.dtype.names is None else any(mask.tobytes())  # of records, one for each field
