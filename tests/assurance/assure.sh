#!/usr/bin/env bash
# assure.sh [--seconds 60] [--mutants 20] [--minutes 600] [--out docs/assurance.md] [--only faults,soak,law,bytes,edits,inventions,tidy,fuzz,coverage,mutation]
# Long checks one after the other; what they found is printed and written as a page. Run by ./dev assure,
# which builds what is needed.
set -eu
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
seconds=60 mutants=20 minutes=600 page=docs/assurance.md only=faults,soak,law,bytes,edits,inventions,tidy,fuzz,coverage,mutation
while [ $# -gt 0 ]; do
  [ $# -ge 2 ] || { echo "assure: $1 needs a value" >&2; exit 2; }
  case $1 in
    --seconds) seconds=$2 ;;
    --mutants) mutants=$2 ;;
    --minutes) minutes=$2 ;;
    --out) page=$2 ;;
    --only) only=$2 ;;
    *) echo "assure: unknown option $1" >&2; exit 2 ;;
  esac
  shift 2
done
work=out/assurance
mkdir -p "$work"
text=$work/page.md
rooms="base geometry interpreter offsets kinematics positioning controller estimation identification diagnosis regression"

wanted() { case ",$only," in *",$1,"*) ;; *) return 1 ;; esac; }

# The page keeps the section of an earlier run where this one leaves a check out.
section() {
  if wanted "$1"; then
    echo "assure: $1" >&2
    "$1" > "$work/$1.md"
  fi
  if [ -f "$work/$1.md" ]; then cat "$work/$1.md"; else echo "($2: not run yet)"; fi
  echo
}

faults() {
  echo "## Failing calls of the system"
  echo
  TRUNNION_FAULTS=all build/release/bin/test_faults > "$work/faults.log" 2>&1 && state=holds || state=FAILS
  echo "Every command, each call of open, read, write, close, fsync, rename, linkat, pread, pwrite, fchmod, readdir (up to 300 places each), and 300 places of malloc: the law **$state**, $(grep -oE '[0-9]+ assertions' "$work/faults.log" | tail -1)."
}

soak() {
  echo "## Random programs on random machines"
  echo
  TRUNNION_SOAK_SECONDS=$seconds TRUNNION_SOAK_SEED=$(date +%s) build/release/bin/test_soak \
    > "$work/soak.log" 2>&1 && state=hold || state=FAIL
  echo "The laws **$state**: $(grep -oE '[0-9]+ programs from seed [0-9]+ in [0-9.]+ s' "$work/soak.log" | tail -1)."
}

law() {
  echo "## Blocks that run refuses when it reaches them"
  echo
  TRUNNION_LAW_BLOCKS=20000 TRUNNION_LAW_SEED=$(date +%s) build/release/bin/test_check \
    "what run refuses*" > "$work/law.log" 2>&1 && state=holds || state=FAILS
  echo "\`check\` refuses each of them: the law **$state**. $(grep -oE '[0-9]+ blocks from seed .*' "$work/law.log" | tail -1)."
  echo
  python3 tests/assurance/refused_blocks.py build/release/bin/trunnion --seed "$(date +%s)" \
    > "$work/refused.log" && state=holds || state=FAILS
  echo "Whole programs, drawn from every code, statement and kind of expression: the law **$state**."
  echo
  sed '2,$s/^ *\([0-9]* with\)/- \1/' "$work/refused.log"
}

bytes() {
  echo "## Same bytes from a Debug build"
  echo
  tests/assurance/bytes.sh build/release/bin/trunnion build/asan/bin/trunnion > "$work/bytes.log" && state=are || state="ARE NOT"
  echo "Outputs of $(grep -c '^same' "$work/bytes.log") commands **$state** the same, byte by byte, from a build with \`-O2 -DNDEBUG\` and one with \`-O1\`, assertions and sanitizers."
  sed -n 's/^other/- differs:/p' "$work/bytes.log"
}

edits() {
  echo "## Edited and rewritten programs, compared"
  echo
  build/release/bin/test_regression "[assure]" > "$work/edits.log" 2>&1 && state=hold || state=FAIL
  echo "The figures of compare **$state**:"
  echo
  tr '\n' ' ' < "$work/edits.log" | tr -s ' ' |
    grep -oE '[0-9]+ (edits judged:|rewrites,)[^/=]*' | sed 's/^/- /'
}

