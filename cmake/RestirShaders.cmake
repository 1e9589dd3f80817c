# Compiles GLSL into C++ headers at build time; also installed, for hosts with a bridge of their own.
#
#   restir_compile_passes(<target> [PASSES <room/stage>...] [RAYS <backend>...] [BRIDGE <dir>])
#       restir's passes (all of them by default), with the restir_bridge.glsl of <dir> instead of the standard one, for ray
#       backends QUERY (the default), PIPELINE, SOFTWARE, or a directory with a restir_rays.glsl of its own.
#       <restir_embedded.h> then gives <target> a restir::ShaderPack for ContextDesc::shaders and each backend,
#       kEmbeddedQueryPack, kEmbeddedPipelinePack, kEmbeddedSoftwarePack and kEmbeddedOwnPack, and the first of them as kEmbeddedPack. Passes that
#       do not trace are compiled once for all.
#
#   restir_compile_shaders(<target> SHADERS <file>... [INCLUDES <dir>...] [VARIANT <name> [STAGE <stage>] [DEFINES <name>...]])
#       the target's own shaders, which may include anything of restir's.
#       a/name.glsl becomes k_name_spv[] in <name.spv.h>. The stage is compute, or what a/name.<stage>.glsl says.
#       VARIANT x: k_name_x_spv[] in <name_x.spv.h>, of another stage or with macros; the same files may be compiled as they are, too.
include_guard(GLOBAL)
find_program(RESTIR_GLSLANG NAMES glslangValidator glslang REQUIRED)

# The first directory holds restir/shared, the second restir/, passes/ and standard/.
function(_restir_shader_dirs includes shader_root)
    get_target_property(dirs restir::shaders RESTIR_SHADER_DIRS)
    list(GET dirs 1 root)
    list(TRANSFORM dirs PREPEND -I)
    set(${includes} ${dirs} PARENT_SCOPE)
    set(${shader_root} ${root} PARENT_SCOPE)
endfunction()

# _restir_compile(<target> SOURCE <file> HEADER <file> SYMBOL <name> STAGE <stage> FLAGS <flag>...)
function(_restir_compile target)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "SOURCE;HEADER;SYMBOL;STAGE" "FLAGS")
    add_custom_command(
        OUTPUT ${arg_HEADER}
        COMMAND ${RESTIR_GLSLANG} -V --quiet --target-env vulkan1.3 -S ${arg_STAGE} ${arg_FLAGS}
                --depfile ${arg_HEADER}.d --vn ${arg_SYMBOL} -o ${arg_HEADER} ${arg_SOURCE}
        DEPENDS ${arg_SOURCE}
        DEPFILE ${arg_HEADER}.d
        COMMENT "glslang: ${arg_SYMBOL}"
        VERBATIM)
    target_sources(${target} PRIVATE ${arg_HEADER})
endfunction()

# The directory with the restir_rays.glsl of a backend, its RayBackend's name, and the one it has in symbols.
function(_restir_ray_backend backend shader_root dir enumerator symbol)
    set(builtin_QUERY RayQuery query)
    set(builtin_PIPELINE Pipeline pipeline)
    set(builtin_SOFTWARE Software software)
    if(DEFINED builtin_${backend})
        list(GET builtin_${backend} 0 name)
        list(GET builtin_${backend} 1 lower)
        set(${dir} ${shader_root}/rays/${lower} PARENT_SCOPE)
        set(${enumerator} ${name} PARENT_SCOPE)
        set(${symbol} ${lower} PARENT_SCOPE)
        return()
    endif()
    get_filename_component(own ${backend} ABSOLUTE)
    if(NOT EXISTS ${own}/restir_rays.glsl)
        message(FATAL_ERROR "restir_compile_passes: RAYS ${backend} is neither QUERY, PIPELINE, SOFTWARE nor a directory with a restir_rays.glsl")
    endif()
    set(${dir} ${own} PARENT_SCOPE)
    set(${enumerator} Own PARENT_SCOPE)
    set(${symbol} own PARENT_SCOPE)
endfunction()

