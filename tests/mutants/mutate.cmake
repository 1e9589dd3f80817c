# cmake -DSPEC=<file> -P mutate.cmake
# Writes a shader with a mistake planted. SPEC sets name, mistake, file, source, target and edits, and find_<i> and
# replace_<i> for each edit.
include(${SPEC})
file(READ "${source}" text)
math(EXPR last "${edits} - 1")
foreach(i RANGE ${last})
    string(FIND "${text}" "${find_${i}}" first)
    string(FIND "${text}" "${find_${i}}" final REVERSE)
    if(NOT first EQUAL final OR first EQUAL -1)
        set(times "is not there")
        if(NOT first EQUAL -1)
            set(times "is there more than once")
        endif()
        message(FATAL_ERROR "\nPlanted bug '${name}' no longer fits shaders/${file}: the text\n\n"
            "${find_${i}}\n\n${times}. The tests plant this mistake to see that they would notice it: ${mistake}.\n"
            "If you changed the shader: in tests/mutants/mutations.cmake give '${name}' the new text, and a replacement "
            "that makes the same mistake in it; then build again and run image_tests --gtest_filter=*Mutants*. "
            "Only if the mistake can no longer be made, remove it there and from tests/image/mutants_test.cpp.\n")
    endif()
    string(REPLACE "${find_${i}}" "${replace_${i}}" text "${text}")
endforeach()
file(WRITE "${target}" "${text}")
