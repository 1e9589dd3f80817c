// What a pixel's reservoir holds, to look at (restir::DebugView): rgb a colour that is shown as it is, w the number
// behind it. The legend is in restir/settings.h.
#ifndef RESTIR_DI_DEBUG_GLSL
#define RESTIR_DI_DEBUG_GLSL
#include "restir/di/spatial.glsl"

#define RS_DEBUG_WINDOW 3   // pixels to each side that Duplicates looks at

const vec4 RS_NO_SAMPLE_SHOWN = vec4(vec3(0.5), -1.0);

// Dark blue at 0, blue, green, yellow, red at 1; evenly spaced.
vec3 rsRamp(float t) {
    const vec3 stops[5] = vec3[](vec3(0.03, 0.03, 0.3), vec3(0.1, 0.4, 0.9), vec3(0.15, 0.75, 0.35),
                                 vec3(1.0, 0.85, 0.2), vec3(0.9, 0.1, 0.1));
    float at = rsSaturate(t) * 4.0;
    int i = min(int(at), 3);
    return mix(stops[i], stops[i + 1], at - float(i));
}

// A hue and a saturation for each.
vec3 rsIdColor(uint id) {
    uint hash = rsHash(id);
    float turn = float(hash & 0xffffu) / 65536.0;
    vec3 hue = clamp(abs(fract(turn + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    return mix(vec3(0.25), hue, 0.6 + 0.4 * float(hash >> 16u) / 65535.0);
}

vec4 rsShowVisibility(RsSurface s, RsReservoir r) {
    bool visible = rsUnoccluded(s, rsDirect(s, rsLoadLight(r.light), r.uv).incident);
    return visible ? vec4(0.15, 0.75, 0.35, 1.0) : vec4(0.9, 0.1, 0.1, 0.0);
}

// `random`: the spatial pass's own, so that these are the neighbours it asked.
vec4 rsShowNeighbours(RsSurface s, uvec2 pixel, uvec2 extent, RsDiConstants di, RsRandom random) {
    const vec3 colors[5] = vec3[](vec3(0.15), vec3(1.0, 0.1, 0.1), vec3(0.15, 0.3, 1.0), vec3(0.1, 0.8, 0.1), vec3(1.0));
    RsNeighbourhood where = rsNeighbourhood(pixel, di, random);
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < where.count; ++i) {
        uint verdict = rsJudgeNeighbour(s, rsNeighbourPixel(where, i), pixel, extent, di);
        sum += vec4(colors[verdict] / float(where.count), verdict == RS_ACCEPTED ? 1.0 : 0.0);
    }
    return sum;
}

vec4 rsShowSample(RsSurface s, RsReservoir r) {
    vec2 uv = rsUnpackUv(r.uv);
    return vec4(uv, max(1.0 - uv.x - uv.y, 0.0), rsDirect(s, rsLoadLight(r.light), r.uv).incident.distance);
}

vec4 rsShowDuplicates(RsReservoir r, uvec2 pixel, uvec2 extent, uint field) {
    float count = -1.0;   // itself
    ivec2 first = max(ivec2(pixel) - RS_DEBUG_WINDOW, ivec2(0));
    ivec2 last = min(ivec2(pixel) + RS_DEBUG_WINDOW, ivec2(extent) - 1);
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            if (!rsIsOnField(ivec2(x, y), field)) continue;   // of another frame
            RsReservoir other = rsLoadSource(uvec2(x, y));
            if (rsHasSample(other) && other.light == r.light && other.uv == r.uv) count += 1.0;
        }
    }
    const float side = float(2 * RS_DEBUG_WINDOW + 1);
    return vec4(rsRamp(sqrt(count / (side * side - 1.0))), count);
}

vec4 rsDiDebug(uint view, RsSurface s, uvec2 pixel, uvec2 extent, RsDiConstants di, RsRandom random) {
    RsReservoir r = rsLoadSource(pixel);
    if (view == RS_DEBUG_NEIGHBOURS) return rsShowNeighbours(s, pixel, extent, di, random);
    if (view == RS_DEBUG_CONFIDENCE) {
        float confidence = float(rsConfidence(r));
        return vec4(rsRamp(confidence / float((di.maxHistory + 1u) * (di.neighbours + 1u))), confidence);
    }
    if (!rsHasSample(r)) return RS_NO_SAMPLE_SHOWN;
    if (view == RS_DEBUG_AGE) return vec4(rsRamp(log2(1.0 + float(rsAge(r))) / 8.0), rsAge(r));
    if (view == RS_DEBUG_WEIGHT) return vec4(rsRamp((log2(r.ucw) / log2(10.0) + 2.0) / 8.0), r.ucw);
    if (view == RS_DEBUG_LIGHT) return vec4(rsIdColor(r.light), r.light);
    if (view == RS_DEBUG_VISIBILITY) return rsShowVisibility(s, r);
    if (view == RS_DEBUG_SAMPLES) return rsShowSample(s, r);
    return rsShowDuplicates(r, pixel, extent, di.field);
}

#endif
