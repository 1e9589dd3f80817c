# Sourced by samples/demo.sh, samples/viewer.sh and tests/run.sh with $root set: restir_setup installs what a build lacks, through apt.

tools='c++:g++ cmake:cmake ninja:ninja-build glslangValidator:glslang-tools'
libraries='libvulkan-dev libglm-dev libtinygltf-dev libstb-dev nlohmann-json3-dev libopenexr-dev libcli11-dev
    vulkan-validationlayers'
test_tools='spirv-val:spirv-tools clang-tidy:clang-tidy'
test_libraries='libgtest-dev glslang-dev'
viewer_libraries='libglfw3-dev libimgui-dev'
# The first release whose software Vulkan driver has ray query.
least_mesa=24.1

say() { printf '== %s\n' "$*"; }

as_root() {
    if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

apt_install() {
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "$@"
}

lists_are_fresh=no
apt_update() {
    [ $lists_are_fresh = yes ] && return
    as_root apt-get update -q || say 'apt-get update had errors; going on with what it has'
    lists_are_fresh=yes
}

missing_tools() {   # missing_tools COMMAND:PACKAGE...
    for tool in "$@"; do
        command -v "${tool%%:*}" > /dev/null || echo "${tool##*:}"
    done
}

missing_libraries() {   # missing_libraries PACKAGE...
    installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "$@" 2> /dev/null || true)
    for library in "$@"; do
        case $installed in
            *"$library installed"*) ;;
            *) echo "$library" ;;
        esac
    done
}

any_exists() {
    for path in "$@"; do
        [ ! -e "$path" ] || return 0
    done
    return 1
}

has_gpu_driver() {
    any_exists /dev/dri/renderD* /dev/nvidia[0-9]* || return 1
    any_exists /usr/share/vulkan/icd.d/*.json /etc/vulkan/icd.d/*.json || return 1
    ! command -v vulkaninfo > /dev/null || vulkaninfo 2> /dev/null | grep -q VK_KHR_ray_query
}

recent_enough() {   # recent_enough MESA_VERSION
    [ -n "$1" ] && [ "$1" != '(none)' ] && dpkg --compare-versions "$1" ge $least_mesa
}

installed_mesa() { dpkg-query -W -f '${Version}\n' mesa-vulkan-drivers 2> /dev/null | head -n 1; }
candidate_mesa() { apt-cache policy mesa-vulkan-drivers | awk '$1 == "Candidate:" { print $2 }'; }

# "URI SUITE" of Debian's own archive, as apt sees it.
debian_archive() {
    apt-cache policy | awk '
        $1 ~ /^-?[0-9]+$/ { uri = $2; suite = $3 }
        $1 == "release" && /o=Debian,/ && /l=Debian,/ && suite ~ /\/main$/ && suite !~ /-/ {
            sub(/\/main$/, "", suite); print uri, suite; exit
        }'
}

# backports_entry URI SUITE FILE: that archive's entry in FILE, mirror, keys and options unchanged, with its backports instead.
backports_entry() {
    case $3 in
        *.sources) awk -v uri="$1" -v suite="$2" '
            BEGIN { RS = ""; FS = "\n" }
            {
                entry = ""; enabled = 1; has_uri = 0; has_suite = 0
                for (i = 1; i <= NF; i++) {
                    line = $i
                    if (line ~ /^#/) continue
                    count = split(line, word, /[ \t]+/)
                    field = tolower(word[1])
                    if (field == "enabled:" && word[2] == "no") enabled = 0
                    for (w = 2; w <= count; w++) {
                        if (field == "uris:" && (word[w] == uri || word[w] == uri "/")) has_uri = 1
                        if (field == "suites:" && word[w] == suite) has_suite = 1
                    }
                    if (field == "suites:") line = "Suites: " suite "-backports"
                    if (field == "types:") line = "Types: deb"
                    if (field == "components:") line = "Components: main"
                    entry = entry line "\n"
                }
                if (enabled && has_uri && has_suite) { printf "%s", entry; exit }
            }' "$3" ;;
        *) awk -v uri="$1" -v suite="$2" '
            $1 == "deb" {
                at = 2
                if ($at ~ /^\[/) { while ($at !~ /\]$/ && at < NF) at++; at++ }
                if (($at == uri || $at == uri "/") && $(at + 1) == suite) {
                    for (i = 1; i <= at; i++) printf "%s ", $i
                    print suite "-backports main"
                    exit
                }
            }' "$3" ;;
    esac
}

add_backports() {   # add_backports URI SUITE
    apt-cache policy | grep -q " $2-backports/main " && return
    for file in /etc/apt/sources.list.d/*.sources /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
        [ -f "$file" ] || continue
        entry=$(backports_entry "$1" "$2" "$file")
        [ -n "$entry" ] || continue
        case $file in
            *.sources) added=/etc/apt/sources.list.d/restir-backports.sources ;;
            *) added=/etc/apt/sources.list.d/restir-backports.list ;;
        esac
        say "adding $2-backports as $added"
        printf '%s\n' "$entry" | as_root tee "$added" > /dev/null
        lists_are_fresh=no
        apt_update
        return
    done
    return 1
}

# Without a GPU that traces rays, Mesa's software driver must do it.
setup_driver() {
    recent_enough "$(installed_mesa)" && return
    has_gpu_driver && return
    say "no GPU driver found: a Mesa of at least $least_mesa is needed for its software Vulkan driver"
    apt_update
    if recent_enough "$(candidate_mesa)"; then
        apt_install mesa-vulkan-drivers
        return
    fi
    archive=$(debian_archive)
    if [ -n "$archive" ] && add_backports ${archive% *} ${archive#* }; then
        apt_install -t "${archive#* }-backports" mesa-vulkan-drivers
    else
        say "this system's apt has only Mesa $(candidate_mesa): without a ray-tracing GPU nothing can be rendered"
    fi
}

restir_setup() {   # restir_setup [tests|viewer]
    # The driver's compiled shaders, seconds each, survive from run to run.
    export MESA_SHADER_CACHE_DIR="${MESA_SHADER_CACHE_DIR:-$root/build/mesa}"
    mkdir -p "$MESA_SHADER_CACHE_DIR"

    [ "${1:-}" = tests ] || { test_tools=''; test_libraries=''; }
    [ "${1:-}" = viewer ] || viewer_libraries=''
    if ! command -v apt-get > /dev/null; then
        say "no apt here, so nothing is installed; the packages of Debian's that restir needs: $tools" $libraries $viewer_libraries
        return
    fi
    missing=$(missing_tools $tools $test_tools; missing_libraries $libraries $test_libraries $viewer_libraries)
    if [ -n "$missing" ]; then
        say 'installing' $missing
        apt_update
        apt_install $missing || return
    fi
    setup_driver
}
