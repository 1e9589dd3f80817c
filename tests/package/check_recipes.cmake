# cmake -DSOURCE=<dir> -DVERSION=<version> -P check_recipes.cmake: the recipes beside the code say what the code says.
file(READ ${SOURCE}/cmake/recipes/vcpkg.json vcpkg)
string(JSON version GET "${vcpkg}" version)
if(NOT version STREQUAL VERSION)
    message(FATAL_ERROR "vcpkg.json is of ${version}, include/restir/version.h of ${VERSION}")
endif()
find_program(PYTHON NAMES python3)
if(PYTHON)
    execute_process(COMMAND ${PYTHON} -c "import ast, sys; ast.parse(open(sys.argv[1]).read())" ${SOURCE}/cmake/recipes/conanfile.py
        COMMAND_ERROR_IS_FATAL ANY)
endif()
