#!/bin/sh
# Builds everything and runs the tests; arguments go to ctest. The long ones: ctest --test-dir build/release -L long
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/cmake/setup.sh"
restir_setup tests

cd "$root"
mkdir -p build
cmake --preset release > build/configure.log 2>&1 || { cat build/configure.log; exit 1; }
cmake --build --preset release
ctest --test-dir build/release --parallel "$(nproc)" --label-exclude long --output-on-failure --no-tests=error "$@"
