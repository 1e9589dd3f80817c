#pragma once

#include <cstdint>

namespace restir {

// How reservoirs are weighed against one another (shaders/restir/di/combine.glsl).
enum class Weights : uint8_t {
    Off,             // 1/M: biased wherever two pixels cannot see the same lights
    Basic,           // 1/Z: unbiased, noisiest
    Balance,         // balance heuristic of the selected sample
    Pairwise,        // defensive pairwise MIS (Bitterli 2022): the quietest
    PairwisePlain,   // without the share that the defensive form gives a pixel's own reservoir whatever its
                     // neighbours
};

// What becomes of visibility when samples are reused. A change drops the history.
enum class VisibilityReuse : uint8_t {
    None,     // no sample is killed, one ray in the final shading (and those of bsdfCandidates): unbiased,
              // noisier in shadow
    Cached,   // occluded samples are killed, weights ignore it: fast, biased towards darkness
    Traced,   // weights trace each neighbour's view of a sample: unbiased while emission and alpha textures
              // stand still, and geometry too where the host gives no FrameInput::previousTlas
};

enum class DirectMode : uint8_t {
    Restir,      // reservoirs
    NextEvent,   // plain next-event estimation: `lightCandidates` lights, a ray each; what ReSTIR is measured
                 // against
    Off,         // no direct light: what surfaces emit, and indirect light
};

struct DiSettings {
    DirectMode mode = DirectMode::Restir;
    uint32_t lightCandidates = 16;   // [1, 65536] lights tried per round before reuse
    // [0, 0.9] the share of them that are drawn by what they may bring to the surface, with LightTableDesc::tree; all others
    // are drawn by power alone. Unbiased whatever it is; 0 is faster where all light comes from one place.
    float treeShare = 0.75f;
    uint32_t initialSamples = 1;     // [1, 8] rounds; a shadow ray for the light that each of them chooses
    uint32_t cutSamples = 4;         // [1, 8] rounds, if more, of a frame whose temporal reuse has no history
    uint32_t bsdfCandidates = 1;     // [0, 8] directions tried, a ray each; 0 where nothing is glossy
    bool temporal = true;
    uint32_t maxHistory = 20;   // [0, 1000] frames a temporal reservoir may stand for
    // Each pixel takes the history of another one nearby: several times less correlation from frame to frame,
    // for denoisers that average over frames, but two to three times the error in each.
    bool permuteHistory = false;
    uint32_t spatialPasses = 1;   // [0, 8]
    uint32_t neighbours = 5;      // [1, 16] per spatial pass
    // With `temporal` and history: one pass over the last frame's reservoirs, at the pixel's old place and at
    // `neighbours` around it, instead of the temporal and the first spatial pass.
    bool fused = false;
    // Half of the pixels of a frame, every other one of a row and in the next frame the others, in half of
    // the time; the rest is filled in from the four pixels around, which blurs light by a pixel: biased
    // there.
    bool checkerboard = false;
    float radius = 30.0f;   // pixels, > 0
    // Neighbours in pairs: if b is a's i-th neighbour, a is b's, and the two share rays and targets: half of
    // both. Needs SessionDesc::pairedNeighbours; without effect on weights other than the pairwise ones,
    // whose questions involve third pixels. Neighbours lie in squares instead of a disc, at the same mean
    // square distance. DebugView::Neighbours goes on showing the disc.
    bool pairedNeighbours = false;
    // Which neighbours count as the same surface; tested before their reservoirs are read.
    float normalThreshold = 0.9f;   // cosine between shading normals, [-1, 1]
    float depthThreshold = 0.1f;    // of linear depth, relative, > 0
    Weights weights = Weights::Pairwise;
    VisibilityReuse visibility = VisibilityReuse::Traced;
    // With Traced visibility and weights other than Basic and Balance the last spatial pass shades the
    // weighted mean of all its inputs instead of the one it keeps: as unbiased, no more rays, less noise in
    // colour and shadow.
    bool averageShading = true;
    // [0, 1] after temporal reuse no pixel's sample brings more than 4 / boilingFilter times the mean of the
    // others of its 8x8 tile: less boiling and less error, biased towards darkness. 0: off.
    float boilingFilter = 0;
};

enum class IndirectMode : uint8_t {
    Off,      // direct light only
    Path,     // plain path tracing, one path a pixel and frame: what reuse is measured against
    Restir,   // reservoirs of paths; needs SessionDesc::indirect
};

// Indirect light: light scattered at least twice (Ouyang et al. 2021). One path a pixel is traced, and its
// second vertex reused. Output::radiance has it all, lobes of its own show it alone; Output::gradient and
// debug views are of direct light.
struct GiSettings {
    IndirectMode mode = IndirectMode::Off;
    uint32_t bounces = 3;   // [2, 64] scattering events of a path at most, the visible surface's among them
    uint32_t lightCandidates =
        4;   // [1, 65536] lights tried at each vertex behind that; one of them gets a shadow ray
    float treeShare = 0.75f;   // as in DiSettings
    bool temporal = true;
    // [0, 1000] frames a temporal reservoir may stand for. With Traced and FrameInput::previousTlas a second
    // vertex counts while there is a surface where it is and its light is seen from there; else things that
    // move are followed as late as that.
    uint32_t maxHistory = 8;
    // [0, 1] In a frame that the host recorded other lights for, or gave a previousTlas to, what is left of the
    // history of light scattered three times and more: what such a path saw is not looked at again. Above 0: less
    // noise, and what changed is followed late. Light scattered twice is looked up in the new lights and traced
    // among what moved, and loses nothing.
    float staleHistory = 0;
    uint32_t spatialPasses = 1;     // [0, 8]
    uint32_t neighbours = 5;        // [1, 16] per spatial pass
    float radius = 30.0f;           // pixels, > 0
    bool pairedNeighbours = false;  // as in DiSettings; both use the same memory
    float normalThreshold = 0.9f;   // as in DiSettings
    float depthThreshold = 0.1f;
    // As in DiSettings. Where nobody around is on a pixel's surface, it traces a path of its own.
    bool checkerboard = false;
    // Paths for one pixel of each 2 x 2, another one in each frame, and the rest filled in from the two or four closest: a quarter
    // of the paths, biased as a checkerboard is. `checkerboard` is then without effect.
    bool halfResolution = false;
    // Not the defensive form: what that leaves to a pixel's own path is more than that is worth here.
    Weights weights = Weights::PairwisePlain;
    // Cached or Traced, as in DiSettings. None does not exist: every path is traced, so a reservoir never
    // holds what its pixel does not see.
    VisibilityReuse visibility = VisibilityReuse::Traced;
    bool averageShading = true;   // as in DiSettings
    // Where a surface is smooth, the pixel's own fresh path, which its BSDF drew, has up to six tenths of what is
    // shown, by roughness and by the specular lobe's part of the reflectance: as unbiased, and less noise in near
    // mirrors. Without effect with a boilingFilter, which it would go around.
    bool ownPath = true;
    float boilingFilter = 0;   // as in DiSettings
};

// Where to start from, each measured against the others and against the truth in the README.
enum class Preset : uint8_t {
    Fast,   // half of the pixels a frame, outliers cut back, shadows of reused samples taken as they were:
            // too dark
    Balanced,   // outliers cut back: a little too dark
    Quality,    // the same with more samples and neighbours
    Unbiased,   // Balanced with more candidates and no filter: the mean of many frames is right
};

// The most neighbours of a preset: what SessionDesc::pairedNeighbours takes for any of them.
inline constexpr uint32_t kPresetPartners = 8;

constexpr DiSettings presetSettings(Preset preset) noexcept {
    DiSettings di;
    if (preset == Preset::Fast) {
        di.checkerboard = true;
        di.visibility = VisibilityReuse::Cached;
    } else {
        di.initialSamples = 2;
        di.pairedNeighbours = true;
        // Fewer make outliers, which the filter takes away.
        if (preset != Preset::Unbiased) di.lightCandidates = 8;
    }
    if (preset == Preset::Quality) {
        di.initialSamples = 4;
        di.cutSamples = 8;
        di.neighbours = kPresetPartners;
    }
    if (preset != Preset::Unbiased) di.boilingFilter = 0.5f;
    return di;
}

// The same for indirect light.
constexpr GiSettings presetIndirect(Preset preset) noexcept {
    GiSettings gi;
    gi.mode = IndirectMode::Restir;
    if (preset == Preset::Fast) {
        gi.checkerboard = true;
        gi.visibility = VisibilityReuse::Cached;
    } else {
        gi.pairedNeighbours = true;
    }
    if (preset == Preset::Quality) gi.neighbours = kPresetPartners;
    if (preset != Preset::Unbiased) gi.boilingFilter = 0.5f;
    return gi;
}

// What Output::debug shows of the reservoirs that a frame ends with. rgb is a colour to be shown as it is
// (neither tone-mapped nor encoded again), w the number behind it. A pixel without a surface is black and 0.
// In the views of a sample, a pixel without one is grey and -1. Ramps run from dark blue over blue, green and
// yellow to red.
enum class DebugView : uint8_t {
    None,
    Confidence,   // M in pixel-frames; ramp from 0 to (maxHistory + 1) (neighbours + 1)
    Age,          // of the sample in frames; ramp 0, 3, 15, 63, 255
    Weight,       // W of the sample; ramp 1e-2, 1, 1e2, 1e4, 1e6
    Light,        // its light id; a colour for each
    Visibility,   // traced anew, a ray a pixel: green and 1, or red and 0 where something blocks it
    Neighbours,   // of the last spatial pass (not of `fused`): how many it took; dark grey taken, red another
                  // normal, blue off the plane, green without a surface, white outside the image or the pixel
                  // itself, in shares of them
    Samples,      // the point on its light: red u, green v, blue 1 - u - v; w its distance in metres (1e30:
                  // infinite)
    Duplicates,   // pixels among the 48 around with the same point on the same light; ramp 0, 3, 12, 27, 48
};

struct Settings {
    DiSettings di;
    GiSettings gi;
    DebugView debugView =
        DebugView::None;     // other than None: one more pass; needs Output::debug and DirectMode::Restir
    bool counters = false;   // sum up rays and rejected weights (Session::counters); costs atomics
};

}   // namespace restir
