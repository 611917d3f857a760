#!/usr/bin/env bash
# clang-tidy over the library's sources, those of a room in one go: most of its time goes into their headers.
# Kernels for several instruction sets are one source: the baseline is looked at.
set -euo pipefail
build=$1
if git grep -n '#include ".*\.cpp"' -- '*.?pp'; then exit 1; fi
cmake -S . -B "$build" -DCMAKE_BUILD_TYPE=Release -DCDFP_TESTS=OFF -DCMAKE_UNITY_BUILD=ON \
  -DCMAKE_UNITY_BUILD_BATCH_SIZE=10 >/dev/null
sed -n 's#^ *"file": "\(.*/\(src_cpp\|fortran_api\)/.*\.c[px][px]\)",*$#\1#p' "$build/compile_commands.json" |
  grep -v '_avx2\.cpp$\|_avx512\.cpp$' | sort -u |
  xargs -P "$(nproc)" -n 1 clang-tidy -p "$build" --quiet --checks=-bugprone-suspicious-include \
      --extra-arg=-Wno-unknown-warning-option 2>&1 |
  { grep -v 'warnings generated\|Suppressed\|Use -header-filter\|^$' || true; }
