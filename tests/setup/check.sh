#!/bin/sh
# check.sh SOURCE OUT: what cmake/setup.sh makes of the ways in which apt's sources are written.
set -eu
root=$1 out=$2
mkdir -p "$out"
. "$root/cmake/setup.sh"

failed=0
expect() {   # expect WHAT EXPECTED ACTUAL
    [ "$2" = "$3" ] || { printf 'FAILED: %s\nexpected:\n%s\ngot:\n%s\n' "$1" "$2" "$3"; failed=1; }
}

cat > "$out/debian.sources" <<'EOF'
Types: deb
URIs: http://tools.example/apt
Suites: bookworm
Components: main

Types: deb
URIs: http://mirror.example/debian
Suites: bookworm
Enabled: no
Components: main

# The one.
Types: deb deb-src
# http://old.example
URIs: http://mirror.example/debian/
Suites: bookworm bookworm-updates
Components: main contrib
Signed-By:
 -----BEGIN PGP PUBLIC KEY BLOCK-----
 .
 mDMEZ

Types: deb
URIs: http://mirror.example/debian-security
Suites: bookworm-security
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg
EOF
expect 'deb822' 'Types: deb
URIs: http://mirror.example/debian/
Suites: bookworm-backports
Components: main
Signed-By:
 -----BEGIN PGP PUBLIC KEY BLOCK-----
 .
 mDMEZ' "$(backports_entry http://mirror.example/debian bookworm "$out/debian.sources")"
expect 'deb822, another suite' '' "$(backports_entry http://mirror.example/debian trixie "$out/debian.sources")"

cat > "$out/sources.list" <<'EOF'
# deb http://mirror.example/debian bookworm main
deb-src http://mirror.example/debian bookworm main
deb http://tools.example/apt bookworm main
deb http://mirror.example/debian bookworm-updates main
deb [ arch=amd64 signed-by=/usr/share/keyrings/a.gpg ] http://mirror.example/debian bookworm main contrib
EOF
expect 'one line with options' \
    'deb [ arch=amd64 signed-by=/usr/share/keyrings/a.gpg ] http://mirror.example/debian bookworm-backports main' \
    "$(backports_entry http://mirror.example/debian bookworm "$out/sources.list")"
echo 'deb http://mirror.example/debian/ bookworm main' > "$out/sources.list"
expect 'one line' 'deb http://mirror.example/debian/ bookworm-backports main' \
    "$(backports_entry http://mirror.example/debian bookworm "$out/sources.list")"

expect 'a missing command' 'its-package' "$(missing_tools sh:dash no-such-command:its-package)"
recent_enough 25.0.7-2~bpo12+1 || expect 'Mesa 25' yes no
! recent_enough 22.3.6-1 || expect 'Mesa 22' no yes
! recent_enough '' || expect 'no Mesa' no yes
exit $failed
