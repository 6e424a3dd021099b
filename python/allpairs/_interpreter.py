# SPDX-License-Identifier: MIT
"""Which interpreter of a process this is."""

from __future__ import annotations

import importlib


def require_main() -> None:
    """Raises ImportError in a sub-interpreter, where loading the extension module would wait for ever."""
    for name in ("_interpreters", "_xxsubinterpreters"):  # since Python 3.13; before
        try:
            interpreters = importlib.import_module(name)
        except ImportError:
            continue
        if interpreters.get_current() != interpreters.get_main():
            raise ImportError("allpairs works in the main interpreter of a process only, and this is a sub-interpreter")
        return
