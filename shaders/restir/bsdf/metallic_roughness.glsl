// The glTF 2.0 metallic-roughness BSDF (specification, appendix B) with KHR_materials_specular's factor: a diffuse
// base under a GGX dielectric, mixed with a GGX metal. Directions are unit and leave the surface.
#ifndef RESTIR_BSDF_METALLIC_ROUGHNESS_GLSL
#define RESTIR_BSDF_METALLIC_ROUGHNESS_GLSL
#include "restir/core/surface.glsl"

// Below this a lobe is a mirror to 8-bit roughness and 16-bit normals.
#define RS_MIN_ALPHA 0.001

float rsAlpha(RsSurface s) { return max(s.roughness * s.roughness, RS_MIN_ALPHA); }

// With sin^2 from a cross product: cos^2 (a^2 - 1) + 1 cancels in 32 bits where the lobe is narrow.
float rsGgxDistribution(float alpha, vec3 normal, vec3 middle) {
    float a2 = alpha * alpha;
    float cosHalf = dot(normal, middle);
    vec3 sine = cross(normal, middle);
    float d = cosHalf * cosHalf * a2 + dot(sine, sine);
    return a2 / (RS_PI * d * d);
}

// Height-correlated Smith shadowing over 4 cos cos (Heitz 2014).
float rsGgxVisibility(float alpha, float cosLight, float cosView) {
    float a2 = alpha * alpha;
    float l = cosView * sqrt(cosLight * cosLight * (1.0 - a2) + a2);
    float v = cosLight * sqrt(cosView * cosView * (1.0 - a2) + a2);
    return 0.5 / (l + v);
}

float rsSchlick(float cosine) {
    float m = clamp(1.0 - cosine, 0.0, 1.0);
    float m2 = m * m;
    return m2 * m2 * m;
}

bool rsReflects(RsSurface s, vec3 light) {
    return dot(s.normal, light) > 0.0 && dot(s.geometricNormal, light) > 0.0;
}

struct RsGgx {
    float lobe;   // without Fresnel
    float schlick;
    float cosLight;
};

RsGgx rsGgx(RsSurface s, vec3 light) {
    float cosLight = dot(s.normal, light);
    float cosView = max(dot(s.normal, s.view), 1e-4);
    vec3 middle = normalize(light + s.view);
    float alpha = rsAlpha(s);
    float lobe = rsGgxDistribution(alpha, s.normal, middle) * rsGgxVisibility(alpha, cosLight, cosView);
    return RsGgx(lobe, rsSchlick(dot(s.view, middle)), cosLight);
}

// BSDF times cosine, 1/sr. 0 below either horizon.
vec3 rsBsdf(RsSurface s, vec3 light) {
    if (!rsReflects(s, light)) return vec3(0.0);
    RsGgx ggx = rsGgx(s, light);
    float lobe = ggx.lobe, schlick = ggx.schlick;
    float fresnel = s.specular * (0.04 + 0.96 * schlick);
    vec3 dielectric = (1.0 - fresnel) / RS_PI * s.baseColor + fresnel * lobe;
    vec3 metal = (s.baseColor + (1.0 - s.baseColor) * schlick) * lobe;
    return mix(dielectric, metal, s.metalness) * ggx.cosLight;
}

vec3 rsDiffuseAlbedo(RsSurface s) { return (1.0 - s.metalness) * s.baseColor; }

// What the specular lobe reflects at normal incidence; not 0 where that is black, since grazing light is reflected still.
vec3 rsSpecularFactor(RsSurface s) { return max(mix(vec3(0.04 * s.specular), s.baseColor, s.metalness), 0.01); }

