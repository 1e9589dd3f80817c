#include <compiler/glsl.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <string_view>

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

namespace restir {
namespace {

namespace fs = std::filesystem;

bool readFile(const fs::path& file, std::string& text) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return false;
    std::ifstream stream(file, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(stream), {});
    return stream.good();
}

// Beside the file that includes, then in the directories in their order: as glslangValidator with -I.
class Includer : public glslang::TShader::Includer {
public:
    explicit Includer(std::span<const fs::path> directories) : directories_(directories) {}

    IncludeResult* includeLocal(const char* name, const char* from, size_t depth) override {
        constexpr size_t kDeepest = 100;   // a file that includes itself would go on for ever
        static constexpr std::string_view kTooDeep = "included too deeply";
        if (depth > kDeepest) return new IncludeResult("", kTooDeep.data(), kTooDeep.size(), nullptr);
        auto text = std::make_unique<std::string>();
        fs::path found = fs::path(from).parent_path() / name;
        for (auto next = directories_.begin(); !readFile(found, *text); ++next) {
            if (next == directories_.end()) return nullptr;
            found = *next / name;
        }
        const std::string* kept = text.release();
        return new IncludeResult(found.string(), kept->data(), kept->size(), const_cast<std::string*>(kept));
    }
    void releaseInclude(IncludeResult* result) override {
        if (result) delete static_cast<std::string*>(result->userData);
        delete result;
    }

private:
    std::span<const fs::path> directories_;
};

EShLanguage languageOf(VkShaderStageFlagBits stage) {
    switch (stage) {
        case VK_SHADER_STAGE_RAYGEN_BIT_KHR: return EShLangRayGen;
        case VK_SHADER_STAGE_MISS_BIT_KHR: return EShLangMiss;
        case VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR: return EShLangClosestHit;
        case VK_SHADER_STAGE_ANY_HIT_BIT_KHR: return EShLangAnyHit;
        default: return EShLangCompute;
    }
}

}   // namespace

Glslang::Glslang() { glslang::InitializeProcess(); }
Glslang::~Glslang() { glslang::FinalizeProcess(); }

std::vector<uint32_t> compileGlsl(const GlslJob& job, std::string& log) {
    std::string text;
    const std::string name = job.file.string();
    if (!readFile(job.file, text)) {
        log = "ERROR: " + name + ":0: cannot be read\n";
        return {};
    }
    const EShLanguage stage = languageOf(job.stage);
    const auto rules = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    const char *source = text.data(), *sourceName = name.c_str();
    const int length = static_cast<int>(text.size());
    glslang::TShader shader(stage);
    shader.setStringsWithLengthsAndNames(&source, &length, &sourceName, 1);
    shader.setPreamble(job.preamble.c_str());
    shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
    Includer includer(job.includes);
    const bool parsed = shader.parse(GetDefaultResources(), 100, ENoProfile, false, false, rules, includer);
    log += shader.getInfoLog();
    if (!parsed) return {};

    glslang::TProgram program;
    program.addShader(&shader);
    const bool linked = program.link(rules) && program.mapIO();
    log += program.getInfoLog();
    std::vector<uint32_t> words;
    if (linked) glslang::GlslangToSpv(*program.getIntermediate(stage), words);
    return words;
}

}   // namespace restir
