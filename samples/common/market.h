// Inside of the built-in market: its materials and its parts. Metres; parts face +z.
#pragma once

#include <array>
#include <map>
#include <string_view>
#include <vector>

#include "mesh_builder.h"

namespace samples::build::market {

constexpr float kHalfStreet = 4.6f;             // from the middle to the facades
constexpr float kNearEnd = 19, kFarEnd = -44;   // along z; the camera stands near the near end
constexpr float kKerb = 0.12f, kPavement = 1.15f;

struct Materials {
    uint32_t cobbles, paving, wood, darkWood, iron, brass, trim, roof, glass, cloth, pot, lattice, foliage,
        flowers;
    uint32_t lamp, clock, gate;
    std::array<uint32_t, 6> walls;
    std::array<uint32_t, 3> windows, shops, doors;
    std::array<uint32_t, 4> awnings, lanterns;
    std::array<uint32_t, 6> bulbs;
    std::array<uint32_t, 5> fruits;
    std::array<uint32_t, 8> signs;
};
Materials makeMaterials(SceneData& scene);

// Pictures for them (market_textures.cpp).
struct GroundImages {
    Image color, roughness, normal;
};
GroundImages paintCobbles();
Image paintPlaster();
Image paintPlanks();
Image paintStripes(const glm::vec3& a, const glm::vec3& b);
Image paintWindow(uint32_t seed);
Image paintShop(uint32_t seed);
Image paintNeon(std::string_view word);
Image paintClock();
Image paintGate();
Image paintLantern();
Image paintFoliage(const glm::vec3& leaf, const glm::vec3& tip);
Image paintLattice();

// The geometries of one mesh, one per material.
class Parts {
public:
    Geometry& of(uint32_t material);
    uint32_t addTo(SceneData& scene);

private:
    std::map<uint32_t, Geometry> parts_;
};

struct House {
    float width;
    uint32_t floors;   // above the shop
    uint32_t seed;
    uint32_t sign;   // into Materials::signs
};
float houseHeight(const House& house);
// Facade in the plane z = 0, x in [0, width].
uint32_t makeHouse(SceneData& scene, const Materials& materials, const House& house);

void addGround(SceneData& scene, const Materials& materials);
void addTower(SceneData& scene, const Materials& materials);
void addStalls(SceneData& scene, const Materials& materials);
void addStreetLamps(SceneData& scene, const Materials& materials);
void addStringLights(SceneData& scene, const Materials& materials);
void addClutter(SceneData& scene, const Materials& materials);
// A quad with a whole texture on it, for leaves and flowers.
void addCard(Geometry& out, Rng& rng, const glm::vec3& centre, const glm::vec3& facing, float size);

}   // namespace samples::build::market
