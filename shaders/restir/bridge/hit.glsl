// What a ray hit in the standard scene set: a surface as pass 0 makes them of the G-buffer, seen from the ray's origin.
#ifndef RESTIR_BRIDGE_HIT_GLSL
#define RESTIR_BRIDGE_HIT_GLSL

// By the cofactors: the inverse transpose times the determinant, whose sign mirrored instances need.
vec3 rsWorldNormal(RsInstance instance, vec3 n) {
    vec3 a = instance.worldFromObject[0].xyz, b = instance.worldFromObject[1].xyz, c = instance.worldFromObject[2].xyz;
    vec3 scaled = vec3(dot(cross(b, c), n), dot(cross(c, a), n), dot(cross(a, b), n));
    return dot(a, cross(b, c)) < 0.0 ? -scaled : scaled;
}

vec3 rsUnitOr(vec3 v, vec3 otherwise) {
    float square = dot(v, v);
    return square > 0.0 ? v * inversesqrt(square) : otherwise;
}

// The tangent follows u, and green points against v, as in glTF.
vec3 rsMappedNormal(RsInstance instance, RsMaterial material, uvec3 corners, vec3 edges[2], vec2 uv, vec3 normal) {
    RsUvStream uvs = RsUvStream(instance.uvs);
    vec2 a = uvs.at[corners.y] - uvs.at[corners.x], b = uvs.at[corners.z] - uvs.at[corners.x];
    float winding = sign(a.x * b.y - a.y * b.x);
    vec3 alongU = winding * (b.y * edges[0] - a.y * edges[1]), alongV = winding * (a.x * edges[1] - b.x * edges[0]);
    vec3 tangent = rsUnitOr(alongU - dot(alongU, normal) * normal, vec3(0.0));
    if (tangent == vec3(0.0)) return normal;
    vec3 up = cross(normal, tangent);
    if (dot(up, alongV) > 0.0) up = -up;
    vec3 map = 2.0 * rsBridgeTexture(material.normalTexture, uv).xyz - 1.0;
    map.xy *= material.normalScale;
    return rsUnitOr(map.x * tangent + map.y * up + map.z * normal, normal);
}

RsSurface rsBridgeHit(RsHit hit, vec3 origin, vec3 direction) {
    RsInstance instance = rsInstances[hit.instance];
    RsMaterial material = rsMaterials[instance.material];
    uvec3 corners = rsCorners(instance, hit.primitive);
    RsVectorStream positions = RsVectorStream(instance.positions);
    vec3 first = rsWorldPoint(instance, positions.at[corners.x]);
    vec3 edges[2] = vec3[2](rsWorldPoint(instance, positions.at[corners.y]) - first,
                            rsWorldPoint(instance, positions.at[corners.z]) - first);
    vec2 uv = rsHitUv(instance, corners, hit.barycentrics);
    RsSurface s;
    s.depth = hit.t * length(direction);
    s.position = first + hit.barycentrics.x * edges[0] + hit.barycentrics.y * edges[1];
    s.view = -normalize(direction);
    s.geometricNormal = rsUnitOr(cross(edges[0], edges[1]), vec3(0.0));
    s.valid = s.geometricNormal != vec3(0.0);
    s.normal = s.geometricNormal;
    if (any(notEqual(instance.normals, uvec2(0u)))) {
        RsVectorStream normals = RsVectorStream(instance.normals);
        vec3 n = (1.0 - hit.barycentrics.x - hit.barycentrics.y) * normals.at[corners.x] +
                 hit.barycentrics.x * normals.at[corners.y] + hit.barycentrics.y * normals.at[corners.z];
        s.normal = rsUnitOr(rsWorldNormal(instance, n), s.geometricNormal);
    }
    if (material.normalTexture != RS_NO_TEXTURE && any(notEqual(instance.uvs, uvec2(0u))))
        s.normal = rsMappedNormal(instance, material, corners, edges, uv, s.normal);
    rsFaceViewer(s);
    s.baseColor = material.baseColor.rgb;
    if (material.baseColorTexture != RS_NO_TEXTURE) s.baseColor *= rsBridgeTexture(material.baseColorTexture, uv).rgb;
    s.baseColor = rsSaturate(s.baseColor);
    vec2 gloss = vec2(material.roughness, material.metalness);
    if (material.metallicRoughnessTexture != RS_NO_TEXTURE) gloss *= rsBridgeTexture(material.metallicRoughnessTexture, uv).gb;
    s.roughness = rsSaturate(gloss.x);
    s.metalness = rsSaturate(gloss.y);
    s.specular = rsSaturate(material.specular);
    s.materialId = instance.material;
    return s;
}

#endif
