# SPDX-License-Identifier: MIT
"""The same boxes in Allpairs, CGAL, PostGIS and shapely: whole lists of pairs, processor time and wall time.

    apt-get install postgresql-15-postgis-3 python3-shapely libcgal-dev
    /usr/bin/python3 bench/spatial build/release/bin/allpairs --boxes 100000 1000000

Each runs in a process of its own on one thread, from a file of boxes to a file of pairs; PostGIS from a table of numbers
to a table of pairs, in a server that is there for it alone. All take turns; the medians are printed, as rows of a table.
The boxes are uniform, with about 2.5 pairs each. shapely has boxes in two dimensions only: for it, and for Allpairs once
more, z is 0. Every list is compared with that of `detect`.
"""

import argparse
import multiprocessing
import os
import pathlib
import signal
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np
import postgis

HERE = pathlib.Path(__file__).parent
CUTOFFS = [100, 1000, 3000]  # of CGAL; the fastest is shown
PAIRS_PER_BOX = 2.5


def uniform(n, axes):
    """Boxes of one side in a unit cube: two overlap on an axis where they are less than a side apart."""
    side = 0.5 * (2 * PAIRS_PER_BOX / n) ** (1 / axes)
    rows = np.zeros((n, 6), np.float32)
    rows[:, :axes] = np.random.default_rng(1).random((n, axes), dtype=np.float32)
    rows[:, 3 : 3 + axes] = rows[:, :axes] + np.float32(side)
    return rows


def run_here(command):
    begin = time.perf_counter()
    process = subprocess.Popen(list(map(str, command)), stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise RuntimeError(f"{command} failed")
    return usage.ru_utime + usage.ru_stime, time.perf_counter() - begin, usage.ru_maxrss / 1024


# Starts all programs: the memory of a new process counts from that of the one that starts it, which has to be small.
starter = multiprocessing.Pool(1)


def run(command):
    """Processor time, wall time, and the most memory in MiB."""
    return starter.apply(run_here, [command])


def in_order(pairs):
    pairs = np.sort(pairs.astype(np.uint64), axis=1)
    return np.sort(pairs[:, 0] << np.uint64(32) | pairs[:, 1])


class Scene:
    def __init__(self, folder, rows):
        self.rows = rows
        self.boxes = folder / "boxes.npy"
        self.pairs = folder / "pairs.npy"
        self.plain = folder / "boxes"  # without a header
        np.save(self.boxes, rows)
        rows.tofile(self.plain)

    def saved(self):
        return np.load(self.pairs)


def allpairs_contenders(program, scene):
    def detect():
        return run([program, "detect", scene.boxes, "-o", scene.pairs, "--threads", 1])

    def join():
        return run([program, "join", scene.boxes, "-o", scene.pairs, "--threads", 1, "--memory", "64M"])

    return {"`allpairs detect`": (detect, scene.saved), "`allpairs join --memory 64M`": (join, scene.saved)}


def cgal_contenders(folder, scene):
    program = folder / "cgal_pairs"
    if not program.exists():
        subprocess.run(["c++", "-std=c++17", "-O3", "-DNDEBUG", HERE / "cgal_pairs.cpp", "-o", program], check=True)
    version = subprocess.run([program], check=True, capture_output=True, text=True).stdout.strip()

    def search(cutoff):
        return run([program, scene.plain, scene.pairs, cutoff])

    def saved():
        return np.fromfile(scene.pairs, np.uint32).reshape(-1, 2)

    return {f"CGAL {version}, cutoff {c}": (lambda c=c: search(c), saved) for c in CUTOFFS}


def shapely_contenders(scene):
    command = [sys.executable, "-W", "ignore", HERE / "shapely_pairs.py"]
    version = subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()
    return {f"shapely {version}, `STRtree`": (lambda: run([*command, scene.boxes, scene.pairs]), scene.saved)}


def postgis_contenders(server, scene):
    server.put(scene.rows)
    version = server.version()

    def load():
        return *server.seconds(postgis.LOAD), None

    def search():
        server.ask("DROP TABLE IF EXISTS pairs")
        return *server.seconds(postgis.SEARCH), None

    return {f"{version}: table and index": (load, None), f"{version}: `&&&`": (search, server.pairs)}


def keep_fastest_cgal(times):
    names = [name for name in times if name.startswith("CGAL")]
    best = min(names, key=lambda name: statistics.median(cpu for cpu, _, _ in times[name]), default=None)
    return {name: values for name, values in times.items() if name not in names or name == best}


def contest(name, contenders, repeats):
    times = {contender: [] for contender in contenders}
    expected = None
    for _ in range(repeats):
        for contender, (call, result) in contenders.items():
            times[contender].append(call())
            print(f"  {name}: {contender}: {times[contender][-1]}", file=sys.stderr, flush=True)
            if result is None:
                continue
            found = in_order(result())
            expected = found if expected is None else expected
            if not np.array_equal(found, expected):
                sys.exit(f"{contender} finds other pairs: {len(found)} instead of {len(expected)}")
    for contender, values in keep_fastest_cgal(times).items():
        cpu, wall = (statistics.median(value[i] for value in values) for i in (0, 1))
        memory = f"{statistics.median(value[2] for value in values):,.0f} MiB" if values[0][2] else ""
        print(f"| {name} | {len(expected):,} | {contender} | {cpu:.3g} s | {wall:.3g} s | {memory} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", help="allpairs")
    parser.add_argument("--boxes", type=int, nargs="+", default=[100_000])
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--without", nargs="+", default=[], choices=["cgal", "postgis", "shapely"])
    arguments = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("ended"))  # and the server with it
    with tempfile.TemporaryDirectory(prefix="allpairs-spatial-") as name:
        folder = pathlib.Path(name)
        server = None if "postgis" in arguments.without else postgis.Server(folder)
        try:
            for n in arguments.boxes:
                solid = Scene(folder, uniform(n, 3))
                contenders = allpairs_contenders(arguments.program, solid)
                contenders |= {} if "cgal" in arguments.without else cgal_contenders(folder, solid)
                contenders |= {} if server is None else postgis_contenders(server, solid)
                contest(f"{n:,}", contenders, arguments.repeats)
                if "shapely" not in arguments.without:
                    flat = Scene(folder, uniform(n, 2))
                    contenders = allpairs_contenders(arguments.program, flat) | shapely_contenders(flat)
                    contest(f"{n:,}, flat", contenders, arguments.repeats)
        finally:
            if server is not None:
                server.stop()


main()
