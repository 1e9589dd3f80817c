#include <di/pass.h>
#include <di/stages.h>

namespace restir::di {

PassInfo nextEvent() noexcept {
    PassInfo pass = makeStage("di.next_event", {}, {});
    makeShading(pass);
    return pass;
}

}   // namespace restir::di
