// What a pixel's own fresh path has of the final shading. Fresh and reused light are two estimates of one integral; their mean with
// shares that no sample has a say in is as unbiased as both (MIS with constant weights). What a smooth surface reflects changes from
// pixel to pixel and frame to frame, so that what others found there is worth less than the path that its own BSDF drew. The share is
// that of the specular lobe in its reflectance, less with roughness.
#ifndef RESTIR_GI_OWN_GLSL
#define RESTIR_GI_OWN_GLSL
#include "restir/di/direct.glsl"

RsLobes rsBridgeLobeFactors(RsSurface s);

// By restir-bench error of metal floors and a coffee maker: README, Measured.
#define RS_OWN_SMOOTH 0.05
#define RS_OWN_ROUGH 0.35
#define RS_OWN_MOST 0.6

float rsOwnShare(RsSurface s) {
    RsLobes factors = rsBridgeLobeFactors(s);
    float specular = rsLuminance(factors.specular), diffuse = rsLuminance(factors.diffuse);
    if (!(specular > 0.0)) return 0.0;
    return RS_OWN_MOST * (1.0 - smoothstep(RS_OWN_SMOOTH, RS_OWN_ROUGH, s.roughness)) * specular / (specular + diffuse);
}

#endif