inventions() {
  echo "## One effect on every measuring program"
  echo
  build/release/bin/test_diagnosis "[.assure][inventions]" > "$work/inventions.log" 2>&1 && state="is named alone" || state="is NOT always named alone"
  echo "Each effect of the catalogue at five sigma, on each program, **$state**: it, or a rival listed with it, first, and nothing else above probability 0.5. The same setup on both sides: no gap."
  echo
  echo "| machine | programs | effects | not first | others claimed | gaps of itself |"
  echo "|---|---|---|---|---|---|"
  awk '/ effects, not first [0-9]+, / {
         gsub(/,/, ""); machine = $1; sub(/^[^:]*: /, "")
         if (!(machine in programs)) order[++machines] = machine
         programs[machine]++; tried[machine] += $1; first[machine] += $5; other[machine] += $8; own[machine] += $12 }
       END { for (k = 1; k <= machines; ++k) { m = order[k]
         print "| " m " | " programs[m] " | " tried[m] " | " first[m] " | " other[m] " | " own[m] " |" } }' "$work/inventions.log"
  echo
  sed -nE 's/^(NOT FIRST|INVENTED|GAP): (.*)/- \1: \2/p' "$work/inventions.log"
  build/release/bin/test_diagnosis "[.assure][written]" > "$work/written.log" 2>&1 && state="predicts no worse" || state="PREDICTS WORSE"
  echo
  echo "What is written by a diagnosis **$state** than the set-up alone on fresh readings of 120 machines (five kinds)."
}

tidy() {
  echo "## clang-tidy on every room"
  echo
  .ci/lint tidy > "$work/tidy.log" 2>&1 && state=hold || state=FAIL
  echo "The checks of .clang-tidy **$state**, $(grep -c 'error:' "$work/tidy.log") findings in $(wc -l < build/tidy/files) groups of files."
}

fuzz() {
  echo "## Fuzzing with sanitizers"
  echo
  echo "| target | seconds | executions | failures |"
  echo "|---|---|---|---|"
  tests/assurance/fuzz.sh "$seconds" "$work" || true
}

coverage() {
  echo "## Branches that the tests take"
  echo
  find build/coverage -name '*.gcda' -delete
  ctest --preset coverage -j"$(nproc)" > "$work/coverage_tests.log" 2>&1 || true
  echo "| room | branches | taken |"
  echo "|---|---|---|"
  tests/assurance/coverage.py build/coverage |
    sed -E 's/^([^ ]+) +([0-9]+) of +([0-9]+) +([0-9.]+) %/| \1 | \3 | \4 % |/'
}

mutation() {
  echo "## Mutants that the tests of a room kill"
  echo
  # shellcheck disable=SC2086
  tests/assurance/mutate.py build/mutants $rooms --mutants "$mutants" --minutes "$minutes" --seed 1 \
    --named tests/assurance/named_mutants.json --out "$work/mutation.json" \
    > "$work/mutation.log"
  echo "| room | mutants | killed by its own tests | by others |"
  echo "|---|---|---|---|"
  python3 -c 'import json, sys
for r in json.load(open(sys.argv[1])):
    all = r["killed"] + r["beside"] + len(r["survivors"])
    print("| %s | %d of %d | %d | %d |" % (r["room"], all, r["candidates"], r["killed"], r["beside"]))' \
    "$work/mutation.json"
  echo
  echo "Survivors:"
  echo
  sed -nE 's/^survived (.*)/- `\1`/p' "$work/mutation.log"
}

{
  echo "# Assurance"
  echo
  echo "Written by \`./dev assure\`: what the long checks found. Each command below repeats one of them."
  echo
  echo "    ./dev assure --only faults          # a library fails single calls of the system"
  echo "    ./dev soak SECONDS [SEED]           # laws on random programs and machines"
  echo "    ./dev assure --only law             # what run refuses, check refuses"
  echo "    ./dev assure --only bytes           # a Debug build with sanitizers beside the release"
  echo "    ./dev assure --only edits           # random edits and harmless rewrites, compared"
  echo "    ./dev assure --only inventions      # each effect on each measuring program, diagnosed"
  echo "    ./dev lint tidy                     # clang-tidy on every room"
  echo "    ./dev fuzz SECONDS"
  echo "    ./dev assure --only coverage"
  echo "    ./dev assure --only mutation --mutants N"
  echo
  section faults "failing calls"
  section soak "random programs"
  section law "refused blocks"
  section bytes "Debug against Release"
  section edits "edits and rewrites"
  section inventions "inventions"
  section tidy "clang-tidy"
  section fuzz "fuzzing"
  section coverage "branches"
  section mutation "mutants"
} > "$text"
cp "$text" "$page"
cat "$page"
