#include <gi/pass.h>
#include <gi/stages.h>

namespace restir::gi {

// Empties occluded reservoirs where visibility is Cached; a pass that may write counts as one that does.
PassInfo shade(uint32_t buffer) noexcept {
    PassInfo pass = makeStage("gi.shade", buffer, buffer, Access::ReadWrite, {{reservoirs(buffer), Access::ReadWrite}});
    pass.shades = true;
    return pass;
}

}   // namespace restir::gi
