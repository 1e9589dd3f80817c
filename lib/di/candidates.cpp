#include <di/stages.h>
#include <frame/pass.h>

namespace restir::di {

PassInfo candidates(uint32_t target) noexcept {
    PassInfo pass = makePass("di.candidates", {{Resource::Surfaces, Access::Read},
                                               {Resource::Scene, Access::Read},
                                               {Resource::Lights, Access::Read},
                                               {reservoirs(target), Access::Write}});
    pass.target = target;
    return pass;
}

}   // namespace restir::di
