// The one place where the samples name the fields of restir::DiSettings, for command lines and for texts such
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

struct DiOption {
    std::string name;     // --NAME on a command line, NAME=value in a text
    std::string values;   // what it takes: "N", "PX", "on|off", "a|b|c"
    std::string help;
    std::function<bool(restir::DiSettings&, std::string_view)> set;   // false: not one of `values`
    std::function<std::string(const restir::DiSettings&)> get;
};
// A new setting is one more line in di_options.cpp.
const std::vector<DiOption>& diOptions();

// --preset NAME, and an option --NAME for each of them that `app` has not got yet; on|off ones also as the flag --NAME or
// --no-NAME. `settings` must outlive the parsing.
void addDiOptions(CLI::App& app, restir::DiSettings& settings);

// The weights, the visibility and whatever else is not the default; parseDi() of it gives `settings` back.
std::string diText(const restir::DiSettings& settings);
// What `text` names is changed in `base`; preset=NAME goes first, it replaces all. Throws std::runtime_error naming what it cannot read.
restir::DiSettings parseDi(std::string_view text, restir::DiSettings base = {});

// Adds to `desc` what a session must declare to be used with `settings`.
void declareFor(const restir::DiSettings& settings, restir::SessionDesc& desc);

}   // namespace samples
