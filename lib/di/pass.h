// What the stages of ReSTIR DI have in common.
#pragma once

#include <frame/pass.h>

namespace restir::di {

struct Reservoirs {
    uint32_t source = 0, target = 0;
};

// Every stage looks at surfaces, the scene and the lights; `uses` is what it does besides.
inline PassInfo makeStage(const char* name, Reservoirs buffers,
                          std::initializer_list<PassInfo::Use> uses) noexcept {
    PassInfo pass = makePass(name, {{Resource::Surfaces, Access::Read},
                                    {Resource::Scene, Access::Read},
                                    {Resource::Lights, Access::Read}});
    for (const PassInfo::Use& use : uses) addUse(pass, use);
    pass.source = buffers.source;
    pass.target = buffers.target;
    return pass;
}

inline void makeShading(PassInfo& pass) noexcept {
    pass.shades = true;
    addUse(pass, {Resource::Outputs, Access::Write});
}

}   // namespace restir::di
