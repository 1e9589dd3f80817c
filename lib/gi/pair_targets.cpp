#include <gi/pass.h>
#include <gi/stages.h>

namespace restir::gi {

PassInfo pairTargets(uint32_t source, uint32_t index) noexcept {
    PassInfo pass = makeStage("gi.pair_targets", source, source, Access::Read,
                              {{reservoirs(source), Access::Read}, {Resource::Notes, Access::Write}});
    pass.index = index;
    return pass;
}

}   // namespace restir::gi
