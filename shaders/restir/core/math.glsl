#ifndef RESTIR_CORE_MATH_GLSL
#define RESTIR_CORE_MATH_GLSL

#define RS_PI 3.14159265358979
#define RS_FAR 1e30

// Rec. 709; positive in every channel, so a target is > 0 wherever the integrand is.
float rsLuminance(vec3 color) { return dot(color, vec3(0.2126, 0.7152, 0.0722)); }

// False for NaN, infinity and negative values.
bool rsIsWeight(float value) { return value >= 0.0 && value < 3e38; }

// NaN becomes 0.
float rsSaturate(float value) { return value > 0.0 ? min(value, 1.0) : 0.0; }
vec3 rsSaturate(vec3 v) { return vec3(rsSaturate(v.x), rsSaturate(v.y), rsSaturate(v.z)); }

// Within 3e-7 rad, since Vulkan lets the built-in function err by 4096 ULP: differences of angles are densities here.
float rsAtan2(float y, float x) {
    float small = min(abs(x), abs(y)), large = max(abs(x), abs(y));
    float t = large > 0.0 ? small / large : 0.0, t2 = t * t;
    // Interpolated at Chebyshev's nodes of t^2.
    float p = 0.0237805191 + t2 * -0.00455979211;
    p = 0.0986886546 + t2 * (-0.0588297546 + t2 * p);
    p = 0.199669614 + t2 * (-0.140032902 + t2 * p);
    float angle = t * (0.999999881 + t2 * (-0.333318114 + t2 * p));
    if (abs(y) > abs(x)) angle = 0.5 * RS_PI - angle;
    if (x < 0.0) angle = RS_PI - angle;
    return y < 0.0 ? -angle : angle;
}

// Right-handed basis around a unit vector without a branch on its direction (Duff et al. 2017).
mat3 rsBasis(vec3 n) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

#endif
