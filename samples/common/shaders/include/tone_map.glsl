// From light to a display's colours. GLSL that is C++ with glm, too: the viewer's shader and the PNG writer show the same.
// Before including it C++ says what TONE_MAP_FUNCTION is, and that it uses glm's names.
#ifndef SAMPLES_TONE_MAP_GLSL
#define SAMPLES_TONE_MAP_GLSL
#ifndef TONE_MAP_FUNCTION
#define TONE_MAP_FUNCTION
#endif

TONE_MAP_FUNCTION float luminance(vec3 color) { return dot(color, vec3(0.2126f, 0.7152f, 0.0722f)); }

// Narkowicz's fit of the ACES filmic curve (2015), scaled so that exposed middle gray stays middle gray.
TONE_MAP_FUNCTION float filmic(float x) {
    const float kPreScale = 0.72f;
    float v = x * kPreScale;
    return min(v * (2.51f * v + 0.03f) / (v * (2.43f * v + 0.59f) + 0.14f), 1.0f);
}

// Mostly the curve of the largest channel, which keeps hues; a part of the curve of each channel, which lets
// bright reds turn orange as film does. Far past white, colours fade slowly, so that lamps look bright and
// still coloured.
TONE_MAP_FUNCTION vec3 toneMap(vec3 color) {
    float peak = max(color.x, max(color.y, color.z));
    if (peak <= 0.0f) return vec3(0.0f);
    const float kFadeStart = 2.0f, kFadeRate = 0.008f, kLargestFade = 0.6f, kPerChannel = 0.35f;
    float fade = 1.0f - 1.0f / (1.0f + kFadeRate * max(peak - kFadeStart, 0.0f));
    vec3 perChannel = vec3(filmic(color.x), filmic(color.y), filmic(color.z));
    vec3 mapped = mix(color * (filmic(peak) / peak), perChannel, kPerChannel);
    return mix(mapped, vec3(filmic(peak)), min(fade, kLargestFade));
}

TONE_MAP_FUNCTION float encodeSrgb(float linear) {
    float v = clamp(linear, 0.0f, 1.0f);
    return v <= 0.0031308f ? 12.92f * v : 1.055f * pow(v, 1.0f / 2.4f) - 0.055f;
}

#endif