function(restir_compile_passes target)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "BRIDGE" "RAYS;PASSES")
    _restir_shader_dirs(includes shader_root)
    if(NOT arg_RAYS)
        set(arg_RAYS QUERY)
    endif()
    if(NOT arg_BRIDGE)
        set(arg_BRIDGE ${shader_root}/standard)
    endif()
    get_filename_component(bridge ${arg_BRIDGE} ABSOLUTE)
    if(NOT arg_PASSES)
        file(GLOB arg_PASSES CONFIGURE_DEPENDS RELATIVE ${shader_root}/passes ${shader_root}/passes/*/*.glsl)
        list(TRANSFORM arg_PASSES REPLACE "\\.glsl$" "")
    endif()

    set(out ${CMAKE_CURRENT_BINARY_DIR}/${target}_passes)
    file(MAKE_DIRECTORY ${out})
    set(compiled "")
    unset(first)
    set(backends "")
    set(define_rgen -DRS_RAY_STAGE)
    set(pack_includes "")
    set(packs "")
    foreach(backend IN LISTS arg_RAYS)
        _restir_ray_backend(${backend} ${shader_root} rays_dir enumerator backend_symbol)
        if(backend_symbol IN_LIST backends)
            message(FATAL_ERROR "restir_compile_passes: RAYS ${arg_RAYS} has ${backend_symbol} twice")
        endif()
        list(APPEND backends ${backend_symbol})
        set(rows "")
        foreach(pass IN LISTS arg_PASSES)
            set(source ${shader_root}/passes/${pass}.glsl)
            file(STRINGS ${source} traces REGEX "define RS_PASS_RAYS")
            string(REPLACE / _ symbol ${pass})
            set(stage comp)
            set(raygen "")
            if(traces)
                string(APPEND symbol _${backend_symbol})
                if(backend STREQUAL PIPELINE)
                    set(stage rgen)
                    set(raygen ", true")
                endif()
            endif()
            string(REPLACE / . name ${pass})
            string(APPEND rows "    {\"${name}\", ${symbol}, sizeof ${symbol} / sizeof(uint32_t)${raygen}},\n")
            if(symbol IN_LIST compiled)
                continue()
            endif()
            list(APPEND compiled ${symbol})
            _restir_compile(${target}
                SOURCE ${source} HEADER ${out}/${symbol}.h SYMBOL ${symbol} STAGE ${stage}
                FLAGS -I${rays_dir} -I${bridge} ${includes} ${define_${stage}})
            string(APPEND pack_includes "#include \"${symbol}.h\"\n")
        endforeach()
        if(backend STREQUAL PIPELINE)
            foreach(shader miss.rmiss closest_hit.rchit any_hit.rahit)
                string(REGEX MATCH "^[^.]+" name ${shader})
                string(REGEX MATCH "[^.]+$" stage ${shader})
                set(symbol rays_${name})
                string(APPEND rows "    {\"rays.${name}\", ${symbol}, sizeof ${symbol} / sizeof(uint32_t)},\n")
                _restir_compile(${target}
                    SOURCE ${rays_dir}/${shader}.glsl HEADER ${out}/${symbol}.h SYMBOL ${symbol} STAGE ${stage}
                    FLAGS -I${bridge} ${includes} -DRS_RAY_STAGE)
                string(APPEND pack_includes "#include \"${symbol}.h\"\n")
            endforeach()
        endif()
        string(REPLACE Ray "" short ${enumerator})
        string(APPEND packs "constexpr restir::ShaderPack::Module kEmbedded${short}Passes[] = {\n${rows}};\n"
            "constexpr restir::ShaderPack kEmbedded${short}Pack{RESTIR_SHADER_ABI, kEmbedded${short}Passes, restir::RayBackend::${enumerator}};\n")
        if(NOT DEFINED first)
            set(first ${short})
        endif()
    endforeach()
    file(CONFIGURE OUTPUT ${out}/restir_embedded.h @ONLY CONTENT [[
// Generated by restir_compile_passes().
#pragma once
#include <restir/context.h>
@pack_includes@
@packs@
static constexpr const restir::ShaderPack& kEmbeddedPack = kEmbedded@first@Pack;
]])
    target_include_directories(${target} PRIVATE ${out})
endfunction()

function(restir_compile_shaders target)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "VARIANT;STAGE" "SHADERS;INCLUDES;DEFINES")
    _restir_shader_dirs(includes shader_root)
    list(TRANSFORM arg_INCLUDES PREPEND -I)
    list(TRANSFORM arg_DEFINES PREPEND -D)
    set(out ${CMAKE_CURRENT_BINARY_DIR}/${target}_shaders)
    file(MAKE_DIRECTORY ${out})
    foreach(shader IN LISTS arg_SHADERS)
        get_filename_component(source ${shader} ABSOLUTE)
        get_filename_component(name ${shader} NAME_WE)
        set(stage comp)
        if(shader MATCHES "\\.(vert|frag|comp|rgen|rmiss|rchit|rahit)\\.glsl$")
            set(stage ${CMAKE_MATCH_1})
        endif()
        if(arg_STAGE)
            set(stage ${arg_STAGE})
        endif()
        if(arg_VARIANT)
            string(APPEND name _${arg_VARIANT})
        endif()
        _restir_compile(${target}
            SOURCE ${source} HEADER ${out}/${name}.spv.h SYMBOL k_${name}_spv STAGE ${stage}
            FLAGS -I${shader_root}/standard ${includes} ${arg_INCLUDES} ${arg_DEFINES})
    endforeach()
    target_include_directories(${target} PRIVATE ${out})
endfunction()
