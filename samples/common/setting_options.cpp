#include "common/setting_options.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <CLI/CLI.hpp>

namespace samples {
namespace {

using restir::DirectMode;
using restir::DiSettings;
using restir::GiSettings;
using restir::IndirectMode;
using restir::Settings;
using restir::VisibilityReuse;
using restir::Weights;

constexpr const char* kOnOff = "on|off";

template <class T>
T& at(Settings& settings, T DiSettings::*field) {
    return settings.di.*field;
}
template <class T>
T& at(Settings& settings, T GiSettings::*field) {
    return settings.gi.*field;
}
template <class Part, class T>
const T& at(const Settings& settings, T Part::*field) {
    return at(const_cast<Settings&>(settings), field);
}

// As in restir/settings.h; what only has to be above 0 ends where it no longer makes a difference.
struct Range {
    double least, most;
};

template <class Part, class T>
SettingOption number(std::string name, T Part::*field, std::string help, Range range,
                     std::string unit = "N") {
    return {.name = std::move(name),
            .values = std::move(unit),
            .help = std::move(help),
            .least = range.least,
            .most = range.most,
            .whole = std::is_integral_v<T>,
            .set =
                [field](Settings& settings, std::string_view text) {
                    T value{};
                    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
                    if (error != std::errc{} || end != text.data() + text.size()) return false;
                    at(settings, field) = value;
                    return true;
                },
            .get =
                [field](const Settings& settings) {
                    char text[32];
                    return std::string(text,
                                       std::to_chars(text, text + sizeof(text), at(settings, field)).ptr);
                }};
}

template <class T, class Part>
SettingOption choice(std::string name, T Part::*field, std::string help,
                     std::vector<std::pair<std::string, T>> choices) {
    std::string list;
    for (const auto& [key, unused] : choices) list += (list.empty() ? "" : "|") + key;
    return {.name = std::move(name),
            .values = std::move(list),
            .help = std::move(help),
            .set =
                [field, choices](Settings& settings, std::string_view text) {
                    for (const auto& [key, value] : choices) {
                        if (key != text) continue;
                        at(settings, field) = value;
                        return true;
                    }
                    return false;
                },
            .get =
                [field, choices](const Settings& settings) {
                    for (const auto& [key, value] : choices)
                        if (value == at(settings, field)) return key;
                    return std::string("?");
                }};
}

template <class Part>
SettingOption onOff(std::string name, bool Part::*field, std::string help) {
    return choice<bool>(std::move(name), field, std::move(help), {{"on", true}, {"off", false}});
}

struct Mode {
    const char* name;
    DirectMode direct;
    IndirectMode indirect;
};
constexpr Mode kModes[] = {{"di", DirectMode::Restir, IndirectMode::Off},
                           {"nee", DirectMode::NextEvent, IndirectMode::Off},
                           {"gi", DirectMode::Restir, IndirectMode::Restir},
                           {"gi-only", DirectMode::Off, IndirectMode::Restir},
                           {"pt-plain", DirectMode::NextEvent, IndirectMode::Path},
                           {"pt-only", DirectMode::Off, IndirectMode::Path}};

const std::vector<std::pair<std::string, Weights>> kWeights = {{"off", Weights::Off},
                                                               {"basic", Weights::Basic},
                                                               {"balance", Weights::Balance},
                                                               {"pairwise", Weights::Pairwise},
                                                               {"plain", Weights::PairwisePlain}};

SettingOption modeOption() {
    std::string list;
    for (const Mode& mode : kModes) list += (list.empty() ? "" : "|") + std::string(mode.name);
    return {.name = "mode",
            .values = std::move(list),
            .help =
                "reservoirs for direct light (di), for indirect light, too (gi) or alone (gi-only); without: "
                "next-event "
                "estimation (nee), a plain path a pixel with it (pt-plain) or without direct light (pt-only)",
            .set =
                [](Settings& settings, std::string_view text) {
                    for (const Mode& mode : kModes) {
                        if (mode.name != text) continue;
                        settings.di.mode = mode.direct;
                        settings.gi.mode = mode.indirect;
                        return true;
                    }
                    return false;
                },
            .get = modeText};
}

std::string refusal(const SettingOption& option, std::string_view name, std::string_view text) {
    const bool listed = option.values.find('|') != std::string::npos;
    return std::string(name) + ": '" + std::string(text) + "' is " +
           (listed ? "none of " + option.values : "no number it can take");
}

// Replaces all settings, and so goes before the others.
const SettingOption& presetOption() {
    static const std::vector<std::pair<std::string, restir::Preset>> kPresets = {
        {"fast", restir::Preset::Fast},
        {"balanced", restir::Preset::Balanced},
        {"quality", restir::Preset::Quality},
        {"unbiased", restir::Preset::Unbiased}};
    static const SettingOption kOption = {.name = "preset",
                                          .values = "fast|balanced|quality|unbiased",
                                          .help = "settings to start from, instead of the defaults",
                                          .set =
                                              [](Settings& settings, std::string_view text) {
                                                  for (const auto& [key, preset] : kPresets) {
                                                      if (key != text) continue;
                                                      applyPreset(settings, preset);
                                                      return true;
                                                  }
                                                  return false;
                                              },
                                          .get = {}};
    return kOption;
}

}   // namespace

const std::vector<SettingOption>& settingOptions() {
    static const std::vector<SettingOption> kOptions = {
        modeOption(),
        number("bounces", &GiSettings::bounces,
               "scattering events of a path, where there is indirect light (3)", {2, 64}),
        number("gi-candidates", &GiSettings::lightCandidates,
               "light candidates at each vertex of a path but the first; one gets a shadow ray (4)",
               {1, 65536}),
        number("gi-max-history", &GiSettings::maxHistory,
               "frames that temporal reuse of indirect light may stand for, at most max-history (8)",
               {0, 1000}),
        number("gi-stale-history", &GiSettings::staleHistory,
               "what is left of the history of light scattered three times and more where lights change, 0 "
               "to 1 (0)",
               {0, 1}),
        onOff("gi-checkerboard", &GiSettings::checkerboard,
              "paths for half of the pixels a frame, the rest filled in, which blurs indirect light by a pixel (off)"),
        onOff("gi-half-resolution", &GiSettings::halfResolution,
              "paths for a quarter of the pixels a frame, filled in likewise (off)"),
        onOff("gi-paired-neighbours", &GiSettings::pairedNeighbours,
              "neighbours of indirect light in pairs that share rays and targets (off)"),
        onOff("gi-own-path", &GiSettings::ownPath,
              "smooth surfaces show some of their pixel's own path beside reused ones (on)"),
        number("gi-boiling-filter", &GiSettings::boilingFilter,
               "cuts outliers of indirect light back, 0 to 1: less noise, too dark (0: off)", {0, 1}),
        choice<Weights>("gi-weights", &GiSettings::weights,
                        "of indirect light, as those of direct light (plain)", kWeights),
        choice<Weights>(
            "weights", &DiSettings::weights,
            "resampling weights: off is biased, basic the noisiest, pairwise the quietest (pairwise)",
            kWeights),
        choice<VisibilityReuse>("visibility", &DiSettings::visibility,
                                "of reused samples: cached is too dark, none noisier (traced)",
                                {{"none", VisibilityReuse::None},
                                 {"cached", VisibilityReuse::Cached},
                                 {"traced", VisibilityReuse::Traced}}),
        number("candidates", &DiSettings::lightCandidates,
               "lights tried in a round; one of them gets a shadow ray (16)", {1, 65536}),
        number("tree-share", &DiSettings::treeShare,
               "of the lights tried, drawn by what they may bring to the surface (0.75)", {0, 0.9}),
        number("gi-tree-share", &GiSettings::treeShare, "the same at vertices of paths (0.75)", {0, 0.9}),
        number("initial-samples", &DiSettings::initialSamples,
               "rounds of light candidates per pixel, a shadow ray each (1)", {1, 8}),
        number("cut-samples", &DiSettings::cutSamples, "rounds in a frame without history, if more (4)",
               {1, 8}),
        number("bsdf-candidates", &DiSettings::bsdfCandidates,
               "directions tried per pixel, a ray each; 0 where nothing is glossy (1)", {0, 8}),
        onOff("temporal", &DiSettings::temporal, "reuse of the last frame's samples (on)"),
        number("max-history", &DiSettings::maxHistory, "frames that temporal reuse may stand for (20)",
               {0, 1000}),
        onOff("permute-history", &DiSettings::permuteHistory,
              "history of another pixel nearby: noise that a denoiser averages better, and more of it (off)"),
        number("spatial-passes", &DiSettings::spatialPasses, "passes of reuse from pixels around (1)",
               {0, 8}),
        number("neighbours", &DiSettings::neighbours, "of each spatial pass (5)", {1, 16}),
        onOff("fused", &DiSettings::fused, "temporal and spatial reuse in one pass (off)"),
        onOff("checkerboard", &DiSettings::checkerboard,
              "half of the pixels a frame, the rest filled in, which blurs light by a pixel (off)"),
        number("radius", &DiSettings::radius, "of spatial reuse, in pixels (30)", {0.1, 1e4}, "PX"),
        onOff("paired-neighbours", &DiSettings::pairedNeighbours,
              "neighbours in pairs that share rays and targets (off)"),
        number("normal-threshold", &DiSettings::normalThreshold,
               "least cosine between the normals of surfaces that share samples (0.9)", {-1, 1}),
        number("depth-threshold", &DiSettings::depthThreshold,
               "largest relative difference of their depths (0.1)", {1e-4, 10}),
        onOff("average", &DiSettings::averageShading,
              "shade the mean of all inputs where it can be had (on)"),
        number("boiling-filter", &DiSettings::boilingFilter,
               "cuts outliers back, 0 to 1: less noise, too dark (0: off)", {0, 1}),
    };
    return kOptions;
}

const SettingOption& settingOption(std::string_view name) {
    if (name == presetOption().name) return presetOption();
    std::string known = presetOption().name;
    for (const SettingOption& option : settingOptions()) {
        if (option.name == name) return option;
        known += " " + option.name;
    }
    throw std::runtime_error("'" + std::string(name) + "' is no setting, known: " + known);
}

void addSettingOptions(CLI::App& app, Settings& settings) {
    std::vector<const SettingOption*> options = {
        &presetOption()};   // CLI11 applies them in this order, whatever the line's
    for (const SettingOption& option : settingOptions()) options.push_back(&option);
    for (const SettingOption* each : options) {
        const SettingOption& option = *each;
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
        "--no-spatial", [&settings] { settings.di.spatialPasses = 0; }, "--spatial-passes 0");
}

void applyPreset(Settings& settings, restir::Preset preset) {
    const GiSettings before = settings.gi;
    settings.di = restir::presetSettings(preset);
    settings.gi = restir::presetIndirect(preset);
    settings.gi.mode = before.mode;
    settings.gi.bounces = before.bounces;
}

void reuseAlike(Settings& settings) {
    const DiSettings& di = settings.di;
    GiSettings& gi = settings.gi;
    if (di.visibility != VisibilityReuse::None) gi.visibility = di.visibility;
    gi.temporal = di.temporal;
    if (gi.mode != IndirectMode::Off) gi.maxHistory = std::min(gi.maxHistory, di.maxHistory);
    gi.spatialPasses = di.spatialPasses;
    gi.neighbours = di.neighbours;
    gi.radius = di.radius;
    gi.normalThreshold = di.normalThreshold;
    gi.depthThreshold = di.depthThreshold;
    gi.averageShading = di.averageShading;
}

std::string modeText(const Settings& settings) {
    for (const Mode& mode : kModes)
        if (settings.di.mode == mode.direct && settings.gi.mode == mode.indirect) return mode.name;
    return "?";
}

std::string settingsText(const Settings& settings) {
    const Settings defaults;
    const bool reuses = settings.di.mode == DirectMode::Restir || settings.gi.mode == IndirectMode::Restir;
    std::string text;
    for (const SettingOption& option : settingOptions()) {
        const bool always = reuses && (option.name == "weights" || option.name == "visibility");
        const std::string value = option.get(settings);
        if (!always && value == option.get(defaults)) continue;
        text += (text.empty() ? "" : " ") + option.name + "=" + value;
    }
    return text;
}

Settings parseSettings(std::string_view text, Settings base) {
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(' '));
        text.remove_prefix(std::min(text.size(), word.size() + 1));
        if (word.empty()) continue;
        const size_t equals = word.find('=');
        const SettingOption& option = settingOption(word.substr(0, equals));
        const std::string_view value = equals == std::string_view::npos ? "" : word.substr(equals + 1);
        if (!option.set(base, value)) throw std::runtime_error(refusal(option, option.name, value));
    }
    reuseAlike(base);
    return base;
}

void declareFor(const Settings& settings, restir::SessionDesc& desc) {
    if (settings.di.pairedNeighbours)
        desc.pairedNeighbours = std::max(desc.pairedNeighbours, settings.di.neighbours);
    if (settings.gi.mode != IndirectMode::Restir) return;
    desc.indirect = true;
    if (settings.gi.pairedNeighbours)
        desc.pairedNeighbours = std::max(desc.pairedNeighbours, settings.gi.neighbours);
}

}   // namespace samples
