#include <di/pass.h>
#include <di/stages.h>

namespace restir::di {

PassInfo debug(uint32_t buffer, uint32_t lastSpatial) noexcept {
    PassInfo pass = makeStage("di.debug", {.source = buffer},
                              {{reservoirs(buffer), Access::Read}, {Resource::DebugOutput, Access::Write}});
    pass.index = lastSpatial;
    return pass;
}

}   // namespace restir::di
