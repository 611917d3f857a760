#!/usr/bin/env bash
# clang-tidy over the library's sources, as they are compiled in the build folder given. Kernels for several
# instruction sets are one source: the baseline is looked at.
set -euo pipefail
build=$1
git ls-files 'src_cpp/*.cpp' 'fortran_api/*.cpp' ':!*_avx2.cpp' ':!*_avx512.cpp' |
  xargs -P "$(nproc)" -n 4 clang-tidy -p "$build" --quiet --extra-arg=-Wno-unknown-warning-option 2>&1 |
  { grep -v 'warnings generated\|Suppressed\|Use -header-filter\|^$' || true; }
