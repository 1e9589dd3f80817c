// Read by C++ and GLSL: gives every field of every shared struct a value of its own.
#ifdef __cplusplus
#define RS_INOUT(T) T&
#define F(b) float(b)
#define U(b) uint(b)
#define V2(b) vec2{float(b), float(b + 1)}
#define V3(b) vec3{float(b), float(b + 1), float(b + 2)}
#define V4(b) vec4{float(b), float(b + 1), float(b + 2), float(b + 3)}
#define U2(b) uvec2{uint(b), uint(b + 1)}
#define U4(b) uvec4{uint(b), uint(b + 1), uint(b + 2), uint(b + 3)}
#define ADDRESS(b) (uint64_t(b) | uint64_t(b + 1) << 32)
#define FILL inline void
#else
#define RS_INOUT(T) inout T
#define F(b) float(b)
#define U(b) uint(b)
#define V2(b) vec2(b, b + 1)
#define V3(b) vec3(b, b + 1, b + 2)
#define V4(b) vec4(b, b + 1, b + 2, b + 3)
#define U2(b) uvec2(b, b + 1)
#define U4(b) uvec4(b, b + 1, b + 2, b + 3)
#define ADDRESS(b) uvec2(b, b + 1)
#define FILL void
#endif

FILL fillReservoir(RS_INOUT(RsReservoir) s, int b) {
    s.light = U(b);
    s.uv = U(b + 1);
    s.ucw = F(b + 2);
    s.confidence = U(b + 3);
}

FILL fillDi(RS_INOUT(RsDiConstants) s, int b) {
    s.lightCandidates = U(b);
    s.bsdfCandidates = U(b + 1);
    s.maxHistory = U(b + 2);
    s.neighbours = U(b + 3);
    s.radius = F(b + 4);
    s.normalThreshold = F(b + 5);
    s.depthThreshold = F(b + 6);
    s.weights = U(b + 7);
    s.visibility = U(b + 8);
    s.boilingFilter = F(b + 9);
    s.initialSamples = U(b + 10);
    s.partnerSquare = U(b + 11);
    s.freshConfidence = U(b + 12);
    s.field = U(b + 13);
    s.previousField = U(b + 14);
    s.treeShare = F(b + 15);
    s.permutation = U(b + 16);
}

FILL fillView(RS_INOUT(RsView) s, int b) {
    s.viewFromWorld[0] = V4(b);
    s.viewFromWorld[1] = V4(b + 4);
    s.viewFromWorld[2] = V4(b + 8);
    s.axisX = V3(b + 12);
    s.axisY = V3(b + 15);
    s.axisZ = V3(b + 18);
    s.eye = V3(b + 21);
    s.projection = V4(b + 24);
    s.translation = V2(b + 28);
    s.depthTerms = V4(b + 30);
    s.zSign = F(b + 34);
    s.perspective = F(b + 35);
    s.jitter = V2(b + 36);
}

FILL fillFrame(RS_INOUT(RsFrame) s, int b) {
    fillView(s.view, b);
    fillView(s.previousView, b + 100);
    s.extent = U2(b + 200);
    s.previousExtent = U2(b + 202);
    s.gbufferOrigin = U2(b + 204);
    s.outputOrigin = U2(b + 206);
    s.seed = U(b + 208);
    s.lightCount = U(b + 209);
    s.previousLightCount = U(b + 210);
    s.flags = U(b + 211);
    s.emptyDepth = F(b + 212);
    s.exposure = F(b + 213);
    s.motionScale = V2(b + 214);
    s.normalEncoding = U(b + 216);
    s.rayLogCapacity = U(b + 217);
    s.debugView = U(b + 218);
    s.environmentExtent = U2(b + 219);
    s.infiniteLights = U4(b + 221);
    fillDi(s.di, b + 226);
    fillDi(s.gi, b + 246);
    s.giBounces = U(b + 266);
    s.giStale = F(b + 267);
    s.giScratch = U(b + 270);
    s.bvhRoot = U(b + 268);
    s.bvhPreviousRoot = U(b + 269);
}

FILL fillPass(RS_INOUT(RsPass) s, int b) {
    s.source = U(b);
    s.target = U(b + 1);
    s.index = U(b + 2);
    s.shades = U(b + 3);
}

FILL fillCounters(RS_INOUT(RsCounters) s, int b) {
    s.rays = U(b);
    s.rejectedWeights = U(b + 1);
    s.loggedRays = U(b + 2);
    s.spare = U(b + 3);
}

FILL fillRay(RS_INOUT(RsLoggedRay) s, int b) {
    s.originTmax = V4(b);
    s.directionClosest = V4(b + 4);
}

FILL fillLight(RS_INOUT(RsPackedLight) s, int b) {
    s.position = V3(b);
    s.kindAndTexture = U(b + 3);
    s.edge1 = V3(b + 4);
    s.edge2 = V3(b + 7);
    s.emission = V3(b + 10);
    s.selection = F(b + 13);
    s.uv0 = V2(b + 14);
    s.uv1 = V2(b + 16);
    s.uv2 = V2(b + 18);
}

FILL fillTexel(RS_INOUT(RsEnvironmentTexel) s, int b) {
    s.threshold = U(b);
    s.alias = U(b + 1);
    s.probability = F(b + 2);
}

FILL fillAlias(RS_INOUT(RsAliasEntry) s, int b) {
    s.threshold = U(b);
    s.alias = U(b + 1);
}

FILL fillTablePass(RS_INOUT(RsTablePass) s, int b) {
    s.lights = U(b);
    s.columns = U(b + 1);
    s.blocks = U(b + 2);
    s.meshLights = U(b + 3);
    s.meshes = U(b + 4);
    s.shift = U(b + 5);
}

FILL fillLightMesh(RS_INOUT(RsLightMesh) s, int b) {
    s.firstLight = U(b);
    s.triangles = U(b + 1);
    s.record = U(b + 2);
}

FILL fillTableState(RS_INOUT(RsTableState) s, int b) {
    for (int i = 0; i < 3; ++i) {
        s.high[i] = U(b + i);
        s.low[i] = U(b + 3 + i);
    }
    s.heaviestPower = U(b + 6);
    s.heaviest = U(b + 7);
    s.scale = U2(b + 8);
    s.surplus = U2(b + 10);
}

FILL fillInstance(RS_INOUT(RsInstance) s, int b) {
    s.positions = ADDRESS(b);
    s.indices = ADDRESS(b + 2);
    s.normals = ADDRESS(b + 4);
    s.uvs = ADDRESS(b + 6);
    s.worldFromObject[0] = V4(b + 8);
    s.worldFromObject[1] = V4(b + 12);
    s.worldFromObject[2] = V4(b + 16);
    s.material = U(b + 20);
    s.firstLight = U(b + 21);
}

FILL fillMaterial(RS_INOUT(RsMaterial) s, int b) {
    s.baseColor = V4(b);
    s.emission = V3(b + 4);
    s.roughness = F(b + 7);
    s.metalness = F(b + 8);
    s.specular = F(b + 9);
    s.normalScale = F(b + 10);
    s.alphaCutoff = F(b + 11);
    s.baseColorTexture = U(b + 12);
    s.metallicRoughnessTexture = U(b + 13);
    s.normalTexture = U(b + 14);
    s.emissionTexture = U(b + 15);
    s.flags = U(b + 16);
}

#undef RS_INOUT
#undef F
#undef U
#undef V2
#undef V3
#undef V4
#undef U2
#undef ADDRESS
#undef FILL
