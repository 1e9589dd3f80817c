#include <lights/environment.h>

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace {

using restir::EnvironmentImportance;

std::vector<float> gray(const std::vector<float>& values) {
    std::vector<float> rgb;
    for (float v : values) rgb.insert(rgb.end(), {v, v, v});
    return rgb;
}

// Mean luminance and probability of a texel's solid angle, as what a linear filter shows.
TEST(Environment, WeighsWhatAFilterShows) {
    const uint32_t width = 6, height = 4;
    std::vector<float> values(width * height, 0.0f);
    values[1 * width + 0] = 8;
    const std::vector<float> rgb = gray(values);
    const EnvironmentImportance importance = restir::weighEnvironment({width, height, rgb});
    const auto row = [](double y) {   // solid angle of a texel
        return 2 * std::numbers::pi / 6 *
               (std::cos(std::numbers::pi * y / 4) - std::cos(std::numbers::pi * (y + 1) / 4));
    };
    const double expected = 8 * (0.75 * row(1) + 0.125 * (row(0) + row(2)));
    EXPECT_NEAR(importance.luminance, expected, 1e-9);
    double sum = 0;
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            const uint32_t across = std::min(x, width - x);   // the map goes on around the sphere
            const double weight = (y == 1   ? 0.75
                                   : y == 3 ? 0
                                            : 0.125) *
                                  (across == 0   ? 0.75
                                   : across == 1 ? 0.125
                                                 : 0);
            const double p = double(importance.texels[y * width + x].probability);
            EXPECT_NEAR(p, 8 * weight * row(y) / expected, 1e-7) << x << ", " << y;
            sum += p;
        }
    EXPECT_NEAR(sum, 1, 1e-6);
}

TEST(Environment, ConstantsIntegrateToTheSphere) {
    for (const auto& [width, height] : {std::pair(1u, 1u), std::pair(7u, 3u), std::pair(64u, 32u)}) {
        const std::vector<float> rgb(size_t{3} * width * height, 2.5f);
        EXPECT_NEAR(restir::weighEnvironment({width, height, rgb}).luminance, 2.5 * 4 * std::numbers::pi,
                    1e-6);
    }
}

TEST(Environment, BlackMapsHoldNothing) {
    const std::vector<float> rgb(3 * 8 * 4, 0.0f);
    const EnvironmentImportance importance = restir::weighEnvironment({8, 4, rgb});
    EXPECT_EQ(importance.luminance, 0);
    for (const auto& texel : importance.texels) EXPECT_EQ(texel.probability, 0);
}

}   // namespace
