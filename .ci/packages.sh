#!/usr/bin/env bash
# Installs what cdfp needs on Debian 12 and is not there yet.
#   .ci/packages.sh          what the build and the examples need
#   .ci/packages.sh tests    and what the tests need
set -euo pipefail
packages=(g++ gfortran cmake make pkg-config libeigen3-dev libhdf5-dev libtomlplusplus-dev libcli11-dev
  nlohmann-json3-dev libcairo2-dev zlib1g-dev fonts-dejavu-core)
[ "${1:-}" = tests ] && packages+=(libgtest-dev clang clang-format clang-tidy doxygen libomp-dev valgrind python3)
missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0
echo "Installing: ${missing[*]}"
sudo=()
if [ "$(id -u)" -ne 0 ]; then sudo=(sudo); fi
"${sudo[@]}" apt-get update -qq
DEBIAN_FRONTEND=noninteractive "${sudo[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
