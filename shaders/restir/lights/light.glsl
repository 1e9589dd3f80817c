// One light: its points, how they are drawn, and what arrives from them.
//
// Measure. A point on a light is (id, u, v): barycentric on a triangle, elsewhere a cell of the unit square
// (restir/lights/cells.glsl), and (0, 0) on a light without extent. It says nothing of who drew it. All densities, targets
// and weights of ReSTIR DI are per unit of that parameter domain scaled to total 1: a point that is uniform on light i,
// drawn with probability P_i, has density P_i; the integrand carries dA = area per unit, or d omega of the light's whole
// solid angle at infinity. This is the area measure up to a factor per light, and it is the reason why a light that moves or
// changes size keeps its samples with |J| = 1 (the dA_now / dA_then of the area measure sits in the two targets).
//
// Density. What a receiver draws may depend on the receiver: p(u, v | receiver) = P_i x rsPdfLightUv. It is evaluated, as
// the target is, at the point as stored, and is nothing that a reservoir keeps.
//     sphere                       uniform in the solid angle of its cone
//     rectangle                    uniform in solid angle, where that is large
//     environment                  by the importance table, uniform within a texel
//     directional                  uniform in solid angle, which is uniform on the domain
//     triangle, disk, capsule, parallelogram    uniform over the area
#ifndef RESTIR_LIGHTS_LIGHT_GLSL
#define RESTIR_LIGHTS_LIGHT_GLSL
#include "restir/core/pack.glsl"
#include "restir/core/random.glsl"
#include "restir/lights/capsule.glsl"
#include "restir/lights/environment.glsl"
#include "restir/lights/rectangle.glsl"
#include "restir/lights/sun.glsl"

vec4 rsBridgeTexture(uint index, vec2 uv);

struct RsIncident {
    vec3 direction;     // unit, from the receiver to the light
    float distance;     // metres; RS_FAR for lights at infinity
    vec3 irradiance;    // per unit of the light's domain, on a plane facing the point, W / m^2
    float solidAngle;   // d omega per unit of the domain; 0 for lights without extent
};

bool rsIsTextured(uint kindAndTexture) { return kindAndTexture >> RS_LIGHT_TEXTURE_SHIFT != RS_LIGHT_NO_TEXTURE; }
uint rsLightKind(RsPackedLight light) { return light.kindAndTexture & RS_LIGHT_KIND_MASK; }

// Whether rays find the light: triangles are hit, extended lights at infinity are behind every miss. The other kinds are
// in no acceleration structure, and drawing lights is the only strategy that knows them.
bool rsIsFoundByRays(RsPackedLight light) {
    uint kind = rsLightKind(light);
    return kind == RS_LIGHT_TRIANGLE || kind == RS_LIGHT_ENVIRONMENT ||
           (kind == RS_LIGHT_DIRECTIONAL && rsSunCone(light) > 0.0);
}

// The point that is in a direction of an extended light at infinity; false: none.
bool rsFindAtInfinity(RsPackedLight light, vec3 direction, out uint uv) {
    if (rsLightKind(light) == RS_LIGHT_DIRECTIONAL) return rsSunUv(light, direction, uv);
    uv = rsEnvironmentUv(light, direction);
    return rsLightKind(light) == RS_LIGHT_ENVIRONMENT;
}

// Uniform on the triangle: the unit square folded over its diagonal, quantised as it will be stored.
uint rsFoldOnTriangle(uint bits) {
    uint u = bits & 0xffffu, v = bits >> 16u;
    return u + v > 0xffffu ? (0xffffu - u) | ((0xffffu - v) << 16u) : bits;
}

// The solid angle under which the receiver sees a whole light whose points it draws by that; 0: a light drawn otherwise.
float rsSeenSolidAngle(RsPackedLight light, vec3 receiver) {
    uint kind = rsLightKind(light);
    if (kind == RS_LIGHT_CAPSULE) return 2.0 * RS_PI * rsSphereCone(light, receiver);
    if (kind == RS_LIGHT_RECTANGLE) return rsViewRectangle(light, receiver).solidAngle;
    return 0.0;
}

// A point of the light for this receiver; `seen` as above.
uint rsSampleLightUv(RsPackedLight light, vec3 receiver, inout RsRandom random, out float seen) {
    uint kind = rsLightKind(light);
    seen = 0.0;
    if (kind == RS_LIGHT_TRIANGLE) return rsFoldOnTriangle(rsNextBits(random));
    if (kind == RS_LIGHT_ENVIRONMENT) return rsSampleEnvironmentUv(random);
    if (kind == RS_LIGHT_CAPSULE) {
        float cone = rsSphereCone(light, receiver);
        seen = 2.0 * RS_PI * cone;
        if (cone > 0.0) return rsCellOf(rsSampleSphereUv(light, receiver, cone, rsNext2(random)));
    }
    if (kind == RS_LIGHT_RECTANGLE) {
        RsRectangleView view = rsViewRectangle(light, receiver);
        seen = view.solidAngle;
        if (seen > 0.0) return rsCellOf(rsSampleRectangleUv(view, rsNext2(random)));
    }
    bool extended = kind >= RS_LIGHT_RECTANGLE || (kind == RS_LIGHT_DIRECTIONAL && rsSunCone(light) > 0.0);
    return extended ? rsNextBits(random) : 0u;
}

// Its density; `incident` is what rsIncident says of that point. For lights that rays find `seen` is 0.
float rsPdfLightUv(RsPackedLight light, uint uv, RsIncident incident, float seen) {
    if (rsLightKind(light) == RS_LIGHT_ENVIRONMENT) return rsPdfEnvironmentUv(uv);
    return seen > 0.0 ? incident.solidAngle / seen : 1.0;
}

