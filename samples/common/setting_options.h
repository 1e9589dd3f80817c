// The one place where the samples name the fields of restir::Settings, for command lines and for texts such
// as "weights=pairwise visibility=traced radius=6".
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <restir/session.h>
#include <restir/settings.h>

namespace CLI {
class App;
}

namespace samples {

struct SettingOption {
    std::string name;     // --NAME on a command line, NAME=value in a text
    std::string values;   // what it takes: "N", "PX", "on|off", "a|b|c"
    std::string help;
    double least = 0, most = 0;   // of a number; both 0: of none
    bool whole = false;
    std::function<bool(restir::Settings&, std::string_view)> set;   // false: not one of `values`
    std::function<std::string(const restir::Settings&)> get;
};
// A new setting is one more line in setting_options.cpp. Those of reuse are direct light's.
const std::vector<SettingOption>& settingOptions();
// Throws std::runtime_error listing the known ones.
const SettingOption& settingOption(std::string_view name);

// --preset NAME, and an option --NAME for each of them that `app` has not got yet; on|off ones also as the
// flag --NAME or --no-NAME. `settings` must outlive the parsing. Call reuseAlike() after it.
void addSettingOptions(CLI::App& app, restir::Settings& settings);
// For direct and indirect light; whether there is indirect light, and of how many bounces, stays.
void applyPreset(restir::Settings& settings, restir::Preset preset);
// Says of indirect light's reuse what is said of direct light's, but for VisibilityReuse::None, which it does
// not have.
void reuseAlike(restir::Settings& settings);

std::string modeText(const restir::Settings& settings);   // the value of the option "mode"
// The weights, the visibility and whatever else is not the default; parseSettings() of it gives `settings`
// back.
std::string settingsText(const restir::Settings& settings);
// What `text` names is changed in `base`, for direct and indirect light alike; preset=NAME goes first
// (applyPreset()). Throws std::runtime_error naming what it cannot read.
restir::Settings parseSettings(std::string_view text, restir::Settings base = {});

// Adds to `desc` what a session must declare to be used with `settings`.
void declareFor(const restir::Settings& settings, restir::SessionDesc& desc);

}   // namespace samples
