#include <restir/compiler.h>

#include <algorithm>
#include <charconv>
#include <fstream>

#include <compiler/glsl.h>

namespace restir {
namespace {

namespace fs = std::filesystem;

void say(const MessageSink& sink, Severity severity, const std::string& text) {
    if (sink.report) sink.report(sink.user, severity, ("restir: " + text).c_str());
}

Error refuse(const MessageSink& sink, const std::string& text, const char* what) {
    say(sink, Severity::Error, text);
    return {Status::InvalidArgument, VK_SUCCESS, what};
}

// "ERROR: file:line: message" as "file:line: message".
void sayLog(const MessageSink& sink, const std::string& log, const std::string& pass) {
    for (size_t begin = 0; begin < log.size();) {
        const size_t end = std::min(log.find('\n', begin), log.size());
        std::string line = log.substr(begin, end - begin);
        begin = end + 1;
        const bool error = line.starts_with("ERROR: "), warning = line.starts_with("WARNING: ");
        if (error || warning) line.erase(0, line.find(' ') + 1);
        if (line.empty() || line.find("compilation errors.  No code generated") != std::string::npos)
            continue;
        line.append(" (").append(pass).append(")");
        say(sink, error ? Severity::Error : Severity::Warning, line);
    }
}

// The RESTIR_SHADER_ABI of the shaders, whichever headers this library was built with; 0 if there is none.
uint32_t shaderAbi(const fs::path& includes) {
    constexpr std::string_view kName = "#define RESTIR_SHADER_ABI ";
    std::ifstream file(includes / "restir/version.h");
    uint32_t abi = 0;
    for (std::string line; std::getline(file, line);)
        if (line.starts_with(kName))
            std::from_chars(line.data() + kName.size(), line.data() + line.size(), abi);
    return abi;
}

// "room.stage" of every passes/room/stage.glsl, as restir_compile_passes() finds them.
std::vector<std::string> findPasses(const fs::path& root) {
    std::vector<std::string> passes;
    std::error_code error;
    for (fs::directory_iterator room(root / "passes", error), end; !error && room != end;
         room.increment(error)) {
        std::error_code inner;
        for (fs::directory_iterator file(room->path(), inner); !inner && file != end; file.increment(inner))
            if (file->path().extension() == ".glsl")
                passes.push_back(room->path().filename().string() + "." + file->path().stem().string());
    }
    std::sort(passes.begin(), passes.end());
    return passes;
}

fs::path fileOf(const fs::path& root, std::string pass) {
    std::replace(pass.begin(), pass.end(), '.', '/');
    return root / "passes" / (pass + ".glsl");
}

// Of the backend's restir_rays.glsl.
fs::path raysOf(const CompileDesc& desc) {
    if (desc.rays == RayBackend::Own) return desc.raysDirectory ? desc.raysDirectory : "";
    const char* const directories[] = {"rays/query", "rays/pipeline", "rays/software"};
    return fs::path(desc.shaderDirectory) / directories[size_t(desc.rays)];
}

struct Job {
    std::string name;
    fs::path file;
    VkShaderStageFlagBits stage = VK_SHADER_STAGE_COMPUTE_BIT;
};

bool traces(const fs::path& pass) {
    std::ifstream file(pass);
    for (std::string line; std::getline(file, line);)
        if (line.find("define RS_PASS_RAYS") != std::string::npos) return true;
    return false;
}

// Passes, and with RayBackend::Pipeline the stages that those which trace share.
std::vector<Job> jobsOf(const CompileDesc& desc) {
    const fs::path root = desc.shaderDirectory;
    std::vector<std::string> names(desc.passes.begin(), desc.passes.end());
    if (names.empty()) names = findPasses(root);
    std::vector<Job> jobs;
    const bool stages = desc.rays == RayBackend::Pipeline;
    for (const std::string& name : names) {
        jobs.push_back({name, fileOf(root, name)});
        if (stages && traces(jobs.back().file)) jobs.back().stage = VK_SHADER_STAGE_RAYGEN_BIT_KHR;
    }
    if (stages) {
        const fs::path shared = raysOf(desc);
        jobs.push_back({"rays.miss", shared / "miss.rmiss.glsl", VK_SHADER_STAGE_MISS_BIT_KHR});
        jobs.push_back({"rays.closest_hit", shared / "closest_hit.rchit.glsl", VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR});
        jobs.push_back({"rays.any_hit", shared / "any_hit.rahit.glsl", VK_SHADER_STAGE_ANY_HIT_BIT_KHR});
    }
    return jobs;
}

// Null, or why nothing can be compiled.
const char* wrongWith(const CompileDesc& desc) {
    std::error_code error;
    const MessageSink& sink = desc.messages;
    const auto lacks = [&](const char* field, const char* directory, const char* file) {
        if (directory && fs::is_regular_file(fs::path(directory) / file, error)) return false;
        say(sink, Severity::Error,
            std::string("CompileDesc::") + field +
                (directory ? std::string(" ") + directory + " has no " + file : " is null"));
        return true;
    };
    if (lacks("includeDirectory", desc.includeDirectory, "restir/version.h"))
        return "CompileDesc::includeDirectory is not restir's";
    if (lacks("shaderDirectory", desc.shaderDirectory, "standard/restir_bridge.glsl"))
        return "CompileDesc::shaderDirectory is not restir's";
    if (desc.rays > RayBackend::Own) {
        say(sink, Severity::Error, "CompileDesc::rays is " + std::to_string(int(desc.rays)));
        return "CompileDesc::rays is no RayBackend";
    }
    if (desc.rays == RayBackend::Pipeline && lacks("shaderDirectory", desc.shaderDirectory, "rays/pipeline/any_hit.rahit.glsl"))
        return "CompileDesc::shaderDirectory is not restir's";
    if (desc.rays == RayBackend::Own && lacks("raysDirectory", desc.raysDirectory, "restir_rays.glsl"))
        return "CompileDesc::raysDirectory has no restir_rays.glsl";
    if (desc.bridgeDirectory && lacks("bridgeDirectory", desc.bridgeDirectory, "restir_bridge.glsl"))
        return "CompileDesc::bridgeDirectory has no restir_bridge.glsl";
    return nullptr;
}

}   // namespace

struct CompiledPack::Impl {
    std::vector<Job> jobs;
    std::vector<std::vector<uint32_t>> words;
    std::vector<ShaderPack::Module> modules;
    ShaderPack pack;
};

CompiledPack::CompiledPack(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
CompiledPack::CompiledPack(CompiledPack&&) noexcept = default;
CompiledPack& CompiledPack::operator=(CompiledPack&&) noexcept = default;
CompiledPack::~CompiledPack() = default;

const ShaderPack& CompiledPack::pack() const noexcept { return impl_->pack; }

Result<CompiledPack> compilePasses(const CompileDesc& desc) noexcept {
    if (const char* wrong = wrongWith(desc)) return Error{Status::InvalidArgument, VK_SUCCESS, wrong};
    const fs::path root = desc.shaderDirectory;
    const fs::path bridge = desc.bridgeDirectory ? fs::path(desc.bridgeDirectory) : root / "standard";
    const std::vector<fs::path> includes = {raysOf(desc), bridge, desc.includeDirectory, root};
    const Glslang glslang;
    auto impl = std::make_unique<CompiledPack::Impl>();
    impl->jobs = jobsOf(desc);
    for (const Job& job : impl->jobs) {
        std::error_code error;
        if (!fs::is_regular_file(job.file, error))
            return refuse(desc.messages, "CompileDesc::passes: " + job.name + ": there is no " + job.file.string(),
                          "an unknown pass");
        std::string log;
        const char* preamble = job.stage == VK_SHADER_STAGE_COMPUTE_BIT ? "" : "#define RS_RAY_STAGE\n";
        impl->words.push_back(
            compileGlsl({.file = job.file, .includes = includes, .preamble = preamble, .stage = job.stage}, log));
        sayLog(desc.messages, log, job.name);
        if (impl->words.back().empty())
            return Error{Status::InvalidArgument, VK_SUCCESS, "a pass does not compile"};
    }
    for (size_t i = 0; i < impl->jobs.size(); ++i)
        impl->modules.push_back({.pass = impl->jobs[i].name.c_str(),
                                 .words = impl->words[i].data(),
                                 .wordCount = impl->words[i].size(),
                                 .traces = impl->jobs[i].stage == VK_SHADER_STAGE_RAYGEN_BIT_KHR});
    impl->pack = {.shaderAbi = shaderAbi(desc.includeDirectory), .modules = impl->modules, .rays = desc.rays};
    return CompiledPack(std::move(impl));
}

}   // namespace restir
