#include "viewer/live_shaders.h"

#include <algorithm>
#include <stdexcept>

#ifdef VIEWER_COMPILES
#include <restir/compiler.h>
#endif

namespace viewer {
namespace {

namespace fs = std::filesystem;

constexpr auto kPause = std::chrono::milliseconds(250);   // between looks

}   // namespace

#ifdef VIEWER_COMPILES

struct LiveShaders::Compiled {
    restir::CompiledPack pack;
};

std::unique_ptr<LiveShaders::Compiled> LiveShaders::compile(restir::RayBackend rays) const {
    std::string said;
    const auto hear = [](void* to, restir::Severity, const char* text) {
        (*static_cast<std::string*>(to) += text) += '\n';
    };
    auto pack = restir::compilePasses({.includeDirectory = VIEWER_INCLUDES,
                                       .shaderDirectory = VIEWER_SHADERS,
                                       .bridgeDirectory = bridge_.c_str(),
                                       .rays = rays,
                                       .messages = {&said, hear}});
    if (!pack) throw std::runtime_error(said.substr(0, said.find_last_not_of('\n') + 1));
    return std::make_unique<Compiled>(Compiled{std::move(*pack)});
}

const restir::ShaderPack& LiveShaders::pack() const { return compiled_->pack.pack(); }

// Of all shaders that the passes may include.
fs::file_time_type LiveShaders::newest() const {
    fs::file_time_type newest = fs::file_time_type::min();
    for (const fs::path& root :
         {fs::path(bridge_), fs::path(VIEWER_SHADERS), fs::path(VIEWER_INCLUDES) / "restir/shared"}) {
        std::error_code error;
        for (fs::recursive_directory_iterator file(root, error), end; !error && file != end;
             file.increment(error)) {
            std::error_code gone;   // an editor may be at work
            const fs::file_time_type time = fs::last_write_time(file->path(), gone);
            if (!gone) newest = std::max(newest, time);
        }
    }
    return newest;
}

#else

struct LiveShaders::Compiled {
    restir::ShaderPack pack;
};
std::unique_ptr<LiveShaders::Compiled> LiveShaders::compile(restir::RayBackend) const {
    throw std::runtime_error(
        "--bridge: this viewer was built without restir::compiler (Debian: glslang-dev spirv-tools)");
}
const restir::ShaderPack& LiveShaders::pack() const { return compiled_->pack; }
fs::file_time_type LiveShaders::newest() const { return {}; }

#endif

LiveShaders::LiveShaders(std::string bridge, restir::RayBackend rays)
    : bridge_(std::move(bridge)),
      rays_(rays),
      seen_(newest()),
      looked_(std::chrono::steady_clock::now()),
      compiled_(compile(rays)) {}
LiveShaders::~LiveShaders() = default;

bool LiveShaders::poll() {
    const auto now = std::chrono::steady_clock::now();
    if (now - looked_ < kPause) return false;
    looked_ = now;
    const fs::file_time_type changed = newest();
    if (changed == seen_) return false;
    seen_ = changed;   // whatever becomes of it: the next change is another try
    compiled_ = compile(rays_);
    return true;
}

void LiveShaders::traceBy(restir::RayBackend rays, const std::function<void()>& adopt) {
    auto last = std::exchange(compiled_, compile(rays));
    try {
        adopt();
    } catch (...) {
        compiled_ = std::move(last);
        throw;
    }
    rays_ = rays;
}

}   // namespace viewer
