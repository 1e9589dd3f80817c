// Photometric profiles: IES LM-63 files of type C.
#pragma once

#include <string_view>

#include "common/scene.h"

namespace samples {

struct PhotometricProfile {
    Image image;   // over the intensity's peak, in 8 bits: u horizontal, v vertical angle, as restir::Light
                   // has it
    float peak = 0;   // candela
    float mean = 0;   // of the image, over all directions
};

// Throws std::runtime_error saying what is wrong.
PhotometricProfile readIes(std::string_view text);

}   // namespace samples
