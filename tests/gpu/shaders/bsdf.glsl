#version 460
// The BSDF of one surface. Job 0: integrals over one bin of directions per invocation. Job 1: samples.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "restir/bsdf/metallic_roughness.glsl"
#include "restir/core/random.glsl"

#define THETA_BINS 16u
#define PHI_BINS 32u
#define STEPS 32u

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Parameters {
    uint job, seed;
    vec3 normal, geometricNormal, view, baseColor;
    float roughness, metalness, specular;
};
struct Result {
    uint bin;      // job 1: of the sample; ~0 where its pdf is 0
    vec3 value;    // job 0: integral of BSDF x cosine; job 1: that over pdf
    float pdf;     // job 0: integral of the pdf; job 1: cosine / pdf
    float worst;   // job 0: the largest |f - its Lambertian form| / pdf-free scale
};
layout(set = 0, binding = 1, scalar) writeonly buffer Out { Result results[]; };

// Bins are equal in cosine and azimuth, over the whole sphere about the normal.
vec3 directionOf(mat3 basis, float u, float v) {
    float z = u * 2.0 - 1.0, r = sqrt(max(1.0 - z * z, 0.0)), phi = 2.0 * RS_PI * v;
    return basis * vec3(r * cos(phi), r * sin(phi), z);
}

Result integrate(RsSurface s, mat3 basis, uint bin) {
    Result result = Result(bin, vec3(0.0), 0.0, 0.0);
    vec2 corner = vec2(bin / PHI_BINS, bin % PHI_BINS), size = 1.0 / vec2(THETA_BINS, PHI_BINS);
    for (uint i = 0u; i < STEPS * STEPS; ++i) {
        vec2 at = (corner + (vec2(i / STEPS, i % STEPS) + 0.5) / float(STEPS)) * size;
        vec3 light = directionOf(basis, at.x, at.y);
        vec3 f = rsBsdf(s, light);
        result.value += f;
        result.pdf += rsPdfBsdf(s, light);
        vec3 lambert = s.baseColor / RS_PI * max(dot(s.normal, light), 0.0);
        result.worst = max(result.worst, length(f - lambert));
    }
    float solidAngle = 4.0 * RS_PI * size.x * size.y / float(STEPS * STEPS);
    result.value *= solidAngle;
    result.pdf *= solidAngle;
    return result;
}

Result draw(RsSurface s, mat3 basis, uint i) {
    RsRandom random = rsRandom(uvec2(i & 511u, i >> 9u), seed, 0u);
    vec3 light = rsSampleBsdf(s, vec3(rsNext2(random), rsNext(random)));
    float pdf = rsPdfBsdf(s, light);
    if (!(pdf > 0.0)) return Result(~0u, vec3(0.0), 0.0, length(light));
    vec3 local = light * basis;
    uint row = min(uint((local.z * 0.5 + 0.5) * float(THETA_BINS)), THETA_BINS - 1u);
    uint column = min(uint(fract(atan(local.y, local.x) / (2.0 * RS_PI)) * float(PHI_BINS)), PHI_BINS - 1u);
    return Result(row * PHI_BINS + column, rsBsdf(s, light) / pdf, local.z / pdf, length(light));
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    RsSurface s;
    s.valid = true;
    s.normal = normal;
    s.geometricNormal = geometricNormal;
    s.view = view;
    s.baseColor = baseColor;
    s.roughness = roughness;
    s.metalness = metalness;
    s.specular = specular;
    mat3 basis = rsBasis(normal);
    if (job == 0u) results[i] = integrate(s, basis, i);
    else results[i] = draw(s, basis, i);
}
