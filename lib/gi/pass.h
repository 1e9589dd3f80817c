// What the stages of ReSTIR GI have in common.
#pragma once

#include <frame/pass.h>

namespace restir::gi {

constexpr Resource reservoirs(uint32_t buffer) noexcept {
    return buffer == 0 ? Resource::GiReservoirsA : Resource::GiReservoirsB;
}

// Every stage looks at surfaces, the scene and the lights; `surfaces` is ReadWrite for those that add to the pixels' own light.
inline PassInfo makeStage(const char* name, uint32_t source, uint32_t target, Access surfaces,
                          std::initializer_list<PassInfo::Use> uses) noexcept {
    PassInfo pass = makePass(name, {{Resource::Surfaces, surfaces},
                                    {Resource::Scene, Access::Read},
                                    {Resource::Lights, Access::Read}});
    for (const PassInfo::Use& use : uses) addUse(pass, use);
    pass.source = source;
    pass.target = target;
    return pass;
}

}   // namespace restir::gi
