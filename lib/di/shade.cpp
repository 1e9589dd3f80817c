#include <di/stages.h>
#include <frame/pass.h>

namespace restir::di {

// Empties occluded reservoirs where visibility is Cached; a pass that may write counts as one that does.
PassInfo shade(uint32_t buffer) noexcept {
    PassInfo pass = makePass("di.shade", {{Resource::Surfaces, Access::Read},
                                          {Resource::Scene, Access::Read},
                                          {Resource::Lights, Access::Read},
                                          {reservoirs(buffer), Access::ReadWrite},
                                          {Resource::Outputs, Access::Write}});
    pass.source = pass.target = buffer;
    pass.shades = true;
    return pass;
}

}   // namespace restir::di
