#!/usr/bin/env bash
# Runs the benchmarks of what is kept from step to step: bench/moving.sh FOLDER_OF_PROGRAMS [--report].
# With --report: their records in docs/, and docs/benchmarks.md with its pictures anew; the records of the searches of
# resting boxes stay as they are.
set -euo pipefail

programs=$1
docs=$(cd "$(dirname "${BASH_SOURCE[0]}")/../docs" && pwd)
data=${ALLPAIRS_DATA:-$docs/../../shared/data}/ccd
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$programs/moving_benchmark" --frames 200 --peer-frames 40 --output "$folder/moving.csv"
"$programs/moving_benchmark" --frames 200 --peer-frames 40 --turn 10 --output "$folder/moving-tens.csv"
"$programs/cycle_benchmark" --output "$folder/cycle.csv"
"$programs/query_benchmark" --output "$folder/queries.csv"
if [[ -d $data ]]; then
  "$programs/element_benchmark" --output "$folder/elements.csv" \
    "$data"/cloth-ball/cloth_ball92.ply "$data"/cloth-ball/cloth_ball93.ply \
    "$data"/armadillo-rollers/326.ply "$data"/armadillo-rollers/327.ply \
    "$data"/cloth-funnel/227.ply "$data"/cloth-funnel/228.ply
else
  echo "moving.sh: no $data: candidates of deforming meshes are left out" >&2
fi

if [[ "${2:-}" == --report ]]; then
  awk 'FNR > 1 || NR == 1' "$folder"/moving.csv "$folder"/moving-tens.csv >"$docs/benchmarks-moving.csv"
  awk 'FNR > 1 || NR == 1' "$folder"/[!m]*.csv >"$docs/benchmarks-tasks.csv"
  /usr/bin/python3 "$docs/../bench/report" "$docs/benchmarks.csv" --external "$docs/benchmarks-external.csv" --docs "$docs"
fi
