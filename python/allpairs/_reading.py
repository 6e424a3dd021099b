# SPDX-License-Identifier: MIT
"""The part of the extension that reads files, which is loaded when it is first used: not every build has it."""

try:
    from ._files import BoxValueFiles, DetectionOptions, JoinOptions, ReadOptions, Scene, join_files, load, sofa_version
except ImportError as problem:
    raise ImportError(
        f"this build of allpairs reads no files, neither scenes and meshes nor boxes, and joins none: {problem}"
    ) from problem

__all__ = ["BoxValueFiles", "DetectionOptions", "JoinOptions", "ReadOptions", "Scene", "join_files", "load", "sofa_version"]
