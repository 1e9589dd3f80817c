// Frames to plan, and what their passes say of themselves.
#pragma once

#include <string>
#include <vector>

#include <frame/pass.h>
#include <frame/plan.h>

namespace tests {

using namespace restir;

constexpr VkExtent2D kExtent{321, 180};

inline Settings settingsOf(bool temporal, uint32_t spatialPasses, VisibilityReuse visibility) {
    Settings settings;
    settings.di.temporal = temporal;
    settings.di.spatialPasses = spatialPasses;
    settings.di.visibility = visibility;
    return settings;
}

std::vector<Settings> allSettings();
std::vector<Plan> allPlans(bool lobes);   // Output::indirectDiffuse and the like asked for
std::vector<Plan> allPlans();             // with and without those; all with and without history

inline std::vector<std::string> names(const Plan& plan) {
    std::vector<std::string> result;
    for (const PassInfo& pass : plan.passes) result.emplace_back(pass.name);
    return result;
}

inline bool writes(Access access) { return access != Access::Read; }

inline bool uses(const PassInfo& pass, Resource resource, bool writing) {
    for (const auto& use : pass.uses())
        if (use.resource == resource && (writing ? writes(use.access) : use.access != Access::Write))
            return true;
    return false;
}

inline bool isIndirect(const PassInfo& pass) { return std::string(pass.name).starts_with("gi."); }
// "temporal" of "di.temporal".
inline std::string stageOf(const PassInfo& pass) { return std::string(pass.name).substr(3); }

inline bool readsHistory(const PassInfo& pass) {
    return stageOf(pass) == "temporal" || stageOf(pass) == "spatiotemporal";
}

inline Resource reservoirBuffer(uint32_t i, bool indirect = false) {
    if (indirect) return i == 0 ? Resource::GiReservoirsA : Resource::GiReservoirsB;
    return i == 0 ? Resource::ReservoirsA : Resource::ReservoirsB;
}
inline Resource reservoirBuffer(uint32_t i, const PassInfo& pass) { return reservoirBuffer(i, isIndirect(pass)); }

inline bool isSpatial(const PassInfo& pass) { return stageOf(pass) == "spatial" || stageOf(pass) == "pair_spatial"; }

}   // namespace tests
