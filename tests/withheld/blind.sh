#!/usr/bin/env bash
# blind.sh [--seeds 5] [--sets 100] [--program PATH] [--out DIR] [--first SEED] [--kinds a,b] [--circumstances a,b] [--timeout 120]
# Generates sealed sets for fresh seeds, lets the program diagnose and predict all of them, then opens the truth
# and prints the score. The truth lives in an unlinked file that only this shell holds open in between.
set -eu
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
seeds=5 sets=100 program='' out='' first='' kinds='' around='' limit=120 jobs=$(nproc)
while [ $# -gt 0 ]; do
  [ $# -ge 2 ] || { echo "blind: $1 needs a value" >&2; exit 2; }
  case $1 in
    --seeds) seeds=$2;; --sets) sets=$2;; --program) program=$2;; --out) out=$2;; --first) first=$2;;
    --kinds) kinds=$2;; --circumstances) around=$2;; --timeout) limit=$2;; --jobs) jobs=$2;;
    *) echo "blind: unknown option $1" >&2; exit 2;;
  esac
  shift 2
done
program=${program:-$here/../../build/release/bin/trunnion}
command -v "$program" >/dev/null || [ -f "$program" ] || { echo "blind: no program at $program (use --program PATH)" >&2; exit 2; }
program=$(realpath "$(command -v "$program" || echo "$program")")
python=
for name in python3 /usr/bin/python3; do
  if "$name" -c 'import numpy, tomllib' 2>/dev/null; then python=$name; break; fi
done
[ -n "$python" ] || { echo "blind: needs python3 (3.11 or later) with numpy" >&2; exit 2; }
export PYTHON=$python OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
first=${first:-$(od -An -N4 -tu4 /dev/urandom | tr -d ' ')}
out=${out:-$(mktemp -d "${TMPDIR:-/tmp}/blind.XXXXXX")}
mkdir -p "$out"; out=$(cd "$out" && pwd)
[ -z "$(ls -A "$out")" ] || { echo "blind: $out is not empty" >&2; exit 2; }

hidden=$(mktemp -d "${TMPDIR:-/tmp}/sealing.XXXXXX")
trap 'rm -rf "$hidden"' EXIT
echo "blind: generating $seeds x $sets sets, seeds $first..$((first + seeds - 1))" >&2
seq 0 $((seeds - 1)) | xargs -P "$jobs" -I{} sh -c \
  '"$1" "$2/generate.py" "$3/seed{}" --seed $(($4 + {})) --sets "$5" --truth "$6/seed{}/truth" ${7:+--kinds "$7"} ${8:+--circumstances "$8"}' \
  _ "$python" "$here" "$out" "$first" "$sets" "$hidden" "$kinds" "$around"
tar -C "$hidden" -cf "$hidden/sealed" --exclude=./sealed .
exec 8<"$hidden/sealed"
rm -rf "$hidden"
echo "blind: sealed; diagnosing with $jobs at a time" >&2

diagnose_one() {   # FOLDER/sets/NAME
  local folder=${1%/sets/*} name=${1##*/} start rc=0 rp=0
  local to=$folder/results/$name
  start=$(date +%s%N)
  local run=("$2"); case $2 in *.py) run=("$PYTHON" "$2");; esac
  timeout "$3" "${run[@]}" diagnose "$1/readings.csv" --setup "$1/setup.toml" --json --out "$to.toml" >"$to.json" 2>"$to.log" || rc=$?
  local seconds=$(( ($(date +%s%N) - start) / 1000000 ))
  timeout "$3" "${run[@]}" predict "$1/holdout.csv" --setup "$to.toml" >"$to.csv" 2>>"$to.log" || rp=$?
  echo "$rc $rp $seconds" >"$to.status"
}
export -f diagnose_one
for folder in "$out"/seed*; do mkdir -p "$folder/results"; done
printf '%s\n' "$out"/seed*/sets/* | xargs -P "$jobs" -I{} bash -c 'diagnose_one "$@"' _ {} "$program" "$limit" 8<&-
(cd "$out" && find . -path '*/results/*' \( -name '*.json' -o -name '*.csv' \) -type f | sort | xargs sha256sum) >"$out/verdicts.sha256"

tar -C "$out" -xf - <&8
exec 8<&-
cat "$out"/seed*/results/*.status | "$python" -c '
import sys
rows = [list(map(int, line.split())) for line in sys.stdin]
times = sorted(r[2] for r in rows)
print(f"diagnose: {len(rows)} runs, median {times[len(times)//2]} ms, longest {times[-1]} ms; "
      f"exit not 0: diagnose {sum(r[0] != 0 for r in rows)}, predict {sum(r[1] != 0 for r in rows)}")' | tee "$out/times.txt"
echo "seeds $first..$((first + seeds - 1)), $sets sets each"
"$python" "$here/score.py" "$out" --json "$out/score.json" | tee "$out/score.txt"
echo "blind: everything is in $out" >&2
