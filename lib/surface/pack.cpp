#include <frame/pass.h>
#include <surface/stages.h>

namespace restir::surface {

PassInfo pack() noexcept {
    return makePass("surface.pack", {{Resource::HostImages, Access::Read}, {Resource::Surfaces, Access::Write}});
}

}   // namespace restir::surface
