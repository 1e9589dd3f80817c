#include <di/pass.h>
#include <di/stages.h>

namespace restir::di {

PassInfo gradient(uint32_t history, uint32_t current) noexcept {
    return makeStage("di.gradient", {history, current},
                     {{Resource::PreviousSurfaces, Access::Read},
                      {reservoirs(history), Access::Read},
                      {reservoirs(current), Access::Read},
                      {Resource::GradientOutput, Access::Write}});
}

}   // namespace restir::di
