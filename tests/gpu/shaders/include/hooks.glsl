// What the library asks its includer for, where a test has nothing to say.
vec4 rsBridgeTexture(uint index, vec2 uv) { return vec4(uv, 0.5, 1.0); }
