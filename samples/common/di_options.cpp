#include "common/di_options.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <utility>

#include <CLI/CLI.hpp>

namespace samples {
namespace {

using restir::DirectMode;
using restir::DiSettings;
using restir::VisibilityReuse;
using restir::Weights;

constexpr const char* kOnOff = "on|off";

template <class T>
DiOption number(std::string name, T DiSettings::*field, std::string help, std::string unit = "N") {
    return {.name = std::move(name),
            .values = std::move(unit),
            .help = std::move(help),
            .set =
                [field](DiSettings& settings, std::string_view text) {
                    T value{};
                    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
                    if (error != std::errc{} || end != text.data() + text.size()) return false;
                    settings.*field = value;
                    return true;
                },
            .get =
                [field](const DiSettings& settings) {
                    char text[32];
                    return std::string(text, std::to_chars(text, text + sizeof(text), settings.*field).ptr);
                }};
}

template <class T>
DiOption choice(std::string name, T DiSettings::*field, std::string help,
                std::vector<std::pair<std::string, T>> choices) {
    std::string list;
    for (const auto& [key, unused] : choices) list += (list.empty() ? "" : "|") + key;
    return {.name = std::move(name),
            .values = std::move(list),
            .help = std::move(help),
            .set =
                [field, choices](DiSettings& settings, std::string_view text) {
                    for (const auto& [key, value] : choices) {
                        if (key != text) continue;
                        settings.*field = value;
                        return true;
                    }
                    return false;
                },
            .get =
                [field, choices](const DiSettings& settings) {
                    for (const auto& [key, value] : choices)
                        if (value == settings.*field) return key;
                    return std::string("?");
                }};
}

DiOption onOff(std::string name, bool DiSettings::*field, std::string help) {
    return choice<bool>(std::move(name), field, std::move(help), {{"on", true}, {"off", false}});
}

std::string refusal(const DiOption& option, std::string_view name, std::string_view text) {
    const bool listed = option.values.find('|') != std::string::npos;
    return std::string(name) + ": '" + std::string(text) + "' is " +
           (listed ? "none of " + option.values : "no number it can take");
}

// Replaces all settings, and so goes before the others.
const DiOption& presetOption() {
    static const std::vector<std::pair<std::string, restir::Preset>> kPresets = {
        {"fast", restir::Preset::Fast},
        {"balanced", restir::Preset::Balanced},
        {"quality", restir::Preset::Quality},
        {"unbiased", restir::Preset::Unbiased}};
    static const DiOption kOption = {.name = "preset",
                                     .values = "fast|balanced|quality|unbiased",
                                     .help = "settings to start from, instead of the defaults",
                                     .set =
                                         [](DiSettings& settings, std::string_view text) {
                                             for (const auto& [key, preset] : kPresets) {
                                                 if (key != text) continue;
                                                 settings = restir::presetSettings(preset);
                                                 return true;
                                             }
                                             return false;
                                         },
                                     .get = {}};
    return kOption;
}

const DiOption& find(std::string_view name) {
    if (name == presetOption().name) return presetOption();
    std::string known = presetOption().name;
    for (const DiOption& option : diOptions()) {
        if (option.name == name) return option;
        known += " " + option.name;
    }
    throw std::runtime_error("'" + std::string(name) + "' is no setting, known: " + known);
}

}   // namespace

const std::vector<DiOption>& diOptions() {
    static const std::vector<DiOption> kOptions = {
        choice<DirectMode>("mode", &DiSettings::mode, "reservoirs, or plain next-event estimation (di)",
                           {{"di", DirectMode::Restir}, {"nee", DirectMode::NextEvent}}),
        choice<Weights>("weights", &DiSettings::weights, "resampling weights (pairwise)",
                        {{"off", Weights::Off},
                         {"basic", Weights::Basic},
                         {"balance", Weights::Balance},
                         {"pairwise", Weights::Pairwise},
                         {"plain", Weights::PairwisePlain}}),
        choice<VisibilityReuse>("visibility", &DiSettings::visibility, "visibility in reuse (traced)",
                                {{"none", VisibilityReuse::None},
                                 {"cached", VisibilityReuse::Cached},
                                 {"traced", VisibilityReuse::Traced}}),
        number("candidates", &DiSettings::lightCandidates, "light candidates per round (16)"),
        number("initial-samples", &DiSettings::initialSamples, "rounds of light candidates per pixel (1)"),
        number("cut-samples", &DiSettings::cutSamples, "rounds in a frame without history, if more (4)"),
        number("bsdf-candidates", &DiSettings::bsdfCandidates, "BSDF candidates per pixel (1)"),
        onOff("temporal", &DiSettings::temporal, "temporal reuse (on)"),
        number("max-history", &DiSettings::maxHistory, "frames that temporal reuse may stand for (20)"),
        onOff("permute-history", &DiSettings::permuteHistory, "history of another pixel nearby (off)"),
        number("spatial-passes", &DiSettings::spatialPasses, "passes of spatial reuse (1)"),
        number("neighbours", &DiSettings::neighbours, "of each spatial pass (5)"),
        onOff("fused", &DiSettings::fused, "temporal and spatial reuse in one pass (off)"),
        onOff("checkerboard", &DiSettings::checkerboard, "half of the pixels a frame, the rest filled in (off)"),
        number("radius", &DiSettings::radius, "of spatial reuse (30)", "PX"),
        onOff("paired-neighbours", &DiSettings::pairedNeighbours,
              "neighbours in pairs that share rays and targets (off)"),
        number("normal-threshold", &DiSettings::normalThreshold,
               "least cosine between the normals of surfaces that share samples (0.9)"),
        number("depth-threshold", &DiSettings::depthThreshold,
               "largest relative difference of their depths (0.1)"),
        onOff("average", &DiSettings::averageShading,
              "shade the mean of all inputs where it can be had (on)"),
        number("boiling-filter", &DiSettings::boilingFilter, "strength, 0 to 1 (0: off)"),
    };
    return kOptions;
}

void addDiOptions(CLI::App& app, DiSettings& settings) {
    std::vector<const DiOption*> options = {&presetOption()};   // CLI11 applies them in this order, whatever the line's
    for (const DiOption& option : diOptions()) options.push_back(&option);
    for (const DiOption* each : options) {
        const DiOption& option = *each;
        const std::string flag = "--" + option.name;
        if (app.get_option_no_throw(flag)) continue;
        const auto set = [&settings, &option, flag](const std::string& text) {
            if (!option.set(settings, text)) throw std::runtime_error(refusal(option, flag, text));
        };
        if (option.values == kOnOff) {
            app.add_flag_function(
                flag + ",!--no-" + option.name, [set](int64_t n) { set(n > 0 ? "on" : "off"); }, option.help);
        } else {
            app.add_option_function<std::string>(flag, set, option.help)->type_name(option.values);
        }
    }
    app.add_flag_callback(
        "--no-spatial", [&settings] { settings.spatialPasses = 0; }, "--spatial-passes 0");
}

std::string diText(const DiSettings& settings) {
    const DiSettings defaults;
    std::string text;
    for (const DiOption& option : diOptions()) {
        const bool always =
            settings.mode == DirectMode::Restir && (option.name == "weights" || option.name == "visibility");
        const std::string value = option.get(settings);
        if (!always && value == option.get(defaults)) continue;
        text += (text.empty() ? "" : " ") + option.name + "=" + value;
    }
    return text;
}

DiSettings parseDi(std::string_view text, DiSettings base) {
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(' '));
        text.remove_prefix(std::min(text.size(), word.size() + 1));
        if (word.empty()) continue;
        const size_t equals = word.find('=');
        const DiOption& option = find(word.substr(0, equals));
        const std::string_view value = equals == std::string_view::npos ? "" : word.substr(equals + 1);
        if (!option.set(base, value)) throw std::runtime_error(refusal(option, option.name, value));
    }
    return base;
}

void declareFor(const DiSettings& settings, restir::SessionDesc& desc) {
    if (settings.pairedNeighbours)
        desc.pairedNeighbours = std::max(desc.pairedNeighbours, settings.neighbours);
}

}   // namespace samples
