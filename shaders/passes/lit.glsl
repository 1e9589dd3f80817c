// What a pixel that a checkerboard lights reflects, in eight bytes for those around it. Exposed, as the range is that of a picture.
uvec2 rsPackLit(RsShading shading) {
    return uvec2(rsPackRadiance(shading.diffuse.rgb * rsFrame.exposure), rsPackRadiance(shading.specular.rgb * rsFrame.exposure));
}
RsLobes rsUnpackLit(uvec2 lit) {
    float scale = rsFrame.exposure > 1e-37 ? 1.0 / rsFrame.exposure : 0.0;
    return RsLobes(rsUnpackRadiance(lit.x) * scale, rsUnpackRadiance(lit.y) * scale);
}
