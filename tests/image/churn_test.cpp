// Lights that come, go, move, change colour and place in the upload, a tenth of them in every frame:
// reservoirs keep the lights that they mean. One table is shown by two views, one of which skips frames.
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <optional>

#include "image/host_view.h"
#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using restir::Light;
using restir::LightKind;
using samples::build::Rng;

void set(float (&to)[3], glm::vec3 v) {
    for (int i = 0; i < 3; ++i) to[i] = v[i];
}
glm::dvec3 vec(const float (&v)[3]) { return {double(v[0]), double(v[1]), double(v[2])}; }

Light randomLight(uint32_t id, Rng& rng) {
    Light light{.id = id, .kind = rng.below(2) ? LightKind::Point : LightKind::Triangle};
    const glm::vec3 position{rng.range(-1, 1), rng.range(0.6f, 2), rng.range(-2, 0.5f)};
    set(light.position, position);
    set(light.vertex1, position + glm::vec3(rng.range(0.1f, 0.3f), 0, 0));   // seen from below
    set(light.vertex2, position + glm::vec3(0, rng.range(-0.1f, 0.1f), rng.range(0.1f, 0.3f)));
    const float power = rng.below(20) == 0   ? 0.0f
                        : rng.below(20) == 0 ? 8.0f
                                             : 1.0f;   // some are black, some strong
    set(light.emission, power * glm::vec3(rng.range(0.1f, 2), rng.range(0.1f, 2), rng.range(0.1f, 2)));
    return light;
}

glm::dvec3 irradiance(const Light& light, glm::dvec3 p) {
    const glm::dvec3 a = vec(light.position), d = a - p;
    if (light.kind == LightKind::Point) return vec(light.emission) * d.y / std::pow(glm::length(d), 3);
    const std::array corners{a, vec(light.vertex1), vec(light.vertex2)};
    return vec(light.emission) * std::abs(polygonIrradiance(corners, p, {0, 1, 0}));
}

// What is lit, kept up to date light by light: as planePicture().
class Truth {
public:
    Truth(const samples::View& view, VkExtent2D extent) : extent_(extent) {
        const samples::CameraPose pose = samples::makePose(view, extent);
        for (uint32_t i = 0; i < extent.width * extent.height; ++i) {
            glm::dvec3 point;
            EXPECT_TRUE(
                planePoint(pose, extent, glm::dvec2(i % extent.width, i / extent.width) + 0.5, point));
            points_.push_back(point);
        }
        sums_.resize(points_.size(), glm::dvec3(0));
    }
    void add(const Light& light, double sign) {
        if (known_) return;
        for (size_t i = 0; i < points_.size(); ++i) sums_[i] += sign * irradiance(light, points_[i]);
    }
    // No longer kept up to date.
    void stop() { known_ = true; }
    samples::FloatImage picture() const {
        samples::FloatImage image{extent_.width, extent_.height, {}};
        for (const glm::dvec3& sum : sums_)
            for (int c = 0; c < 3; ++c)
                image.rgb.push_back(float(sum[c] * double(kAlbedo[c]) / std::numbers::pi));
        return image;
    }

private:
    VkExtent2D extent_;
    std::vector<glm::dvec3> points_, sums_;
    bool known_ = false;
};

// All lights of a frame, by id and as they are uploaded.
class Crowd {
public:
    Crowd(uint32_t slots, Truth truth) : truth_(std::move(truth)), slots_(slots), changed_(slots) {
        for (uint32_t id = 0; id < slots; ++id)
            if (rng_.below(8) != 0) put(id, randomLight(id, rng_));
        shuffle();
    }
    // A tenth of the ids: new lights only where there was none in the last frame.
    void step() {
        for (uint32_t i = 0; i < slots_.size() / 10; ++i) {
            const uint32_t id = rng_.below(uint32_t(slots_.size()));
            const std::optional<Light> was = slots_[id];
            if (changed_[id] == frame_ + 1) continue;
            changed_[id] = frame_ + 1;
            const Light other = randomLight(id, rng_);
            if (!was)
                put(id, other);
            else if (rng_.below(3) == 0)
                remove(id);
            else
                put(id, moved(*was, other));
        }
        ++frame_;
        shuffle();
    }
    std::span<const Light> lights() const { return lights_; }
    bool shines(uint32_t id) const {
        return id < slots_.size() && slots_[id] && vec(slots_[id]->emission) != glm::dvec3(0);
    }
    Truth& truth() { return truth_; }

private:
    // Another place, or another colour.
    Light moved(const Light& was, const Light& other) {
        Light light = was;
        if (rng_.below(2) == 0) {
            std::copy(other.emission, other.emission + 3, light.emission);
        } else {
            const glm::dvec3 by = 0.3 * (vec(other.position) - vec(was.position));
            for (auto corner : {&light.position, &light.vertex1, &light.vertex2})
                for (int i = 0; i < 3; ++i) (*corner)[i] += float(by[i]);
        }
        return light;
    }
    void put(uint32_t id, const Light& light) {
        if (slots_[id]) truth_.add(*slots_[id], -1);
        slots_[id] = light;
        truth_.add(light, 1);
    }
    void remove(uint32_t id) {
        truth_.add(*slots_[id], -1);
        slots_[id].reset();
    }
    void shuffle() {
        lights_.clear();
        for (const auto& light : slots_)
            if (light) lights_.push_back(*light);
        for (size_t i = lights_.size(); i > 1; --i)
            std::swap(lights_[i - 1], lights_[rng_.below(uint32_t(i))]);
    }

