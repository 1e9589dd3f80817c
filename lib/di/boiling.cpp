#include <di/pass.h>
#include <di/stages.h>

namespace restir::di {

PassInfo boiling(uint32_t buffer) noexcept {
    return makeStage("di.boiling", {buffer, buffer}, {{reservoirs(buffer), Access::ReadWrite}});
}

}   // namespace restir::di
