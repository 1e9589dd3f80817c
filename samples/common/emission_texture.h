// What emissive textures mean for the lights made from their triangles.
#pragma once

#include "common/scene.h"

namespace samples {

// An alpha-masked emitter shines only where it is. The SDK's lights have no alpha, so each such material gets
// an emission texture that is black around every texel that is cut out.
void bakeMaskedEmission(SceneData& scene);

// Luminance of a material's emission as a texture, for averaging over triangles.
class EmissionMap {
public:
    // The material has an emission texture.
    EmissionMap(const SceneData& scene, const restir::gpu::RsMaterial& material);

    // Mean over a triangle of texture coordinates; 0 only if it is black everywhere, filtering included.
    float mean(const glm::vec2 (&uv)[3]) const;

private:
    float texel(int64_t x, int64_t y) const;
    float bilinear(glm::vec2 uv) const;
    float touched(const glm::vec2 (&uv)[3]) const;

    int64_t width_ = 0, height_ = 0;
    Wrap wrapU_ = Wrap::Repeat, wrapV_ = Wrap::Repeat;
    std::vector<float> luminance_;
    float average_ = 0;
};

float luminance(const glm::vec3& color);

}   // namespace samples
