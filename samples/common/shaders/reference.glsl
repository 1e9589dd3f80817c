#version 460
#extension GL_GOOGLE_include_directive : require
// The reference: unidirectional path tracing, next-event estimation with every light equally likely, combined
// with BSDF sampling by the balance heuristic. Shares no code with the SDK.
#include "include/scene_trace.glsl"
#include "include/camera.glsl"
#include "include/bsdf.glsl"
#include "include/reference_lights.glsl"

layout(set = 0, binding = 0) uniform writeonly image2D radianceImage;   // w: rays traced

layout(push_constant, scalar) uniform Constants {
    CameraPose camera;
    uvec2 extent;
    uint seed;
    uint frame;
    uint paths;       // per pixel
    uint bounces;     // scattering events at most
    uint lightCount;
    uint flags;
};

const uint kNextEvent = 1u;   // off: BSDF sampling alone finds the lights
const uint kJitter = 2u;      // paths spread over the pixel instead of through its centre
const uint kIndirect = 4u;    // only light that was scattered twice at least
// Ray origins leave the surface by this much of the largest coordinate: some hundred float roundings.
const float kRayOffset = 4e-5;
const float kLeastCosine = 1e-3;   // between shading normal and view, see vertexFrame()

uvec4 randomState;

// PCG in four dimensions (Jarzynski and Olano 2020), counting in w.
vec4 random4() {
    uvec4 v = randomState * 1664525u + 1013904223u;
    v += v.yzxy * v.wxyz.wxyz;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> 16;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    ++randomState.w;
    return vec4(v >> 8) * (1.0 / 16777216.0);
}

// One vertex of a path, seen from `view`.
struct Vertex {
    Surface surface;
    Bsdf bsdf;
    mat3 worldFromLocal;   // z is the shading normal, on the viewer's side
    vec3 geometricNormal;  // on the viewer's side
    vec3 view;             // in the local frame
    vec3 origin;           // of rays that leave it
};

