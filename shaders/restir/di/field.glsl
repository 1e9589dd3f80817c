// Which pixels a frame lights: one of each cell. A cell is a pixel (RS_FIELD_ALL), the pair 2k, 2k + 1 of a row (1 or 2: where
// x + y + field is even), or a block of 2 x 2 (RS_FIELD_BLOCKS + x + 2 y). Blocks are of indirect light alone: registers.
#ifndef RESTIR_DI_FIELD_GLSL
#define RESTIR_DI_FIELD_GLSL
#include "restir/shared/di.h"

#ifdef RS_PASS_INDIRECT
bool rsIsOfBlocks(uint field) { return field >= RS_FIELD_BLOCKS; }
#else
bool rsIsOfBlocks(uint field) { return false; }
#endif

bool rsIsInside(ivec2 pixel, uvec2 extent) {
    return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, ivec2(extent)));
}

// The one of a pixel's block.
ivec2 rsOnBlock(ivec2 pixel, uint field) {
    return ivec2(bitfieldInsert(pixel.x, int(field), 0, 1), bitfieldInsert(pixel.y, int(field >> 1u), 0, 1));
}

bool rsIsOnField(ivec2 pixel, uint field) {
    if (rsIsOfBlocks(field)) return rsOnBlock(pixel, field) == pixel;
    return field == RS_FIELD_ALL || ((pixel.x + pixel.y + int(field)) & 1) == 0;
}
// The pixel of its cell that is on the field.
ivec2 rsOnField(ivec2 pixel, uint field) {
    if (rsIsOfBlocks(field)) return rsOnBlock(pixel, field);
    return rsIsOnField(pixel, field) ? pixel : ivec2(pixel.x ^ 1, pixel.y);
}

// Its cell, and back.
ivec2 rsFieldCell(ivec2 pixel, uint field) {
    if (rsIsOfBlocks(field)) return pixel >> 1;
    return field == RS_FIELD_ALL ? pixel : ivec2(pixel.x >> 1, pixel.y);
}
ivec2 rsFieldPixel(ivec2 cell, uint field) {
    if (rsIsOfBlocks(field)) return rsOnBlock(2 * cell, field);
    return field == RS_FIELD_ALL ? cell : ivec2(2 * cell.x + ((cell.y + int(field)) & 1), cell.y);
}

// What covers the pixels that are off the field: the other one of each pair; of blocks all, those on the field among them.
uint rsOtherField(uint field) { return rsIsOfBlocks(field) ? RS_FIELD_ALL : 3u - field; }

#endif
