#!/bin/sh
# check.sh SOURCE BUILD [CLANG_TIDY]: clang-tidy with the house's .clang-tidy has nothing to say of the library.
set -eu
source=$1 build=$2 tidy=${3:-}
if [ -z "$tidy" ] || [ ! -f "$build/compile_commands.json" ]; then
    echo 'skipped: there is no clang-tidy, or no compile_commands.json (the presets have it)'
    exit 77
fi
find "$source/lib" -name '*.cpp' | xargs -P "$(nproc)" -n 3 "$tidy" --quiet -p "$build" 2> "$build/tidy.log" && exit
cat "$build/tidy.log"
exit 1
