#include <gi/pass.h>
#include <gi/stages.h>

namespace restir::gi {

PassInfo candidates(uint32_t target) noexcept {
    return makeStage("gi.candidates", target, target, Access::Read, {{reservoirs(target), Access::Write}});
}

PassInfo path() noexcept {
    PassInfo pass = makeStage("gi.candidates", 0, 0, Access::ReadWrite, {});
    pass.shades = true;
    return pass;
}

}   // namespace restir::gi
