#include <string_view>

#include "market.h"

namespace samples::build::market {

namespace {

void addGroundMaterials(SceneData& scene, Materials& m) {
    GroundImages images = paintCobbles();
    const uint32_t color = addTexture(scene, std::move(images.color));
    const uint32_t roughness = addTexture(scene, std::move(images.roughness));
    const uint32_t normal = addTexture(scene, std::move(images.normal));
    m.cobbles = addMaterial(scene, {.color = glm::vec3{1},
                                    .roughness = 1,
                                    .colorTexture = color,
                                    .roughnessTexture = roughness,
                                    .normalTexture = normal});
}

void addPlainMaterials(SceneData& scene, Materials& m) {
    const uint32_t plaster = addTexture(scene, paintPlaster()), planks = addTexture(scene, paintPlanks());
    const auto rough = [&](uint32_t color, float roughness, uint32_t texture = RS_NO_TEXTURE) {
        return addMaterial(scene, {.color = hex(color), .roughness = roughness, .colorTexture = texture});
    };
    const auto metal = [&](uint32_t color, float roughness) {
        return addMaterial(scene, {.color = hex(color), .roughness = roughness, .metalness = 1});
    };
    m.paving = rough(0x7d766e, 0.45f, plaster);
    m.wood = rough(0xb07a48, 0.65f, planks);
    m.darkWood = rough(0x5b3d28, 0.5f, planks);
    m.iron = metal(0x4c4a48, 0.38f);
    m.brass = metal(0xd9a85a, 0.22f);
    m.trim = rough(0xe2dccb, 0.6f);
    m.roof = rough(0x6e4436, 0.7f, planks);
    m.glass = rough(0x0a0d12, 0.06f);
    m.cloth = rough(0x7a2530, 0.95f);
    m.pot = rough(0xb0623c, 0.7f);
    constexpr std::array<uint32_t, 6> kWalls = {0xd6a860, 0xc67f5e, 0x8fa7b3, 0xd9cdb4, 0x9c6b62, 0xa9b58c};
    for (size_t i = 0; i < kWalls.size(); ++i) m.walls[i] = rough(kWalls[i], 0.85f, plaster);
    constexpr std::array<uint32_t, 3> kDoors = {0x2f5a4a, 0x7a2f26, 0x2c4468};
    for (size_t i = 0; i < kDoors.size(); ++i) m.doors[i] = rough(kDoors[i], 0.35f, planks);
    constexpr std::array<uint32_t, 5> kFruits = {0xf08a1d, 0xc8202a, 0x8fc22c, 0xf3cf3a, 0x5b2a66};
    for (size_t i = 0; i < kFruits.size(); ++i) m.fruits[i] = rough(kFruits[i], 0.32f);
}

void addClothAndLeaves(SceneData& scene, Materials& m) {
    constexpr std::array<std::array<uint32_t, 2>, 4> kStripes = {
        {{0xc23b32, 0xf3ead6}, {0x2d6a8a, 0xf1ead8}, {0x2f7d54, 0xf3e6c4}, {0xdd9a2b, 0xf5ecd8}}};
    for (size_t i = 0; i < kStripes.size(); ++i) {
        const uint32_t stripes = addTexture(scene, paintStripes(hex(kStripes[i][0]), hex(kStripes[i][1])));
        m.awnings[i] = addMaterial(
            scene, {.color = glm::vec3{1}, .roughness = 0.9f, .colorTexture = stripes, .doubleSided = true});
    }
    const auto cutOut = [&](Image image, float roughness, float metalness) {
        return addMaterial(scene, {.color = glm::vec3{1},
                                   .roughness = roughness,
                                   .metalness = metalness,
                                   .colorTexture = addTexture(scene, std::move(image)),
                                   .doubleSided = true,
                                   .alphaMask = true});
    };
    m.foliage = cutOut(paintFoliage(hex(0x2f5d27), hex(0x86a83c)), 0.5f, 0);
    m.flowers = cutOut(paintFoliage(hex(0xb8284e), hex(0xf2b2c4)), 0.6f, 0);
    m.lattice = cutOut(paintLattice(), 0.4f, 1);
}

// Radiances are chosen so that every kind of light counts: small things are bright, large ones dim.
void addLights(SceneData& scene, Materials& m) {
    const auto glowing = [&](const glm::vec3& emission, Image image) {
        return addMaterial(scene, {.color = glm::vec3{0.04f},
                                   .roughness = 0.25f,
                                   .emission = emission,
                                   .emissionTexture = addTexture(scene, std::move(image))});
    };
    const auto bare = [&](const glm::vec3& emission) {
        return addMaterial(scene, {.color = glm::vec3{0.3f}, .roughness = 0.3f, .emission = emission});
    };
    constexpr std::array<uint32_t, 3> kRooms = {0xffb469, 0xffd39a, 0xff9d52};
    for (uint32_t i = 0; i < 3; ++i) m.windows[i] = glowing(hex(kRooms[i]) * 2.6f, paintWindow(i + 1));
    constexpr std::array<uint32_t, 3> kShops = {0xffc988, 0xffe0b8, 0xbfe0ff};
    for (uint32_t i = 0; i < 3; ++i) m.shops[i] = glowing(hex(kShops[i]) * 1.7f, paintShop(20 + 7 * i));
    constexpr std::array<std::string_view, 8> kWords = {"RESTIR", "CAFE", "BAR",   "BOOKS",
                                                        "NOODLE", "TEA",  "FRUIT", "PIANO"};
    constexpr std::array<uint32_t, 8> kNeons = {0xff3fa4, 0x3fd2ff, 0xff5a3c, 0x5dff8f,
                                                0xff3d4f, 0x8f7bff, 0xffb02e, 0x38f0d8};
    for (size_t i = 0; i < kWords.size(); ++i)
        m.signs[i] = glowing(hex(kNeons[i]) * 14.0f, paintNeon(kWords[i]));
    constexpr std::array<uint32_t, 4> kLanterns = {0xff5a36, 0xffa53c, 0xffd27a, 0xff3f5e};
    for (size_t i = 0; i < kLanterns.size(); ++i)
        m.lanterns[i] = glowing(hex(kLanterns[i]) * 3.5f, paintLantern());
    constexpr std::array<uint32_t, 6> kBulbs = {0xffc36b, 0xffdca0, 0xff7048, 0x6cc4ff, 0x8dff86, 0xff86d8};
    for (size_t i = 0; i < kBulbs.size(); ++i) m.bulbs[i] = bare(hex(kBulbs[i]) * 70.0f);
    m.lamp = bare(hex(0xffce90) * 20.0f);
    m.clock = glowing(hex(0xfff0cf) * 2.2f, paintClock());
    m.gate = glowing(hex(0xff9a48) * 3.5f, paintGate());
}

}   // namespace

Materials makeMaterials(SceneData& scene) {
    Materials materials{};
    addGroundMaterials(scene, materials);
    addPlainMaterials(scene, materials);
    addClothAndLeaves(scene, materials);
    addLights(scene, materials);
    return materials;
}

Geometry& Parts::of(uint32_t material) {
    Geometry& geometry = parts_[material];
    geometry.material = material;
    return geometry;
}

uint32_t Parts::addTo(SceneData& scene) {
    std::vector<Geometry> geometries;
    for (auto& [material, geometry] : parts_) geometries.push_back(std::move(geometry));
    return addMesh(scene, std::move(geometries));
}

}   // namespace samples::build::market
