// Which pixels a frame lights: all of them (field 0), or every other one of a row, where x + y + field is even (1 or 2).
// Pixels 2k and 2k + 1 of a row are a pair, one of which is on either field.
#ifndef RESTIR_DI_FIELD_GLSL
#define RESTIR_DI_FIELD_GLSL

#define RS_FIELD_ALL 0u

bool rsIsInside(ivec2 pixel, uvec2 extent) {
    return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, ivec2(extent)));
}

uint rsOtherField(uint field) { return 3u - field; }
bool rsIsOnField(ivec2 pixel, uint field) { return field == RS_FIELD_ALL || ((pixel.x + pixel.y + int(field)) & 1) == 0; }
// The pixel of its pair that is on the field.
ivec2 rsOnField(ivec2 pixel, uint field) { return rsIsOnField(pixel, field) ? pixel : ivec2(pixel.x ^ 1, pixel.y); }

// Pixels of a field as a grid, half as wide, and back.
ivec2 rsFieldCell(ivec2 pixel, uint field) { return field == RS_FIELD_ALL ? pixel : ivec2(pixel.x >> 1, pixel.y); }
ivec2 rsFieldPixel(ivec2 cell, uint field) {
    return field == RS_FIELD_ALL ? cell : ivec2(2 * cell.x + ((cell.y + int(field)) & 1), cell.y);
}

#endif
