# SPDX-License-Identifier: MIT
"""Builds the Python package for pip (PEP 517), with CMake and nothing that would have to be downloaded.

Why a backend of our own: those that run CMake (scikit-build-core, py-build-cmake, meson-python) are not among Debian
12's packages, or pip fetches them into an isolated environment; setuptools would have to be there, in a version that
suits, and would know nothing of CMake. What a wheel is made of is little: files, two texts about them, and a list.
docs/decisions/0011-python-build.md has more.

``--config-settings cmake.NAME=VALUE`` passes -DNAME=VALUE to CMake: cmake.ALLPAIRS_BUILD_SCENE=OFF builds the engine alone,
which needs no reader of files. ALLPAIRS_JOBS says how many jobs run at once. repair_wheel.py, beside this file, makes a
wheel self-contained.
"""

from __future__ import annotations

import base64
import hashlib
import importlib.util
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import time
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
PACKAGE_FOLDER = "site"  # where CMake installs the package, below the prefix that it is given
FIRST_ZIP_DATE = 315532800  # 1 January 1980: zip files know no earlier one


def get_requires_for_build_wheel(config_settings=None):
    return []


def get_requires_for_build_sdist(config_settings=None):
    return []


# What is said of the package.


def project_version():
    """The version that CMakeLists.txt gives the whole project."""
    return re.search(r"^\s+VERSION (\S+)$", (ROOT / "CMakeLists.txt").read_text(), re.M).group(1)


def project_table():
    """The [project] table of pyproject.toml: its texts and lists of texts. Python 3.9 and 3.10 have no tomllib."""
    text = (ROOT / "pyproject.toml").read_text().split("[project]\n")[1]
    table = dict(re.findall(r'^([\w-]+) = "(.*)"$', text, re.M))
    for name, body in re.findall(r"^([\w-]+) = \[(.*?)\]$", text, re.M | re.S):
        table[name] = re.findall(r'"(.*?)"', body)
    return table


def metadata():
    table = project_table()
    fields = [
        ("Metadata-Version", "2.1"),
        ("Name", table["name"]),
        ("Version", project_version()),
        ("Summary", table["description"]),
        ("License", "MIT"),
        ("Keywords", ",".join(table["keywords"])),
        ("Requires-Python", table["requires-python"]),
        *(("Requires-Dist", requirement) for requirement in table["dependencies"]),
        *(("Classifier", classifier) for classifier in table["classifiers"]),
        ("Description-Content-Type", "text/markdown"),
    ]
    lines = "".join(f"{name}: {value}\n" for name, value in fields)
    return lines + "\n" + (ROOT / table["readme"]).read_text()


