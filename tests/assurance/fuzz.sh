#!/usr/bin/env bash
# fuzz.sh SECONDS LOGS [TARGET...]: libFuzzer on every target of build/fuzz, two at a time, each from its corpus in
# the repository; a row of a table for each. What it learns stays in out/corpus, logs and failing inputs in LOGS.
set -eu
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
seconds=$1 logs=$2
shift 2
mkdir -p "$logs"
[ $# -gt 0 ] || set -- build/fuzz/bin/*_fuzz

one() {
  subject=$(basename "$1" _fuzz)
  mkdir -p "out/corpus/$subject"
  seeds=("tests/fuzz/corpus/$subject")
  case $subject in control | interpreter | run | compare) seeds+=(tests/nc) ;; esac
  "$1" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -print_final_stats=1 \
    -artifact_prefix="$logs/$subject-" "out/corpus/$subject" "${seeds[@]}" > "$logs/$subject.log" 2>&1 &&
    failures=0 || failures=1
  executions=$(sed -nE 's/stat::number_of_executed_units: *//p' "$logs/$subject.log")
  echo "| $subject | $seconds | ${executions:-0} | $failures |"
  return "$failures"
}

# The rows in the order of the targets, whichever ends first.
state=0
while [ $# -gt 0 ]; do
  one "$1" > "$logs.first" & first=$!
  if [ $# -gt 1 ]; then one "$2" > "$logs.second" || state=1; else : > "$logs.second"; fi
  wait $first || state=1
  cat "$logs.first" "$logs.second"
  rm -f "$logs.first" "$logs.second"
  shift
  [ $# -eq 0 ] || shift
done
exit $state
