// A scene watched through independent sequences, by the SDK and by the reference path tracer. Pixels that see
// an emitter are black in both: its own light, which nobody estimates, would hide what others receive.
// Primary rays go through the pixels' middles.
#pragma once

#include <map>
#include <memory>

#include <common/gpu_scene.h>
#include <common/reference.h>
#include <common/renderer.h>

#include "proof/cell.h"

namespace proof {

class Prover {
public:
    // `session` declares what the settings to come need. This and the rest throw std::runtime_error.
    Prover(samples::Device& device, samples::SceneData scene, VkExtent2D extent,
           const restir::SessionDesc& session, const samples::LightingDesc& lighting = {});

    Take estimate(const Scenario& scenario, const restir::Settings& settings, uint32_t seed);
    // `paths` per pixel and picture. Where nothing changes it makes one picture for all frames.
    Take reference(const Scenario& scenario, const Transport& transport, uint32_t paths, uint32_t seed);

    VkExtent2D extent() const { return extent_; }

private:
    // Which pixels see an emitter, in each frame that counts; one for all where nothing changes.
    using Masks = std::vector<std::vector<bool>>;
    const Masks& masks(const Scenario& scenario);
    // The frames that count; `once`: where they are all the same, the last alone.
    samples::Sequence sequenceOf(const Scenario& scenario, uint32_t seed, bool once) const;
    template <class Render>
    Take take(const Scenario& scenario, samples::Sequence sequence, const Render& render);

    samples::Device& device_;
    VkExtent2D extent_;
    samples::SceneData black_;   // nothing of it reflects
    samples::View view_;
    std::unique_ptr<samples::GpuScene> scene_;
    std::unique_ptr<samples::Renderer> renderer_;
    std::unique_ptr<samples::Reference> reference_;
    std::map<std::string, Masks> masks_;
};

// Materials rounded to what the SDK's packed surfaces hold, so that packing does not count as bias.
void roundMaterials(samples::SceneData& scene);

}   // namespace proof
