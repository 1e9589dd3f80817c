#include <di/stages.h>
#include <frame/pass.h>

namespace restir::di {

PassInfo pairSpatial(uint32_t source, uint32_t target, uint32_t index, bool shades) noexcept {
    PassInfo pass = makePass("di.pair_spatial", {{Resource::Surfaces, Access::Read},
                                                 {Resource::Scene, Access::Read},
                                                 {Resource::Lights, Access::Read},
                                                 {Resource::Notes, Access::Read},
                                                 {reservoirs(source), Access::Read},
                                                 {reservoirs(target), Access::Write}});
    pass.source = source;
    pass.target = target;
    pass.index = index;
    pass.shades = shades;
    if (shades) pass.useList[pass.useCount++] = {Resource::Outputs, Access::Write};
    return pass;
}

}   // namespace restir::di
