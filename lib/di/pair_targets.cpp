#include <di/pass.h>
#include <di/stages.h>

namespace restir::di {

PassInfo pairTargets(uint32_t source, uint32_t index) noexcept {
    PassInfo pass = makeStage("di.pair_targets", {source, source},
                              {{reservoirs(source), Access::Read}, {Resource::Notes, Access::Write}});
    pass.index = index;
    return pass;
}

}   // namespace restir::di
