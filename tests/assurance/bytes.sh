#!/usr/bin/env bash
# bytes.sh PROGRAM_A PROGRAM_B: the same commands with both; one line each, "same" or "other". Exit 1 when bytes differ.
set -eu
# shellcheck disable=SC2034  # read as ${!side}
a=$(realpath "$1") b=$(realpath "$2")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/a" "$work/b"
export TRUNNION_HOME=$PWD
machine=machines/bc_table.toml
commands=(
  "run programs/sphere9.nc --setup $machine --json --truth --trace OUT/t.csv --readings OUT/r.csv"
  "run O8002 --programs programs/pivot --programs programs --setup $machine --readings OUT/r.csv --inject C.backlash:gap_rad=2e-5"
  "run O8200 --programs programs/ballbar/bc --programs programs --setup $machine --readings OUT/b.csv"
  "predict IN/r.csv --setup $machine --jacobian OUT/j.csv"
  "identify IN/r.csv --setup $machine --effects location,C.backlash --json --out OUT/s.toml"
  "diagnose IN/r.csv --setup $machine --json --out OUT/d.toml --html OUT/d.html"
  "pivot --setup $machine --json --svg OUT/p"
  "ballbar --setup machines/ac_trunnion.toml --json --csv OUT/e.csv --svg OUT/plots"
  "volumetric --setup $machine --grid 3 --rotary-grid 3 --csv OUT/v.csv --svg OUT/v"
  "compensate programs/sphere9.nc --setup $machine --out OUT/c.nc"
  "compare programs/pivot programs/ballbar/bc --json"
  "check programs --json"
)
state=0
"$a" run O8002 --programs programs/pivot --programs programs --setup "$machine" --readings "$work/r.csv" \
  --inject C.backlash:gap_rad=2e-5 > /dev/null 2>&1
for words in "${commands[@]}"; do
  for side in a b; do
    folder=$work/$side
    rm -rf "${folder:?}"/*
    line=${words//OUT/$folder}
    line=${line//IN/$work}
    # shellcheck disable=SC2086
    "${!side}" $line > "$folder/out.txt" 2> "$folder/err.txt" || echo "exit code $?" >> "$folder/err.txt"
    find "$folder" -type f -exec sed -i "s#$folder#FOLDER#g; s#$work#WORK#g" {} +
  done
  if diff -r "$work/a" "$work/b" > /dev/null; then echo "same  $words"; else echo "other $words"; state=1; fi
done
exit $state
