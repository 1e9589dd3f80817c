// Pictures of lights that the SDK reads from the scene, beside those of the same lights uploaded by a host.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "image/world.h"

namespace tests {
namespace {

using samples::Emitters;
using samples::Sequence;

constexpr VkExtent2D kExtent{48, 32};
constexpr uint32_t kFrames = 6;

samples::FloatImage picture(const std::string& animation, Emitters emitters) {
    samples::SceneData scene = samples::makeBuiltin("cornell");
    const Sequence sequence{.view = scene.views[0],
                            .frames = kFrames,
                            .seed = 5,
                            .orbitDegrees = 1,
                            .motion = samples::findMotion(scene, animation)};
    World world(std::move(scene), kExtent, {.emitters = emitters});
    return world.render(sequence, unbiased());
}

// Corners are transformed on another processor, so they differ by their last bits, and here and there a draw
// with them, which neighbours and later frames may take over.
TEST(MeshLights, MovingAndSwitchingAsUploaded) {
    for (const char* animation : {"lights", "switching"}) {
        SCOPED_TRACE(animation);
        const samples::FloatImage host = picture(animation, Emitters::Uploaded),
                                  device = picture(animation, Emitters::Meshes);
        ASSERT_EQ(host.rgb.size(), device.rgb.size());
        size_t different = 0;
        for (size_t i = 0; i < host.rgb.size(); ++i)
            different += std::abs(host.rgb[i] - device.rgb[i]) > 1e-3f * host.rgb[i] + 1e-6f;
        EXPECT_LT(double(different), 0.03 * double(host.rgb.size()));
    }
}

}   // namespace
}   // namespace tests
