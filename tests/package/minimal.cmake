# A stranger's evening: samples/minimal copied out of the tree, built against the installed package with two commands and
# run under the validation layer. cmake -DSOURCE= -DWORK= -DPREFIX= -DGENERATOR= -DTOOLCHAIN= -P minimal.cmake
file(REMOVE_RECURSE ${WORK})
file(COPY ${SOURCE}/samples/minimal DESTINATION ${WORK})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${WORK}/minimal -B ${WORK}/build -G ${GENERATOR} ${TOOLCHAIN}
    -Drestir_ROOT=${PREFIX} -DCMAKE_BUILD_TYPE=Release COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK}/build COMMAND_ERROR_IS_FATAL ANY)

set(ENV{VK_INSTANCE_LAYERS} VK_LAYER_KHRONOS_validation)
set(ENV{VK_LAYER_ENABLES} VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT)
execute_process(COMMAND ${WORK}/build/minimal ${WORK}/minimal.ppm
    OUTPUT_VARIABLE said ERROR_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
if(said)
    message(FATAL_ERROR "it should have been silent: ${said}")
endif()
file(SIZE ${WORK}/minimal.ppm bytes)
file(READ ${WORK}/minimal.ppm texels OFFSET 200000 LIMIT 90000 HEX)
string(REGEX MATCHALL "[8-f]." bright "${texels}")
list(LENGTH bright count)
if(NOT bytes EQUAL 388815 OR count LESS 1000)
    message(FATAL_ERROR "the picture has ${bytes} bytes, and ${count} bright values in its middle")
endif()
