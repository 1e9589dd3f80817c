#include <di/pass.h>
#include <di/stages.h>

namespace restir::di {

PassInfo fill(uint32_t buffer) noexcept {
    PassInfo pass = makeStage("di.fill", {buffer, buffer}, {{reservoirs(buffer), Access::Read}});
    makeShading(pass);
    return pass;
}

}   // namespace restir::di
