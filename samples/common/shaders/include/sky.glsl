// The scene's environment map: its radiance, and directions drawn by two cumulative distributions, rows first. Half of
// the directions are uniform over the sphere, so that no rounding of the distributions starves a dark sky.
#ifndef SAMPLES_SKY_GLSL
#define SAMPLES_SKY_GLSL
#include "scene.glsl"

// SkyHeader in sky.h, then the rows' distribution and each row's: height + 1 and width + 1 numbers from 0 to 1.
layout(set = 1, binding = 5, scalar) readonly buffer SceneSky {
    uint skyTexture;   // RS_NO_TEXTURE: no sky
    float skyRotation;
    float skyScale;
    uint skyWidth, skyHeight;
    float skyDistribution[];
};

const float kSkyPi = 3.14159265358979;

bool hasSky() { return skyTexture != RS_NO_TEXTURE; }

// Turning the map by an angle about y takes its x axis towards -z.
vec2 skyCoordinates(vec3 direction) {
    vec3 d = normalize(direction);
    float u = 0.5 + (atan(d.z, d.x) + skyRotation) / (2.0 * kSkyPi);
    return vec2(u - floor(u), acos(clamp(d.y, -1.0, 1.0)) / kSkyPi);
}
vec3 skyDirection(vec2 uv) {
    float phi = 2.0 * kSkyPi * (uv.x - 0.5) - skyRotation, theta = kSkyPi * uv.y;
    return vec3(sin(theta) * cos(phi), cos(theta), sin(theta) * sin(phi));
}
vec3 skyRadiance(vec3 direction) { return skyScale * sceneTexture(skyTexture, skyCoordinates(direction)).rgb; }

// Start of a row's distribution; row -1 is that of the rows.
uint skyStart(int row) { return row < 0 ? 0u : skyHeight + 1u + uint(row) * (skyWidth + 1u); }

float skyPdf(vec3 direction) {
    vec2 uv = skyCoordinates(direction);
    uint x = min(uint(uv.x * float(skyWidth)), skyWidth - 1u), y = min(uint(uv.y * float(skyHeight)), skyHeight - 1u);
    uint row = skyStart(int(y)) + x;
    float share = (skyDistribution[y + 1u] - skyDistribution[y]) * (skyDistribution[row + 1u] - skyDistribution[row]);
    float perTexel = share * float(skyWidth) * float(skyHeight);   // per unit of uv
    float sine = max(sin(kSkyPi * uv.y), 1e-6);
    return 0.5 * perTexel / (2.0 * kSkyPi * kSkyPi * sine) + 0.5 / (4.0 * kSkyPi);
}

// Which of `count` steps holds `random`, and where in it.
float skySearch(uint start, uint count, float random, out uint found) {
    uint low = 0u, high = count;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (skyDistribution[start + middle] <= random) low = middle;
        else high = middle;
    }
    found = low;
    float a = skyDistribution[start + low], b = skyDistribution[start + low + 1u];
    return b > a ? clamp((random - a) / (b - a), 0.0, 1.0) : 0.5;
}

vec3 sampleSky(vec3 random) {
    if (random.z < 0.5) {
        float z = 1.0 - 2.0 * random.x, phi = 2.0 * kSkyPi * random.y;
        return vec3(sqrt(max(1.0 - z * z, 0.0)) * vec2(cos(phi), sin(phi)), z);
    }
    uint x, y;
    float v = skySearch(skyStart(-1), skyHeight, random.x, y);
    float u = skySearch(skyStart(int(y)), skyWidth, random.y, x);
    return skyDirection((vec2(x, y) + vec2(u, v)) / vec2(skyWidth, skyHeight));
}

#endif
