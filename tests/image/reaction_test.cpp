// How soon a change shows. Every stored sample is validated in every frame: its target is that of this
// frame's lights, and a ray of this frame goes to it before it is shaded. So nothing of a light that went out
// or is hidden outlives it. One light is red and the other blue, so each colour tells of one light.
#include <gtest/gtest.h>

#include "image/host_view.h"
#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using restir::Light;
using restir::VisibilityReuse;
using restir::Weights;

constexpr VkExtent2D kExtent{32, 32};
constexpr uint32_t kBefore = 6;   // frames until the change
constexpr float kBlockerHeight = 0.95f, kBlockerHalf = 0.25f;

Light bulb(uint32_t id, glm::vec3 position, glm::vec3 intensity) {
    Light light{.id = id, .kind = restir::LightKind::Point};
    for (int c = 0; c < 3; ++c) {
        light.position[c] = position[c];
        light.emission[c] = intensity[c];
    }
    return light;
}

const glm::vec3 kRedPosition{0.1f, 1.6f, -0.2f};
const Light kRed = bulb(0, kRedPosition, {50, 0, 0});
const Light kBlue = bulb(1, {-0.8f, 1.2f, 0.9f}, {0, 0, 1});

samples::SceneData room(bool blocked) {
    samples::SceneData scene = planeScene();
    if (blocked)
        addQuad(scene, lamp({0, kBlockerHeight, -0.2f}, kBlockerHalf), {.color = {0, 0, 0}, .specular = 0});
    return scene;
}

struct Combination {
    std::string name;
    restir::Settings settings;
};
std::vector<Combination> combinations() {
    std::vector<Combination> all;
    for (auto [seen, visibility] :
         {std::pair("none", VisibilityReuse::None), std::pair("cached", VisibilityReuse::Cached),
          std::pair("traced", VisibilityReuse::Traced)}) {
        for (Weights weights : {Weights::Off, Weights::Basic, Weights::Balance, Weights::Pairwise, Weights::PairwisePlain}) {
            for (uint32_t passes : {0u, 1u}) {
                Combination c{std::string(seen) + ", weights " + std::to_string(int(weights)) +
                                  ", spatial passes " + std::to_string(passes),
                              {}};
                c.settings.di.visibility = visibility;
                c.settings.di.weights = weights;
                c.settings.di.spatialPasses = passes;
                c.settings.di.lightCandidates = 4;
                all.push_back(c);
            }
            all.push_back(all.back());
            all.back().name += ", fused";
            all.back().settings.di.fused = true;
        }
    }
    return all;
}

class Reaction : public testing::Test {
protected:
    Reaction()
        : open_(device(), room(false)),
          blocked_(device(), room(true)),
          view_(room(false).views[0]),
          host(open_, view_, {.maxExtent = kExtent, .maxLights = 2}) {
        auto made = restir::Scene::create(host.context(), {.instances = blocked_.instances(),
                                                           .materials = blocked_.materials(),
                                                           .textures = blocked_.textures()});
        blockedScene_ = std::make_unique<restir::Scene>(device().require(std::move(made), "Scene"));
    }

    samples::FloatImage frame(uint32_t index, uint32_t seed, bool blocked, const restir::Settings& settings) {
        restir::FrameInput input = host.input(index);
        input.seed = seed;
        input.resetHistory = index == 0;
        if (blocked) {
            input.tlas = blocked_.tlas();
            input.scene = blockedScene_.get();
        }
        return host.frame(input, settings);
    }
    // The red light's umbra on the plane: its pixels' mean in a channel.
    double meanInUmbra(const samples::FloatImage& image, size_t channel) const {
        const samples::CameraPose pose = samples::makePose(view_, kExtent);
        double sum = 0;
        uint32_t pixels = 0;
        for (uint32_t i = 0; i < kExtent.width * kExtent.height; ++i) {
            glm::dvec3 point;
            if (!planePoint(pose, kExtent, glm::dvec2(i % kExtent.width, i / kExtent.width) + 0.5, point))
                continue;
            const glm::dvec3 d = glm::dvec3(kRedPosition) - point;
            const glm::dvec3 at = point + d * (double(kBlockerHeight) / d.y);
            if (std::abs(at.x) > 0.98 * double(kBlockerHalf) ||
                std::abs(at.z + 0.2) > 0.98 * double(kBlockerHalf))
                continue;
            sum += double(image.rgb[3 * i + channel]);
            ++pixels;
        }
        EXPECT_GT(pixels, 40u);
        return sum / pixels;
    }
    static float largestOf(const samples::FloatImage& image, size_t channel) {
        float largest = 0;
        for (size_t i = channel; i < image.rgb.size(); i += 3) largest = std::max(largest, image.rgb[i]);
        return largest;
    }

    samples::GpuScene open_, blocked_;
    samples::View view_;
    HostView host;
    std::unique_ptr<restir::Scene> blockedScene_;
};

TEST_F(Reaction, LightThatGoesOutIsGoneAtOnce) {
    for (const Combination& c : combinations()) {
        SCOPED_TRACE(c.name);
        for (bool stays : {false, true}) {   // as a black light, or not at all
            host.upload(std::array{kRed, kBlue});
            samples::FloatImage image;
            for (uint32_t i = 0; i < kBefore; ++i) image = frame(i, 1, false, c.settings);
            EXPECT_GT(largestOf(image, 0), 1);
            if (stays)
                host.upload(std::array{bulb(0, kRedPosition, {0, 0, 0}), kBlue});
            else
                host.upload(std::array{kBlue});
            EXPECT_EQ(largestOf(frame(kBefore, 1, false, c.settings), 0), 0);
        }
    }
}

TEST_F(Reaction, LightThatIsHiddenIsGoneAtOnce) {
    host.upload(std::array{kRed, kBlue});
    for (const Combination& c : combinations()) {
        SCOPED_TRACE(c.name);
        samples::FloatImage image;
        for (uint32_t i = 0; i < kBefore; ++i) image = frame(i, 1, false, c.settings);
        EXPECT_GT(meanInUmbra(image, 0), 1);
        EXPECT_EQ(meanInUmbra(frame(kBefore, 1, true, c.settings), 0), 0);
    }
}

// What was hidden is another matter: no stored sample has it. `None` never killed any, so nothing is missing;
// with the other two the history counts as if it could have held the light, and fades in as it is replaced.
TEST_F(Reaction, LightThatIsBaredComesBack) {
    host.upload(std::array{kRed});
    restir::Settings settings;
    const auto bare = [&](VisibilityReuse visibility, uint32_t frames) {
        settings.di.visibility = visibility;
        for (uint32_t i = 0; i < 20; ++i) frame(i, 1, true, settings);
        samples::FloatImage image;
        for (uint32_t i = 20; i < 20 + frames; ++i) image = frame(i, 1, false, settings);
        return meanInUmbra(image, 0);
    };
    const double all = bare(VisibilityReuse::None, 40);
    EXPECT_NEAR(bare(VisibilityReuse::None, 1) / all, 1, 1e-3);
    for (auto [visibility, first] :
         {std::pair(VisibilityReuse::Cached, 0.15), std::pair(VisibilityReuse::Traced, 0.27)}) {
        EXPECT_NEAR(bare(visibility, 1) / all, first, 0.05);
        EXPECT_NEAR(bare(visibility, 40) / all, 1, 0.02);
    }
}

}   // namespace
}   // namespace tests
