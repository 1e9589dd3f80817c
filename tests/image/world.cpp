#include "image/world.h"

#include <cstdlib>
#include <filesystem>

namespace tests {

samples::Device& device() {
    static samples::Device device({.validate = true});
    return device;
}

World::World(samples::SceneData scene, VkExtent2D extent, const samples::LightingDesc& lighting)
    : extent_(extent), lighting_(lighting) {
    view_ = scene.views.empty() ? samples::frameScene(scene) : scene.views[0];
    scene_ = std::make_unique<samples::GpuScene>(device(), std::move(scene));
}

samples::Renderer& World::renderer() {
    if (!renderer_) {
        const restir::SessionDesc session{.pairedNeighbours = 16, .indirect = true};
        renderer_ = std::make_unique<samples::Renderer>(device(), *scene_, extent_, session, lighting_);
    }
    return *renderer_;
}

samples::FloatImage World::render(const samples::Sequence& sequence, const restir::Settings& settings) {
    return renderer().render(sequence, settings);
}

samples::FloatImage World::reference(const samples::Sequence& sequence, const samples::ReferenceSettings& settings) {
    if (!reference_) reference_ = std::make_unique<samples::Reference>(device(), *scene_, extent_);
    return reference_->render(sequence, settings);
}

SeedStatistics World::seeds(uint32_t count, samples::Sequence sequence, const restir::Settings& settings,
                            const std::vector<bool>& leftOut) {
    SeedStatistics statistics(leftOut);
    for (sequence.seed = 1; sequence.seed <= count; ++sequence.seed) statistics.add(render(sequence, settings));
    return statistics;
}

SeedStatistics World::referenceSeeds(uint32_t count, samples::Sequence sequence,
                                     const samples::ReferenceSettings& settings, const std::vector<bool>& leftOut) {
    SeedStatistics statistics(leftOut);
    for (sequence.seed = 1; sequence.seed <= count; ++sequence.seed) statistics.add(reference(sequence, settings));
    return statistics;
}

std::vector<bool> emitterBlocks(const samples::SceneData& scene, VkExtent2D extent, const samples::View& view) {
    samples::SceneData black = scene;
    samples::makeLambert(black);
    for (auto& material : black.materials) material.baseColor = {0, 0, 0, 1};
    World world(std::move(black), extent);
    const samples::FloatImage image =
        world.reference({.view = view, .frames = 8, .accumulate = true}, {.paths = 8});
    std::vector<bool> leftOut;
    for (const auto& mean : blocksOf(image).mean) leftOut.push_back(luminance(mean) > 0);
    return leftOut;
}

restir::Settings unbiased() {
    restir::Settings settings;
    settings.di.weights = restir::Weights::Pairwise;
    settings.di.visibility = restir::VisibilityReuse::Traced;
    return settings;
}

std::string sharedScene(const std::string& name) {
    const char* root = std::getenv("RESTIR_SHARED_SCENES");
    const std::filesystem::path path = std::filesystem::path(root ? root : RESTIR_SHARED_SCENES) / name;
    return std::filesystem::exists(path) ? path.string() : std::string();
}

}   // namespace tests
