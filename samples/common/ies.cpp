#include "common/ies.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace samples {
namespace {

constexpr uint32_t kWidth = 128, kHeight = 128;   // of the image
constexpr size_t kMostAngles = 4096;              // of either kind

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error("IES profile: " + what); }

// Numbers are apart by blanks, commas and ends of lines.
class Numbers {
public:
    explicit Numbers(std::string_view text) : rest_(text) {}

    double next(const char* name) {
        constexpr std::string_view blanks = " \t\r\n,";
        rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
        std::string_view word = rest_.substr(0, rest_.find_first_of(blanks));
        rest_.remove_prefix(word.size());
        if (word.starts_with('+')) word.remove_prefix(1);
        double value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (word.empty()) fail(std::string("ends before ") + name);
        if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
            fail(std::string(name) + " is '" + std::string(word.substr(0, 32)) + "', no number");
        return value;
    }
    size_t count(const char* name) {
        const double value = next(name);
        if (!(value >= 1 && value <= double(kMostAngles) && value == std::floor(value)))
            fail(std::string(name) + " is " + std::to_string(value) + ", must be 1 to " +
                 std::to_string(kMostAngles));
        return static_cast<size_t>(value);
    }
    std::vector<double> ascending(size_t count, const char* name) {
        std::vector<double> values;
        for (size_t i = 0; i < count; ++i) {
            values.push_back(next(name));
            if (i > 0 && !(values[i] > values[i - 1])) fail(std::string(name) + " do not ascend");
        }
        return values;
    }

private:
    std::string_view rest_;
};

// The line that begins with TILT=, which is what it is set to; `text` goes on behind it.
std::string_view takeTilt(std::string_view& text) {
    constexpr std::string_view key = "TILT=";
    size_t at = text.find(key);
    while (at != std::string_view::npos && at > 0 && text[at - 1] != '\n' && text[at - 1] != '\r')
        at = text.find(key, at + 1);
    if (at == std::string_view::npos) fail("no line TILT=");
    text.remove_prefix(at + key.size());
    std::string_view tilt = text.substr(0, text.find_first_of("\r\n"));
    text.remove_prefix(tilt.size());
    return tilt.substr(0, tilt.find_last_not_of(" \t") + 1);
}

// Of how a lamp's output depends on its position, which is not used.
void skipTilt(Numbers& numbers) {
    numbers.next("the lamp's position");
    const size_t pairs = numbers.count("the number of tilt angles");
    for (size_t i = 0; i < 2 * pairs; ++i) numbers.next("a tilt angle or factor");
}

struct Web {
    std::vector<double> vertical, horizontal;   // degrees
    std::vector<double> candela;                // [horizontal][vertical]

    double at(double h, double v) const;
};

// What a sorted list has around a value: the element below, and how far it is to the next one.
struct Between {
    size_t below;
    double share;
};
Between find(const std::vector<double>& values, double value) {
    if (values.size() == 1 || value <= values.front()) return {0, 0};
    if (value >= values.back()) return {values.size() - 2, 1};
    const auto above = std::upper_bound(values.begin(), values.end(), value);
    const auto below = static_cast<size_t>(above - values.begin()) - 1;
    return {below, (value - values[below]) / (values[below + 1] - values[below])};
}

// `h` in [0, 360). A web that ends earlier is mirrored; nothing shines beyond the vertical angles.
double Web::at(double h, double v) const {
    if (v < vertical.front() || v > vertical.back()) return 0;
    const double first = horizontal.front(), last = horizontal.back();
    if (first == 0 && last == 90) h = h > 180 ? 360 - h : h;
    if (first == 0 && last == 90 && h > 90) h = 180 - h;
    if (first == 0 && last == 180 && h > 180) h = 360 - h;
    if (first == 90 && h < 90) h = 180 - h;
    if (first == 90 && h > 270) h = 540 - h;
    const auto [i, x] = find(horizontal, h);
    const auto [j, y] = find(vertical, v);
    // Named anew for clang 14, which captures no structured bindings.
    const auto value = [&, row = i, column = j](size_t di, size_t dj) {
        return candela[std::min(row + di, horizontal.size() - 1) * vertical.size() +
                       std::min(column + dj, vertical.size() - 1)];
    };
    return (1 - x) * ((1 - y) * value(0, 0) + y * value(0, 1)) +
           x * ((1 - y) * value(1, 0) + y * value(1, 1));
}

Web readWeb(Numbers& numbers) {
    numbers.next("the number of lamps");
    numbers.next("lumens per lamp");
    const double multiplier = numbers.next("the candela multiplier");
    Web web;
    const size_t verticals = numbers.count("the number of vertical angles");
    const size_t horizontals = numbers.count("the number of horizontal angles");
    if (const double type = numbers.next("the photometric type"); type != 1)
        fail("photometric type " + std::to_string(int(std::clamp(type, -99.0, 99.0))) +
             " is not supported, only C, 1");
    for (const char* name : {"units", "width", "length", "height"}) numbers.next(name);
    const double ballast = numbers.next("the ballast factor");
    for (const char* name : {"the file generation type", "input watts"}) numbers.next(name);
    web.vertical = numbers.ascending(verticals, "vertical angles");
    web.horizontal = numbers.ascending(horizontals, "horizontal angles");
    const double first = web.horizontal.front(), last = web.horizontal.back();
    const bool known = horizontals == 1 || (first == 0 && (last == 90 || last == 180 || last == 360)) ||
                       (first == 90 && last == 270);
    if (!known) fail("horizontal angles run from " + std::to_string(first) + " to " + std::to_string(last));
    if (web.vertical.front() < 0 || web.vertical.back() > 180) fail("vertical angles are beyond 0 to 180");
    for (size_t i = 0; i < verticals * horizontals; ++i) {
        web.candela.push_back(numbers.next("candela values") * multiplier * ballast);
        if (!(web.candela.back() >= 0 && web.candela.back() < 1e12))
            fail("a candela value is negative or beyond 1e12");
    }
    return web;
}

}   // namespace

PhotometricProfile readIes(std::string_view text) {
    if (!text.starts_with("IES")) fail("does not begin with IESNA: or IES:");
    const std::string_view tilt = takeTilt(text);
    Numbers numbers(text);
    if (tilt == "INCLUDE") skipTilt(numbers);
    const Web web = readWeb(numbers);
    PhotometricProfile profile{.image = {.width = kWidth, .height = kHeight}};
    profile.peak = static_cast<float>(*std::max_element(web.candela.begin(), web.candela.end()));
    double sum = 0, sphere = 0;
    for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < kWidth; ++x) {
            const double v = (y + 0.5) / kHeight, h = (x + 0.5) / kWidth;
            const double share = profile.peak > 0 ? web.at(360 * h, 180 * v) / double(profile.peak) : 0;
            const auto byte = static_cast<uint8_t>(std::lround(255 * share));
            profile.image.rgba.insert(profile.image.rgba.end(), {byte, byte, byte, 255});
            const double ring = std::sin(std::numbers::pi * v);
            sum += ring * byte / 255;
            sphere += ring;
        }
    profile.mean = static_cast<float>(sum / sphere);
    return profile;
}

}   // namespace samples
