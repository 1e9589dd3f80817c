#include <algorithm>
#include <array>
#include <cmath>

#include "builtin.h"
#include "mesh_builder.h"

namespace samples::build {

namespace {

// Metres. Houses stand on both sides of a street along z.
constexpr uint32_t kHousesPerSide = 12, kHouses = 2 * kHousesPerSide, kHouseKinds = 4, kTrees = 24,
                   kTreeKinds = 3;
constexpr float kHouseWidth = 9, kHouseHeight = 13, kHalfStreet = 7;
constexpr float kLength = kHousesPerSide * kHouseWidth;
constexpr uint32_t kFloors = 4, kWindowsPerFloor = 3;

float houseZ(uint32_t house) { return kHouseWidth * (static_cast<float>(house) + 0.5f) - kLength / 2; }

// Where house `i` of both sides stands: its facade is in the mesh's xy plane, seen from +z.
glm::mat4 housePlace(uint32_t i) {
    const bool left = i % 2 == 0;
    return place({left ? -kHalfStreet : kHalfStreet, 0, houseZ(i / 2)}, left ? kPi / 2 : -kPi / 2);
}

// The largest grid with about the given aspect that needs no more than `triangles`.
glm::uvec2 gridWithin(uint64_t triangles, float aspect) {
    const double cells = static_cast<double>(triangles) / 2;
    if (cells < 1) return {0, 0};
    const auto columns = static_cast<uint32_t>(std::clamp(std::sqrt(cells * aspect), 1.0, cells));
    return {columns, static_cast<uint32_t>(cells / columns)};
}

struct WindowRect {
    glm::vec2 lo, hi;
};

WindowRect windowRect(uint32_t floor, uint32_t column) {
    const glm::vec2 cell{kHouseWidth / kWindowsPerFloor, kHouseHeight / kFloors};
    const glm::vec2 corner{(static_cast<float>(column) + 0.28f) * cell.x - kHouseWidth / 2,
                           (static_cast<float>(floor) + 0.25f) * cell.y};
    return {corner, corner + cell * glm::vec2{0.44f, 0.58f}};
}

// Relief of a facade: recessed windows, sills, a cornice, rough plaster.
float relief(const glm::vec2& p, uint32_t kind) {
    constexpr float kRecess = -0.22f, kSill = 0.08f;
    for (uint32_t i = 0; i < kFloors * kWindowsPerFloor; ++i) {
        const WindowRect window = windowRect(i / kWindowsPerFloor, i % kWindowsPerFloor);
        const bool across = p.x > window.lo.x && p.x < window.hi.x;
        if (across && p.y > window.lo.y && p.y < window.hi.y) return kRecess;
        if (across && p.y > window.lo.y - 0.2f && p.y <= window.lo.y) return kSill;
    }
    if (p.y > kHouseHeight - 0.6f) return 0.35f;
    return 0.05f * noise(p * 2.0f, 64, kind);
}

Geometry makeFacade(uint32_t material, uint32_t kind, glm::uvec2 grid) {
    Geometry facade{.material = material};
    if (grid.x == 0 || grid.y == 0) return facade;
    addPatch(facade, {.origin = {-kHouseWidth / 2, 0, 0},
                      .u = {kHouseWidth, 0, 0},
                      .v = {0, kHouseHeight, 0},
                      .columns = grid.x,
                      .rows = grid.y,
                      .uvScale = {kHouseWidth / 3, kHouseHeight / 3}});
    for (glm::vec3& position : facade.positions) position.z = relief(glm::vec2{position}, kind);
    facade.normals.clear();
    return facade;
}

// `count` single-triangle leaves in a crown over the origin.
Geometry makeLeaves(uint32_t material, uint64_t count, Rng& rng) {
    Geometry leaves{.material = material};
    leaves.positions.reserve(count * 3);
    leaves.normals.reserve(count * 3);
    leaves.uvs.reserve(count * 3);
    leaves.indices.reserve(count * 3);
    for (uint64_t i = 0; i < count; ++i) {
        const glm::vec3 outward = rng.direction();
        const glm::vec3 centre =
            glm::vec3{0, 5.2f, 0} + outward * glm::vec3{1.9f, 1.6f, 1.9f} * std::cbrt(rng.uniform());
        const glm::vec3 u = rng.direction();
        const glm::vec3 v =
            glm::cross(u, glm::normalize(outward + 0.5f * rng.direction() + glm::vec3{0, 0.01f, 0}));
        const float size = rng.range(0.05f, 0.11f);
        addTriangle(leaves,
                    {centre - u * size, centre + u * size, centre + (v + 0.02f * outward) * 2.0f * size});
    }
    return leaves;
}

constexpr std::array<uint32_t, 6> kBulbColors = {0xffc56e, 0xff6b4a, 0x5ec8ff, 0x86ff7a, 0xffe9c9, 0xf27cff};
constexpr uint32_t kBulbTriangles = 8, kBulbsPerString = 16,
                   kStringTriangles = kBulbTriangles * kBulbsPerString;

class StreetBuilder {
public:
    explicit StreetBuilder(const StreetSize& size)
        : plain_(size.triangles - size.emissive), emissive_(size.emissive) {
        makeMaterials();
    }

