// glTF metallic-roughness for the reference path tracer: written apart from the SDK's, to check it.
// All directions are in the frame of the shading normal (z).
#ifndef SAMPLES_BSDF_GLSL
#define SAMPLES_BSDF_GLSL

const float kPi = 3.14159265358979;
const float kDielectricF0 = 0.04;
const float kLeastAlpha = 0.001;

struct Bsdf {
    vec3 baseColor;
    float alpha;      // GGX, isotropic
    float metalness;
    float specular;   // scales the dielectric's reflection
};

Bsdf makeBsdf(vec3 baseColor, vec3 gloss) {
    return Bsdf(baseColor, max(gloss.x * gloss.x, kLeastAlpha), gloss.y, gloss.z);
}

float bsdfFade(float cosine) {
    float c = clamp(1.0 - cosine, 0.0, 1.0);
    return c * c * c * c * c;
}

// sin^2 instead of 1 - cos^2: near-mirrors would drown in rounding.
float bsdfGgx(Bsdf b, vec3 h) {
    float d = h.z * h.z * b.alpha * b.alpha + dot(h.xy, h.xy);
    return b.alpha * b.alpha / (kPi * d * d);
}

// Smith's sqrt(cos^2 + alpha^2 sin^2), the building block of G1 and of the height-correlated G2.
float bsdfSmith(Bsdf b, vec3 w) { return sqrt(w.z * w.z + b.alpha * b.alpha * dot(w.xy, w.xy)); }

// BSDF times the cosine of l. Both directions point away from the surface.
vec3 bsdfTimesCosine(Bsdf b, vec3 v, vec3 l) {
    if (v.z <= 0.0 || l.z <= 0.0) return vec3(0.0);
    vec3 h = normalize(v + l);
    float fade = bsdfFade(dot(v, h));
    // G2 / (4 cos cos) = 1 / (2 (cos_l smith_v + cos_v smith_l))
    float microfacets = bsdfGgx(b, h) * 0.5 / (l.z * bsdfSmith(b, v) + v.z * bsdfSmith(b, l));
    float reflected = b.specular * mix(kDielectricF0, 1.0, fade);
    vec3 dielectric = (1.0 - reflected) * b.baseColor / kPi + reflected * microfacets;
    vec3 metal = mix(b.baseColor, vec3(1.0), fade) * microfacets;
    return mix(dielectric, metal, b.metalness) * l.z;
}

// How often the microfacets are sampled rather than the cosine lobe.
float bsdfGlossyShare(Bsdf b, vec3 v) {
    float fade = bsdfFade(v.z);
    float brightness = max(b.baseColor.r, max(b.baseColor.g, b.baseColor.b));
    float reflected = b.specular * mix(kDielectricF0, 1.0, fade);
    float glossy = mix(reflected, mix(brightness, 1.0, fade), b.metalness);
    float diffuse = (1.0 - b.metalness) * (1.0 - reflected) * brightness;
    if (glossy <= 0.0) return 0.0;
    return diffuse <= 0.0 ? 1.0 : clamp(glossy / (glossy + diffuse), 0.1, 0.9);
}

float bsdfPdf(Bsdf b, vec3 v, vec3 l) {
    if (v.z <= 0.0 || l.z <= 0.0) return 0.0;
    vec3 h = normalize(v + l);
    // Visible normals: G1 D / (4 cos_v), G1 = 2 cos_v / (cos_v + smith_v)
    float glossy = bsdfGgx(b, h) / (2.0 * (v.z + bsdfSmith(b, v)));
    return mix(l.z / kPi, glossy, bsdfGlossyShare(b, v));
}

// Visible normal of the GGX distribution by a spherical cap (Dupuy and Benyoub 2023).
vec3 bsdfVisibleNormal(Bsdf b, vec3 v, vec2 random) {
    vec3 stretched = normalize(vec3(b.alpha * v.xy, v.z));
    float phi = 2.0 * kPi * random.x;
    float z = 1.0 - random.y * (1.0 + stretched.z);
    float r = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
    vec3 h = vec3(r * cos(phi), r * sin(phi), z) + stretched;
    return normalize(vec3(b.alpha * h.xy, h.z));
}

vec3 bsdfSample(Bsdf b, vec3 v, vec3 random) {
    if (random.z < bsdfGlossyShare(b, v)) return reflect(-v, bsdfVisibleNormal(b, v, random.xy));
    float phi = 2.0 * kPi * random.x;
    return vec3(sqrt(random.y) * vec2(cos(phi), sin(phi)), sqrt(1.0 - random.y));
}

#endif
