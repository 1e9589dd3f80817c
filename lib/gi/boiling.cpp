#include <gi/pass.h>
#include <gi/stages.h>

namespace restir::gi {

PassInfo boiling(uint32_t buffer) noexcept {
    return makeStage("gi.boiling", buffer, buffer, Access::Read, {{reservoirs(buffer), Access::ReadWrite}});
}

}   // namespace restir::gi
