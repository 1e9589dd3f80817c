function(run)
    execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(shared_static OFF)
set(shared_shared ON)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G ${GENERATOR} ${TOOLCHAIN} -DCMAKE_BUILD_TYPE=Release
    -DBUILD_SHARED_LIBS=${shared_${KIND}} -DRESTIR_SAMPLES=OFF -DRESTIR_TESTS=OFF)
run(${CMAKE_COMMAND} --build ${WORK}/build)

file(REMOVE_RECURSE ${WORK}/installed ${WORK}/moved)
run(${CMAKE_COMMAND} --install ${WORK}/build --prefix ${WORK}/installed)
file(RENAME ${WORK}/installed ${WORK}/moved)

file(GLOB_RECURSE package_files ${WORK}/moved/*.cmake ${WORK}/moved/*.pc)
foreach(package_file IN LISTS package_files)
    file(READ ${package_file} text)
    string(FIND "${text}" ${WORK} at)
    if(at GREATER -1)
        message(FATAL_ERROR "${package_file} names a directory of the machine it was made on")
    endif()
endforeach()
