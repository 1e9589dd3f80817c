// The library's passes with a bridge of the user's, compiled anew whenever one of their files changes.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include <restir/context.h>

namespace viewer {

class LiveShaders {
public:
    // The directory of a restir_bridge.glsl. Throws std::runtime_error if the passes do not compile with it,
    // or if the viewer was built without restir::compiler.
    LiveShaders(std::string bridge, restir::RayBackend rays);
    ~LiveShaders();
    LiveShaders(const LiveShaders&) = delete;
    LiveShaders& operator=(const LiveShaders&) = delete;

    // Looks for changes, a few times a second. True: there is another pack(). Throws std::runtime_error with
    // the compiler's words where there should be one; the last stays.
    bool poll();
    // Compiles for another ray backend, for what `adopt` does with pack(). Throws as poll() or as that; the last stays.
    void traceBy(restir::RayBackend rays, const std::function<void()>& adopt);
    const restir::ShaderPack& pack() const;

private:
    struct Compiled;
    std::unique_ptr<Compiled> compile(restir::RayBackend rays) const;
    std::filesystem::file_time_type newest() const;

    std::string bridge_;
    restir::RayBackend rays_;
    std::filesystem::file_time_type seen_;
    std::chrono::steady_clock::time_point looked_;
    std::unique_ptr<Compiled> compiled_;
};

}   // namespace viewer
