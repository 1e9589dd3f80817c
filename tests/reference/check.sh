#!/bin/sh
# check.sh BUILD [DOXYGEN]: the reference is made without a warning, and says of a member what its comment says.
set -eu
build=$1 doxygen=${2:-}
if [ -z "$doxygen" ]; then
    echo 'skipped: there is no doxygen'
    exit 77
fi
rm -rf "$build/reference"
"$doxygen" "$build/Doxyfile"
expect() {   # expect PAGE TEXT
    grep -q -- "$2" "$build/reference/html/$1.html" || { echo "FAILED: $1.html does not say: $2"; exit 1; }
}
expect structrestir_1_1DiSettings 'a shadow ray for the light that each of them chooses'
expect namespacerestir 'unbiased while emission and alpha textures stand still'   # a comment of two lines behind an enumerator
expect classrestir_1_1Session 'Records a whole frame outside any render pass'
expect structrestir_1_1gpu_1_1RsInstance 'uint32 x 3 per triangle'
