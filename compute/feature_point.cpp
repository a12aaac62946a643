// SPDX-License-Identifier: MIT
#include "compute/feature_point.hpp"

#include <algorithm>
#include <cmath>

namespace burin {
namespace {

// Below this cosine of the angle to the mean normal a cell counts as curved or sharp. 0.995 is 5.7 degrees; flatter cells
// have a second eigenvalue far below the cut-off, so both ways give the same point.
constexpr float kFlat = 0.995f;
// Directions with less than this share of the largest eigenvalue carry no position, only noise.
constexpr float kEigenvalueCutoff = 0.02f;

struct Symmetric3 {
    float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
};

struct Eigen3 {
    std::array<float, 3> values{};
    glm::mat3 vectors{1.0f};  // columns
};

// Cyclic Jacobi rotations; five sweeps take a 3 x 3 matrix to float precision.
Eigen3 eigen(const Symmetric3& m) {
    float a[3][3] = {{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}};
    Eigen3 e;
    for (int sweep = 0; sweep < 5; ++sweep) {
        for (int p = 0; p < 2; ++p) {
            for (int q = p + 1; q < 3; ++q) {
                if (std::abs(a[p][q]) < 1e-12f) continue;
                const float theta = (a[q][q] - a[p][p]) / (2.0f * a[p][q]);
                const float t = (theta >= 0 ? 1.0f : -1.0f) / (std::abs(theta) + std::sqrt(theta * theta + 1.0f));
                const float c = 1.0f / std::sqrt(t * t + 1.0f), s = t * c;
                for (int k = 0; k < 3; ++k) {
                    const float kp = a[k][p], kq = a[k][q];
                    a[k][p] = c * kp - s * kq;
                    a[k][q] = s * kp + c * kq;
                }
                for (int k = 0; k < 3; ++k) {
                    const float pk = a[p][k], qk = a[q][k];
                    a[p][k] = c * pk - s * qk;
                    a[q][k] = s * pk + c * qk;
                }
                const Vec3f vp = e.vectors[p], vq = e.vectors[q];
                e.vectors[p] = c * vp - s * vq;
                e.vectors[q] = s * vp + c * vq;
            }
        }
    }
    e.values = {a[0][0], a[1][1], a[2][2]};
    return e;
}

// A vertex keeps off the cell's faces, by less than any feature's error, so that vertices of two cells never coincide: formats
// without shared vertices (STL) would take them for one.
constexpr float kInset = 1.0f / 256.0f;

Vec3f within_cell(const Vec3f& p) { return glm::clamp(p, Vec3f(kInset), Vec3f(1.0f - kInset)); }

}  // namespace

Vec3f feature_point(std::span<const Crossing> crossings) {
    Vec3f mean_position(0.0f), normal_sum(0.0f);
    for (const Crossing& c : crossings) {
        mean_position += c.position;
        normal_sum += c.normal;
    }
    mean_position /= static_cast<float>(crossings.size());
    const float sum_length = glm::length(normal_sum);
    bool flat = sum_length > 1e-6f;
    const Vec3f mean_normal = flat ? normal_sum / sum_length : normal_sum;
    for (const Crossing& c : crossings) flat = flat && glm::dot(c.normal, mean_normal) > kFlat;

    if (flat) {  // only the offset along the common normal is determined
        float weighted = 0.0f, weights = 0.0f;
        for (const Crossing& c : crossings) {
            const float along = glm::dot(c.normal, mean_normal);
            weighted += along * glm::dot(c.normal, c.position - mean_position);
            weights += along * along;
        }
        return within_cell(mean_position + mean_normal * (weighted / weights));
    }

    Symmetric3 ata;
    Vec3f atb(0.0f);
    for (const Crossing& c : crossings) {
        const Vec3f& n = c.normal;
        const float d = glm::dot(n, c.position - mean_position);
        ata.xx += n.x * n.x;
        ata.xy += n.x * n.y;
        ata.xz += n.x * n.z;
        ata.yy += n.y * n.y;
        ata.yz += n.y * n.z;
        ata.zz += n.z * n.z;
        atb += n * d;
    }
    const Eigen3 e = eigen(ata);
    const float largest = std::max({e.values[0], e.values[1], e.values[2]});
    Vec3f offset(0.0f);
    for (int k = 0; k < 3; ++k) {
        const float value = e.values[static_cast<std::size_t>(k)];
        if (value > kEigenvalueCutoff * largest) offset += e.vectors[k] * (glm::dot(e.vectors[k], atb) / value);
    }
    return within_cell(mean_position + offset);
}

}  // namespace burin
