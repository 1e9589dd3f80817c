// G-buffers written by the CPU: every encoding shows the same surface, and nothing in one makes a NaN.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "image/host_view.h"
#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using restir::DepthKind;
using restir::NormalEncoding;

constexpr VkExtent2D kExtent{32, 32};
constexpr size_t kPixels = size_t{32} * 32;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
constexpr float kEmpty = -7;

// The plane as a host would draw it into the images' corner; the left quarter of a whole picture is empty.
struct CpuPlane {
    std::vector<glm::vec4> depth, normal, color, emission;

    explicit CpuPlane(const samples::CameraPose& pose, VkExtent2D extent = kExtent) {
        const glm::dvec2 last(extent.width - 1, extent.height - 1);
        for (uint32_t i = 0; i < kPixels; ++i) {
            glm::dvec3 point;
            const glm::dvec2 pixel = glm::min(glm::dvec2(i % 32, i / 32), last);
            EXPECT_TRUE(planePoint(pose, extent, pixel + 0.5, point));
            const float linear = glm::dot(glm::vec3(point) - pose.eye, pose.forward);
            depth.emplace_back(i % 32 < 8 ? kEmpty : linear);
            normal.emplace_back(0, 1, 0, 0);
            color.emplace_back(kAlbedo, 0);
            emission.emplace_back(0);
        }
    }
};

glm::vec4 encode(glm::vec3 n, NormalEncoding encoding) {
    if (encoding == NormalEncoding::Xyz) return {n, 0};
    if (encoding == NormalEncoding::XyzUnorm) return {0.5f + 0.5f * n, 0};
    glm::vec2 e = glm::vec2(n) / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    if (n.z < 0) {
        const glm::vec2 sign(e.x >= 0 ? 1 : -1, e.y >= 0 ? 1 : -1);
        e = (1.0f - glm::vec2(std::abs(e.y), std::abs(e.x))) * sign;
    }
    return encoding == NormalEncoding::Octahedral ? glm::vec4(e, 0, 0) : glm::vec4(0.5f + 0.5f * e, 0, 0);
}

class GBufferTest : public testing::Test {
protected:
    GBufferTest() {
        samples::SceneData data = planeScene();
        view = data.views[0];
        scene = std::make_unique<samples::GpuScene>(device(), std::move(data));
        host = std::make_unique<HostView>(*scene, view, HostDesc{.maxExtent = kExtent, .maxLights = 4});
        pose = samples::makePose(view, kExtent);
        restir::Light light{.id = 0, .kind = restir::LightKind::Point, .position = {0.3f, 1, 0}};
        host->upload(std::span(&light, 1));
    }

    // Two frames of it; `change` has the last word on the input.
    samples::FloatImage render(const CpuPlane& plane, const std::function<void(restir::FrameInput&)>& change = {}) {
        const samples::GpuImage depth = floatImage(kExtent, plane.depth);
        const samples::GpuImage normal = floatImage(kExtent, plane.normal);
        const samples::GpuImage color = floatImage(kExtent, plane.color);
        const samples::GpuImage emission = floatImage(kExtent, plane.emission);
        samples::FloatImage image;
        for (uint32_t i = 0; i < 2; ++i) {
            restir::FrameInput input = host->input(i);
            input.gbuffer = {.depth = {depth.view()},
                             .normal = {normal.view()},
                             .baseColor = {color.view()},
                             .emission = {emission.view()},
                             .normals = NormalEncoding::Xyz,
                             .depthKind = DepthKind::Linear,
                             .emptyDepth = kEmpty};
            input.resetHistory = i == 0;
            if (change) change(input);
            settings.counters = true;
            image = host->frame(input, settings);
            EXPECT_TRUE(allFinite(image));
            EXPECT_EQ(host->session().counters(i).rejectedWeights, 0u);
        }
        return image;
    }
    // The same surface, stored as `projection` maps it: (p22 z + p32) / -z with z = -depth.
    samples::FloatImage renderDevice(CpuPlane plane, float p22, float p32, float emptyDepth) {
        for (glm::vec4& d : plane.depth) d.x = d.x == kEmpty ? emptyDepth : (-p22 * d.x + p32) / d.x;
        return render(plane, [&](restir::FrameInput& input) {
            input.gbuffer.depthKind = DepthKind::Device;
            input.gbuffer.emptyDepth = emptyDepth;
            input.camera.clipFromView.m[10] = p22;
            input.camera.clipFromView.m[14] = p32;
        });
    }

