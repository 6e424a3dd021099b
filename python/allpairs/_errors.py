# SPDX-License-Identifier: MIT
"""What goes wrong, as exceptions: each is a ValueError, and one about a file is an OSError too."""

from __future__ import annotations


class Error(ValueError):
    """Base of everything that this package raises about bad data, settings or files."""


class InvalidArgument(Error):
    """A setting or an array that makes no sense: another shape, a NaN distance, a reversed region."""


class InvalidBox(Error):
    """A box, or a value that belongs to a box, that cannot be used; ``index`` says which one."""

    def __init__(self, message: str, index: int) -> None:
        super().__init__(message)
        self.index = index

    def __reduce__(self) -> tuple[type[InvalidBox], tuple[str, int]]:
        return type(self), (str(self), self.index)


class LimitExceeded(Error):
    """There are more pairs than ``max_pairs``; ``count`` is how many had been found when that was noticed."""

    def __init__(self, message: str, count: int) -> None:
        super().__init__(message)
        self.count = count

    def __reduce__(self) -> tuple[type[LimitExceeded], tuple[str, int]]:
        return type(self), (str(self), self.count)


class FileError(Error, OSError):
    """A file that is missing, unreadable or malformed.

    ``path`` names it; ``line`` and ``column`` count from 1, and are 0 where there is none.
    """

    def __init__(self, message: str, path: str, line: int, column: int) -> None:
        super().__init__(message)
        self.path = path
        self.line = line
        self.column = column

    def __reduce__(self) -> tuple[type[FileError], tuple[str, str, int, int]]:
        return type(self), (str(self), self.path, self.line, self.column)
