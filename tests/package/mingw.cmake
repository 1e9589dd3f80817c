# The library as a DLL and a program that links it, for Windows by mingw-w64.
# cmake -DSOURCE= -DWORK= -DCOMPILER= -DGENERATOR= -DVULKAN=<include dir> -DGLM=<include dir> -P mingw.cmake
function(run)
    execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Headers that belong to no system, away from this system's own.
foreach(headers ${VULKAN}/vulkan ${VULKAN}/vk_video ${GLM}/glm)
    file(COPY ${headers} DESTINATION ${WORK}/include)
endforeach()
file(WRITE ${WORK}/glm/glmConfig.cmake "add_library(glm::glm INTERFACE IMPORTED)\n
set_target_properties(glm::glm PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${WORK}/include)\n")
file(WRITE ${WORK}/consumer/CMakeLists.txt "cmake_minimum_required(VERSION 3.22)\nproject(consumer LANGUAGES CXX)
add_subdirectory(${SOURCE} restir)\nadd_executable(consumer ${SOURCE}/tests/package/consumer.cpp)
target_link_libraries(consumer PRIVATE restir::restir)\n")
run(${CMAKE_COMMAND} -S ${WORK}/consumer -B ${WORK}/build -G ${GENERATOR} -DCMAKE_BUILD_TYPE=Release -DCMAKE_SYSTEM_NAME=Windows
    -DCMAKE_CXX_COMPILER=${COMPILER} -DBUILD_SHARED_LIBS=ON -DRESTIR_WERROR=ON -Dglm_DIR=${WORK}/glm
    -DCMAKE_DISABLE_FIND_PACKAGE_VulkanHeaders=ON -DVulkan_INCLUDE_DIR=${WORK}/include -DVulkan_LIBRARY=unused)
run(${CMAKE_COMMAND} --build ${WORK}/build)