    samples::View view;
    samples::CameraPose pose;
    std::unique_ptr<samples::GpuScene> scene;
    std::unique_ptr<HostView> host;
    restir::Settings settings = unbiased();
};

TEST_F(GBufferTest, EmptyPixelsAreBlack) {
    CpuPlane plane(pose);
    plane.emission.assign(kPixels, glm::vec4(2));
    const samples::FloatImage image = render(plane);
    for (size_t i = 0; i < kPixels; ++i) {
        for (size_t c = 0; c < 3; ++c) {
            const float value = image.rgb[3 * i + c];
            ASSERT_TRUE(i % 32 < 8 ? value == 0 : value > 2) << i << ": " << value;
        }
    }
}

TEST_F(GBufferTest, EmissionAloneWithoutLights) {
    host->upload({});
    CpuPlane plane(pose);
    plane.emission.assign(kPixels, glm::vec4(2, 1, 0.5f, 0));
    const samples::FloatImage image = render(plane);
    for (size_t i = 0; i < kPixels; ++i) {
        const glm::vec3 color(image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2]);
        ASSERT_EQ(color, i % 32 < 8 ? glm::vec3(0) : glm::vec3(2, 1, 0.5f)) << i;
    }
}

TEST_F(GBufferTest, NormalEncodingsAgree) {
    // Tilted everywhere a little differently, down to below the horizon of +z.
    CpuPlane plane(pose);
    std::vector<glm::vec3> normals;
    for (size_t i = 0; i < kPixels; ++i) {
        const float turn = float(i) * 0.37f;
        normals.push_back(glm::normalize(glm::vec3(0.6f * std::cos(turn), 1, 0.6f * std::sin(turn))));
        plane.normal[i] = glm::vec4(normals[i], 0);
    }
    const samples::FloatImage expected = render(plane);
    for (NormalEncoding encoding :
         {NormalEncoding::XyzUnorm, NormalEncoding::Octahedral, NormalEncoding::OctahedralUnorm}) {
        for (size_t i = 0; i < kPixels; ++i) plane.normal[i] = encode(normals[i], encoding);
        const samples::FloatImage image =
            render(plane, [&](restir::FrameInput& input) { input.gbuffer.normals = encoding; });
        EXPECT_LT(largestDifference(image, expected), 2e-4) << int(encoding);   // a step of 16 bits
    }
}

TEST_F(GBufferTest, DepthKindsAgree) {
    const CpuPlane plane(pose);
    const samples::FloatImage expected = render(plane);
    EXPECT_GT(largest(expected), 0);
    const float near = 0.1f, far = 100;
    // Cancellation near 1 costs digits, which is why depth is reversed.
    const float p22 = -far / (far - near), p32 = -far * near / (far - near);
    EXPECT_LT(largestDifference(renderDevice(plane, p22, p32, 1), expected), 1e-3);
    EXPECT_LT(largestDifference(renderDevice(plane, -1 - p22, -p32, 0), expected), 1e-5);   // reversed
    EXPECT_LT(largestDifference(renderDevice(plane, 0, near, 0), expected), 1e-5);          // and infinite
}

