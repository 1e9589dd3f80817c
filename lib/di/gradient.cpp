#include <di/stages.h>
#include <frame/pass.h>

namespace restir::di {

PassInfo gradient(uint32_t history, uint32_t current) noexcept {
    PassInfo pass = makePass("di.gradient", {{Resource::Surfaces, Access::Read},
                                             {Resource::PreviousSurfaces, Access::Read},
                                             {Resource::Scene, Access::Read},
                                             {Resource::Lights, Access::Read},
                                             {reservoirs(history), Access::Read},
                                             {reservoirs(current), Access::Read},
                                             {Resource::GradientOutput, Access::Write}});
    pass.source = history;
    pass.target = current;
    return pass;
}

}   // namespace restir::di
