#include <rays/place.h>

#include <algorithm>
#include <cmath>

namespace restir {
namespace {

constexpr double kRounding = 1e-6;   // of the box's coordinates: rays are followed in object space

// The inverse of an affine transform, by cofactors.
bool invert(const float (&m)[3][4], gpu::vec4 (&inverse)[3]) noexcept {
    double cofactors[3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            cofactors[i][j] = double(m[a][c]) * m[b][d] - double(m[a][d]) * m[b][c];
        }
    const double determinant =
        m[0][0] * cofactors[0][0] + m[0][1] * cofactors[0][1] + m[0][2] * cofactors[0][2];
    if (determinant == 0) return false;
    for (int i = 0; i < 3; ++i) {
        double row[4] = {cofactors[0][i] / determinant, cofactors[1][i] / determinant,
                         cofactors[2][i] / determinant, 0};
        row[3] = -(row[0] * m[0][3] + row[1] * m[1][3] + row[2] * m[2][3]);
        for (double value : row)
            if (!(std::abs(value) <= kLargestCoordinate)) return false;
        inverse[i] = {float(row[0]), float(row[1]), float(row[2]), float(row[3])};
    }
    return true;
}

}   // namespace

bool placeInstance(const BvhInstance& instance, const Box& mesh, gpu::RsBvhInstance& placed,
                   Box& world) noexcept {
    if (mesh.isEmpty() || !invert(instance.worldFromObject, placed.objectFromWorld)) return false;
    placed.record = instance.record;
    for (int i = 0; i < 3; ++i) {
        const float* row = instance.worldFromObject[i];
        double low = row[3], high = row[3];
        for (int j = 0; j < 3; ++j) {
            const double a = double(row[j]) * mesh.low[j], b = double(row[j]) * mesh.high[j];
            low += std::min(a, b);
            high += std::max(a, b);
        }
        const double slack = kRounding * std::max(std::abs(low), std::abs(high));
        if (!(high + slack <= kLargestCoordinate && low - slack >= -kLargestCoordinate)) return false;
        world.low[i] = float(low - slack);
        world.high[i] = float(high + slack);
    }
    return true;
}

}   // namespace restir