// One light without extent leaves nothing to chance. Pixels that are lit have the very values of a whole frame, and so
// have those without anybody beside them; the others have the mean of their neighbours, in nine bits.
TEST_F(GBufferTest, CheckerboardFillsEveryPixel) {
    for (const VkExtent2D extent :
         {kExtent, VkExtent2D{31, 17}, VkExtent2D{10, 1}, VkExtent2D{9, 2}, VkExtent2D{1, 9}}) {
        const CpuPlane whole(pose, extent);
        CpuPlane lonely(pose, extent);
        for (size_t i = 0; i < kPixels; ++i)
            if (i % 32 % 2 == 1 || i / 32 % 3 == 1) lonely.depth[i].x = kEmpty;
        for (const CpuPlane* plane : {&whole, static_cast<const CpuPlane*>(&lonely)}) {
            for (auto visibility : {restir::VisibilityReuse::None, restir::VisibilityReuse::Cached,
                                    restir::VisibilityReuse::Traced}) {
                settings.di.visibility = visibility;
                const auto draw = [&](bool checkerboard, float exposure) {
                    settings.di.checkerboard = checkerboard;
                    return render(*plane, [&](restir::FrameInput& input) {
                        input.extent = extent;
                        input.exposure = exposure;   // what the last draw left does not pass for an answer
                    });
                };
                const samples::FloatImage half = draw(true, 0.5f), all = draw(false, 1);
                if (extent.width > 8) {
                    EXPECT_GT(largest(all), 0);
                }
                const auto isLit = [&](int x, int y) { return (x + y) % 2 == 0 || extent.width == 1; };
                for (int y = 0; y < int(extent.height); ++y) {
                    for (int x = 0; x < int(extent.width); ++x) {
                        const auto at = [&](int dx, int dy) { return 3 * (size_t(y + dy) * extent.width + size_t(x + dx)); };
                        float expected = all.rgb[at(0, 0)], brightest = 0, sum = 0, count = 0;
                        for (auto [dx, dy] : {std::pair(-1, 0), std::pair(1, 0), std::pair(0, -1), std::pair(0, 1)}) {
                            if (x + dx < 0 || y + dy < 0 || x + dx >= int(extent.width) || y + dy >= int(extent.height)) continue;
                            if (plane->depth[size_t(y + dy) * 32 + size_t(x + dx)].x == kEmpty) continue;
                            const float value = all.rgb[at(dx, dy)];
                            brightest = std::max(brightest, value);
                            sum += value;
                            ++count;
                        }
                        const bool filled = !isLit(x, y) && expected > 0 && count > 0;
                        if (filled) expected = sum / count;
                        ASSERT_NEAR(2 * half.rgb[at(0, 0)], expected, filled ? 0.005f * brightest : 1e-4f * expected)
                            << extent.width << "x" << extent.height << " at " << x << " " << y;
                    }
                }
            }
        }
    }
}

TEST_F(GBufferTest, HostileValuesStayOut) {
    const float values[] = {kNan, kInf, -kInf, -1, 0, 1e38f, -1e38f, 1e-38f, 65504};
    CpuPlane plane(pose);
    for (size_t i = 0; i < kPixels; ++i) {
        const float bad = values[(i / 5) % std::size(values)];
        switch (i % 5) {
            case 0: plane.depth[i].x = bad; break;
            case 1: plane.normal[i] = glm::vec4(bad); break;
            case 2: plane.normal[i].y = bad; break;
            case 3: plane.color[i] = glm::vec4(bad); break;
            case 4: plane.emission[i] = glm::vec4(bad); break;
        }
    }
    for (DepthKind kind : {DepthKind::Linear, DepthKind::Device}) {
        for (NormalEncoding encoding : {NormalEncoding::Xyz, NormalEncoding::XyzUnorm, NormalEncoding::Octahedral,
                                        NormalEncoding::OctahedralUnorm}) {
            const samples::FloatImage image = render(plane, [&](restir::FrameInput& input) {
                input.gbuffer.depthKind = kind;
                input.gbuffer.normals = encoding;
            });
            for (float v : image.rgb) ASSERT_GE(v, 0);
            if (encoding != NormalEncoding::Xyz || kind != DepthKind::Linear) continue;
            for (size_t i = 0; i < kPixels; ++i) {
                const float bad = values[(i / 5) % std::size(values)];
                const bool gone = i % 5 == 0 ? !(bad > 0 && bad < 1e30f) : i % 5 == 1 && !std::isfinite(bad);
                if (gone) {
                    ASSERT_EQ(image.rgb[3 * i], 0) << i;
                }
            }
        }
    }
}

TEST_F(GBufferTest, HostileMotionStaysOut) {
    std::vector<glm::vec4> motion(kPixels);
    const float values[] = {kNan, kInf, -kInf, 1e38f, -1e38f, 0, 3};
    for (size_t i = 0; i < kPixels; ++i)
        motion[i] = {values[i % std::size(values)], values[(i / 7) % std::size(values)], 0, 0};
    const samples::GpuImage image = floatImage(kExtent, motion);
    const CpuPlane plane(pose);
    const samples::FloatImage expected = render(plane);
    const samples::FloatImage moved =
        render(plane, [&](restir::FrameInput& input) { input.gbuffer.motion = {image.view()}; });
    EXPECT_LT(largestDifference(moved, expected), 1e-5);   // one light without extent: history changes nothing
}

}   // namespace
}   // namespace tests
