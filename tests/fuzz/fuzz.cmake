# Each target under libFuzzer for a while: cmake -DSOURCE= -DWORK= -DTARGETS=frame,lights,gltf -DSECONDS=<each> -P fuzz.cmake
string(REPLACE , ";" TARGETS ${TARGETS})
function(run)
    execute_process(COMMAND ${ARGV} WORKING_DIRECTORY ${SOURCE} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

find_program(CLANGXX clang++)
file(WRITE ${WORK}/empty.cpp "extern \"C\" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }\n")
set(result 1)
if(CLANGXX)
    execute_process(COMMAND ${CLANGXX} -fsanitize=fuzzer,address ${WORK}/empty.cpp -o ${WORK}/empty RESULT_VARIABLE result ERROR_QUIET)
endif()
if(result)
    message("fuzzing is skipped: there is no clang++ with libFuzzer (Debian: clang libclang-rt-14-dev)")
    return()
endif()

list(TRANSFORM TARGETS PREPEND fuzz_ OUTPUT_VARIABLE programs)
run(${CMAKE_COMMAND} --preset fuzz -B ${WORK}/build)
run(${CMAKE_COMMAND} --build ${WORK}/build --target ${programs})
foreach(target IN LISTS TARGETS)
    file(MAKE_DIRECTORY ${WORK}/corpus/${target})
    execute_process(
        COMMAND ${WORK}/build/tests/fuzz/fuzz_${target} ${WORK}/corpus/${target} -max_total_time=${SECONDS} -max_len=2048
            -timeout=20 -rss_limit_mb=4000 -print_final_stats=1 -artifact_prefix=${WORK}/${target}-
        RESULT_VARIABLE result ERROR_VARIABLE said)
    string(REGEX MATCH "number_of_executed_units: ([0-9]+)" executions "${said}")
    message("${target}: ${CMAKE_MATCH_1} executions")
    if(result)
        message(FATAL_ERROR "${said}\n${target}: ended with ${result}; the input is ${WORK}/${target}-*")
    endif()
endforeach()
