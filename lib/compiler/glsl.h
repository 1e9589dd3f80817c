// One pass from GLSL to SPIR-V.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <vulkan/vulkan_core.h>

namespace restir {

// Once for all that is compiled; glslang counts them.
class Glslang {
public:
    Glslang();
    ~Glslang();
    Glslang(const Glslang&) = delete;
    Glslang& operator=(const Glslang&) = delete;
};

struct GlslJob {
    std::filesystem::path file;
    std::span<const std::filesystem::path> includes;   // the first that has a file wins
    std::string preamble;                              // definitions
    VkShaderStageFlagBits stage = VK_SHADER_STAGE_COMPUTE_BIT;
};

// Empty if the file does not compile. `log` gets what glslang says, a line each: ERROR: <file>:<line>:
// <message>.
std::vector<uint32_t> compileGlsl(const GlslJob& job, std::string& log);

}   // namespace restir
