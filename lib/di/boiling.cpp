#include <di/stages.h>
#include <frame/pass.h>

namespace restir::di {

PassInfo boiling(uint32_t buffer) noexcept {
    PassInfo pass = makePass("di.boiling", {{Resource::Surfaces, Access::Read},
                                            {Resource::Scene, Access::Read},
                                            {Resource::Lights, Access::Read},
                                            {reservoirs(buffer), Access::ReadWrite}});
    pass.source = pass.target = buffer;
    return pass;
}

}   // namespace restir::di
