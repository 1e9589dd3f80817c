#include <di/pass.h>
#include <di/stages.h>

namespace restir::di {

PassInfo pairSpatial(uint32_t source, uint32_t target, uint32_t index, bool shades) noexcept {
    PassInfo pass = spatial(source, target, index, shades);
    pass.name = "di.pair_spatial";
    addUse(pass, {Resource::Notes, Access::Read});
    return pass;
}

}   // namespace restir::di
