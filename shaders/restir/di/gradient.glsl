// How much of a pixel's light has changed since the last frame, in [0, 1], for denoisers: in luminance
//     g = int |f_now - f_then| / int max(f_now, f_then),    f_then: last frame's lights at this frame's surface.
// What is lost is found by a sample of last frame's light, what is gained by one of this frame's:
//     lost = max(p^_then(then) - p^_now(then) V_now, 0) W_then      gained = max(p^_now(now) - p^_then(now), 0) W_now
//     g = (lost + gained) / (p^_then(then) W_then + gained)
// Numerator and denominator are unbiased but for visibility; their ratio is only after a filter over pixels. Light that a blocker sets free counts as old: last frame's V of `now` is not
// known.
#ifndef RESTIR_DI_GRADIENT_GLSL
#define RESTIR_DI_GRADIENT_GLSL
#include "restir/di/direct.glsl"
#include "restir/di/reservoir.glsl"

// x: lost + gained, y: the light that both frames have or one of them. Where nothing is known of the last frame `known`
// is false, `then` empty and all light new.
vec2 rsDiGradient(RsSurface s, RsReservoir now, RsReservoir then, bool known, uint visibility) {
    float old = 0.0, lost = 0.0, gained = 0.0;
    if (rsHasSample(then)) {
        RsDirect direct = rsDirect(s, rsLoadLight(then.light), then.uv);
        bool left = direct.target > 0.0;
        // Only where samples are killed was it visible before.
        if (left && visibility != RS_VISIBILITY_NONE) left = rsUnoccluded(s, direct.incident);
        float before = rsDirect(s, rsLoadPreviousLight(then.light), then.uv).target;
        old = before * then.ucw;
        lost = max(before - (left ? direct.target : 0.0), 0.0) * then.ucw;
    }
    if (rsHasSample(now)) {
        float before = known ? rsDirect(s, rsLoadPreviousLight(now.light), now.uv).target : 0.0;
        gained = max(rsDirect(s, rsLoadLight(now.light), now.uv).target - before, 0.0) * now.ucw;
    }
    return vec2(lost + gained, old + gained);
}

#endif