    SceneData build() {
        addWindows();
        addStrings();
        addRemainingLights();
        const uint64_t facades = plain_ / 2;
        addPoles();
        addGround(plain_ / 10);
        addFacades(facades);
        addTrees();
        addViews();
        return std::move(scene_);
    }

private:
    void makeMaterials() {
        constexpr std::array<uint32_t, kHouseKinds> kWalls = {0xb08a62, 0x8f6a5a, 0x9aa0a6, 0xc2a878};
        const uint32_t plaster =
            addTexture(scene_, paint(256, 256, true, [](const glm::vec2& uv) {
                           return glm::vec4{glm::vec3{0.55f + 0.45f * fractalNoise(uv, 8, 3)}, 1};
                       }));
        for (const uint32_t wall : kWalls)
            walls_.push_back(addMaterial(
                scene_,
                {.color = hex(wall), .roughness = 0.9f, .colorTexture = plaster, .doubleSided = true}));
        ground_ = addMaterial(scene_, {.color = hex(0x6a6866), .roughness = 0.35f, .colorTexture = plaster});
        leaf_ = addMaterial(scene_, {.color = hex(0x4f7a35), .roughness = 0.6f, .doubleSided = true});
        bark_ = addMaterial(scene_, {.color = hex(0x4a3626), .roughness = 0.9f});
        metal_ = addMaterial(scene_, {.color = hex(0x8a8d92), .roughness = 0.4f, .metalness = 1});
        window_ = addMaterial(scene_, {.color = glm::vec3{0.2f}, .emission = hex(0xffc27a) * 4.0f});
        for (const uint32_t color : kBulbColors)
            bulbs_.push_back(addMaterial(scene_, {.color = glm::vec3{0.2f}, .emission = hex(color) * 60.0f}));
    }

    // Instances a mesh of one geometry as often as `budget` and `wanted` allow.
    void repeat(uint64_t& budget, uint64_t wanted, const Geometry& geometry, auto&& placeOf) {
        const uint64_t triangles = geometry.indices.size() / 3, count = std::min(wanted, budget / triangles);
        const uint32_t mesh = count > 0 ? addMesh(scene_, {geometry}) : kNoMesh;
        for (uint64_t i = 0; i < count; ++i) addInstance(scene_, mesh, placeOf(static_cast<uint32_t>(i)));
        budget -= count * triangles;
    }

    // Lit windows take up to a fifth of the emissive triangles.
    void addWindows() {
        uint64_t budget = emissive_ / 5;
        const uint64_t reserved = emissive_ - budget;
        for (uint32_t i = 0; i < kFloors * kWindowsPerFloor; ++i) {
            if (hash(i + 11) % 3 == 0) continue;
            const WindowRect rect = windowRect(i / kWindowsPerFloor, i % kWindowsPerFloor);
            Geometry pane{.material = window_};
            addPatch(pane, {.origin = {rect.lo.x, rect.lo.y, -0.15f},
                            .u = {rect.hi.x - rect.lo.x, 0, 0},
                            .v = {0, rect.hi.y - rect.lo.y, 0}});
            repeat(budget, kHouses, pane, housePlace);
        }
        emissive_ = reserved + budget;
    }

    void addStrings() {
        const uint64_t count = emissive_ / kStringTriangles;
        if (count == 0) return;
        std::vector<uint32_t> meshes;
        for (const uint32_t material : bulbs_) {
            Geometry string{.material = material};
            const std::vector<glm::vec3> wire =
                hangingWire({-kHalfStreet, 0, 0}, {kHalfStreet, 0, 0}, 1.1f, kBulbsPerString + 1);
            for (uint32_t i = 1; i <= kBulbsPerString; ++i) addOctahedron(string, wire[i], 0.06f);
            meshes.push_back(addMesh(scene_, {string}));
        }
        Rng rng(5);
        for (uint64_t i = 0; i < count; ++i) {
            const float along = (static_cast<float>(i) + 0.5f) / static_cast<float>(count) - 0.5f;
            addInstance(scene_, meshes[i % meshes.size()],
                        place({0, rng.range(5.2f, 8.5f), along * kLength}, rng.range(-0.25f, 0.25f)));
        }
        emissive_ -= count * kStringTriangles;
    }

