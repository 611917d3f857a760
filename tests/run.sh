#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test.
#   tests/run.sh          all of it: Release tests, sanitizers, format and lint
#   tests/run.sh quick    Release tests only
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=$(nproc)
export OMP_WAIT_POLICY=passive # tests run beside one another
.ci/packages.sh tests

echo "== Release build and tests"
cmake -S . -B build -DCMAKE_BUILD_TYPE=Release >build.log 2>&1 || { cat build.log; exit 1; }
cmake --build build -j "$jobs" >>build.log 2>&1 || { tail -n 60 build.log; exit 1; }
rm -f build.log
ctest --test-dir build --output-on-failure -j "$jobs"
[ "${1:-}" = quick ] && exit 0

echo "== Address and undefined-behaviour sanitizers"
cmake -S . -B build-sanitize -DCMAKE_BUILD_TYPE=None -DCDFP_SANITIZE=ON >build.log 2>&1 || { cat build.log; exit 1; }
cmake --build build-sanitize -j "$jobs" >>build.log 2>&1 || { tail -n 60 build.log; exit 1; }
rm -f build.log
ASAN_OPTIONS=detect_leaks=1 LSAN_OPTIONS=suppressions=$PWD/tests/leaks.supp:print_suppressions=0 \
  ctest --test-dir build-sanitize --output-on-failure -j "$jobs"

echo "== Format and lint"
mapfile -t sources < <(git ls-files '*.cpp' '*.hpp' '*.h')
clang-format --dry-run -Werror "${sources[@]}"
.ci/lint.sh build-lint
echo "All checks passed."
