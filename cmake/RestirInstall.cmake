include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/restir)
set(shader_dir ${CMAKE_INSTALL_DATADIR}/restir/shaders)

install(TARGETS restir restir_shaders EXPORT restir)
install(EXPORT restir NAMESPACE restir:: FILE restirTargets.cmake DESTINATION ${package_dir})
if(TARGET restir_compiler)
    install(TARGETS restir_compiler EXPORT restirCompiler)
    install(EXPORT restirCompiler NAMESPACE restir:: FILE restirCompilerTargets.cmake DESTINATION ${package_dir})
    install(FILES include/restir/compiler.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/restir)
endif()
install(DIRECTORY include/restir DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} PATTERN compiler.h EXCLUDE)
install(DIRECTORY shaders/ DESTINATION ${shader_dir} FILES_MATCHING PATTERN *.glsl)

configure_package_config_file(cmake/restirConfig.cmake.in ${PROJECT_BINARY_DIR}/restirConfig.cmake
    INSTALL_DESTINATION ${package_dir}
    PATH_VARS CMAKE_INSTALL_INCLUDEDIR shader_dir)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/restirConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/restirConfig.cmake ${PROJECT_BINARY_DIR}/restirConfigVersion.cmake
    cmake/RestirShaders.cmake DESTINATION ${package_dir})

set(pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH restir_pc_up /${pc_dir} /)
string(REGEX REPLACE "/$" "" restir_pc_up "${restir_pc_up}")
configure_file(cmake/restir.pc.in ${PROJECT_BINARY_DIR}/restir.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/restir.pc DESTINATION ${pc_dir})
