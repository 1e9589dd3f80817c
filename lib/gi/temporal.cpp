#include <gi/pass.h>
#include <gi/stages.h>

namespace restir::gi {

PassInfo temporal(uint32_t history, uint32_t target) noexcept {
    return makeStage("gi.temporal", history, target, Access::Read,
                     {{Resource::PreviousSurfaces, Access::Read},
                      {reservoirs(history), Access::Read},
                      {reservoirs(target), Access::ReadWrite}});
}

}   // namespace restir::gi
