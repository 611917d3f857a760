#!/usr/bin/env bash
# Builds cdfp and runs the laminated-glass case; results in out/laminated_glass.
#   examples/laminated_glass/run.sh [CASE.toml] [--out DIR] [--threads N]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

case_file=$root/examples/laminated_glass/case.toml
if [ $# -gt 0 ] && [[ $1 != -* ]]; then
  case_file=$(realpath "$1")
  shift
fi
out=$root/out/laminated_glass
arguments=()
while [ $# -gt 0 ]; do
  case $1 in
    --out) out=$(realpath -m "${2:?--out needs a folder}"); shift ;;
    --out=*) out=$(realpath -m "${1#--out=}") ;;
    *) arguments+=("$1") ;;
  esac
  shift
done

"$root/.ci/packages.sh"
cmake -S "$root" -B "$root/build" -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$root/build" --target cdfp_command --parallel "$(nproc)"

status=0
"$root/build/bin/cdfp" run "$case_file" --out "$out" "${arguments[@]}" || status=$?
if [ "$status" -eq 0 ] || [ "$status" -eq 130 ]; then  # 130: ended by Ctrl-C
  echo
  echo "Cracks of the whole plate:   $out/cracks_upper.png, $out/cracks_lower.png"
  echo "Force and energies:          $out/force.png, $out/energy.png, $out/history.csv"
  echo "Figures of the run:          $out/summary.json"
  echo "For ParaView and for HDF5:   $out/results.pvd, $out/results.h5"
fi
exit $status
