# SPDX-License-Identifier: MIT
"""Writes docs/benchmarks.md and its pictures from the records of a run."""

import argparse
import sys
from pathlib import Path

from charts import pair_cost_chart, save, thread_chart, time_chart
from moving import write_moving
from page import write_page
from records import Table, read_external, read_results
from worlds import write_worlds


def chart_cells(table):
    """For each scene the largest size up to 100,000, above which not all settings are measured."""
    cells = []
    for scene in table.scenes():
        sizes = [boxes for boxes in table.sizes(scene) if boxes <= 100000]
        cells.append((scene, max(sizes)))
    return cells


def write_pictures(table, folder):
    for scene in table.scenes():
        save(time_chart(table, scene), folder / f"time-{scene}.svg")
    save(pair_cost_chart(table, chart_cells(table)), folder / "pair-cost.svg")
    if table.scaling:
        save(thread_chart(table), folder / "threads.svg")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("records", type=Path, help="CSV file that allpairs_bench wrote")
    parser.add_argument("--external", type=Path, help="CSV file of other programs: name,scene,n,ms,pairs,hash")
    parser.add_argument("--docs", type=Path, default=Path("docs"), help="folder to write to")
    arguments = parser.parse_args()
    records = read_results(arguments.records)
    if arguments.external and arguments.external.exists():
        records += read_external(arguments.external)
    if not records:
        sys.exit(f"{arguments.records}: no records")
    table = Table(records)
    write_pictures(table, arguments.docs / "images" / "benchmarks")
    page = write_page(table, records, write_moving(arguments.docs), write_worlds(arguments.docs))
    (arguments.docs / "benchmarks.md").write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
