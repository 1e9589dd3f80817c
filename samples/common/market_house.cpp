#include <algorithm>
#include <cmath>

#include "market.h"

namespace samples::build::market {

namespace {

constexpr float kShopHeight = 3.5f, kFloorHeight = 2.9f, kReveal = 0.22f, kDepth = 6;

struct Rect {
    float x0, y0, x1, y1;
    float width() const { return x1 - x0; }
    float height() const { return y1 - y0; }
};

void addWallRect(Geometry& wall, const Rect& r, float z = 0) {
    if (r.width() <= 0 || r.height() <= 0) return;
    constexpr float kMetresPerTile = 4;
    addPatch(wall, {.origin = {r.x0, r.y0, z},
                    .u = {r.width(), 0, 0},
                    .v = {0, r.height(), 0},
                    .uvScale = {r.width() / kMetresPerTile, r.height() / kMetresPerTile},
                    .uvOffset = {r.x0 / kMetresPerTile, -r.y1 / kMetresPerTile}});
}

// The part of a facade inside `cell` around the opening `hole`, with the hole's four inner sides.
void addWallAround(Geometry& wall, const Rect& cell, const Rect& hole) {
    addWallRect(wall, {cell.x0, cell.y0, hole.x0, cell.y1});
    addWallRect(wall, {hole.x1, cell.y0, cell.x1, cell.y1});
    addWallRect(wall, {hole.x0, cell.y0, hole.x1, hole.y0});
    addWallRect(wall, {hole.x0, hole.y1, hole.x1, cell.y1});
    const glm::vec3 x{hole.width(), 0, 0}, y{0, hole.height(), 0}, z{0, 0, kReveal};
    const glm::vec3 corner{hole.x0, hole.y0, -kReveal};
    addPatch(wall, {.origin = corner, .u = z, .v = y});
    addPatch(wall, {.origin = corner + x + z, .u = -z, .v = y});
    addPatch(wall, {.origin = corner + z, .u = x, .v = -z});
    addPatch(wall, {.origin = corner + y, .u = x, .v = z});
}

void addFrame(Geometry& frame, const Rect& hole, uint32_t columns, uint32_t rows) {
    constexpr float kBar = 0.035f, kBack = -kReveal, kFront = -kReveal + 0.07f;
    const auto bar = [&](float x0, float y0, float x1, float y1) {
        addBox(frame, {x0 - kBar, y0 - kBar, kBack}, {x1 + kBar, y1 + kBar, kFront});
    };
    for (uint32_t i = 0; i <= columns; ++i) {
        const float x = glm::mix(hole.x0, hole.x1, static_cast<float>(i) / static_cast<float>(columns));
        bar(x, hole.y0, x, hole.y1);
    }
    for (uint32_t i = 0; i <= rows; ++i) {
        const float y = glm::mix(hole.y0, hole.y1, static_cast<float>(i) / static_cast<float>(rows));
        bar(hole.x0, y, hole.x1, y);
    }
}

void addPane(Geometry& pane, const Rect& hole, uint32_t columns, uint32_t rows) {
    addPatch(pane, {.origin = {hole.x0, hole.y0, 0.01f - kReveal},
                    .u = {hole.width(), 0, 0},
                    .v = {0, hole.height(), 0},
                    .columns = columns,
                    .rows = rows});
}

class HouseBuilder {
public:
    HouseBuilder(const Materials& materials, const House& house)
        : m_(materials), house_(house), rng_(house.seed), wall_(m_.walls[rng_.below(6)]) {}

