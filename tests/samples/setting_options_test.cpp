// What the samples call the settings: texts and command lines.
#include <gtest/gtest.h>

#include <set>

#include <CLI/CLI.hpp>

#include <common/setting_options.h>

namespace tests {
namespace {

using restir::Settings;
using samples::parseSettings;
using samples::settingOptions;
using samples::settingsText;

// A value that the defaults do not have.
std::string another(const samples::SettingOption& option) {
    const std::string now = option.get({});
    const size_t bar = option.values.find('|');
    if (bar == std::string::npos) return now == "7" ? "8" : "7";
    const std::string first = option.values.substr(0, bar);
    return first != now ? first : option.values.substr(bar + 1, option.values.find('|', bar + 1) - bar - 1);
}

Settings parseLine(const std::string& line) {
    Settings settings;
    CLI::App app;
    samples::addSettingOptions(app, settings);
    app.parse(line);
    return settings;
}

std::string whatOf(const std::function<void()>& thrower) {
    try {
        thrower();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

TEST(SettingOptions, TextsAndBack) {
    EXPECT_EQ(settingsText({}), "weights=pairwise visibility=traced");
    EXPECT_EQ(settingsText(parseSettings("radius=6  visibility=none")),
              "weights=pairwise visibility=none radius=6");
    EXPECT_EQ(settingsText(parseSettings("mode=nee candidates=12")), "mode=nee candidates=12");
    EXPECT_EQ(parseSettings("radius=6.25", parseSettings("neighbours=3")).di.neighbours, 3u);
    std::string all;
    std::set<std::string> names;
    for (const samples::SettingOption& option : settingOptions()) {
        EXPECT_TRUE(names.insert(option.name).second) << option.name;
        all += option.name + "=" + another(option) + " ";
    }
    const Settings changed = parseSettings(all);
    for (const samples::SettingOption& option : settingOptions()) {
        EXPECT_EQ(option.get(changed), another(option)) << option.name;
        EXPECT_EQ(option.get(parseSettings(settingsText(parseSettings(option.name + "=" + another(option))))),
                  another(option))
            << option.name;
    }
}

TEST(SettingOptions, CommandLines) {
    for (const samples::SettingOption& option : settingOptions()) {
        if (option.values == "on|off") {
            EXPECT_EQ(option.get(parseLine("--" + option.name)), "on");
            EXPECT_EQ(option.get(parseLine("--no-" + option.name)), "off");
        } else {
            EXPECT_EQ(option.get(parseLine("--" + option.name + " " + another(option))), another(option));
        }
    }
    EXPECT_EQ(parseLine("--no-spatial").di.spatialPasses, 0u);
}

TEST(SettingOptions, PresetsAreWhatToStartFrom) {
    using restir::Preset;
    const std::pair<const char*, Preset> presets[] = {{"fast", Preset::Fast},
                                                      {"balanced", Preset::Balanced},
                                                      {"quality", Preset::Quality},
                                                      {"unbiased", Preset::Unbiased}};
    std::set<std::string> texts;
    for (const auto& [name, preset] : presets) {
        Settings settings;
        samples::applyPreset(settings, preset);
        const std::string text = settingsText(settings);
        EXPECT_TRUE(texts.insert(text).second) << name << " is like another";
        EXPECT_EQ(settingsText(parseSettings(std::string("preset=") + name)), text);
        EXPECT_EQ(settingsText(parseSettings(text)), text);
        EXPECT_EQ(settingsText(parseLine(std::string("--max-history 3 --preset ") + name)),
                  settingsText(parseSettings("max-history=3", settings)));
        restir::SessionDesc desc;
        samples::declareFor(settings, desc);
        EXPECT_LE(desc.pairedNeighbours, restir::kPresetPartners);
    }
    EXPECT_EQ(whatOf([] { parseSettings("preset=best"); }),
              "preset: 'best' is none of fast|balanced|quality|unbiased");
}

TEST(SettingOptions, RefusalsNameTheCulprit) {
    EXPECT_EQ(whatOf([] { parseSettings("weights=best"); }),
              "weights: 'best' is none of off|basic|balance|pairwise|plain");
    EXPECT_EQ(whatOf([] { parseSettings("radius=6px"); }), "radius: '6px' is no number it can take");
    EXPECT_EQ(whatOf([] { parseSettings("neighbours"); }), "neighbours: '' is no number it can take");
    EXPECT_EQ(whatOf([] { parseSettings("colour=red"); }).substr(0, 29), "'colour' is no setting, known");
    EXPECT_EQ(whatOf([] { parseLine("--candidates many"); }),
              "--candidates: 'many' is no number it can take");
}

}   // namespace
}   // namespace tests
