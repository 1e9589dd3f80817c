#!/bin/sh
# check.sh SOURCE WORK [CLANG_TIDY]: clang-tidy with the house's .clang-tidy has nothing to say of the library.
# The files of a room are read as one: most of the time goes into the headers that they share.
set -eu
source=$1 work=$2 tidy=${3:-}
if [ -z "$tidy" ]; then
    echo 'skipped: there is no clang-tidy'
    exit 77
fi
mkdir -p "$work"
rm -f "$work"/*.cpp
for room in "$source"/lib/*/; do
    find "$room" -name '*.cpp' | sort | sed 's/.*/#include "&"/' > "$work/$(basename "$room").cpp"
done
find "$work" -name '*.cpp' -print0 | xargs -0 -P "$(nproc)" -n 1 sh -c '
    "$0" --quiet --config-file="$1/.clang-tidy" --checks=-bugprone-suspicious-include "$2" \
        -- -std=c++20 -I"$1/include" -I"$1/lib" -I"$1/tests/tidy" 2> "$2.log" || { cat "$2.log"; exit 1; }' \
    "$tidy" "$source"