    uint32_t build(SceneData& scene) {
        addShop();
        for (uint32_t floor = 0; floor < house_.floors; ++floor) addFloor(floor);
        addBody();
        addSign();
        if (rng_.uniform() < 0.45f) addIvy();
        return parts_.addTo(scene);
    }

private:
    void addShop() {
        const float w = house_.width, door = rng_.uniform() < 0.5f ? 0.4f : w - 1.5f;
        const bool doorLeft = door < w / 2;
        const float split = doorLeft ? door + 1.3f : door - 0.2f;
        const Rect doorHole{door, 0.1f, door + 1.1f, 2.45f};
        const Rect shopHole{doorLeft ? split + 0.25f : 0.4f, 0.75f, doorLeft ? w - 0.4f : split - 0.25f,
                            2.6f};
        const Rect doorCell{doorLeft ? 0 : split, 0, doorLeft ? split : w, kShopHeight};
        const Rect shopCell{doorLeft ? split : 0, 0, doorLeft ? w : split, kShopHeight};
        const bool open = rng_.uniform() < 0.72f;
        const uint32_t front = m_.doors[rng_.below(3)];
        addWallAround(parts_.of(wall_), doorCell, doorHole);
        addWallAround(parts_.of(front), shopCell, shopHole);
        addPane(parts_.of(open ? m_.shops[rng_.below(3)] : m_.glass), shopHole, 6, 2);
        addFrame(parts_.of(front), shopHole, 4, 1);
        addBox(parts_.of(m_.trim), {shopHole.x0 - 0.15f, 0.62f, -0.05f}, {shopHole.x1 + 0.15f, 0.72f, 0.2f});
        addDoor(doorHole, front);
        addAwning(shopHole);
        addBox(parts_.of(m_.trim), {0, kShopHeight - 0.12f, 0}, {w, kShopHeight, 0.14f});
    }

    void addDoor(const Rect& hole, uint32_t front) {
        addBox(parts_.of(front), {hole.x0, hole.y0, -kReveal}, {hole.x1, hole.y1 - 0.45f, 0.05f - kReveal});
        const Rect light{hole.x0, hole.y1 - 0.45f, hole.x1, hole.y1};
        addPane(parts_.of(rng_.uniform() < 0.6f ? m_.windows[rng_.below(3)] : m_.glass), light, 1, 1);
        addFrame(parts_.of(front), light, 3, 1);
        addSphere(parts_.of(m_.brass), {hole.x1 - 0.15f, 1.15f, 0.08f - kReveal}, glm::vec3{0.045f}, 8, 6);
        addBox(parts_.of(m_.paving), {hole.x0 - 0.1f, 0, -kReveal}, {hole.x1 + 0.1f, hole.y0, 0.3f});
    }

    void addAwning(const Rect& hole) {
        constexpr float kTop = 3.1f, kFront = 2.55f, kReach = 1.15f, kHem = 0.22f;
        Geometry& awning = parts_.of(m_.awnings[rng_.below(4)]);
        const float x0 = hole.x0 - 0.2f, width = hole.width() + 0.4f;
        const glm::vec2 repeat{width / 1.6f, 1};
        addPatch(awning, {.origin = {x0, kFront, kReach},
                          .u = {width, 0, 0},
                          .v = {0, kTop - kFront, 0.02f - kReach},
                          .columns = 8,
                          .rows = 3,
                          .uvScale = repeat});
        addPatch(awning, {.origin = {x0, kFront - kHem, kReach},
                          .u = {width, 0, 0},
                          .v = {0, kHem, 0},
                          .uvScale = repeat});
        addTriangle(awning, {glm::vec3{x0, kFront, kReach}, {x0, kTop, 0.02f}, {x0, kFront, 0.02f}});
        const float x1 = x0 + width;
        addTriangle(awning, {glm::vec3{x1, kFront, kReach}, {x1, kFront, 0.02f}, {x1, kTop, 0.02f}});
        addBox(parts_.of(m_.iron), {x0, kFront - 0.02f, kReach - 0.03f},
               {x1, kFront + 0.01f, kReach - 0.005f});
    }

    void addFloor(uint32_t floor) {
        const uint32_t columns = house_.width > 6 ? 3 : 2;
        const float y = kShopHeight + kFloorHeight * static_cast<float>(floor);
        const float cellWidth = house_.width / static_cast<float>(columns);
        const bool balcony = floor == 0 && rng_.uniform() < 0.4f;
        balcony_ |= balcony;
        for (uint32_t column = 0; column < columns; ++column) {
            const float x = cellWidth * static_cast<float>(column), middle = x + cellWidth / 2;
            const Rect hole{middle - 0.5f, y + (balcony ? 0.15f : 0.75f), middle + 0.5f, y + 2.3f};
            addWallAround(parts_.of(wall_), {x, y, x + cellWidth, y + kFloorHeight}, hole);
            addWindow(hole, !balcony);
        }
        if (balcony) addBalcony(y);
        addBox(parts_.of(m_.trim), {0, y + kFloorHeight - 0.1f, 0}, {house_.width, y + kFloorHeight, 0.07f});
    }

