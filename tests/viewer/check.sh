#!/bin/sh
# check.sh SCRIPT OUT [VIEWER]: the viewer goes through a script without a word of validation, and says what it lacks.
set -eu
script=$1 out=$2 viewer=${3:-}
if [ -z "$viewer" ]; then
    echo 'skipped: there is no restir-viewer, or no xvfb-run to show it under'
    exit 77
fi
# One X server for all of it: xvfb-run may leave one behind whose program ends at once.
[ -n "${UNDER_XVFB:-}" ] || UNDER_XVFB=yes exec xvfb-run -a -s '-screen 0 800x600x24' sh "$0" "$@"
mkdir -p "$out"
cd "$out"
rm -f ./*.png ./*.exr

fail() { printf 'FAILED: %s\n' "$*"; cat said; exit 1; }

show() { "$viewer" "$@" > said 2>&1; }

{ cat "$script"; printf 'shot end.png\nshot end.exr\npanelshot window.png\n'; } > all.script
show builtin:cornell --size 320x180 --validate --script all.script || fail 'the session'
cat said
grep -q '^validation messages: 0$' said || fail 'no count of validation messages'
for file in end.png end.exr window.png; do
    [ -s "$file" ] || fail "$file was not written"
done

echo 'set radius=far' > bad.script
! show builtin:cornell --script bad.script || fail 'a bad script was accepted'
grep -q "bad.script:1: radius: 'far'" said || fail 'the bad line of a script was not named'
! show nowhere.gltf || fail 'a scene that does not exist was shown'
grep -q 'nowhere.gltf' said || fail 'the missing scene was not named'
! env -u DISPLAY -u WAYLAND_DISPLAY "$viewer" builtin:cornell > said 2>&1 || fail 'a window without a display'
grep -q 'no display' said || fail 'the missing display was not named'

# A bridge that changes while the viewer runs: broken, then mended.
rm -rf bridge said && mkdir bridge && : > said
bridge() { printf '%s\n' "$1" > bridge.new && mv bridge.new bridge/restir_bridge.glsl; }
await() {
    for second in $(seq 200); do
        ! "$@" || return 0
        sleep 1
    done
    fail "waited in vain for: $*"
}
bridge '#include "restir/bridge/standard.glsl"'
printf 'frames 1\nshot live.png\nframes 1\ncompilations 1\nframes 1\ncompilations 2\nframes 2\n' > live.script
show builtin:cornell --size 320x180 --scale 0.25 --validate --bridge bridge --script live.script &
viewer_id=$!
started() { [ -s live.png ] || grep -q 'built without restir::compiler' said; }
await started
! grep -q 'built without restir::compiler' said || exit 0
bridge 'nonsense'
await grep -q 'bridge/restir_bridge.glsl:1: ' said
bridge '#include "restir/bridge/standard.glsl" // mended'
wait $viewer_id || fail 'the session with a bridge'
grep -q 'compiled again' said || fail 'a mended bridge was not compiled'
grep -q '^validation messages: 0$' said || fail 'no count of validation messages, with a bridge'
