#include <di/pass.h>
#include <di/stages.h>

namespace restir::di {

PassInfo temporal(uint32_t history, uint32_t target) noexcept {
    return makeStage("di.temporal", {history, target},
                     {{Resource::PreviousSurfaces, Access::Read},
                      {reservoirs(history), Access::Read},
                      {reservoirs(target), Access::ReadWrite}});
}

}   // namespace restir::di
