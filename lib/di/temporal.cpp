#include <di/stages.h>
#include <frame/pass.h>

namespace restir::di {

PassInfo temporal(uint32_t history, uint32_t target) noexcept {
    PassInfo pass = makePass("di.temporal", {{Resource::Surfaces, Access::Read},
                                             {Resource::PreviousSurfaces, Access::Read},
                                             {Resource::Scene, Access::Read},
                                             {Resource::Lights, Access::Read},
                                             {reservoirs(history), Access::Read},
                                             {reservoirs(target), Access::ReadWrite}});
    pass.source = history;
    pass.target = target;
    return pass;
}

}   // namespace restir::di