def tag():
    """Of this interpreter: the module is compiled for it."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    abi = python + getattr(sys, "abiflags", "")
    return f"{python}-{abi}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def stem():
    return f"allpairs-{project_version()}"


# Building.


def cmake_arguments(build, prefix, config_settings):
    definitions = {
        "CMAKE_BUILD_TYPE": "Release",
        "CMAKE_UNITY_BUILD": "ON",
        "BUILD_SHARED_LIBS": "OFF",
        "Python_EXECUTABLE": sys.executable,
        "ALLPAIRS_BUILD_PYTHON": "ON",
        "ALLPAIRS_BUILD_APP": "OFF",
        "ALLPAIRS_BUILD_C": "OFF",
        "ALLPAIRS_BUILD_TESTS": "OFF",
        "ALLPAIRS_BUILD_EXAMPLES": "OFF",
        "ALLPAIRS_PYTHON_DIR": PACKAGE_FOLDER,
        "CMAKE_INSTALL_PREFIX": str(prefix),
        "CMAKE_INSTALL_LIBDIR": "lib",
    }
    if importlib.util.find_spec("pybind11"):  # of pip's; that of Debian's development package is where CMake looks
        definitions["pybind11_DIR"] = importlib.import_module("pybind11").get_cmake_dir()
    for name, value in (config_settings or {}).items():
        if name.startswith("cmake."):
            definitions[name.removeprefix("cmake.")] = value
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    return ["-S", str(ROOT), "-B", str(build), *generator, *(f"-D{name}={value}" for name, value in definitions.items())]


WITHOUT_FILES = (
    ". Where a library that reads files is not there, such as Assimp, "
    "--config-settings cmake.ALLPAIRS_BUILD_SCENE=OFF builds the engine alone"
)


def run(*command, hint=""):
    print("+", *command, flush=True)
    try:
        subprocess.run(command, check=True)
    except FileNotFoundError:
        raise SystemExit(f"allpairs: {command[0]} is not there; scripts/packages.txt lists what the build needs") from None
    except subprocess.CalledProcessError as error:
        raise SystemExit(f"allpairs: {command[0]} failed with status {error.returncode}; see above{hint}") from None


def build_package(folder, config_settings):
    """Builds the module and returns the folder with the package in it."""
    build, prefix = folder / "build", folder / "prefix"
    jobs = os.environ.get("ALLPAIRS_JOBS", str(os.cpu_count() or 1))
    run("cmake", *cmake_arguments(build, prefix, config_settings), hint=WITHOUT_FILES)
    run("cmake", "--build", str(build), "--parallel", jobs, "--target", "allpairs_python")
    run("cmake", "--install", str(build), "--component", "python", "--strip")
    run("cmake", "--install", str(build), "--component", "mpi", "--strip")  # nothing, where there is no MPI
    return prefix / PACKAGE_FOLDER


# A wheel: a zip file whose last member lists the others with their hashes.


class Wheel:
    def __init__(self, path):
        date = max(int(os.environ.get("SOURCE_DATE_EPOCH", FIRST_ZIP_DATE)), FIRST_ZIP_DATE)
        self.date = time.gmtime(date)[:6]
        self.zip = zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED)
        self.records = []

    def add(self, name, data, mode=0o644):
        info = zipfile.ZipInfo(name, self.date)
        info.external_attr = (0o100000 | mode) << 16
        info.compress_type = zipfile.ZIP_DEFLATED
        self.zip.writestr(info, data)
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        self.records.append(f"{name},sha256={digest},{len(data)}")

    def close(self, record_name):
        self.add(record_name, "".join(f"{line}\n" for line in [*self.records, f"{record_name},,"]).encode())
        self.zip.close()


def information():
    """The files of the .dist-info folder but RECORD, by name."""
    wheel = f"Wheel-Version: 1.0\nGenerator: allpairs {project_version()}\nRoot-Is-Purelib: false\nTag: {tag()}\n"
    return {
        "METADATA": metadata().encode(),
        "WHEEL": wheel.encode(),
        "LICENSE": (ROOT / "LICENSE").read_bytes(),
    }


def write_wheel(path, package, information_files):
    """A wheel of the files below the folder `package`, and of those of its .dist-info folder, by name."""
    folder = f"{stem()}.dist-info"
    wheel = Wheel(path)
    for file in sorted(path for path in package.rglob("*") if path.is_file()):
        mode = 0o755 if ".so" in file.suffixes else 0o644
        wheel.add(file.relative_to(package).as_posix(), file.read_bytes(), mode)
    for file, data in information_files.items():
        wheel.add(f"{folder}/{file}", data)
    wheel.close(f"{folder}/RECORD")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name = f"{stem()}-{tag()}.whl"
    with tempfile.TemporaryDirectory(prefix="allpairs-") as temporary:
        package = build_package(pathlib.Path(temporary), config_settings)
        write_wheel(pathlib.Path(wheel_directory) / name, package, information())
    return name


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = pathlib.Path(metadata_directory) / f"{stem()}.dist-info"
    folder.mkdir()
    for file, data in information().items():
        (folder / file).write_bytes(data)
    return folder.name


# A source archive: what git tracks.


def source_files():
    tracked = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-z"], capture_output=True, check=False)
    if tracked.returncode == 0 and tracked.stdout:
        return sorted(name for name in tracked.stdout.decode().split("\0") if name and (ROOT / name).is_file())
    files = (path.relative_to(ROOT) for path in ROOT.rglob("*") if path.is_file())
    # An unpacked sdist has a PKG-INFO, which build_sdist() writes itself.
    return sorted(path.as_posix() for path in files if path.parts[0] not in ("build", ".git", "PKG-INFO"))


def build_sdist(sdist_directory, config_settings=None):
    name = f"{stem()}.tar.gz"
    with tarfile.open(pathlib.Path(sdist_directory) / name, "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for file in source_files():
            archive.add(ROOT / file, f"{stem()}/{file}", recursive=False)
        about = metadata().encode()
        info = tarfile.TarInfo(f"{stem()}/PKG-INFO")
        info.size = len(about)
        archive.addfile(info, io.BytesIO(about))
    return name
