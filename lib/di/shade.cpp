#include <di/stages.h>
#include <frame/pass.h>

namespace restir::di {

PassInfo shade(uint32_t buffer, bool kills) noexcept {
    PassInfo pass = makePass("di.shade", {{Resource::Surfaces, Access::Read},
                                          {Resource::Scene, Access::Read},
                                          {Resource::Lights, Access::Read},
                                          {reservoirs(buffer), kills ? Access::ReadWrite : Access::Read},
                                          {Resource::Outputs, Access::Write}});
    pass.source = pass.target = buffer;
    return pass;
}

}   // namespace restir::di
