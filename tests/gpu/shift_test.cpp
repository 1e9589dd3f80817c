// The reconnection shift of indirect light (THEORY.md, section 6), over thousands of pairs of receivers:
// there and back it ends where it began, and its Jacobian is the determinant of the map of directions that it
// is.
#include <cmath>
#include <random>

#include <glm/glm.hpp>

#include "shift.spv.h"
#include "support/gpu.h"

namespace {

constexpr uint32_t kPairs = 1u << 14;

struct Pair {   // as in shift.glsl
    glm::vec3 from, to, vertex, normal;
};
struct Seen {
    glm::vec3 direction;
    float distance, solidAngle;
};
struct Result {
    Seen from, to;
    glm::vec3 normal;
};

std::vector<Pair> randomPairs() {
    std::mt19937 random(6);
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> scale(-3, 3);
    const auto vector = [&] { return glm::vec3(normal(random), normal(random), normal(random)); };
    std::vector<Pair> pairs(kPairs);
    for (Pair& p : pairs) {
        p.vertex = vector();
        p.from = p.vertex + std::exp2(scale(random)) * vector();
        p.to = p.from + std::exp2(scale(random)) * vector();
        p.normal = glm::normalize(vector());
        if (dot(p.normal, p.from - p.vertex) < 0) p.normal = -p.normal;
    }
    return pairs;
}

// What the shift makes of a direction: to where it meets the vertex's plane, seen from the other receiver.
glm::dvec3 shifted(const Pair& p, glm::dvec3 normal, glm::dvec3 direction) {
    const glm::dvec3 from = p.from, to = p.to, vertex = p.vertex;
    const double t = dot(normal, vertex - from) / dot(normal, direction);
    return normalize(from + t * direction - to);
}

// By differences of directions a little off, along two axes of the sphere.
double determinant(const Pair& p, const Result& r) {
    const glm::dvec3 normal = normalize(glm::dvec3(r.normal)),
                     w = normalize(glm::dvec3(p.vertex) - glm::dvec3(p.from));
    const glm::dvec3 u = normalize(cross(w, std::abs(w.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0))),
                     v = cross(w, u);
    const double step = 1e-6;
    const auto along = [&](glm::dvec3 axis) {
        return (shifted(p, normal, normalize(w + step * axis)) -
                shifted(p, normal, normalize(w - step * axis))) /
               (2 * step);
    };
    return length(cross(along(u), along(v)));
}

class Shift : public tests::GpuTest {};

TEST_F(Shift, ThereAndBackIsTheSamePath) {
    const std::vector<Pair> pairs = randomPairs();
    std::vector<Pair> reversed = pairs;
    for (Pair& p : reversed) std::swap(p.from, p.to);
    static const tests::Kernel kernel(k_shift_spv, 2);
    std::vector<Result> there(kPairs), back(kPairs);
    kernel.run(kPairs / 64, {tests::in(pairs), tests::out(there)});
    kernel.run(kPairs / 64, {tests::in(reversed), tests::out(back)});
    uint32_t defined = 0;
    for (uint32_t i = 0; i < kPairs; ++i) {
        const Pair& p = pairs[i];
        const Result& r = there[i];
        const double cosine = dot(normalize(glm::dvec3(p.to) - glm::dvec3(p.vertex)), glm::dvec3(r.normal));
        if (std::abs(cosine) < 1e-3) continue;
        EXPECT_EQ(r.to.solidAngle > 0, cosine > 0)
            << "defined where the vertex shows its face, and there alone";
        if (!(r.from.solidAngle > 0 && r.to.solidAngle > 0)) continue;
        ++defined;
        for (const auto& [receiver, seen] : {std::pair(p.from, r.from), std::pair(p.to, r.to)})
            EXPECT_LT(length(receiver + seen.distance * seen.direction - p.vertex),
                      1e-5f * (length(receiver) + length(p.vertex)));
        const double j = double(r.to.solidAngle) / double(r.from.solidAngle),
                     inverse = double(back[i].to.solidAngle) / double(back[i].from.solidAngle);
        EXPECT_NEAR(j * inverse, 1, 1e-6);
        // Near the edge of the face the stored normal's rounding is all that is left of the cosine.
        if (double(r.from.solidAngle) * r.from.distance * r.from.distance > 0.05 && cosine > 0.05) {
            EXPECT_NEAR(j / determinant(p, r), 1, 1e-4) << i;
        }
    }
    EXPECT_GT(defined, kPairs / 2);
}

}   // namespace
