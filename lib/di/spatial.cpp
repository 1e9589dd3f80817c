#include <di/pass.h>
#include <di/stages.h>

namespace restir::di {

PassInfo spatial(uint32_t source, uint32_t target, uint32_t index, bool shades) noexcept {
    PassInfo pass = makeStage("di.spatial", {source, target},
                              {{reservoirs(source), Access::Read}, {reservoirs(target), Access::Write}});
    pass.index = index;
    if (shades) makeShading(pass);
    return pass;
}

}   // namespace restir::di
