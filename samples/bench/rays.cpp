// Rays alone, by each backend: how fast, and how far they agree.
#include <chrono>
#include <cstdio>
#include <memory>

#include "bench/workbench.h"
#include "common/lighting.h"
#include "common/ray_lists.h"

namespace bench {
namespace {

struct Options {
    std::vector<std::string> scenes;
    VkExtent2D extent{480, 270};
    uint32_t rounds = 5;
};

struct Kind {
    const char* name;
    std::vector<samples::RsLoggedRay> rays;
};

// What passes trace: from the eye, on from there in random directions, and shadow rays of random lengths from
// there.
std::vector<Kind> raysOf(const samples::View& view, VkExtent2D extent, samples::RayTracer& tracer) {
    const float reach = 2 * glm::distance(view.eye, view.target);
    std::vector<Kind> kinds = {{"primary", samples::primaryRays(samples::makePose(view, extent), extent)}};
    const std::vector<samples::RayHit> seen = tracer.trace(kinds[0].rays);
    kinds.push_back({"scattered", samples::scatteredRays(kinds[0].rays, seen, reach, true, 1)});
    kinds.push_back({"shadow", samples::scatteredRays(kinds[0].rays, seen, reach, false, 2)});
    return kinds;
}

struct Backend {
    const char* name;
    std::unique_ptr<samples::Lighting> lighting;
    std::unique_ptr<samples::RayTracer> tracer;
};

void printTrees(const samples::GpuScene& scene) {
    const auto start = std::chrono::steady_clock::now();
    restir::BvhStatistics sum;
    for (const restir::BvhMesh& mesh : scene.makeBvhMeshes()) {
        const restir::BvhStatistics& s = mesh.statistics();
        sum.triangles += s.triangles;
        sum.nodes += s.nodes;
        sum.depth = std::max(sum.depth, s.depth);
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf("BVH: %llu triangles of meshes, %llu nodes, depth %u, %.1f MiB, built in %.2f s\n",
                static_cast<unsigned long long>(sum.triangles), static_cast<unsigned long long>(sum.nodes),
                sum.depth, double(48 * sum.triangles + 64 * sum.nodes) / (1 << 20), seconds);
}

void run(samples::Device& device, const std::string& name, const Options& options) {
    samples::SceneData data = load({.scene = name});
    const samples::View view = data.views.empty() ? samples::frameScene(data) : data.views[0];
    samples::GpuScene scene(device, std::move(data));
    std::printf("\n%s, %llu triangles\n", name.c_str(),
                static_cast<unsigned long long>(scene.triangleCount()));
    printTrees(scene);
    std::vector<Backend> backends;
    for (const samples::RayBackendName& known : samples::rayBackends()) {
        if (!device.has(known.backend)) continue;
        Backend& made = backends.emplace_back();
        made.name = known.name;
        made.lighting =
            std::make_unique<samples::Lighting>(device, scene, samples::LightingDesc{.rays = known.backend});
        made.tracer = std::make_unique<samples::RayTracer>(device, scene, known.backend, made.lighting->bvh());
    }
    std::printf("%-10s %9s %-10s %9s %9s %14s %14s %14s %10s\n", "", "rays", "", "Mrays/s", "ratio",
                "hit or not", "elsewhere", "same place", "largest dt");
    for (const Kind& kind : raysOf(view, options.extent, *backends[0].tracer)) {
        std::vector<samples::RayHit> expected;
        double first = 0;
        for (Backend& backend : backends) {
            const std::vector<samples::RayHit> hits = backend.tracer->trace(kind.rays);
            if (expected.empty()) expected = hits;
            const double rate =
                double(kind.rays.size()) * 1e-3 / backend.tracer->milliseconds(options.rounds);
            if (first == 0) first = rate;
            const samples::HitComparison c = samples::compareHits(kind.rays, expected, hits);
            std::printf("%-10s %9zu %-10s %9.2f %9.2f %14zu %14zu %14zu %10.1e\n", kind.name,
                        kind.rays.size(), backend.name, rate, rate / first, c.otherFound, c.otherTriangle,
                        c.otherAtSame, c.largestT);
        }
    }
}

}   // namespace

void addRays(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("rays",
                                           "Millions of rays a second by each ray backend, and how many of "
                                           "them hit something else than by the first.");
    command->add_option("scenes", options->scenes, "glTF files or builtin:NAME")
        ->required()
        ->type_name("SCENE...");
    samples::addSize(*command, options->extent, "of the picture whose rays are traced");
    command->add_option("--rounds", options->rounds, "times each list is traced; the best counts (5)")
        ->check(CLI::Range(1, 1000))
        ->type_name("N");
    command->callback([options] {
        samples::Device device;
        std::printf("%s\n", device.driver().c_str());
        for (const std::string& scene : options->scenes) run(device, scene, *options);
    });
}

}   // namespace bench
