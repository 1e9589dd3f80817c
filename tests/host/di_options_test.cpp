// What the samples call the settings: texts and command lines.
#include <gtest/gtest.h>

#include <set>

#include <CLI/CLI.hpp>

#include <common/di_options.h>

namespace tests {
namespace {

using restir::DiSettings;
using samples::diOptions;
using samples::diText;
using samples::parseDi;

// A value that the defaults do not have.
std::string another(const samples::DiOption& option) {
    const std::string now = option.get({});
    const size_t bar = option.values.find('|');
    if (bar == std::string::npos) return now == "7" ? "8" : "7";
    const std::string first = option.values.substr(0, bar);
    return first != now ? first : option.values.substr(bar + 1, option.values.find('|', bar + 1) - bar - 1);
}

DiSettings parseLine(const std::string& line) {
    DiSettings settings;
    CLI::App app;
    samples::addDiOptions(app, settings);
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

TEST(DiOptions, TextsAndBack) {
    EXPECT_EQ(diText({}), "weights=pairwise visibility=traced");
    EXPECT_EQ(diText(parseDi("radius=6  visibility=none")), "weights=pairwise visibility=none radius=6");
    EXPECT_EQ(diText(parseDi("mode=nee candidates=12")), "mode=nee candidates=12");
    EXPECT_EQ(parseDi("radius=6.25", parseDi("neighbours=3")).neighbours, 3u);
    std::string all;
    std::set<std::string> names;
    for (const samples::DiOption& option : diOptions()) {
        EXPECT_TRUE(names.insert(option.name).second) << option.name;
        all += option.name + "=" + another(option) + " ";
    }
    const DiSettings changed = parseDi(all);
    for (const samples::DiOption& option : diOptions()) {
        EXPECT_EQ(option.get(changed), another(option)) << option.name;
        EXPECT_EQ(option.get(parseDi(diText(parseDi(option.name + "=" + another(option))))), another(option))
            << option.name;
    }
}

TEST(DiOptions, CommandLines) {
    for (const samples::DiOption& option : diOptions()) {
        if (option.values == "on|off") {
            EXPECT_EQ(option.get(parseLine("--" + option.name)), "on");
            EXPECT_EQ(option.get(parseLine("--no-" + option.name)), "off");
        } else {
            EXPECT_EQ(option.get(parseLine("--" + option.name + " " + another(option))), another(option));
        }
    }
    EXPECT_EQ(parseLine("--no-spatial").spatialPasses, 0u);
}

TEST(DiOptions, PresetsAreWhatToStartFrom) {
    using restir::Preset;
    const std::pair<const char*, Preset> presets[] = {{"fast", Preset::Fast},
                                                      {"balanced", Preset::Balanced},
                                                      {"quality", Preset::Quality},
                                                      {"unbiased", Preset::Unbiased}};
    std::set<std::string> texts;
    for (const auto& [name, preset] : presets) {
        const DiSettings settings = restir::presetSettings(preset);
        const std::string text = diText(settings);
        EXPECT_TRUE(texts.insert(text).second) << name << " is like another";
        EXPECT_EQ(diText(parseDi(std::string("preset=") + name)), text);
        EXPECT_EQ(diText(parseDi(text)), text);
        EXPECT_EQ(diText(parseLine(std::string("--max-history 3 --preset ") + name)), diText(parseDi("max-history=3", settings)));
        restir::SessionDesc desc;
        samples::declareFor(settings, desc);
        EXPECT_LE(desc.pairedNeighbours, restir::kPresetPartners);
    }
    EXPECT_EQ(whatOf([] { parseDi("preset=best"); }), "preset: 'best' is none of fast|balanced|quality|unbiased");
}

TEST(DiOptions, RefusalsNameTheCulprit) {
    EXPECT_EQ(whatOf([] { parseDi("weights=best"); }),
              "weights: 'best' is none of off|basic|balance|pairwise|plain");
    EXPECT_EQ(whatOf([] { parseDi("radius=6px"); }), "radius: '6px' is no number it can take");
    EXPECT_EQ(whatOf([] { parseDi("neighbours"); }), "neighbours: '' is no number it can take");
    EXPECT_EQ(whatOf([] { parseDi("colour=red"); }).substr(0, 29), "'colour' is no setting, known");
    EXPECT_EQ(whatOf([] { parseLine("--candidates many"); }),
              "--candidates: 'many' is no number it can take");
}

}   // namespace
}   // namespace tests
