#include <di/stages.h>
#include <frame/pass.h>

namespace restir::di {

PassInfo debug(uint32_t buffer, uint32_t lastSpatial) noexcept {
    PassInfo pass = makePass("di.debug", {{Resource::Surfaces, Access::Read},
                                          {Resource::Scene, Access::Read},
                                          {Resource::Lights, Access::Read},
                                          {reservoirs(buffer), Access::Read},
                                          {Resource::DebugOutput, Access::Write}});
    pass.source = buffer;
    pass.index = lastSpatial;
    return pass;
}

}   // namespace restir::di
