# SPDX-License-Identifier: MIT
"""A PostgreSQL server of its own, in a folder that goes with it, with the extension PostGIS."""

import os
import pathlib
import re
import shutil
import subprocess
import time

import numpy as np

SETTINGS = {
    "fsync": "off",
    "synchronous_commit": "off",
    "full_page_writes": "off",
    "autovacuum": "off",
    "jit": "off",
    "max_parallel_workers_per_gather": "0",  # one thread, as all others
    "shared_buffers": "1GB",
    "work_mem": "512MB",
    "maintenance_work_mem": "1GB",
    "max_wal_size": "8GB",
}

# A line from one corner to the other is the smallest geometry whose n-dimensional bounds are the box. In the order of
# geometries, which is that of a Hilbert curve, they make an index that is searched in half of the time.
LOAD = """
DROP TABLE IF EXISTS pairs, boxes;
CREATE UNLOGGED TABLE boxes AS SELECT id, ST_MakeLine(ST_MakePoint(a, b, c), ST_MakePoint(d, e, f)) AS box FROM rows
  ORDER BY box;
CREATE INDEX ON boxes USING gist (box gist_geometry_ops_nd);
ANALYZE boxes;
"""
SEARCH = """
CREATE UNLOGGED TABLE pairs AS
  SELECT a.id AS first, b.id AS second FROM boxes a JOIN boxes b ON a.box &&& b.box AND a.id < b.id;
"""


def programs():
    return sorted(pathlib.Path("/usr/lib/postgresql").glob("*/bin"))[-1]


def as_owner(command):
    """The server refuses to run as root."""
    return ["runuser", "-u", "postgres", "--", *command] if os.geteuid() == 0 else command


class Server:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.data = self.folder / "cluster"
        self.data.mkdir()
        if os.geteuid() == 0:
            self.folder.chmod(0o755)
            shutil.chown(self.data, "postgres")
        self._run([programs() / "initdb", "-D", self.data, "-E", "UTF8", "--locale=C", "-A", "trust", "-U", "postgres"])
        options = [f"-c {name}={value}" for name, value in SETTINGS.items()]
        options += ["-c listen_addresses=''", f"-c unix_socket_directories={self.data}"]
        self._run([programs() / "pg_ctl", "-D", self.data, "-w", "-l", self.data / "log", "-o", " ".join(options), "start"])
        self.ask("CREATE EXTENSION postgis")

    def stop(self):
        self._run([programs() / "pg_ctl", "-D", self.data, "-m", "immediate", "stop"])

    def version(self):
        server = self.ask("SHOW server_version").split()[0]
        return f"PostGIS {self.ask('SELECT PostGIS_Lib_Version()')} on PostgreSQL {server}"

    def ask(self, statement):
        command = ["psql", "-X", "-q", "-A", "-t", "-h", self.data, "-U", "postgres", "-c", statement]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()

    def put(self, rows):
        """Fills the table of plain numbers, which is not part of any time."""
        self.ask("DROP TABLE IF EXISTS rows")
        self.ask("CREATE UNLOGGED TABLE rows (id integer, a float8, b float8, c float8, d float8, e float8, f float8)")
        path = self.folder / "rows.csv"
        with open(path, "w") as file:
            for i, row in enumerate(rows.astype(np.float64).tolist()):
                file.write(f"{i},{','.join(map(repr, row))}\n")
        self.ask(f"COPY rows FROM '{path}' (FORMAT csv)")
        path.unlink()

    def pairs(self):
        text = self.ask("SELECT first, second FROM pairs")
        return np.array(re.findall(r"\d+", text), dtype=np.uint32).reshape(-1, 2)

    def seconds(self, statements):
        """Processor time, by the server's own count, and wall time."""
        begin = time.perf_counter()
        command = ["psql", "-X", "-q", "-h", self.data, "-U", "postgres", "-v", "ON_ERROR_STOP=1", "-f", "-"]
        text = "SET client_min_messages = log; SET log_statement_stats = on;" + statements
        done = subprocess.run(command, check=True, capture_output=True, text=True, input=text)
        wall = time.perf_counter() - begin
        used = re.findall(r"([\d.]+) s user, ([\d.]+) s system, [\d.]+ s elapsed", done.stderr)
        return sum(float(user) + float(system) for user, system in used), wall

    def _run(self, command):
        subprocess.run(as_owner(list(map(str, command))), check=True, stdout=subprocess.DEVNULL, cwd="/")
