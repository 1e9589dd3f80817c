// A small host that drives the SDK itself, frame by frame: four frame slots with a target each.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include <common/gbuffer.h>
#include <common/gpu_scene.h>
#include <common/image_io.h>
#include <restir/restir.h>

namespace tests {

struct HostDesc {
    VkExtent2D maxExtent{32, 32};
    uint32_t maxLights = 0;   // 0: as many as the scene has
    restir::MemoryProvider memory = {};
    uint32_t rayLogCapacity = 0;
    bool allOutputs = false;   // else radiance alone
    uint32_t pairedNeighbours = 0;
    bool indirect = false;
    const restir::ShaderPack* shaders = nullptr;   // null: the library's
    std::optional<restir::RayBackend> rays;   // unset: of the shaders, else the best of the device
    std::shared_ptr<restir::Context> context = nullptr;   // instead of one of its own: another view's, with its pipelines
};

// The images of restir::Output.
enum class Target : uint8_t {
    Radiance,
    Diffuse,
    Specular,
    Gradient,
    Debug,
    IndirectDiffuse,
    IndirectSpecular,
    Count
};

class HostView {
public:
    static constexpr uint32_t kSlots = 4;

    // Uploads the scene's lights. The scene outlives it.
    HostView(const samples::GpuScene& scene, const samples::View& view, const HostDesc& desc);
    ~HostView();

    static restir::ContextDesc contextDesc();

    // The camera of the next input(), now; the one before is where motion comes from.
    void look(const samples::View& view);
    // Replaces the lights, now.
    void upload(std::span<const restir::Light> lights);
    // The G-buffer of another extent, from the next input() on.
    void resize(VkExtent2D extent);

    // A whole frame as frame `index` of a sequence would have it, but for the lobes of indirect light.
    restir::FrameInput input(uint32_t index) const;
    // With what the target needs around it.
    void record(VkCommandBuffer cmd, const restir::FrameInput& input, const restir::Settings& settings) {
        record(cmd, *session_, input, settings);
    }
    void record(VkCommandBuffer cmd, restir::Session& session, const restir::FrameInput& input,
                const restir::Settings& settings);
    // What the target needs around passes that someone else records.
    void around(VkCommandBuffer cmd, const restir::FrameInput& input, const std::function<void()>& passes);
    samples::FloatImage read(uint32_t slot) const;                         // once the GPU is done
    std::span<const glm::vec4> read(uint32_t slot, Target target) const;   // HostDesc::allOutputs

    // Asks for the lobes of indirect light, too. HostDesc::allOutputs
    void addIndirectLobes(restir::FrameInput& input) const;

    samples::FloatImage frame(const restir::FrameInput& input, const restir::Settings& settings);
    // `count` frames from `first` on; the last one's picture.
    samples::FloatImage frames(uint32_t first, uint32_t count, const restir::Settings& settings,
                               uint32_t seed = 0);

    restir::Session& session() { return *session_; }
    restir::LightTable& lights() { return *lights_; }
    restir::Bvh* bvh() { return bvh_.get(); }   // of the scene at rest; RayBackend::Software
    const restir::Context& context() const { return *context_; }
    std::shared_ptr<restir::Context> sharedContext() const { return context_; }
    void newSession();

private:
    void makeBvh();

    const samples::GpuScene& scene_;
    samples::View view_;
    HostDesc desc_;
    VkExtent2D extent_;
    std::vector<std::unique_ptr<samples::GBufferPass>> gbuffers_;   // the last one counts
    size_t targetCount() const { return desc_.allOutputs ? size_t(Target::Count) : 1; }

    std::array<samples::GpuImage, size_t(Target::Count)> targets_[kSlots];
    std::array<samples::Buffer, size_t(Target::Count)> readbacks_[kSlots];
    std::array<VkExtent2D, kSlots> extents_{};   // of the frames read back
    std::shared_ptr<restir::Context> context_;
    std::unique_ptr<restir::Scene> sdkScene_;
    std::unique_ptr<restir::LightTable> lights_;
    std::unique_ptr<restir::Bvh> bvh_;
    std::unique_ptr<restir::Session> session_;
};

// An image of four floats a pixel, written by the CPU.
samples::GpuImage floatImage(VkExtent2D extent, const std::vector<glm::vec4>& texels);

}   // namespace tests