// Two-sided shading: both normals turn to the viewer, and a shading normal that looks away is bent back.
mat3 vertexFrame(vec3 normal, vec3 geometricNormal, vec3 view) {
    vec3 n = dot(normal, geometricNormal) < 0.0 ? -normal : normal;
    float cosine = dot(n, view);
    if (cosine <= kLeastCosine) n = normalize(n + (kLeastCosine - cosine) * view);
    float s = n.z < 0.0 ? -1.0 : 1.0;   // frame without trigonometry (Duff et al. 2017)
    float a = -1.0 / (s + n.z), b = n.x * n.y * a;
    return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

Vertex makeVertex(Surface s, vec3 view) {
    RsMaterial material = sceneMaterials[s.material];
    Vertex v;
    v.surface = s;
    v.bsdf = makeBsdf(sceneBaseColor(material, s.uv), sceneGloss(material, s.uv));
    v.geometricNormal = dot(s.geometricNormal, view) < 0.0 ? -s.geometricNormal : s.geometricNormal;
    v.worldFromLocal = vertexFrame(s.normal, v.geometricNormal, view);
    v.view = view * v.worldFromLocal;
    vec3 size = abs(s.position);
    float scale = max(max(size.x, size.y), max(size.z, distance(s.position, camera.eye)));
    v.origin = s.position + kRayOffset * scale * v.geometricNormal;
    return v;
}

vec3 reflected(Vertex v, vec3 direction) {
    if (dot(v.geometricNormal, direction) <= 0.0) return vec3(0.0);
    return bsdfTimesCosine(v.bsdf, v.view, direction * v.worldFromLocal);
}

// Light arriving by next-event estimation, without visibility; `target` is where the shadow ray ends.
vec3 lightContribution(Vertex v, out vec3 target) {
    vec4 random = random4();
    uint index = min(uint(random.x * float(lightCount)), lightCount - 1u);
    LightSample light = sampleLight(index, random.yzw, v.origin);
    target = light.target;
    vec3 f = light.weight > 0.0 ? reflected(v, light.direction) * light.radiance : vec3(0.0);
    if (f == vec3(0.0)) return f;
    float share = 1.0;
    if (light.pdf > 0.0) {   // which BSDF sampling finds, too
        float pdf = light.pdf / float(lightCount);
        share = pdf / (pdf + bsdfPdf(v.bsdf, v.view, light.direction * v.worldFromLocal));
    }
    return f * share * light.weight * float(lightCount);
}

// One path. Every ray goes through the one traversal call, shadow rays and path rays in turn: on a software
// driver a second call site costs as much compile time as the rest.
vec3 tracePath(vec3 origin, vec3 direction, inout uint rays) {
    bool nextEvent = (flags & kNextEvent) != 0u && lightCount > 0u;
    uint leastScattered = (flags & kIndirect) != 0u ? 2u : 0u;
    vec3 radiance = vec3(0.0), throughput = vec3(1.0), pending = vec3(0.0);
    vec3 nextOrigin, nextDirection;
    float pdf = 0.0, tMax = 1e30;   // pdf 0: a camera ray, all of whose emission counts
    bool shadow = false;
    uint scattered = 0u;
    for (uint guard = 0u; guard < 2u * bounces + 2u; ++guard) {
        uint rayFlags = shadow ? gl_RayFlagsTerminateOnFirstHitEXT : gl_RayFlagsNoneEXT;
        Hit hit = sceneTrace(origin, direction, tMax, rayFlags);
        ++rays;
        if (shadow) {
            if (!hit.found) radiance += pending;
        } else {
            if (!hit.found) {
                if (!hasSky()) break;
                float lightPdf = pdf > 0.0 && nextEvent ? skyPdf(direction) / float(lightCount) : 0.0;
                if (scattered >= leastScattered)
                    radiance += throughput * skyRadiance(direction) * (pdf > 0.0 ? pdf / (pdf + lightPdf) : 1.0);
                break;
            }
            Surface s = sceneSurface(hit);
            vec3 toOrigin = -normalize(direction);
            vec3 emission = sceneEmission(s, toOrigin);
            if (emission != vec3(0.0) && scattered >= leastScattered) {
                float lightPdf = pdf > 0.0 && nextEvent ? trianglePdf(s, origin) / float(lightCount) : 0.0;
                radiance += throughput * emission * (pdf > 0.0 ? pdf / (pdf + lightPdf) : 1.0);
            }
            if (scattered == bounces) break;
            ++scattered;
            Vertex v = makeVertex(s, toOrigin);
            vec3 target = vec3(0.0);
            pending = nextEvent && scattered >= leastScattered ? throughput * lightContribution(v, target) : vec3(0.0);
            vec3 local = bsdfSample(v.bsdf, v.view, random4().xyz);
            nextOrigin = v.origin;
            nextDirection = v.worldFromLocal * local;
            pdf = bsdfPdf(v.bsdf, v.view, local);
            vec3 f = reflected(v, nextDirection);
            throughput = pdf > 0.0 ? throughput * f / pdf : vec3(0.0);
            if (pending != vec3(0.0)) {
                origin = v.origin;
                direction = target - v.origin;
                tMax = 1.0;
                shadow = true;
                continue;
            }
        }
        if (throughput == vec3(0.0)) break;
        origin = nextOrigin;
        direction = nextDirection;
        tMax = 1e30;
        shadow = false;
    }
    return radiance;
}

// Where path `index` of the pixel's whole sequence starts, in the pixel: the R2 sequence (Roberts 2018), begun at a
// random place, covers it more evenly than independent points.
vec2 pixelOffset(uint pixelIndex, uint index) {
    if ((flags & kJitter) == 0u) return vec2(0.5);
    randomState = uvec4(pixelIndex, 0xffffffffu, seed, 0u);
    uvec2 start = uvec2(random4().xy * 16777216.0) << 8;
    return vec2((start + index * uvec2(3242174889u, 2447445414u)) >> 8) * (1.0 / 16777216.0);
}

void main() {
    uvec2 pixel = sceneThread();
    if (any(greaterThanEqual(pixel, extent))) return;
    vec3 sum = vec3(0.0);
    uint rays = 0u;
    uint pixelIndex = pixel.y * extent.x + pixel.x;
    for (uint path = 0u; path < paths; ++path) {
        vec2 offset = pixelOffset(pixelIndex, frame * paths + path);
        randomState = uvec4(pixelIndex, frame, seed ^ (path << 8), 0u);
        sum += tracePath(camera.eye, cameraDirection(camera, vec2(pixel) + offset, vec2(extent)), rays);
    }
    imageStore(radianceImage, ivec2(pixel), vec4(sum / float(max(paths, 1u)), float(rays)));
}
