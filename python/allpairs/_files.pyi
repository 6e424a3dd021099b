# SPDX-License-Identifier: MIT
from typing import Optional

from ._core import PairArray, Strategy

class DetectionOptions:
    distance: Optional[float]
    strategy: Strategy
    threads: int
    verify: bool
    def set_region(self, box: list[float]) -> None: ...

class Scene:
    def __len__(self) -> int: ...
    def model(self, index: int) -> tuple[str, str, int, bool, bool, bool, bool, tuple[int, ...], float]: ...
    def remarks(self) -> list[tuple[str, int, str, str, bool]]: ...
    def warnings(self) -> list[tuple[str, int, str, str, bool]]: ...
    def method(self) -> str: ...
    def alarm_distance(self) -> float: ...
    def region(self) -> Optional[list[float]]: ...
    def detect(self, options: DetectionOptions) -> PairArray: ...

class SofaVersion:
    from_scene: SofaVersion
    sofa_2006: SofaVersion
    sofa_2612: SofaVersion

def sofa_version(version: str) -> SofaVersion: ...

class ReadOptions:
    search_roots: list[str]
    partial: bool
    sofa: SofaVersion
    allow_outside: bool
    max_memory: int
    recursive: bool

def load(path: str, options: ReadOptions) -> Scene: ...

class BoxValueFiles:
    margin: list[str]
    group: list[str]
    category: list[str]
    mask: list[str]

class JoinOptions:
    distance: float
    memory: int
    work: str
    resume: bool
    second: list[str]
    values: BoxValueFiles
    second_values: BoxValueFiles
    def set_region(self, box: list[float]) -> None: ...

def join_files(inputs: list[str], output: Optional[str], options: JoinOptions, threads: int) -> tuple[int, ...]: ...
