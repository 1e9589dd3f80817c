#include "proof/prover.h"

#include <algorithm>
#include <cmath>

namespace proof {
namespace {

constexpr float kColorSteps = 1023, kGlossSteps = 255;

samples::SceneData blackened(samples::SceneData scene) {
    samples::makeLambert(scene);
    for (auto& material : scene.materials) material.baseColor = {0, 0, 0, 1};
    return scene;
}

// The mean of a sequence's frames from `first` on, and the last two. Static references have a single frame.
class Collector {
public:
    Collector(VkExtent2D extent, const std::vector<std::vector<bool>>& masks, uint32_t first)
        : masks_(masks), first_(first), sum_(size_t{extent.width} * extent.height * 3, 0.0) {
        take_.mean = take_.end.before = take_.end.last = {extent.width, extent.height, {}};
    }

    void operator()(uint32_t index, std::span<const float> rgba) {
        if (index < first_) return;
        const std::vector<bool>& mask = masks_[std::min<size_t>(index - first_, masks_.size() - 1)];
        samples::FloatImage& last = take_.end.last;
        std::swap(take_.end.before.rgb, last.rgb);
        last.rgb.resize(sum_.size());
        for (size_t i = 0; i < sum_.size(); ++i) {
            last.rgb[i] = mask[i / 3] ? 0 : rgba[i / 3 * 4 + i % 3];
            sum_[i] += double(last.rgb[i]);
        }
        ++count_;
    }

    Take finish() {
        take_.mean.rgb.reserve(sum_.size());
        for (double value : sum_) take_.mean.rgb.push_back(float(value / count_));
        if (count_ == 1) take_.end.before = take_.end.last;
        return std::move(take_);
    }

private:
    const std::vector<std::vector<bool>>& masks_;
    uint32_t first_, count_ = 0;
    std::vector<double> sum_;
    Take take_;
};

}   // namespace

void roundMaterials(samples::SceneData& scene) {
    const auto gloss = [](float& value) { value = std::round(value * kGlossSteps) / kGlossSteps; };
    for (auto& material : scene.materials) {
        for (float* channel : {&material.baseColor.x, &material.baseColor.y, &material.baseColor.z}) {
            const float root = std::round(std::sqrt(*channel) * kColorSteps) / kColorSteps;
            *channel = root * root;
        }
        gloss(material.roughness);
        gloss(material.metalness);
        gloss(material.specular);
    }
}

Prover::Prover(samples::Device& device, samples::SceneData scene, VkExtent2D extent,
               const restir::SessionDesc& session, const samples::LightingDesc& lighting)
    : device_(device), extent_(extent), black_(blackened(scene)) {
    roundMaterials(scene);
    view_ = scene.views.empty() ? samples::frameScene(scene) : scene.views[0];
    scene_ = std::make_unique<samples::GpuScene>(device, std::move(scene));
    renderer_ = std::make_unique<samples::Renderer>(device, *scene_, extent, session, lighting);
    reference_ = std::make_unique<samples::Reference>(device, *scene_, extent);
}

samples::Sequence Prover::sequenceOf(const Scenario& scenario, uint32_t seed, bool once) const {
    samples::Sequence sequence{.view = view_,
                               .frames = scenario.frames,
                               .seed = seed,
                               .accumulate = true,
                               .skip = once && !scenario.changes() ? scenario.frames - 1 : scenario.warmUp,
                               .jitter = false,
                               .orbitDegrees = scenario.orbitDegrees};
    if (!scenario.animation.empty()) sequence.motion = samples::findMotion(black_, scenario.animation);
    return sequence;
}

const Prover::Masks& Prover::masks(const Scenario& scenario) {
    Masks& masks = masks_[scenario.name];
    if (!masks.empty()) return masks;
    samples::GpuScene scene(device_, black_);
    samples::Reference emission(device_, scene, extent_);
    samples::Sequence sequence = sequenceOf(scenario, 0, true);
    sequence.eachFrame = [&](uint32_t, std::span<const float> rgba) {
        std::vector<bool> mask;
        for (size_t i = 0; i < rgba.size(); i += 4) mask.push_back(rgba[i] + rgba[i + 1] + rgba[i + 2] > 0);
        masks.push_back(std::move(mask));
    };
    emission.render(sequence, {.bounces = 0});
    return masks;
}

template <class Render>
Take Prover::take(const Scenario& scenario, samples::Sequence sequence, const Render& render) {
    Collector collector(extent_, masks(scenario), sequence.skip);
    sequence.eachFrame = std::ref(collector);
    render(sequence);
    return collector.finish();
}

Take Prover::estimate(const Scenario& scenario, const restir::Settings& settings, uint32_t seed) {
    return take(scenario, sequenceOf(scenario, seed, false),
                [&](const samples::Sequence& sequence) { renderer_->render(sequence, settings); });
}

Take Prover::reference(const Scenario& scenario, const Transport& transport, uint32_t paths, uint32_t seed) {
    const samples::ReferenceSettings settings{
        .paths = paths, .bounces = transport.bounces, .direct = transport.direct};
    return take(scenario, sequenceOf(scenario, seed, true),
                [&](const samples::Sequence& sequence) { reference_->render(sequence, settings); });
}

}   // namespace proof
