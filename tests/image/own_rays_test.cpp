// A ray backend that a host plugs in by include order, against ray query on the same wall.
#include <gtest/gtest.h>

#include <restir_embedded.h>

#include "image/host_view.h"
#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

constexpr VkExtent2D kExtent{48, 32};

TEST(OwnRays, SeeAWallByFormula) {
    samples::SceneData data = planeScene();
    addQuad(data, {.origin = {0.1f, 0.5f, -50}, .u = {100, 0, 0}, .v = {0, 0, 100}}, {});
    const samples::View view = data.views[0];
    const samples::GpuScene scene(device(), std::move(data));
    const auto picture = [&](const HostDesc& desc) {
        HostView host(scene, view, desc);
        const restir::Light lamps[] = {
            {.id = 0, .kind = restir::LightKind::Point, .position = {-0.2f, 0.9f, 0}, .emission = {1, 2, 3}},
            {.id = 1,
             .kind = restir::LightKind::Sphere,
             .position = {0.4f, 1.2f, 0},
             .radius = 0.1f,
             .emission = {9, 9, 9}}};
        host.upload(lamps);
        restir::FrameInput first = host.input(0);
        if (desc.rays == restir::RayBackend::Own) first.tlas = VK_NULL_HANDLE;   // nobody asks for it
        host.frame(first, unbiased());
        const samples::FloatImage image = host.frames(1, 3, unbiased());
        EXPECT_GT(largest(image), 0.1f);
        return image;
    };
    HostDesc desc{.maxExtent = kExtent, .maxLights = 2};
    const samples::FloatImage query = picture(desc);
    desc.rays = restir::RayBackend::Own;
    desc.shaders = &kEmbeddedOwnPack;
    EXPECT_LE(largestDifference(picture(desc), query), 1e-4);
}

}   // namespace
}   // namespace tests
