#include <di/stages.h>
#include <frame/pass.h>

namespace restir::di {

PassInfo nextEvent() noexcept {
    PassInfo pass = makePass("di.next_event", {{Resource::Surfaces, Access::Read},
                                               {Resource::Scene, Access::Read},
                                               {Resource::Lights, Access::Read},
                                               {Resource::Outputs, Access::Write}});
    pass.shades = true;
    return pass;
}

}   // namespace restir::di
