#include <gi/pass.h>
#include <gi/stages.h>

namespace restir::gi {

PassInfo fill() noexcept {
    PassInfo pass = makeStage("gi.fill", 0, 0, Access::ReadWrite, {});
    pass.shades = true;
    return pass;
}

}   // namespace restir::gi