    // Single shards hanging over the middle of the street make up the exact count.
    void addRemainingLights() {
        Geometry shards{.material = bulbs_.front()};
        Rng rng(9);
        for (uint64_t i = 0; i < emissive_; ++i) {
            const glm::vec3 centre{rng.range(-1, 1), rng.range(4.5f, 5.5f), rng.range(-0.5f, 0.5f) * kLength};
            const glm::vec3 u = rng.direction() * 0.08f, v = rng.direction() * 0.08f;
            addTriangle(shards, {centre, centre + u, centre + v + glm::vec3{0, 0.01f, 0}});
        }
        addInstance(scene_, addMesh(scene_, {shards}));
        emissive_ = 0;
    }

    void addPoles() {
        Geometry pole{.material = metal_}, trunk{.material = bark_};
        constexpr std::array<glm::vec2, 5> kPole = {
            {{0.16f, 0}, {0.12f, 0.5f}, {0.06f, 0.8f}, {0.05f, 5}, {0, 5.1f}}};
        constexpr std::array<glm::vec2, 3> kTrunk = {{{0.24f, 0}, {0.15f, 2}, {0.08f, 5}}};
        addLathe(pole, glm::vec3{0}, kPole, 12);
        addLathe(trunk, glm::vec3{0}, kTrunk, 8);
        uint64_t budget = plain_ / 10;
        const uint64_t reserved = plain_ - budget;
        repeat(budget, kHouses, pole, [](uint32_t i) { return besideStreet(i, 0.5f); });
        repeat(budget, kTrees, trunk, [](uint32_t i) { return besideStreet(i, 0); });
        plain_ = reserved + budget;
    }

    static glm::mat4 besideStreet(uint32_t i, float shift) {
        const float x = i % 2 == 0 ? -kHalfStreet + 2 : kHalfStreet - 2;
        return place({x, 0, houseZ(i / 2 % kHousesPerSide) + shift * kHouseWidth},
                     2.4f * static_cast<float>(i));
    }

    void addGround(uint64_t budget) {
        const float width = 2 * kHalfStreet;
        const glm::uvec2 grid = gridWithin(std::min(budget, plain_), width / kLength);
        if (grid.x == 0) return;
        Geometry ground{.material = ground_};
        addPatch(ground, {.origin = {-kHalfStreet, 0, kLength / 2},
                          .u = {width, 0, 0},
                          .v = {0, 0, -kLength},
                          .columns = grid.x,
                          .rows = grid.y,
                          .uvScale = {width / 4, kLength / 4}});
        for (glm::vec3& p : ground.positions) p.y = 0.06f * noise(glm::vec2{p.x, p.z}, 256, 21);
        ground.normals.clear();
        plain_ -= ground.indices.size() / 3;
        addInstance(scene_, addMesh(scene_, {ground}));
    }

    void addFacades(uint64_t budget) {
        const glm::uvec2 grid = gridWithin(std::min(budget, plain_) / kHouses, kHouseWidth / kHouseHeight);
        const uint64_t triangles = uint64_t{2} * grid.x * grid.y;
        std::vector<uint32_t> meshes;
        for (uint32_t kind = 0; kind < kHouseKinds && triangles > 0; ++kind)
            meshes.push_back(addMesh(scene_, {makeFacade(walls_[kind], kind, grid)}));
        for (uint32_t i = 0; i < kHouses && triangles > 0; ++i)
            addInstance(scene_, meshes[hash(i) % kHouseKinds], housePlace(i));
        plain_ -= triangles * kHouses;
    }

    // Crowns take everything left; one more clump takes what does not divide by the number of trees.
    void addTrees() {
        Rng rng(31);
        const uint64_t perTree = plain_ / kTrees;
        std::vector<uint32_t> meshes;
        for (uint32_t kind = 0; kind < kTreeKinds; ++kind)
            meshes.push_back(addMesh(scene_, {makeLeaves(leaf_, perTree, rng)}));
        for (uint32_t i = 0; i < kTrees; ++i) addInstance(scene_, meshes[i % kTreeKinds], besideStreet(i, 0));
        const uint32_t rest = addMesh(scene_, {makeLeaves(leaf_, plain_ % kTrees, rng)});
        addInstance(scene_, rest, place({0, -2, -kLength / 2 + 1}));
        plain_ = 0;
    }

    void addViews() {
        const float end = kLength / 2;
        scene_.views = {
            {.eye = {1.2f, 1.7f, end - 4},
             .target = {0, 3.2f, end - 24},
             .verticalFov = 0.9f,
             .name = "street"},
            {.eye = {-4, 9, end - 2}, .target = {1, 3, end - 30}, .verticalFov = 0.9f, .name = "above"}};
    }

    SceneData scene_{.name = "street"};
    uint64_t plain_, emissive_;   // triangles still to place
    std::vector<uint32_t> walls_, bulbs_;
    uint32_t ground_ = 0, leaf_ = 0, bark_ = 0, metal_ = 0, window_ = 0;
};

}   // namespace

SceneData makeStreet(const StreetSize& size) { return StreetBuilder(size).build(); }

}   // namespace samples::build
