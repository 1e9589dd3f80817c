// What a host that moves all of its lights in every frame pays for them: time on the CPU beside that of
// copying the same bytes, time on the GPU, memory.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "bench/chart.h"
#include "bench/command.h"
#include "common/device.h"
#include "common/gpu_scene.h"
#include "common/mesh_builder.h"
#include "restir/lights.h"

namespace bench {
namespace {

using restir::Light;
using restir::LightKind;

struct Options {
    std::vector<uint32_t> counts{100, 1000, 10'000, 100'000, 1'000'000};
    std::string kinds = "triangles";
    uint32_t rounds = 20;
    bool tree = true;
    std::string plot;
};

void set(float (&to)[3], const glm::vec3& from) { std::copy(&from.x, &from.x + 3, to); }

LightKind kindOf(const std::string& kinds, uint32_t i) {
    constexpr LightKind all[] = {LightKind::Triangle, LightKind::Point, LightKind::Spot};
    if (kinds == "mixed") return all[i % 3];
    return kinds == "points" ? LightKind::Point : kinds == "spots" ? LightKind::Spot : LightKind::Triangle;
}

// All over a city, of very different powers.
std::vector<Light> randomLights(uint32_t count, const std::string& kinds) {
    samples::build::Rng rng(1);
    const auto direction = [&] { return glm::vec3(rng.range(-1, 1), rng.range(-1, 1), rng.range(-1, 1)); };
    std::vector<Light> lights(count);
    for (uint32_t i = 0; i < count; ++i) {
        Light& light = lights[i];
        const glm::vec3 position = 500.0f * direction();
        light.id = i;
        light.kind = kindOf(kinds, i);
        set(light.position, position);
        set(light.vertex1, position + 0.1f * direction());
        set(light.vertex2, position + 0.1f * direction());
        set(light.direction, direction() + glm::vec3(0, 2, 0));
        set(light.emission, glm::exp(3.0f * direction()));
    }
    return lights;
}

void move(std::vector<Light>& lights) {
    for (Light& light : lights) {
        light.position[1] += 0.001f;
        light.vertex1[1] += 0.001f;
        light.vertex2[1] += 0.001f;
    }
}

double millisecondsOf(const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

struct Times {   // the best of all rounds, milliseconds
    double copy = std::numeric_limits<double>::infinity(), upload = copy, record = copy, gpu = copy;
};

// The same triangles, as a mesh of a scene.
std::unique_ptr<samples::GpuScene> meshOf(const samples::Device& device, const std::vector<Light>& lights) {
    using namespace samples::build;
    samples::SceneData scene;
    samples::Geometry geometry{.material = addMaterial(scene, {.emission = glm::vec3(1)})};
    const auto point = [](const float(&p)[3]) { return glm::vec3(p[0], p[1], p[2]); };
    for (const Light& light : lights)
        addTriangle(geometry, {point(light.position), point(light.vertex1), point(light.vertex2)});
    addInstance(scene, addMesh(scene, {std::move(geometry)}));
    return std::make_unique<samples::GpuScene>(device, std::move(scene));
}

// With a scene the lights are its mesh, which the table reads anew in every round.
Times measure(const samples::Device& device, restir::LightTable& table, std::vector<Light>& lights,
              const restir::Scene* scene, uint32_t rounds) {
    Times best;
    std::vector<Light> copies(lights.size());
    for (uint32_t round = 0; round < rounds; ++round) {
        const uint32_t slot = round % 2;
        move(lights);
        best.copy = std::min(best.copy, millisecondsOf([&] {
                                 std::memcpy(static_cast<void*>(copies.data()), lights.data(),
                                             lights.size() * sizeof(Light));
                             }));
        move(lights);
        best.upload = std::min(best.upload, millisecondsOf([&] {
                                   if (scene) return;
                                   device.check(table.upload(slot, lights), "restir::LightTable::upload");
                               }));
        device.submitAndWait([&](VkCommandBuffer cmd) {
            best.record =
                std::min(best.record, millisecondsOf([&] {
                             device.check(table.record(cmd, slot, scene), "restir::LightTable::record");
                         }));
        });
        double gpu = 0;
        for (const restir::PassTiming& pass : table.timings(slot)) gpu += pass.milliseconds;
        best.gpu = std::min(best.gpu, gpu);
    }
    return best;
}

// Best times over the number of lights.
class Curves {
public:
    void add(uint32_t count, const Times& times) {
        const double values[] = {times.copy, times.upload + times.record, times.gpu};
        for (size_t i = 0; i < 3; ++i) chart_.lines[i].points.emplace_back(count, values[i]);
    }
    void save(const std::string& file) const {
        std::ofstream stream(file);
        stream << toSvg(chart_);
        if (!stream.flush()) throw std::runtime_error("cannot write " + file);
    }

private:
    Chart chart_{.title = "Moving all lights in a frame",
                 .xName = "lights",
                 .yName = "milliseconds",
                 .lines = {{.name = "one memcpy of them", .points = {}, .dashed = true},
                           {.name = "CPU: upload and record", .points = {}},
                           {.name = "GPU: the table's passes", .points = {}}}};
};

void run(const Options& options) {
    samples::Device device;
    const restir::ContextDesc desc{.device = device.sdkInfo(),
                                   .rays = device.bestRays(),
                                   .pipelines = restir::PipelineCreation::OnDemand,
                                   .framesInFlight = 2,
                                   .queueFamily = device.queueFamily()};
    const restir::Context context = device.require(restir::Context::create(desc), "restir::Context");
    std::printf("%s, %zu bytes a light, best of %u\n", options.kinds.c_str(), sizeof(Light), options.rounds);
    std::printf("%9s %11s %11s %11s %7s %11s %11s\n", "lights", "memcpy ms", "upload ms", "record ms",
                "ratio", "GPU ms", "MiB");
    Curves curves;
    for (uint32_t count : options.counts) {
        restir::LightTableDesc tableDesc{.maxLights = count, .tree = options.tree};
        std::vector<Light> lights = randomLights(count, options.kinds);
        std::unique_ptr<samples::GpuScene> mesh;
        std::unique_ptr<restir::Scene> scene;
        if (options.kinds == "meshes") {
            mesh = meshOf(device, lights);
            tableDesc.meshLights = count;
            tableDesc.maxMeshes = 1;
            scene = std::make_unique<restir::Scene>(
                device.require(restir::Scene::create(
                                   context, {.instances = mesh->instances(), .materials = mesh->materials()}),
                               "restir::Scene"));
        }
        auto table = device.require(restir::LightTable::create(context, tableDesc), "restir::LightTable");
        if (mesh) {
            device.check(table.uploadMeshes(0, mesh->lightMeshes()), "restir::LightTable::uploadMeshes");
            device.submitAndWait([&](VkCommandBuffer cmd) {
                device.check(table.record(cmd, 0, scene.get()), "restir::LightTable::record");
            });
        }
        const Times best = measure(device, table, lights, scene.get(), options.rounds);
        curves.add(count, best);
        std::printf("%9u %11.4f %11.4f %11.4f %7.2f %11.3f %11.3f\n", count, best.copy, best.upload,
                    best.record, (best.upload + best.record) / best.copy, best.gpu,
                    double(restir::LightTable::memoryNeeded(context, tableDesc)) / (1 << 20));
    }
    if (!options.plot.empty()) curves.save(options.plot);
}

}   // namespace

void addLights(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("lights",
                                           "What it costs to move all lights in every frame: CPU time over "
                                           "that of one memcpy of them, GPU time, memory.");
    command->add_option("--counts", options->counts, "of lights (100,1000,10000,100000,1000000)")
        ->delimiter(',')
        ->check(CLI::Range(1, 1 << 20))
        ->type_name("N,N...");
    command
        ->add_option("--kinds", options->kinds,
                     "of lights; meshes: triangles that the GPU reads from a scene (triangles)")
        ->check(CLI::IsMember({"triangles", "points", "spots", "mixed", "meshes"}))
        ->type_name("triangles|points|spots|mixed|meshes");
    command->add_flag("!--no-tree", options->tree, "without LightTableDesc::tree");
    command->add_option("--rounds", options->rounds, "frames of each count (20)")
        ->check(CLI::Range(2, 10000))
        ->type_name("N");
    command->add_option("--plot", options->plot, "draws the times over the counts")->type_name("FILE.svg");
    command->callback([options] { run(*options); });
}

}   // namespace bench
