// Every struct of include/restir/shared has the same bytes in C++ and in GLSL's scalar layout.
#include <cstddef>
#include <cstring>

#include <restir/shared/bvh.h>
#include <restir/shared/frame.h>
#include <restir/shared/gi.h>
#include <restir/shared/light_table.h>
#include <restir/shared/lights.h>
#include <restir/shared/scene.h>

#include "layout.spv.h"
#include "support/gpu.h"

namespace restir::gpu {
#include "gpu/shaders/include/fill.glsl"
}

namespace {

using namespace restir::gpu;

// Two structs as C++ lays them out, and room for what the shader writes: more of it than should be needed.
template <class T>
struct Pair {
    explicit Pair(void (*fill)(T&, int))
        : expected(2), written(3 * sizeof(T) / sizeof(uint32_t), kUntouched) {
        static_assert(sizeof(T) % sizeof(uint32_t) == 0);
        fill(expected[0], 1000);
        fill(expected[1], 2000);
    }
    void check(const char* name) const {
        std::vector<uint32_t> wanted(2 * sizeof(T) / sizeof(uint32_t));
        std::memcpy(wanted.data(), expected.data(), 2 * sizeof(T));
        for (size_t i = 0; i < wanted.size(); ++i)
            ASSERT_EQ(written[i], wanted[i])
                << name << " at byte " << i * sizeof(uint32_t) << ", size " << sizeof(T);
        for (size_t i = wanted.size(); i < written.size(); ++i) ASSERT_EQ(written[i], kUntouched) << name;
    }

    static constexpr uint32_t kUntouched = 0xdeadbeef;
    std::vector<T> expected;
    std::vector<uint32_t> written;
};

class Layout : public tests::GpuTest {};

TEST_F(Layout, EveryStructIsTheSameInCppAndGlsl) {
    Pair<RsReservoir> reservoir(fillReservoir);
    Pair<RsDiConstants> di(fillDi);
    Pair<RsView> view(fillView);
    Pair<RsFrame> frame(fillFrame);
    Pair<RsPass> pass(fillPass);
    Pair<RsCounters> counters(fillCounters);
    Pair<RsLoggedRay> ray(fillRay);
    Pair<RsPackedLight> light(fillLight), streamed(fillLight);
    Pair<RsAliasEntry> alias(fillAlias);
    Pair<RsInstance> instance(fillInstance);
    Pair<RsMaterial> material(fillMaterial);
    Pair<RsEnvironmentTexel> texel(fillTexel);
    Pair<RsTablePass> tablePass(fillTablePass);
    Pair<RsTableState> tableState(fillTableState);
    Pair<RsLightMesh> lightMesh(fillLightMesh);
    using tests::out;
    const tests::Kernel kernel(k_layout_spv, 17);
    kernel.run(1, {out(reservoir.written), out(di.written), out(view.written), out(frame.written),
                   out(pass.written), out(counters.written), out(ray.written), out(light.written),
                   out(alias.written), out(instance.written), out(material.written),
                   tests::in(streamed.expected), out(streamed.written), out(tablePass.written),
                   out(tableState.written), out(texel.written), out(lightMesh.written)});
    reservoir.check("RsReservoir");
    di.check("RsDiConstants");
    view.check("RsView");
    frame.check("RsFrame");
    pass.check("RsPass");
    counters.check("RsCounters");
    ray.check("RsLoggedRay");
    light.check("RsPackedLight");
    alias.check("RsAliasEntry");
    instance.check("RsInstance");
    material.check("RsMaterial");
    tablePass.check("RsTablePass");
    tableState.check("RsTableState");
    texel.check("RsEnvironmentTexel");
    lightMesh.check("RsLightMesh");
    streamed.check("RsPackedLight from its stream");
}

TEST_F(Layout, SizesThatMemoryBudgetsCountOn) {
    EXPECT_EQ(sizeof(RsReservoir), 16u);
    EXPECT_EQ(sizeof(RsGiReservoir), 16u * RS_GI_STREAMS);
    EXPECT_EQ(sizeof(RsPackedLight), 16u * RS_LIGHT_STRIDE);
    EXPECT_EQ(sizeof(RsAliasEntry), 8u);
    EXPECT_EQ(sizeof(RsEnvironmentTexel), 12u);
    EXPECT_EQ(sizeof(RsLoggedRay), 32u);
    EXPECT_LE(sizeof(RsPass), 128u);
    // Read as vectors of 16 bytes.
    EXPECT_EQ(sizeof(RsBvhNode), 64u);
    EXPECT_EQ(offsetof(RsBvhNode, child0), 12u);
    EXPECT_EQ(offsetof(RsBvhNode, parent), 28u);
    EXPECT_EQ(offsetof(RsBvhNode, child1), 44u);
    EXPECT_EQ(sizeof(RsBvhCorner), 16u);
    EXPECT_EQ(sizeof(RsBvhInstance), 64u);
    EXPECT_EQ(offsetof(RsBvhInstance, root), 48u);
}

}   // namespace
