#include "builtin.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace samples {

namespace {

constexpr std::string_view kBuiltinPrefix = "builtin:";
constexpr uint64_t kMaxStreetTriangles = 200'000'000;

[[noreturn]] void fail(std::string_view name, const std::string& what) {
    throw std::runtime_error("builtin:" + std::string{name} + ": " + what);
}

uint64_t parseCount(std::string_view name, std::string_view key, std::string_view text) {
    uint64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end) fail(name, std::string{key} + " must be a whole number");
    if (value > kMaxStreetTriangles)
        fail(name, std::string{key} + " must be at most " + std::to_string(kMaxStreetTriangles));
    return value;
}

// "key=value&...": calls `take` with both of each.
template <class Take>
void eachParameter(std::string_view query, const Take& take) {
    while (!query.empty()) {
        const std::string_view pair = query.substr(0, query.find('&'));
        query.remove_prefix(std::min(query.size(), pair.size() + 1));
        const size_t equals = pair.find('=');
        take(pair.substr(0, equals), equals == std::string_view::npos ? "" : pair.substr(equals + 1));
    }
}

build::StreetSize parseStreet(std::string_view name, std::string_view query) {
    build::StreetSize size;
    eachParameter(query, [&](std::string_view key, std::string_view value) {
        if (key == "triangles")
            size.triangles = parseCount(name, key, value);
        else if (key == "emissive")
            size.emissive = parseCount(name, key, value);
        else
            fail(name, "unknown key '" + std::string{key} + "', known: triangles, emissive");
    });
    if (size.triangles == 0) fail(name, "triangles must be at least 1");
    if (size.emissive > size.triangles) fail(name, "more emissive triangles than triangles");
    return size;
}

std::string_view parseLamps(std::string_view name, std::string_view query) {
    std::string_view kind = "all";
    eachParameter(query, [&](std::string_view key, std::string_view value) {
        if (key != "kind") fail(name, "unknown key '" + std::string{key} + "', known: kind");
        kind = value;
    });
    return kind;
}

constexpr struct {
    std::string_view name;
    SceneData (*make)();
} kScenes[] = {{"cornell", build::makeCornell},
               {"rooms", build::makeRooms},
               {"market", build::makeMarket},
               {"city", build::makeCity}};   // without parameters

}   // namespace

SceneData makeBuiltin(std::string_view name) {
    const size_t mark = name.find('?');
    const std::string_view kind = name.substr(0, mark);
    const std::string_view query = mark == std::string_view::npos ? "" : name.substr(mark + 1);
    if (kind == "street") return build::makeStreet(parseStreet(name, query));
    if (kind == "lamps") return build::makeLamps(parseLamps(name, query));
    const auto* scene = std::find_if(std::begin(kScenes), std::end(kScenes), [&](const auto& s) { return s.name == kind; });
    if (scene == std::end(kScenes)) fail(name, "unknown, known: cornell, rooms, market, city, street, lamps");
    if (!query.empty()) fail(name, "takes no parameters, got '" + std::string{query} + "'");
    return scene->make();
}

SceneData loadScene(const std::string& nameOrPath, std::vector<std::string>& warnings) {
    if (nameOrPath.starts_with(kBuiltinPrefix))
        return makeBuiltin(std::string_view{nameOrPath}.substr(kBuiltinPrefix.size()));
    return loadGltf(nameOrPath, warnings);
}

}   // namespace samples