// glTF KHR_lights_punctual: inverse square, windowed to reach 0 at the range.
float rsRangeFalloff(float distanceSquared, float range) {
    float window = 1.0;
    if (range > 0.0) {
        float q = distanceSquared / (range * range);
        window = clamp(1.0 - q * q, 0.0, 1.0);
    }
    return window / distanceSquared;
}

// Where on the plane of its edges a flat light has a point.
vec2 rsPlanarPoint(uint kind, uint packedUv) {
    if (kind == RS_LIGHT_TRIANGLE) return rsUnpackUv(packedUv);
    vec2 uv = rsCellCentre(packedUv);
    return kind == RS_LIGHT_DISK ? rsDiscFromSquare(uv) : uv;
}

// A point as a receiver sees it, before what it emits.
struct RsSeenPoint {
    vec3 direction;
    float distance;
    float solidAngle;
    float factor;        // irradiance over the light's emission and texture; 0: no light arrives
    vec2 coordinates;    // of the texture
};

// Where the profile of a point or spot light has the light that travels along `direction`.
vec2 rsProfileUv(RsPackedLight light, vec3 direction) {
    vec3 x = vec3(light.uv0, light.uv1.x);
    vec2 d = vec2(dot(direction, x), dot(direction, cross(x, light.edge1)));
    return vec2(fract(rsAtan2(d.y, d.x) / (2.0 * RS_PI)), rsAtan2(length(d), dot(direction, light.edge1)) / RS_PI);
}

RsSeenPoint rsSeeAtInfinity(RsPackedLight light, vec2 uv) {
    if (rsLightKind(light) == RS_LIGHT_ENVIRONMENT) {
        float solidAngle = rsEnvironmentSolidAngle(uv);
        return RsSeenPoint(rsEnvironmentDirection(light, uv), RS_FAR, solidAngle, solidAngle, uv);
    }
    float cone = rsSunCone(light);
    if (cone == 0.0) return RsSeenPoint(-light.edge1, RS_FAR, 0.0, 1.0, uv);
    return RsSeenPoint(rsSunDirection(light, uv), RS_FAR, rsSunSolidAngle(cone), rsSunFlux(cone), uv);
}

RsSeenPoint rsSeePoint(RsPackedLight light, uint packedUv, vec3 receiver) {
    uint kind = rsLightKind(light);
    bool punctual = kind == RS_LIGHT_POINT || kind == RS_LIGHT_SPOT;
    RsSeenPoint seen = RsSeenPoint(vec3(0.0, 0.0, 1.0), 0.0, 0.0, 0.0, vec2(0.0));
    RsLightPoint point = RsLightPoint(vec3(0.0), vec3(0.0));
    if (kind == RS_LIGHT_CAPSULE) {
        point = rsCapsulePoint(light, rsCellCentre(packedUv));
    } else if (!punctual) {
        vec2 at = rsPlanarPoint(kind, packedUv);
        seen.coordinates = light.uv0 + at.x * (light.uv1 - light.uv0) + at.y * (light.uv2 - light.uv0);
        float area = kind == RS_LIGHT_TRIANGLE ? 0.5 : kind == RS_LIGHT_DISK ? RS_PI : 1.0;
        point = RsLightPoint(at.x * light.edge1 + at.y * light.edge2, area * cross(light.edge1, light.edge2));
    }
    vec3 toLight = light.position - receiver + point.offset;
    float distanceSquared = dot(toLight, toLight);
    if (!(distanceSquared > 1e-20)) return seen;
    seen.distance = sqrt(distanceSquared);
    seen.direction = toLight / seen.distance;

    if (!punctual) {
        float cosArea = -dot(point.areaNormal, seen.direction);
        if ((light.kindAndTexture & RS_LIGHT_TWO_SIDED) != 0u) cosArea = abs(cosArea);
        seen.solidAngle = cosArea > 0.0 ? cosArea / distanceSquared : 0.0;
        seen.factor = seen.solidAngle;
        return seen;
    }
    seen.factor = rsRangeFalloff(distanceSquared, light.edge2.z);
    if (kind == RS_LIGHT_SPOT) {
        float cone = clamp(-dot(light.edge1, seen.direction) * light.edge2.x + light.edge2.y, 0.0, 1.0);
        seen.factor *= cone * cone;
    }
    return seen;
}

RsIncident rsIncident(RsPackedLight light, uint packedUv, vec3 receiver) {
    uint kind = rsLightKind(light);
    if (kind == RS_LIGHT_NONE) return RsIncident(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), 0.0);
    bool infinite = kind == RS_LIGHT_DIRECTIONAL || kind == RS_LIGHT_ENVIRONMENT;
    RsSeenPoint seen;
    if (infinite) seen = rsSeeAtInfinity(light, rsCellCentre(packedUv));
    else seen = rsSeePoint(light, packedUv, receiver);
    vec3 irradiance = seen.factor * light.emission;
    if (seen.factor > 0.0 && rsIsTextured(light.kindAndTexture)) {
        bool profile = kind == RS_LIGHT_POINT || kind == RS_LIGHT_SPOT;
        vec2 at = profile ? rsProfileUv(light, -seen.direction) : seen.coordinates;
        irradiance *= rsBridgeTexture(light.kindAndTexture >> RS_LIGHT_TEXTURE_SHIFT, at).rgb;
    }
    return RsIncident(seen.direction, seen.distance, irradiance, seen.solidAngle);
}

#endif
