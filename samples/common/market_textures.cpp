#include <algorithm>
#include <cmath>
#include <string_view>

#include "market.h"

namespace samples::build::market {

namespace {

constexpr uint32_t kCobbleSide = 1024, kCobbleRows = 36, kCobbleColumns = 26;

float smooth(float lo, float hi, float x) {
    const float t = std::clamp((x - lo) / (hi - lo), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

float cellRandom(uint32_t a, uint32_t b, uint32_t seed) {
    return static_cast<float>(hash(a + hash(b + hash(seed))) >> 8) * 0x1p-24f;
}

struct Stone {
    float height, shade;   // height in [0, 1]: 0 in the joints
    float puddle;          // 1: under water
};

// Rows of rounded stones, every second one shifted by half a stone; repeats at the borders.
Stone stoneAt(const glm::vec2& uv) {
    const float row = uv.y * kCobbleRows + 0.25f * (noise(uv * 13.0f, 13, 4) - 0.5f);
    const auto rowIndex = static_cast<uint32_t>(std::floor(row + kCobbleRows)) % kCobbleRows;
    const float shift = rowIndex % 2 == 0 ? 0.0f : 0.5f;
    const float column = uv.x * kCobbleColumns + shift + 0.3f * (noise(uv * 17.0f, 17, 5) - 0.5f);
    const auto columnIndex = static_cast<uint32_t>(std::floor(column + kCobbleColumns)) % kCobbleColumns;
    const glm::vec2 inside = glm::abs(glm::vec2{glm::fract(column), glm::fract(row)} * 2.0f - 1.0f);
    const float edge = std::pow(std::pow(inside.x, 6.0f) + std::pow(inside.y, 6.0f), 1 / 6.0f);
    const float tilt = cellRandom(columnIndex, rowIndex, 6);
    const float dome = smooth(1.0f, 0.72f, edge) * (0.75f + 0.25f * tilt) + 0.1f * (1 - edge);
    const float pool = smooth(0.5f, 0.58f, fractalNoise(uv, 3, 77));
    const float grain = 0.06f * fractalNoise(uv, 96, 8);
    return {std::clamp(dome + grain, 0.0f, 1.1f), cellRandom(columnIndex, rowIndex, 7), pool};
}

// The surface seen: water levels out whatever lies below it.
float surfaceHeight(const Stone& stone) {
    return glm::mix(stone.height, std::max(stone.height, 0.9f), stone.puddle);
}

float segmentDistance(const glm::vec2& p, const glm::vec2& a, const glm::vec2& b) {
    const glm::vec2 along = b - a, offset = p - a;
    const float t = std::clamp(glm::dot(offset, along) / std::max(glm::dot(along, along), 1e-6f), 0.0f, 1.0f);
    return glm::length(offset - along * t);
}

// Strokes of a letter on a grid of 3 x 5 points; each digit pair is a point, blanks part the strokes.
std::string_view strokes(char letter) {
    switch (letter) {
        case 'A':
            return "0003142320 0222";
        case 'B':
            return "0004142312 0212 12211000";
        case 'C':
            return "241403011020";
        case 'D':
            return "00041423211000";
        case 'E':
            return "24040020 0212";
        case 'F':
            return "240400 0212";
        case 'I':
            return "1014";
        case 'K':
            return "0004 2402 0220";
        case 'L':
            return "040020";
        case 'N':
            return "00042024";
        case 'O':
            return "01031423211001";
        case 'P':
            return "000414231202";
        case 'R':
            return "000414231202 1220";
        case 'S':
            return "241403211000";
        case 'T':
            return "0424 1410";
        case 'U':
            return "0401102124";
        default:
            return "";
    }
}

float letterDistance(std::string_view letter, const glm::vec2& p) {
    float nearest = 1e3f;
    const auto point = [&](size_t i) { return glm::vec2{letter[i] - '0', letter[i + 1] - '0'}; };
    for (size_t i = 0; i + 3 < letter.size(); i += 2) {
        if (letter[i + 2] == ' ') {
            ++i;
            continue;
        }
        nearest = std::min(nearest, segmentDistance(p, point(i), point(i + 2)));
    }
    return nearest;
}

glm::vec4 gray(float value) { return {value, value, value, 1}; }

}   // namespace

GroundImages paintCobbles() {
    std::vector<Stone> stones(size_t{kCobbleSide} * kCobbleSide);
    for (uint32_t y = 0; y < kCobbleSide; ++y)
        for (uint32_t x = 0; x < kCobbleSide; ++x)
            stones[y * kCobbleSide + x] = stoneAt((glm::vec2(x, y) + 0.5f) / static_cast<float>(kCobbleSide));
    const auto at = [&](const glm::vec2& uv, uint32_t dx, uint32_t dy) -> const Stone& {
        const uint32_t x = static_cast<uint32_t>(uv.x * kCobbleSide) + dx,
                       y = static_cast<uint32_t>(uv.y * kCobbleSide) + dy;
        return stones[(y % kCobbleSide) * kCobbleSide + x % kCobbleSide];
    };
    constexpr uint32_t kBack = kCobbleSide - 1;
    GroundImages images;
    images.color = paint(kCobbleSide, kCobbleSide, true, [&](const glm::vec2& uv) {
        const Stone& stone = at(uv, 0, 0);
        const glm::vec3 dry = glm::mix(hex(0x5b5550), hex(0x8a7d70), stone.shade);
        const glm::vec3 color = dry * glm::mix(0.25f, 1.0f, std::min(stone.height, 1.0f));
        return glm::vec4{color * glm::mix(0.75f, 0.4f, stone.puddle), 1};
    });
    images.roughness = paint(kCobbleSide, kCobbleSide, false, [&](const glm::vec2& uv) {
        const Stone& stone = at(uv, 0, 0);
        const float damp = glm::mix(0.62f, 0.26f + 0.16f * stone.shade, std::min(stone.height, 1.0f));
        return glm::vec4{0, glm::mix(damp, 0.07f, stone.puddle), 0, 1};
    });
    images.normal = paint(kCobbleSide, kCobbleSide, false, [&](const glm::vec2& uv) {
        constexpr float kSteepness = 1.6f;
        const float right = surfaceHeight(at(uv, 1, 0)) - surfaceHeight(at(uv, kBack, 0));
        const float up = surfaceHeight(at(uv, 0, kBack)) - surfaceHeight(at(uv, 0, 1));
        const glm::vec3 normal = glm::normalize(glm::vec3{-kSteepness * right, -kSteepness * up, 1});
        return glm::vec4{normal * 0.5f + 0.5f, 1};
    });
    return images;
}

Image paintPlaster() {
    return paint(512, 512, true, [](const glm::vec2& uv) {
        const float stain = smooth(0.45f, 0.75f, fractalNoise(uv, 4, 12));
        return gray(0.72f + 0.28f * fractalNoise(uv, 32, 13) - 0.3f * stain);
    });
}

Image paintPlanks() {
    return paint(256, 256, true, [](const glm::vec2& uv) {
        constexpr float kPlanks = 6;
        const auto plank = static_cast<uint32_t>(uv.y * kPlanks);
        const float joint = std::abs(glm::fract(uv.y * kPlanks) - 0.5f) * 2;
        const float fibre = noise({uv.x * 4, uv.y * 64}, 64, plank);
        return gray((0.6f + 0.25f * cellRandom(plank, 0, 3) + 0.25f * fibre) * (joint > 0.94f ? 0.3f : 1.0f));
    });
}

Image paintStripes(const glm::vec3& a, const glm::vec3& b) {
    return paint(128, 64, true, [&](const glm::vec2& uv) {
        const bool first = glm::fract(uv.x * 4) < 0.5f;
        return glm::vec4{(first ? a : b) * (0.8f + 0.2f * fractalNoise(uv, 8, 14)), 1};
    });
}

// Curtains at the sides, a lamp's glow in the middle, here and there a plant's outline.
Image paintWindow(uint32_t seed) {
    return paint(96, 128, true, [seed](const glm::vec2& uv) {
        const float side = std::abs(uv.x - 0.5f) * 2;
        const float drawn = 0.45f + 0.35f * cellRandom(seed, 1, 2) + 0.12f * uv.y;
        const float folds = 0.75f + 0.25f * std::sin(uv.x * 60 + static_cast<float>(seed));
        const float glow =
            0.35f + 0.65f * std::exp(-6 * glm::dot(uv - glm::vec2{0.45f, 0.3f}, uv - glm::vec2{0.45f, 0.3f}));
        const float curtain = smooth(drawn - 0.03f, drawn + 0.03f, side);
        const float plant =
            smooth(0.05f, -0.02f,
                   uv.y - 1.05f + 0.35f * fractalNoise(uv + 0.1f * static_cast<float>(seed), 6, seed));
        const float light =
            glm::mix(glow, 0.4f * folds * glow + 0.12f, curtain) * glm::mix(0.25f, 1.0f, plant);
        return glm::vec4{glm::mix(glm::vec3{1, 0.86f, 0.7f}, glm::vec3{1, 0.62f, 0.4f}, curtain) * light, 1};
    });
}

// Shelves of jars and boxes, dark before a back wall with pools of lamplight.
Image paintShop(uint32_t seed) {
    return paint(256, 160, true, [seed](const glm::vec2& uv) {
        constexpr float kShelves = 3, kSlots = 18, kLamps = 4;
        const auto shelf = static_cast<uint32_t>(uv.y * kShelves),
                   slot = static_cast<uint32_t>(uv.x * kSlots);
        const glm::vec2 in{glm::fract(uv.x * kSlots), glm::fract(uv.y * kShelves)};
        const glm::vec2 lamp{(glm::fract(uv.x * kLamps) - 0.5f) / kLamps * 2.5f, uv.y - 0.1f};
        const float wall = 0.18f + 0.82f * std::exp(-7 * glm::dot(lamp, lamp));
        if (in.y > 0.93f) return gray(0.06f);
        const float above = in.y - 1 + 0.2f + 0.5f * cellRandom(slot, shelf, seed);
        const float neck = above < 0.16f && cellRandom(slot, shelf, 9) < 0.6f ? 0.12f : 0.36f;
        if (above < 0 || std::abs(in.x - 0.5f) > neck) return glm::vec4{glm::vec3{1, 0.82f, 0.58f} * wall, 1};
        const glm::vec3 tint{cellRandom(slot, shelf, 3), cellRandom(slot, shelf, 4),
                             cellRandom(slot, shelf, 5)};
        return glm::vec4{glm::mix(glm::vec3{0.35f, 0.18f, 0.07f}, tint, 0.35f) * (0.1f + 0.3f * wall), 1};
    });
}

Image paintNeon(std::string_view word) {
    constexpr float kAdvance = 3, kMargin = 1.1f;
    const float width = kAdvance * static_cast<float>(word.size()) - 1 + 2 * kMargin,
                height = 4 + 2 * kMargin;
    return paint(384, 128, true, [&](const glm::vec2& uv) {
        const glm::vec2 p{uv.x * width - kMargin, (1 - uv.y) * height - kMargin};
        float distance = 1e3f;
        for (size_t i = 0; i < word.size(); ++i)
            distance = std::min(distance, letterDistance(strokes(word[i]),
                                                         p - glm::vec2{kAdvance * static_cast<float>(i), 0}));
        const glm::vec2 edge = glm::min(p + 0.75f, glm::vec2{width - kMargin, height - kMargin} - 0.35f - p);
        distance = std::min(distance, std::abs(std::min(edge.x, edge.y)) + 0.05f);
        return gray(smooth(0.24f, 0.1f, distance) + 0.05f * std::exp(-2.5f * distance));
    });
}

Image paintClock() {
    return paint(256, 256, true, [](const glm::vec2& uv) {
        const glm::vec2 p = (uv - 0.5f) * glm::vec2{2, -2};
        const float radius = glm::length(p), angle = std::atan2(p.x, p.y) / (2 * kPi);
        const float mark = std::abs(glm::fract(angle * 12 + 0.5f) - 0.5f) * radius;
        const bool dial = radius > 0.72f && radius < 0.88f && mark < 0.2f;
        const bool hands = segmentDistance(p, {0, 0}, {-0.36f, 0.28f}) < 0.05f ||
                           segmentDistance(p, {0, 0}, {0.3f, 0.62f}) < 0.03f;
        if (radius > 0.97f) return gray(0);
        return gray(dial || hands || radius > 0.93f ? 0.02f : 1 - 0.25f * radius);
    });
}

Image paintGate() {
    return paint(128, 192, true, [](const glm::vec2& uv) {
        const glm::vec2 p{(uv.x - 0.5f) * 2, (1 - uv.y) * 3};
        const bool open = p.y < 2 ? std::abs(p.x) < 0.94f : glm::length(p - glm::vec2{0, 2}) < 0.94f;
        return open ? gray(0.35f + 0.65f * std::exp(-0.9f * p.y)) : gray(0);
    });
}

Image paintLantern() {
    return paint(32, 64, true, [](const glm::vec2& uv) {
        const float rib = std::abs(glm::fract(uv.y * 9) - 0.5f) < 0.09f ? 0.45f : 1.0f;
        const float cap = smooth(0.03f, 0.12f, uv.y) * smooth(0.97f, 0.88f, uv.y);
        return gray(rib * cap * (0.45f + 0.55f * std::sin(kPi * uv.y)));
    });
}

Image paintFoliage(const glm::vec3& leaf, const glm::vec3& tip) {
    constexpr uint32_t kLeaves = 22;
    return paint(128, 128, true, [&](const glm::vec2& uv) {
        glm::vec4 color{leaf, 0};
        for (uint32_t i = 0; i < kLeaves; ++i) {
            const glm::vec2 centre{0.14f + 0.72f * cellRandom(i, 0, 41),
                                   0.14f + 0.72f * cellRandom(i, 1, 41)};
            const float turn = 2 * kPi * cellRandom(i, 2, 41);
            const glm::vec2 d = uv - centre;
            const glm::vec2 local{d.x * std::cos(turn) + d.y * std::sin(turn),
                                  d.y * std::cos(turn) - d.x * std::sin(turn)};
            const float inside = glm::length(local / glm::vec2{0.12f, 0.055f});
            if (inside > 1) continue;
            const float vein = std::abs(local.y) < 0.006f ? 0.7f : 1.0f;
            color = {glm::mix(leaf, tip, cellRandom(i, 3, 41)) * vein * (1.1f - 0.4f * inside), 1};
        }
        return color;
    });
}

// Wrought iron: diamonds with rings where they cross, rails at top and bottom.
Image paintLattice() {
    return paint(128, 128, true, [](const glm::vec2& uv) {
        const glm::vec2 turned{uv.x + uv.y, uv.x - uv.y + 1};
        const glm::vec2 bars = glm::abs(glm::fract(turned * 2.0f) - 0.5f);
        const glm::vec2 cell = glm::fract(turned * 2.0f) - 0.5f;
        const bool ring = std::abs(glm::length(cell) - 0.28f) < 0.05f;
        const bool rail = uv.y < 0.07f || uv.y > 0.93f;
        const bool iron = rail || ring || std::min(0.5f - bars.x, 0.5f - bars.y) < 0.05f;
        return glm::vec4{glm::vec3{0.25f}, iron ? 1.0f : 0.0f};
    });
}

}   // namespace samples::build::market
