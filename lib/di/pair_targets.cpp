#include <di/stages.h>
#include <frame/pass.h>

namespace restir::di {

PassInfo pairTargets(uint32_t source, uint32_t index) noexcept {
    PassInfo pass = makePass("di.pair_targets", {{Resource::Surfaces, Access::Read},
                                                 {Resource::Scene, Access::Read},
                                                 {Resource::Lights, Access::Read},
                                                 {reservoirs(source), Access::Read},
                                                 {Resource::Notes, Access::Write}});
    pass.source = pass.target = source;
    pass.index = index;
    return pass;
}

}   // namespace restir::di