// rsBsdf = diffuse * rsDiffuseAlbedo + specular * rsSpecularFactor. Nothing is divided by the albedo, which may be 0.
RsLobes rsBsdfLobes(RsSurface s, vec3 light) {
    if (!rsReflects(s, light)) return RsLobes(vec3(0.0), vec3(0.0));
    RsGgx ggx = rsGgx(s, light);
    float fresnel = s.specular * (0.04 + 0.96 * ggx.schlick);
    vec3 metal = s.baseColor + (1.0 - s.baseColor) * ggx.schlick;
    vec3 specular = mix(vec3(fresnel), metal, s.metalness) * ggx.lobe / rsSpecularFactor(s);
    float diffuse = rsLuminance(rsDiffuseAlbedo(s)) > 0.0 ? (1.0 - fresnel) / RS_PI : 0.0;
    return RsLobes(vec3(diffuse * ggx.cosLight), specular * ggx.cosLight);
}

// Probability that rsSampleBsdf takes the specular lobe: its share of the albedo, seen from the viewer.
float rsSpecularChance(RsSurface s) {
    float schlick = rsSchlick(max(dot(s.normal, s.view), 0.0));
    float color = rsLuminance(s.baseColor);
    float fresnel = s.specular * (0.04 + 0.96 * schlick);
    float specular = mix(fresnel, color + (1.0 - color) * schlick, s.metalness);
    float diffuse = (1.0 - s.metalness) * (1.0 - fresnel) * color;
    return specular > 0.0 ? clamp(specular / (specular + diffuse), 0.05, 1.0) : 0.0;
}

// Density of the normals visible from `view` in tangent space (Heitz 2018), per solid angle of the reflection.
float rsPdfGgx(float alpha, float cosView, vec3 normal, vec3 middle) {
    float a2 = alpha * alpha;
    float g1 = 2.0 / (cosView + sqrt(a2 + (1.0 - a2) * cosView * cosView));   // 2 x Smith G1 / (2 cosView)
    return g1 * rsGgxDistribution(alpha, normal, middle) * 0.25;
}

vec3 rsSampleGgxNormal(vec3 view, float alpha, vec2 u) {
    vec3 v = normalize(vec3(alpha * view.xy, view.z));
    float r = sqrt(u.x);
    float phi = 2.0 * RS_PI * u.y;
    vec2 t = r * vec2(cos(phi), sin(phi));
    // The lower half of the projected hemisphere is squeezed by the slant of v; `side` is the axis of that slant.
    float slant = dot(v.xy, v.xy);
    vec3 side = slant > 0.0 ? vec3(-v.y, v.x, 0.0) * inversesqrt(slant) : vec3(1.0, 0.0, 0.0);
    vec3 up = cross(v, side);
    float s = 0.5 * (1.0 + v.z);
    t.y = mix(sqrt(max(1.0 - t.x * t.x, 0.0)), t.y, s);
    vec3 n = t.x * side + t.y * up + sqrt(max(1.0 - dot(t, t), 0.0)) * v;
    return normalize(vec3(alpha * n.xy, max(n.z, 1e-6)));
}

float rsPdfBsdf(RsSurface s, vec3 light) {
    if (!rsReflects(s, light)) return 0.0;
    float chance = rsSpecularChance(s);
    float pdf = (1.0 - chance) * dot(s.normal, light) / RS_PI;
    if (chance > 0.0) {
        vec3 middle = normalize(light + s.view);
        pdf += chance * rsPdfGgx(rsAlpha(s), max(dot(s.normal, s.view), 1e-4), s.normal, middle);
    }
    return pdf;
}

// A direction; one below a horizon is a candidate with value 0 and must be counted as such.
vec3 rsSampleBsdf(RsSurface s, vec3 u) {
    mat3 basis = rsBasis(s.normal);
    if (u.z < rsSpecularChance(s)) {
        vec3 view = s.view * basis;
        view.z = max(view.z, 1e-4);
        vec3 middle = basis * rsSampleGgxNormal(normalize(view), rsAlpha(s), u.xy);
        return reflect(-s.view, middle);
    }
    float r = sqrt(u.x);
    float phi = 2.0 * RS_PI * u.y;
    return basis * vec3(r * cos(phi), r * sin(phi), sqrt(max(1.0 - u.x, 0.0)));
}

#endif
