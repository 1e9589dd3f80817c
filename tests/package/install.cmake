function(run)
    execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# One after the other in one tree: the shaders are the same, and take longer than the library.
foreach(kind static shared)
    string(COMPARE EQUAL ${kind} shared is_shared)
    set(prefix ${WORK}/${kind})
    run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G ${GENERATOR} ${TOOLCHAIN} -DCMAKE_BUILD_TYPE=Release
        -DBUILD_SHARED_LIBS=${is_shared} -DRESTIR_SAMPLES=OFF -DRESTIR_TESTS=OFF)
    run(${CMAKE_COMMAND} --build ${WORK}/build)

    file(REMOVE_RECURSE ${prefix})
    run(${CMAKE_COMMAND} --install ${WORK}/build --prefix ${prefix}/installed)
    file(RENAME ${prefix}/installed ${prefix}/moved)

    file(GLOB_RECURSE package_files ${prefix}/moved/*.cmake ${prefix}/moved/*.pc)
    foreach(package_file IN LISTS package_files)
        file(READ ${package_file} text)
        string(FIND "${text}" ${WORK} at)
        if(at GREATER -1)
            message(FATAL_ERROR "${package_file} names a directory of the machine it was made on")
        endif()
    endforeach()
endforeach()
