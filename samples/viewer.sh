#!/bin/sh
# Builds restir-viewer and opens its window on a market street at night; arguments go to the viewer.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/cmake/setup.sh"
restir_setup viewer

cd "$root"
say 'building'
mkdir -p build
cmake --preset release -DRESTIR_TESTS=OFF > build/configure.log 2>&1 || { cat build/configure.log; exit 1; }
cmake --build --preset release --target restir-viewer
exec build/release/bin/restir-viewer "$@"
