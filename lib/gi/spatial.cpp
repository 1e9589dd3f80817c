#include <gi/pass.h>
#include <gi/stages.h>

namespace restir::gi {

PassInfo spatial(uint32_t source, uint32_t target, uint32_t index, bool shades) noexcept {
    PassInfo pass = makeStage("gi.spatial", source, target, shades ? Access::ReadWrite : Access::Read,
                              {{reservoirs(source), Access::Read}, {reservoirs(target), Access::Write}});
    pass.index = index;
    pass.shades = shades;
    return pass;
}

}   // namespace restir::gi
