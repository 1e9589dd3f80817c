// A host with a render graph: it asks for the passes, places them and its own barriers, and gets the same
// picture.
#include <gtest/gtest.h>

#include <map>

#include "image/host_view.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using restir::PassInfo;

constexpr VkExtent2D kExtent{32, 24};

bool touches(const PassInfo::Use& a, const PassInfo::Use& b) {
    return a.resource == b.resource && (a.access != restir::Access::Read || b.access != restir::Access::Read);
}
bool dependent(const PassInfo& a, const PassInfo& b) {
    for (const PassInfo::Use& x : a.uses())
        for (const PassInfo::Use& y : b.uses())
            if (touches(x, y)) return true;
    return false;
}

// The passes of several views, in an order that keeps each view's dependencies but differs from record()'s
// wherever it can: views take turns, and of the passes that are ready the last one of the list goes first.
class Graph {
public:
    explicit Graph(restir::RayBackend rays) : scope_(restir::Session::passScope(rays)) {}

    void add(restir::Session& session, std::span<const PassInfo> passes) {
        views_.push_back({&session, {passes.begin(), passes.end()}, std::vector<bool>(passes.size())});
    }

    void execute(VkCommandBuffer cmd) {
        for (bool any = true; any;) {
            any = false;
            for (View& view : views_) any |= step(cmd, view);
        }
    }

    std::string order(size_t view) const { return views_[view].order; }
    uint32_t barriers() const { return barriers_; }

private:
    struct View {
        restir::Session* session;
        std::vector<PassInfo> passes;
        std::vector<bool> done;
        std::vector<size_t> sinceBarrier = {};
        std::string order = {};
    };

    static bool ready(const View& view, size_t i) {
        for (size_t before = 0; before < i; ++before)
            if (!view.done[before] && dependent(view.passes[before], view.passes[i])) return false;
        return true;
    }

    bool step(VkCommandBuffer cmd, View& view) {
        for (size_t i = view.passes.size(); i-- > 0;) {
            if (view.done[i] || !ready(view, i)) continue;
            for (size_t before : view.sinceBarrier) {
                if (!dependent(view.passes[before], view.passes[i])) continue;
                samples::memoryBarrier(cmd, {scope_.stages, scope_.access}, {scope_.stages, scope_.access});
                ++barriers_;
                for (View& all : views_) all.sinceBarrier.clear();
                break;
            }
            EXPECT_EQ(view.session->recordPass(cmd, uint32_t(i)), restir::Status::Ok);
            view.done[i] = true;
            view.sinceBarrier.push_back(i);
            view.order += std::to_string(i) + " ";
            return true;
        }
        return false;
    }

    restir::Scope scope_;
    std::vector<View> views_;
    uint32_t barriers_ = 0;
};

class GraphTest : public testing::Test {
protected:
    GraphTest() {
        samples::SceneData data = planeScene();
        for (float x : {-0.5f, 0.4f}) addQuad(data, lamp({x, 1, 0}, 0.2f), {.emission = {3, 5, 7}});
        view = data.views[0];
        scene = std::make_unique<samples::GpuScene>(device(), std::move(data));
        settings.di.pairedNeighbours = true;
        settings.di.spatialPasses = 2;
        settings.di.boilingFilter = 0.5f;
        settings.debugView = restir::DebugView::Age;
        settings.gi.mode = restir::IndirectMode::Restir;
        settings.gi.checkerboard = true;
        settings.gi.boilingFilter = 0.5f;
    }
    std::unique_ptr<HostView> makeHost(restir::RayBackend rays = device().bestRays(),
                                       std::shared_ptr<restir::Context> context = nullptr) const {
        return std::make_unique<HostView>(*scene, view,
                                          HostDesc{.maxExtent = kExtent,
                                                   .allOutputs = true,
                                                   .pairedNeighbours = restir::kPresetPartners,
                                                   .indirect = true,
                                                   .rays = rays,
                                                   .context = std::move(context)});
    }
    // Every output is asked for.
    static restir::FrameInput inputOf(const HostView& host, uint32_t index) {
        restir::FrameInput input = host.input(index);
        host.addIndirectLobes(input);
        return input;
    }

    samples::View view;
    std::unique_ptr<samples::GpuScene> scene;
    restir::Settings settings = unbiased();
};

