#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""repair_wheel.py WHEEL [FOLDER]: makes a wheel self-contained, and prints the path of the new one, which goes to FOLDER (.).

What auditwheel does, where that is not there (Debian 12 does not have it): the shared libraries that the wheel's modules
need, and that a Linux system may not have, are copied into it under names of their own, with their licences, and found
there. The new wheel is for systems with the C library of this one or a newer one (PEP 600). Needs patchelf, ldd and, for the
licences, dpkg.
"""

from __future__ import annotations

import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import build_backend

# Those that every such system has: the C and C++ libraries of manylinux (PEP 599, PEP 600).
SYSTEM = {"libc", "libm", "libdl", "libpthread", "librt", "libutil", "libgcc_s", "libstdc++", "ld-linux-x86-64", "ld-linux-aarch64"}


def output_of(*command):
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout
    except FileNotFoundError:
        raise SystemExit(f"repair_wheel.py: {command[0]} is not there (Debian: apt install {command[0]})") from None
    except subprocess.CalledProcessError as error:
        raise SystemExit(f"repair_wheel.py: {' '.join(command)}: {error.stderr.strip()}") from None


def is_of_system(name):
    return pathlib.PurePath(name).name.split(".so")[0] in SYSTEM or name.startswith("linux-vdso")


def libraries_of(modules):
    """Where the loader finds what modules need, and what that needs, by name; without what every system has."""
    found = {}
    for module in modules:
        lines = output_of("ldd", str(module)).splitlines()
        for name, path in (match.groups() for match in map(re.compile(r"^\s+(\S+) => (.+?)(?: \(0x.*)?$").match, lines) if match):
            if is_of_system(name):
                continue
            if path == "not found":
                raise SystemExit(f"repair_wheel.py: {module.name} needs {name}, which is not found")
            found[name] = pathlib.Path(path).resolve()
    return found


def own_name(name, path):
    """libtbb-1a2b3c4d.so.12: another copy of the library, from elsewhere, is never taken for it."""
    digest = hashlib.sha256(path.read_bytes()).hexdigest()[:8]
    stem, dot, rest = name.partition(".so")
    return f"{stem}-{digest}{dot}{rest}"


def copy_libraries(folder, found):
    """Copies libraries to a folder, and returns their new names by the old ones."""
    folder.mkdir()
    names = {name: own_name(name, path) for name, path in found.items()}
    for name, path in found.items():
        copy = folder / names[name]
        shutil.copyfile(path, copy)
        copy.chmod(0o755)
        output_of("patchelf", "--set-soname", names[name], str(copy))
        redirect(copy, names, "$ORIGIN")
    return names


def redirect(file, names, where):
    """Has a file look for libraries under their new names and in their new place."""
    output_of("patchelf", "--force-rpath", "--set-rpath", where, str(file))
    for needed in output_of("patchelf", "--print-needed", str(file)).split():
        if needed in names:  # one by one: patchelf 0.14 mixes the names of several changes up
            output_of("patchelf", "--replace-needed", needed, names[needed], str(file))


def licences(found):
    """The copyright files of the packages that libraries come from, by the names that they get."""
    texts = {}
    for path in found.values():
        names = {str(path), str(path).removeprefix("/usr")}
        result = subprocess.run(["dpkg-query", "--search", *names], capture_output=True, text=True, check=False)
        for line in result.stdout.splitlines():
            package = line.split(": ")[0].split(":")[0]
            texts[f"licenses/{package}"] = pathlib.Path("/usr/share/doc", package, "copyright").read_bytes()
    return texts


def repaired_platform(platform):
    """linux_x86_64 becomes manylinux_2_36_x86_64 where the C library is glibc 2.36."""
    version = os.confstr("CS_GNU_LIBC_VERSION").split()[1].replace(".", "_")
    return re.sub(r"^linux_", f"manylinux_{version}_", platform)


def repair(wheel, target):
    stem, platform = wheel.stem.rsplit("-", 1)
    new = target / f"{stem}-{repaired_platform(platform)}.whl"
    with tempfile.TemporaryDirectory(prefix="allpairs-") as temporary:
        tree = pathlib.Path(temporary)
        with zipfile.ZipFile(wheel) as archive:
            archive.extractall(tree)
        about = next(tree.glob("*.dist-info"))
        information = {file.name: file.read_bytes() for file in sorted(about.iterdir()) if file.name != "RECORD"}
        shutil.rmtree(about)
        modules = sorted(tree.rglob("*.so"))
        # MPI is the machine's: a process has one, mpi4py's, and its ranks are started by what belongs to that.
        found = libraries_of([module for module in modules if not module.name.startswith("_mpi.")])
        names = copy_libraries(tree / "allpairs.libs", found)
        for module in modules:
            redirect(module, names, "$ORIGIN/" + os.path.relpath(tree / "allpairs.libs", module.parent))
        information["WHEEL"] = information["WHEEL"].replace(platform.encode(), repaired_platform(platform).encode())
        build_backend.write_wheel(new, tree, {**information, **licences(found)})
    return new


if __name__ == "__main__":
    if not 2 <= len(sys.argv) <= 3 or not sys.argv[1].endswith(".whl"):
        sys.exit("usage: repair_wheel.py WHEEL [FOLDER]")
    print(repair(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2] if len(sys.argv) == 3 else ".")))
