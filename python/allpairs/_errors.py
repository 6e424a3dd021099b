# SPDX-License-Identifier: MIT
"""Exceptions: each is a ValueError, and one about a file is also an OSError."""

from __future__ import annotations

import os
import re
from typing import Any


class Error(ValueError):
    """Base of all exceptions of this package about bad data, settings or files."""


class InvalidArgument(Error):
    """An invalid setting or array: a wrong shape, a NaN distance, a reversed region."""


class InvalidBox(Error):
    """An invalid box or per-box value; ``index`` is its index."""

    def __init__(self, message: str, index: int) -> None:
        super().__init__(message)
        self.index = index

    def __reduce__(self) -> tuple[type[InvalidBox], tuple[str, int]]:
        return type(self), (str(self), self.index)


class LimitExceeded(Error):
    """More pairs than ``max_pairs``; ``count`` is the number found when the limit was exceeded."""

    def __init__(self, message: str, count: int) -> None:
        super().__init__(message)
        self.count = count

    def __reduce__(self) -> tuple[type[LimitExceeded], tuple[str, int]]:
        return type(self), (str(self), self.count)


class FileError(Error, OSError):
    """A file that is missing, unreadable or malformed.

    ``path`` names it, as ``filename`` does; ``line`` and ``column`` count from 1, and are 0 if unknown. ``errno`` and
    ``strerror`` are what the system says, such as ``errno.ENOENT`` of a file that is not there; None if the content is what
    is wrong.
    """

    def __init__(self, message: str, path: str, line: int, column: int, errno: int | None = None) -> None:
        super().__init__(message)
        self.path = self.filename = path
        self.line = line
        self.column = column
        if errno is not None:
            self.errno, self.strerror = errno, os.strerror(errno)

    def __str__(self) -> str:
        return str(self.args[0])  # OSError's would be made of errno, strerror and filename

    def __reduce__(self) -> tuple[type[FileError], tuple[Any, ...]]:
        return type(self), (str(self), self.path, self.line, self.column, self.errno)


def shown_path(path: str) -> str:
    """A path for messages: control characters, line separators and bytes that are not UTF-8 are written as \\xNN."""
    text = os.fsencode(path).decode("utf-8", "backslashreplace")
    escaped = lambda found: "".join(f"\\x{byte:02x}" for byte in found[0].encode())
    return re.sub("[\0-\x1f\x7f-\x9f\u2028\u2029]", escaped, text)


def file_error(path: str, problem: object, cause: Exception | None = None) -> FileError:
    """An error of a file; of the system, if it is the cause."""
    return FileError(f"{shown_path(path)}: {problem}", path, 0, 0, getattr(cause, "errno", None))