class GraphOrder : public GraphTest, public testing::WithParamInterface<restir::RayBackend> {};

TEST_P(GraphOrder, AnotherLegalOneGivesTheSameBits) {
    const restir::RayBackend rays = GetParam();
    if (!device().has(rays)) GTEST_SKIP() << "not with this device";
    constexpr uint32_t kFrames = 3;
    // One context for all: of the same shaders made twice a driver may round otherwise (NVIDIA 580, ray pipelines).
    const std::unique_ptr<HostView> plain = makeHost(rays), first = makeHost(rays, plain->sharedContext()),
                                    second = makeHost(rays, plain->sharedContext());
    std::vector<glm::vec4> expected[size_t(Target::Count)];
    for (uint32_t i = 0; i < kFrames; ++i) plain->frame(inputOf(*plain, i), settings);
    for (size_t t = 0; t < size_t(Target::Count); ++t) {
        const auto texels = plain->read(kFrames - 1, Target(t));
        expected[t].assign(texels.begin(), texels.end());
    }

    std::string order;
    const restir::Scope scope = restir::Session::passScope(rays);
    device().submitAndWait([&](VkCommandBuffer cmd) {
        for (uint32_t i = 0; i < kFrames; ++i) {
            const restir::FrameInput inputs[] = {inputOf(*first, i), inputOf(*second, i)};
            Graph graph(rays);
            for (HostView* host : {first.get(), second.get()}) {
                auto passes = host->session().prepare(inputs[host == second.get()], settings);
                ASSERT_TRUE(passes);
                EXPECT_EQ(passes->size(), i == 0 ? 11u : 15u);
                graph.add(host->session(), *passes);
            }
            samples::memoryBarrier(cmd, {scope.stages, scope.access}, {scope.stages, scope.access});
            first->around(cmd, inputs[0],
                          [&] { second->around(cmd, inputs[1], [&] { graph.execute(cmd); }); });
            order = graph.order(0);
            EXPECT_LT(graph.barriers(), 14u);   // two views share them
        }
    });
    EXPECT_EQ(first->session().timings(kFrames - 1).size(), 15u);
    EXPECT_EQ(order, "0 1 2 3 4 5 6 7 8 10 9 11 12 13 14 ") << "pair_targets before gradient";
    for (const auto& host : {first.get(), second.get()})
        for (size_t t = 0; t < size_t(Target::Count); ++t) {
            const auto texels = host->read(kFrames - 1, Target(t));
            float largest = 0;
            for (size_t p = 0; p < texels.size(); ++p)
                for (int c = 0; c < 4; ++c) largest = std::max(largest, std::abs(texels[p][c] - expected[t][p][c]));
            EXPECT_EQ(largest, 0) << "output " << t;
        }
}

INSTANTIATE_TEST_SUITE_P(Backends, GraphOrder,
                         testing::Values(restir::RayBackend::RayQuery, restir::RayBackend::Pipeline,
                                         restir::RayBackend::Software));

TEST_F(GraphTest, RefusesWhatWasNotPrepared) {
    const std::unique_ptr<HostView> host = makeHost();
    device().submitAndWait([&](VkCommandBuffer cmd) {
        EXPECT_EQ(host->session().recordPass(cmd, 0), restir::Status::InvalidArgument);
        settings.counters = true;
        EXPECT_FALSE(host->session().prepare(host->input(0), settings));
        settings.counters = false;
        ASSERT_TRUE(host->session().prepare(host->input(0), settings));
        EXPECT_EQ(host->session().recordPass(cmd, 99), restir::Status::InvalidArgument);
        EXPECT_EQ(host->session().recordPass(VK_NULL_HANDLE, 0), restir::Status::InvalidArgument);
        host->around(cmd, host->input(0),
                     [&] { EXPECT_EQ(host->session().recordPass(cmd, 0), restir::Status::Ok); });
        EXPECT_EQ(host->session().recordPass(cmd, 0), restir::Status::InvalidArgument);   // once is enough
        ASSERT_TRUE(host->session().plan(host->input(1), settings));   // its list replaced the other
        EXPECT_EQ(host->session().recordPass(cmd, 0), restir::Status::InvalidArgument);
    });
}

}   // namespace
}   // namespace tests