    void addWindow(const Rect& hole, bool sill) {
        const bool lit = rng_.uniform() < 0.42f;
        addPane(parts_.of(lit ? m_.windows[rng_.below(3)] : m_.glass), hole, 2, 3);
        addFrame(parts_.of(m_.trim), hole, 2, 3);
        addBox(parts_.of(m_.trim), {hole.x0 - 0.12f, hole.y1, 0}, {hole.x1 + 0.12f, hole.y1 + 0.14f, 0.08f});
        if (!sill) return;
        addBox(parts_.of(m_.trim), {hole.x0 - 0.1f, hole.y0 - 0.1f, -0.02f},
               {hole.x1 + 0.1f, hole.y0, 0.14f});
        if (rng_.uniform() < 0.4f) addFlowerBox(hole);
        if (rng_.uniform() < 0.55f) addShutters(hole);
    }

    void addShutters(const Rect& hole) {
        Geometry& wood = parts_.of(m_.doors[house_.seed % 3]);
        for (const float x : {hole.x0 - 0.56f, hole.x1 + 0.06f}) {
            addBox(wood, {x, hole.y0, 0}, {x + 0.5f, hole.y1, 0.03f});
            constexpr uint32_t kSlats = 7;
            for (uint32_t i = 0; i < kSlats; ++i) {
                const float y = glm::mix(hole.y0, hole.y1, (static_cast<float>(i) + 0.3f) / kSlats);
                addBox(wood, {x + 0.05f, y, 0.03f}, {x + 0.45f, y + 0.1f, 0.055f});
            }
        }
    }

    void addFlowerBox(const Rect& hole) {
        addBox(parts_.of(m_.pot), {hole.x0, hole.y0, 0.05f}, {hole.x1, hole.y0 + 0.2f, 0.3f});
        for (uint32_t i = 0; i < 14; ++i) {
            const glm::vec3 centre{rng_.range(hole.x0, hole.x1), hole.y0 + rng_.range(0.15f, 0.4f),
                                   rng_.range(0.1f, 0.34f)};
            addCard(parts_.of(i % 3 == 0 ? m_.flowers : m_.foliage), rng_, centre, {0, 0.3f, 1},
                    rng_.range(0.14f, 0.22f));
        }
    }

    void addBalcony(float y) {
        constexpr float kReach = 0.85f, kRail = 1.0f;
        const float x0 = 0.5f, x1 = house_.width - 0.5f;
        addBox(parts_.of(m_.paving), {x0, y, 0}, {x1, y + 0.12f, kReach});
        Geometry& iron = parts_.of(m_.lattice);
        const float floor = y + 0.12f;
        const glm::vec3 up{0, kRail, 0};
        addPatch(iron, {.origin = {x0, floor, kReach},
                        .u = {x1 - x0, 0, 0},
                        .v = up,
                        .uvScale = {(x1 - x0) / kRail, 1}});
        addPatch(iron,
                 {.origin = {x0, floor, 0}, .u = {0, 0, kReach}, .v = up, .uvScale = {kReach / kRail, 1}});
        addPatch(
            iron,
            {.origin = {x1, floor, kReach}, .u = {0, 0, -kReach}, .v = up, .uvScale = {kReach / kRail, 1}});
        addBox(parts_.of(m_.iron), {x0, floor + kRail, kReach - 0.03f},
               {x1, floor + kRail + 0.05f, kReach + 0.03f});
    }

