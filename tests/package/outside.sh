#!/usr/bin/env bash
# Installs a build to a prefix of its own and builds an outside project against it, by CMake and by pkg-config,
# in C, C++ and Fortran, and by the installed module sources.
#   outside.sh BUILD FOLDER CMAKE
set -euo pipefail
build=$1 folder=$2 cmake=$3
source=$(cd "$(dirname "$0")/outside" && pwd)
rm -rf "$folder"
mkdir -p "$folder/by_pkg_config"
"$cmake" --install "$build" --prefix "$folder/prefix" >"$folder/install.log"

"$cmake" -S "$source" -B "$folder/by_cmake" -DCMAKE_PREFIX_PATH="$folder/prefix" -DCMAKE_BUILD_TYPE=Release >"$folder/cmake.log"
"$cmake" --build "$folder/by_cmake" >>"$folder/cmake.log"
for program in from_c from_cpp from_fortran; do "$folder/by_cmake/$program"; done

libraries=$(dirname "$(find "$folder/prefix" -name cdfp.pc)")
export PKG_CONFIG_PATH=$libraries LD_LIBRARY_PATH=$libraries/..
cd "$folder/by_pkg_config"
# shellcheck disable=SC2046 # flags are words
gcc "$source/main.c" $(pkg-config --cflags --libs cdfp) -o from_c
# shellcheck disable=SC2046
g++ -std=c++20 "$source/main.cpp" $(pkg-config --cflags --libs cdfp) -o from_cpp
# shellcheck disable=SC2046
gfortran "$source/main.f90" $(pkg-config --cflags --libs cdfp) -o from_fortran
for program in from_c from_cpp from_fortran; do "./$program"; done

# as fpm does it: the installed module sources, each once those that it uses are compiled, and the library
mkdir -p "$folder/by_sources"
cd "$folder/by_sources"
pending=("$folder"/prefix/share/cdfp/fortran/*.f90)
while [ ${#pending[@]} -gt 0 ]; do
  left=()
  for module in "${pending[@]}"; do gfortran -c "$module" 2>last_error.log || left+=("$module"); done
  if [ ${#left[@]} -eq ${#pending[@]} ]; then cat last_error.log; exit 1; fi
  pending=(${left[@]+"${left[@]}"})
done
gfortran "$source/main.f90" ./*.o -L"$libraries/.." -lcdfp -o from_fortran
./from_fortran
"$folder/prefix/bin/cdfp" --version
