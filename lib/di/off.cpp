#include <di/pass.h>
#include <di/stages.h>

namespace restir::di {

PassInfo off() noexcept {
    PassInfo pass = makePass("di.off", {{Resource::Surfaces, Access::Read}});
    makeShading(pass);
    return pass;
}

}   // namespace restir::di
