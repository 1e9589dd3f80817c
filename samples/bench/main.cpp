// restir-bench: what ReSTIR costs and what it buys, on one scene in one run.
//
//   cost   GPU time of the SDK's passes over that of one dispatch that traces the same rays again
//   error  mean((I - R)^2 / (R^2 + 0.01 mean(R)^2)) of single frames over independent seeds, for `di` and for plain
//          next-event estimation with as many samples as fit the same GPU time. R is the mean of independent frames
//          without temporal reuse, an unbiased estimator (tests/image hold it to other renderers).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "common/di_options.h"
#include "common/ray_replay.h"
#include "common/renderer.h"

namespace {

using samples::FloatImage;

struct Options {
    std::string scene;
    uint32_t width = 320, height = 180;
    uint32_t frames = 30, seeds = 8, referenceFrames = 128;
    float move = 0.2f;
    restir::DiSettings di;
};

double luminance(const FloatImage& image, size_t pixel) {
    const float* c = &image.rgb[3 * pixel];
    return 0.2126 * double(c[0]) + 0.7152 * double(c[1]) + 0.0722 * double(c[2]);
}

double meanOf(const FloatImage& image) {
    double sum = 0;
    for (size_t i = 0; i < image.rgb.size() / 3; ++i) sum += luminance(image, i);
    return sum / (double(image.rgb.size()) / 3);
}

double errorOf(const FloatImage& image, const FloatImage& reference) {
    const double floor = 0.01 * meanOf(reference) * meanOf(reference);
    double sum = 0;
    const size_t pixels = image.rgb.size() / 3;
    for (size_t i = 0; i < pixels; ++i) {
        const double r = luminance(reference, i), d = luminance(image, i) - r;
        sum += d * d / (r * r + floor);
    }
    return sum / double(pixels);
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
    return values[values.size() / 2];
}

// GPU milliseconds of all passes of a frame, from their medians.
double frameTime(const samples::RenderStats& stats) {
    double sum = 0;
    for (const auto& pass : stats.passes) sum += median(pass.milliseconds);
    return sum;
}

restir::SessionDesc sessionOf(const Options& options) {
    restir::SessionDesc desc{.rayLogCapacity = options.width * options.height * 24};
    samples::declareFor(options.di, desc);
    return desc;
}

class Bench {
public:
    Bench(samples::Device& device, samples::GpuScene& scene, const samples::View& view, const Options& options)
        : device_(device),
          scene_(scene),
          options_(options),
          view_(view),
          renderer_(device, scene, {options.width, options.height}, sessionOf(options)) {}

    void run() {
        cost();
        if (options_.referenceFrames == 0) return;
        const FloatImage reference = makeReference();
        const double di = error(settings(), options_.frames, reference);
        const double diTime = frameTime(renderer_.stats());
        restir::Settings nee;
        nee.di.mode = restir::DirectMode::NextEvent;
        nee.di.lightCandidates = matchingSamples(nee, diTime);
        const double neeError = error(nee, 2, reference);
        const double neeTime = frameTime(renderer_.stats());
        std::printf("error: di %.4f in %.1f ms, nee with %u samples %.4f in %.1f ms: %.1f times lower, %.1f at equal time\n",
                    di, diTime, nee.di.lightCandidates, neeError, neeTime, neeError / di,
                    neeError * neeTime / (di * diTime));
    }

private:
    restir::Settings settings() const {
        restir::Settings s;
        s.di = options_.di;
        return s;
    }
    FloatImage frame(uint32_t seed, uint32_t frames, const restir::Settings& s) {
        return renderer_.render({.view = view_, .frames = frames, .seed = seed, .orbitDegrees = options_.move}, s);
    }

    void cost() {
        frame(1, options_.frames, settings());
        const auto& stats = renderer_.stats();
        double total = 0;
        for (const auto& pass : stats.passes) {
            std::printf("%-16s %8.2f ms\n", pass.name.c_str(), median(pass.milliseconds));
            total += median(pass.milliseconds);
        }
        const uint32_t rays = stats.counters.rays;
        const double replay = samples::replayRays(device_, scene_, renderer_.session().rayLog(), stats.counters.loggedRays, 5);
        const double pixels = double(options_.width) * options_.height;
        std::printf("cost: %.1f ms, %.2f rays and %.0f ns a pixel, %u weights rejected; the rays alone %.1f ms: ratio %.2f\n",
                    total, rays / pixels, total * 1e6 / pixels, stats.counters.rejectedWeights, replay, total / replay);
    }

    FloatImage makeReference() {
        restir::Settings s = settings();
        s.di.temporal = false;
        s.di.weights = restir::Weights::Pairwise;
        s.di.visibility = restir::VisibilityReuse::Traced;
        FloatImage sum = frame(1000, 1, s);
        for (uint32_t i = 1; i < options_.referenceFrames; ++i) {
            const FloatImage one = frame(1000 + i, 1, s);
            for (size_t k = 0; k < sum.rgb.size(); ++k) sum.rgb[k] += one.rgb[k];
        }
        for (float& v : sum.rgb) v /= float(options_.referenceFrames);
        return sum;
    }

    double error(const restir::Settings& s, uint32_t frames, const FloatImage& reference) {
        double sum = 0;
        for (uint32_t seed = 1; seed <= options_.seeds; ++seed) sum += errorOf(frame(seed, frames, s), reference);
        return sum / options_.seeds;
    }

    // Next-event samples whose passes take as long.
    uint32_t matchingSamples(restir::Settings s, double milliseconds) {
        s.di.lightCandidates = 4;
        frame(1, 3, s);
        const double four = frameTime(renderer_.stats());
        s.di.lightCandidates = 8;
        frame(1, 3, s);
        const double one = (frameTime(renderer_.stats()) - four) / 4;
        return std::max(1u, uint32_t(std::lround(4 + (milliseconds - four) / one)));
    }

    samples::Device& device_;
    samples::GpuScene& scene_;
    Options options_;
    samples::View view_;
    samples::Renderer renderer_;
};

void run(const Options& options) {
    std::vector<std::string> warnings;
    samples::SceneData data = samples::loadScene(options.scene, warnings);
    const samples::View view = data.views.empty() ? samples::frameScene(data) : data.views[0];
    samples::Device device;
    samples::GpuScene scene(device, std::move(data));
    std::printf("%s, %ux%u, %zu lights, %s\n", options.scene.c_str(), options.width, options.height,
                scene.lights().size(), device.driver().c_str());
    Bench(device, scene, view, options).run();
}

}   // namespace

int main(int argc, char** argv) {
    CLI::App app("Measures cost and error of ReSTIR DI on a scene.", "restir-bench");
    Options options;
    app.add_option("scene", options.scene, "a glTF file or builtin:NAME")->required();
    app.add_option("--width", options.width)->check(CLI::Range(1, 4096));
    app.add_option("--height", options.height)->check(CLI::Range(1, 4096));
    app.add_option("--frames", options.frames, "of history before the one measured")->check(CLI::Range(2, 10000));
    app.add_option("--seeds", options.seeds)->check(CLI::Range(1, 10000));
    app.add_option("--reference-frames", options.referenceFrames, "averaged into R; 0: cost only")->check(CLI::Range(0, 100000));
    app.add_option("--move", options.move, "degrees a frame");
    samples::addDiOptions(app, options.di);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "restir-bench: %s\n", error.what());
        return 1;
    }
    try {
        run(options);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "restir-bench: %s\n", error.what());
        return 1;
    }
    return 0;
}
