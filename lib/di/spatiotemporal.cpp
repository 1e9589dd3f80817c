#include <di/pass.h>
#include <di/stages.h>

namespace restir::di {

PassInfo spatiotemporal(uint32_t history, uint32_t target, bool shades) noexcept {
    PassInfo pass = temporal(history, target);   // with neighbours: the same buffers
    pass.name = "di.spatiotemporal";
    if (shades) makeShading(pass);
    return pass;
}

}   // namespace restir::di
