# SPDX-License-Identifier: MIT
"""Runs the examples in the package's docstrings and in the Python blocks of the documents named as arguments."""

import doctest
import importlib
import importlib.util
import pathlib
import pkgutil
import re
import sys

import allpairs


def of_modules():
    names = ["allpairs"] + [f"allpairs.{module.name}" for module in pkgutil.iter_modules(allpairs.__path__)]
    for name in names:
        if name in ("allpairs._core", "allpairs._files", "allpairs._mpi"):
            continue
        needed = {"allpairs._parts": "dask", "allpairs.dask": "dask", "allpairs.mpi": "mpi4py"}.get(name)
        if needed and importlib.util.find_spec(needed) is None:
            continue
        if name == "allpairs.mpi" and importlib.util.find_spec("allpairs._mpi") is None:
            continue
        yield name, doctest.testmod(importlib.import_module(name))


def of_document(path):
    blocks = re.findall(r"^```(?:python|pycon)\n(.*?)^```", pathlib.Path(path).read_text(), re.M | re.S)
    test = doctest.DocTestParser().get_doctest("\n".join(blocks), {}, path, path, 0)
    runner = doctest.DocTestRunner()
    runner.run(test)
    return path, runner.summarize()


results = [*of_modules(), *map(of_document, sys.argv[1:])]
for name, result in results:
    print(f"{name}: {result.attempted} examples, {result.failed} failed")
ran = sum(result.attempted for _, result in results)
sys.exit(0 if ran > 20 and not any(result.failed for _, result in results) else 1)
