#!/usr/bin/env bash
# Builds what a benchmark needs, prints its table, and last a line "NAME: pass" or "NAME: short: what".
#   benchmarks/run.sh NAME [arguments]
set -euo pipefail
cd "$(dirname "$0")/.."
names=$(cd benchmarks && ls ./*.cpp ./*.f90 | sed 's|^./||; s|\.[a-z0-9]*$||' | tr '\n' ' ')
name=${1:?"usage: benchmarks/run.sh NAME; there are: $names"}
shift
if [ ! -f "benchmarks/$name.cpp" ] && [ ! -f "benchmarks/$name.f90" ]; then
  echo "there is no benchmark '$name'; there are: $names" >&2
  exit 2
fi
.ci/packages.sh
log=$(mktemp)
if ! { cmake -S . -B build -DCMAKE_BUILD_TYPE=Release -DCDFP_BENCHMARKS=ON &&
       cmake --build build -j "$(nproc)" --target "bench_$name"; } >"$log" 2>&1; then
  tail -n 60 "$log"
  exit 1
fi
rm -f "$log"
export GOMP_SPINCOUNT="${GOMP_SPINCOUNT:-20000}"  # spinning threads would slow one another beside other work
exec "build/bin/bench_$name" "$@"
