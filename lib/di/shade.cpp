#include <di/pass.h>
#include <di/stages.h>

namespace restir::di {

// Empties occluded reservoirs where visibility is Cached; a pass that may write counts as one that does.
PassInfo shade(uint32_t buffer) noexcept {
    PassInfo pass = makeStage("di.shade", {buffer, buffer}, {{reservoirs(buffer), Access::ReadWrite}});
    makeShading(pass);
    return pass;
}

}   // namespace restir::di
