#include <gi/pass.h>
#include <gi/stages.h>

namespace restir::gi {

PassInfo pairSpatial(uint32_t source, uint32_t target, uint32_t index, bool shades) noexcept {
    PassInfo pass = spatial(source, target, index, shades);
    pass.name = "gi.pair_spatial";
    addUse(pass, {Resource::Notes, Access::Read});
    return pass;
}

}   // namespace restir::gi
