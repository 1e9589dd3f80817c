# The API reference, from the comments of the public headers: cmake --build <dir> --target restir_reference
find_program(RESTIR_DOXYGEN doxygen)
find_program(RESTIR_AWK awk)
if(RESTIR_DOXYGEN AND RESTIR_AWK AND PROJECT_IS_TOP_LEVEL)
    configure_file(cmake/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
    add_custom_target(restir_reference
        COMMAND ${RESTIR_DOXYGEN} ${PROJECT_BINARY_DIR}/Doxyfile
        COMMENT "reference/html/index.html" VERBATIM)
endif()
