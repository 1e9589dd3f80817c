#!/bin/sh
# check.sh GLSLANG SPIRV_VAL SOURCE OUT
# Every pass is valid SPIR-V, and every file of the GLSL library but the bridge, which binds, compiles on its own: the only
# names it asks of its includer are the scenes to trace.
set -eu
glslang=$1 spirv_val=$2 source=$3 out=$4
mkdir -p "$out"
failed=0

compile() {   # compile NAME FILE [BACKEND [STAGE]]
    defines=
    [ "${3:-query}" = pipeline ] && defines=-DRS_RAY_STAGE
    if ! "$glslang" -V --quiet --target-env vulkan1.3 -S "${4:-comp}" $defines -I"$source/shaders/standard" -I"$source/shaders/rays/${3:-query}" \
        -I"$source/include" -I"$source/shaders" -o "$out/module.spv" "$2" ||
        ! "$spirv_val" --target-env vulkan1.3 --scalar-block-layout "$out/module.spv"
    then
        echo "FAILED: $1"
        failed=1
    fi
}

cd "$source/shaders"
for file in $(find passes -mindepth 2 -name '*.glsl' | sort); do
    compile "$file" "$file"
    if grep -q 'define RS_PASS_RAYS' "$file"; then
        compile "$file, software" "$file" software
        compile "$file, pipeline" "$file" pipeline rgen
    fi
done
for stage in rmiss rchit rahit; do
    for file in rays/pipeline/*.$stage.glsl; do compile "$file" "$file" pipeline $stage; done
done
for file in $(find restir -name '*.glsl' ! -path 'restir/bridge/*' | sort); do
    stage=comp extension=GL_EXT_ray_query group='layout(local_size_x = 8, local_size_y = 8) in;'
    [ "$file" = restir/rays/pipeline.glsl ] && stage=rgen extension=GL_EXT_ray_tracing group=
    cat > "$out/alone.glsl" <<EOF
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension $extension : require
layout(set = 0, binding = 0) uniform accelerationStructureEXT rsTlas;
layout(set = 0, binding = 1) uniform accelerationStructureEXT rsPreviousTlas;
#include "$file"
$group
void main() {}
EOF
    compile "$file, alone" "$out/alone.glsl" query $stage
done
exit $failed
