#include <di/pass.h>
#include <di/stages.h>

namespace restir::di {

PassInfo candidates(uint32_t target) noexcept {
    return makeStage("di.candidates", {.target = target}, {{reservoirs(target), Access::Write}});
}

}   // namespace restir::di