    Rng rng_{77};   // the same lights in every sequence
    Truth truth_;
    std::vector<std::optional<Light>> slots_;
    std::vector<uint32_t> changed_;   // in which frame, last
    uint32_t frame_ = 0;
    std::vector<Light> lights_;
};

// A picture of its own table's lights: the mean over frames, beside what it should be.
struct Watcher {
    restir::Session session;
    uint32_t every = 1;   // frames
    samples::FloatImage sum, expected;
    uint32_t frames = 0;
};

void accumulate(samples::FloatImage& sum, const samples::FloatImage& image) {
    if (sum.rgb.empty()) sum = {image.width, image.height, std::vector<float>(image.rgb.size())};
    for (size_t i = 0; i < image.rgb.size(); ++i) sum.rgb[i] += image.rgb[i];
}

struct Play {
    uint32_t lights = 0, frames = 0, sequences = 0;
    VkExtent2D extent{};
    uint32_t uploadEvery = 1, secondEvery = 3;   // frames
};

class ChurnTest : public testing::Test {
protected:
    ChurnTest() {
        samples::SceneData data = planeScene();
        view = data.views[0];
        scene = std::make_unique<samples::GpuScene>(device(), std::move(data));
        settings.di.bsdfCandidates = 0;   // the triangles are in no acceleration structure
        settings.di.radius = 6;   // more independent samples in a picture and over frames
        settings.di.maxHistory = 5;
        settings.counters = true;
        settings.debugView = restir::DebugView::Light;
    }

    Watcher watcher(const Play& play, uint32_t every) const {
        return {
            device().require(restir::Session::create(host->context(), {.maxExtent = play.extent}), "Session"),
            every};
    }

    void show(Watcher& watcher, Crowd& crowd, uint32_t frame, uint32_t seed) {
        restir::FrameInput input = host->input(frame);
        input.seed = seed;
        device().submitAndWait(
            [&](VkCommandBuffer cmd) { host->record(cmd, watcher.session, input, settings); });
        const samples::FloatImage image = host->read(input.frameSlot);
        ASSERT_TRUE(allFinite(image));
        EXPECT_EQ(watcher.session.counters(input.frameSlot).rejectedWeights, 0u);
        for (const glm::vec4& pixel : host->read(input.frameSlot, Target::Debug)) {
            if (pixel.w < 0) continue;   // no sample
            ASSERT_TRUE(crowd.shines(uint32_t(pixel.w))) << "light " << pixel.w << " in frame " << frame;
            ++samplesSeen;
        }
        accumulate(watcher.sum, image);
        accumulate(watcher.expected, crowd.truth().picture());
        ++watcher.frames;
    }

    void run(const Play& play) {
        host = std::make_unique<HostView>(
            *scene, view, HostDesc{.maxExtent = play.extent, .maxLights = play.lights, .allOutputs = true});
        const Crowd first(play.lights, Truth(view, play.extent));
        std::vector<SeedStatistics> statistics(2);
        std::vector<samples::FloatImage> expected(2);
        for (uint32_t seed = 1; seed <= play.sequences; ++seed) {
            Crowd crowd = first;
            if (seed > 1) crowd.truth().stop();   // the same as the first one's
            std::vector<Watcher> watchers;
            for (uint32_t every : {1u, play.secondEvery}) watchers.push_back(watcher(play, every));
            for (uint32_t frame = 0; frame < play.frames; ++frame) {
                if (frame > 0 && frame % play.uploadEvery == 0) crowd.step();
                if (frame % play.uploadEvery == 0) host->upload(crowd.lights());
                for (Watcher& watcher : watchers) {
                    if (frame % watcher.every != 0) continue;
                    ASSERT_NO_FATAL_FAILURE(show(watcher, crowd, frame, seed));
                }
            }
            for (size_t i = 0; i < watchers.size(); ++i) {
                for (auto* image : {&watchers[i].sum, &watchers[i].expected})
                    for (float& v : image->rgb) v /= float(watchers[i].frames);
                statistics[i].add(watchers[i].sum);
                if (seed == 1) expected[i] = watchers[i].expected;
            }
        }
        EXPECT_GT(samplesSeen,
                  uint64_t{play.extent.width} * play.extent.height * play.sequences * play.frames / 2);
        Verdict verdict(2, play.sequences);
        verdict.add("every frame", compare(statistics[0], exactly(expected[0])));
        verdict.add("now and then", compare(statistics[1], exactly(expected[1])));
    }

    restir::Settings settings = unbiased();
    samples::View view;
    std::unique_ptr<samples::GpuScene> scene;
    std::unique_ptr<HostView> host;
    uint64_t samplesSeen = 0;
};

// The second view loses its history in each of its frames: the lights that it knew are gone.
TEST_F(ChurnTest, OneViewSkipsFrames) {
    run({.lights = 1500,
         .frames = 7,
         .sequences = 96,
         .extent = {32, 32},
         .uploadEvery = 1,
         .secondEvery = 3});
}

// Both keep their history, the first one through frames without an upload.
TEST_F(ChurnTest, UploadsAtTheRateOfTheSlowerView) {
    run({.lights = 400,
         .frames = 6,
         .sequences = 96,
         .extent = {32, 32},
         .uploadEvery = 2,
         .secondEvery = 2});
}

// Ten thousand changes a frame.
using LongChurnTest = ChurnTest;
TEST_F(LongChurnTest, AHundredThousandLights) {
    run({.lights = 100'000,
         .frames = 200,
         .sequences = 8,
         .extent = {32, 32},
         .uploadEvery = 1,
         .secondEvery = 2});
}

}   // namespace
}   // namespace tests
