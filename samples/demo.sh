#!/bin/sh
# Builds restir-render and renders a market street at night, lit by ReSTIR. All it needs is Debian or Ubuntu.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/cmake/setup.sh"
restir_setup

cd "$root"
say 'building'
mkdir -p build/demo
cmake --preset release -DRESTIR_TESTS=OFF > build/demo/configure.log 2>&1 || { cat build/demo/configure.log; exit 1; }
cmake --build --preset release --target restir-render

say 'rendering builtin:market'
build/release/bin/restir-render builtin:market --size 960x540 --frames 24 --move 0.1 --preset balanced \
    --out build/demo/market.exr --png build/demo/market.png "$@"
say "the picture: $root/build/demo/market.png, and in linear floats: $root/build/demo/market.exr"
