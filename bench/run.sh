#!/usr/bin/env bash
# Runs the benchmarks: bench/run.sh PROGRAM [--report] [arguments of the program].
# With --report: the full plan, and docs/benchmarks.md with its pictures and records anew. Without: the quick plan.
set -euo pipefail

program=$1
shift
docs=$(cd "$(dirname "${BASH_SOURCE[0]}")/../docs" && pwd)

if [[ "${1:-}" == --report ]]; then
  shift
  records=$(mktemp)
  trap 'rm -f "$records"' EXIT
  "$program" "$@" --output "$records"
  cp "$records" "$docs/benchmarks.csv"
  /usr/bin/python3 "$docs/../bench/report" "$docs/benchmarks.csv" --external "$docs/benchmarks-external.csv" --docs "$docs"
else
  "$program" --quick --output "$(dirname "$program")/../benchmarks.csv" "$@"
fi
