#include <di/stages.h>
#include <frame/pass.h>

namespace restir::di {

PassInfo spatiotemporal(uint32_t history, uint32_t target, bool shades) noexcept {
    PassInfo pass = makePass("di.spatiotemporal", {{Resource::Surfaces, Access::Read},
                                                   {Resource::PreviousSurfaces, Access::Read},
                                                   {Resource::Scene, Access::Read},
                                                   {Resource::Lights, Access::Read},
                                                   {reservoirs(history), Access::Read},
                                                   {reservoirs(target), Access::ReadWrite}});
    pass.source = history;
    pass.target = target;
    pass.shades = shades;
    if (shades) pass.useList[pass.useCount++] = {Resource::Outputs, Access::Write};
    return pass;
}

}   // namespace restir::di
