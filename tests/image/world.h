// One device for the whole program, and scenes rendered on it.
#pragma once

#include <memory>
#include <string>

#include <common/gpu_scene.h>
#include <common/prepare_scene.h>
#include <common/reference.h>
#include <common/renderer.h>
#include <proof/block_statistics.h>

namespace tests {

using namespace proof;   // the statistics

samples::Device& device();   // validation on: every test ends with noMessages()

class World {
public:
    World(samples::SceneData scene, VkExtent2D extent, const samples::LightingDesc& lighting = {});

    samples::FloatImage render(const samples::Sequence& sequence, const restir::Settings& settings);
    samples::FloatImage reference(const samples::Sequence& sequence, const samples::ReferenceSettings& settings);

    // Independent sequences with seeds 1 .. count.
    SeedStatistics seeds(uint32_t count, samples::Sequence sequence, const restir::Settings& settings,
                         const std::vector<bool>& leftOut = {});
    SeedStatistics referenceSeeds(uint32_t count, samples::Sequence sequence, const samples::ReferenceSettings& settings,
                                  const std::vector<bool>& leftOut = {});

    const samples::View& view() const { return view_; }
    samples::Renderer& renderer();

private:
    VkExtent2D extent_;
    samples::LightingDesc lighting_;
    samples::View view_;
    std::unique_ptr<samples::GpuScene> scene_;
    std::unique_ptr<samples::Renderer> renderer_;
    std::unique_ptr<samples::Reference> reference_;
};

// Blocks in which an emitter is seen: their own light would hide what they receive.
std::vector<bool> emitterBlocks(const samples::SceneData& scene, VkExtent2D extent, const samples::View& view);

// Direct light with every kind of reuse: pairwise weights, traced visibility.
restir::Settings unbiased();

// A file of ../shared/scenes, empty where that directory is missing.
std::string sharedScene(const std::string& name);

}   // namespace tests