    // Sides, cornice, roof and a chimney.
    void addBody() {
        const float w = house_.width, h = houseHeight(house_), ridge = h + 1.9f;
        constexpr float kEaves = 0.35f, kRidge = -kDepth / 2;
        Geometry& wall = parts_.of(wall_);
        addPatch(wall,
                 {.origin = {0, 0, -kDepth}, .u = {0, 0, kDepth}, .v = {0, h, 0}, .uvScale = {2, h / 4}});
        addPatch(wall, {.origin = {w, 0, 0}, .u = {0, 0, -kDepth}, .v = {0, h, 0}, .uvScale = {2, h / 4}});
        addTriangle(wall, {glm::vec3{0, h, -kDepth}, {0, h, 0}, {0, ridge, kRidge}});
        addTriangle(wall, {glm::vec3{w, h, 0}, {w, h, -kDepth}, {w, ridge, kRidge}});
        addBox(parts_.of(m_.trim), {0, h - 0.3f, 0}, {w, h, 0.3f});
        Geometry& roof = parts_.of(m_.roof);
        const glm::vec3 slope{0, ridge - h, kRidge - kEaves};
        addPatch(roof,
                 {.origin = {-0.05f, h, kEaves}, .u = {w + 0.1f, 0, 0}, .v = slope, .uvScale = {w / 2, 2}});
        addPatch(roof, {.origin = {w + 0.05f, h, -kDepth},
                        .u = {-w - 0.1f, 0, 0},
                        .v = {0, ridge - h, -kRidge},
                        .uvScale = {w / 2, 2}});
        const float chimney = rng_.range(0.2f, 0.7f) * w;
        addBox(parts_.of(m_.pot), {chimney, h, kRidge - 0.3f}, {chimney + 0.7f, ridge + 0.9f, kRidge + 0.3f});
    }

    // A blade sign that stands out from the facade, lit on both faces.
    void addSign() {
        const uint32_t neon = m_.signs[house_.sign];
        const float x = rng_.range(0.3f, 0.7f) * house_.width;
        const float y = kShopHeight + rng_.range(0.0f, 0.5f);
        // Beyond the railing, where there is one.
        const float start = balcony_ ? 0.95f : 0.25f;
        constexpr float kWidth = 1.65f, kHeight = 0.62f, kThick = 0.07f;
        addBox(parts_.of(m_.iron), {x - kThick, y, start}, {x + kThick, y + kHeight, start + kWidth});
        addBox(parts_.of(m_.iron), {x - 0.02f, y + kHeight, 0},
               {x + 0.02f, y + kHeight + 0.05f, start + kWidth});
        constexpr float kGap = 0.004f;
        const glm::vec3 along{0, 0, kWidth}, up{0, kHeight, 0};
        Geometry& faces = parts_.of(neon);
        addPatch(faces,
                 {.origin = {x - kThick - kGap, y, start}, .u = along, .v = up, .columns = 6, .rows = 2});
        addPatch(faces, {.origin = {x + kThick + kGap, y, start + kWidth},
                         .u = -along,
                         .v = up,
                         .columns = 6,
                         .rows = 2});
    }

    void addIvy() {
        const float edge = rng_.uniform() < 0.5f ? 0.0f : house_.width;
        const float top = houseHeight(house_) * rng_.range(0.55f, 0.9f);
        for (uint32_t i = 0; i < 130; ++i) {
            const float y = top * std::sqrt(rng_.uniform());
            const float spread = 0.25f + 0.55f * (1 - y / top) + 0.25f * std::sin(2.5f * y);
            const float x = edge + (edge > 0 ? -1.0f : 1.0f) * spread * rng_.uniform();
            addCard(parts_.of(m_.foliage), rng_, {x, y, rng_.range(0.04f, 0.2f)}, {0, 0, 1},
                    rng_.range(0.18f, 0.3f));
        }
    }

    const Materials& m_;
    House house_;
    Rng rng_;
    uint32_t wall_;
    bool balcony_ = false;
    Parts parts_;
};

}   // namespace

float houseHeight(const House& house) {
    return kShopHeight + kFloorHeight * static_cast<float>(house.floors) + 0.3f;
}

uint32_t makeHouse(SceneData& scene, const Materials& materials, const House& house) {
    return HouseBuilder(materials, house).build(scene);
}

void addCard(Geometry& out, Rng& rng, const glm::vec3& centre, const glm::vec3& facing, float size) {
    const glm::vec3 normal = glm::normalize(glm::normalize(facing) + 0.7f * rng.direction());
    const glm::vec3 helper = std::abs(normal.x) < 0.8f ? glm::vec3{1, 0, 0} : glm::vec3{0, 1, 0};
    const glm::vec3 right = glm::normalize(glm::cross(helper, normal)), up = glm::cross(normal, right);
    const float turn = rng.range(0, 2 * kPi);
    const glm::vec3 u = (right * std::cos(turn) + up * std::sin(turn)) * size;
    const glm::vec3 v = (up * std::cos(turn) - right * std::sin(turn)) * size;
    addPatch(out, {.origin = centre - 0.5f * (u + v), .u = u, .v = v});
}

}   // namespace samples::build::market
