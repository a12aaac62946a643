// SPDX-License-Identifier: MIT
#include "compute/feature_point.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "shaders/shared/feature_constants.h"

namespace burin {
namespace {

using shared::kEigenvalueCutoff;
using shared::kLeastSine2;
using shared::kLeastVolume;
using shared::kOutside;
using shared::kSameCluster;
using shared::kTowardsTangents;

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

}  // namespace

namespace {

// The mean plane of crossings whose normals are alike.
struct Cluster {
    Vec3f first_normal, normal_sum;
    float offset_sum;  // of the crossings' planes from the mean position, along their own normals
    float count;
};

struct Clusters {
    std::array<Cluster, 3> of;
    int count = 0;  // 4: there are more
};

Clusters find_clusters(std::span<const Crossing> crossings, const Vec3f& mean_position) {
    Clusters clusters;
    for (const Crossing& c : crossings) {
        const float offset = glm::dot(c.normal, c.position - mean_position);
        int k = 0;
        while (k < clusters.count &&
               glm::dot(clusters.of[static_cast<std::size_t>(k)].first_normal, c.normal) < kSameCluster) {
            ++k;
        }
        if (k == 3) {
            clusters.count = 4;
            return clusters;
        }
        Cluster& cluster = clusters.of[static_cast<std::size_t>(k)];
        if (k == clusters.count) {
            ++clusters.count;
            cluster = {c.normal, c.normal, offset, 1.0f};
        } else {
            cluster.normal_sum += c.normal;
            cluster.offset_sum += offset;
            cluster.count += 1.0f;
        }
    }
    return clusters;
}

// From the mean position to the nearest point of the clusters' planes; nothing where they do not determine it.
std::optional<Vec3f> offset_to_planes(const Clusters& clusters) {
    if (clusters.count > 3) return std::nullopt;
    std::array<Vec3f, 3> n;
    std::array<float, 3> d{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(clusters.count); ++k) {
        const Cluster& c = clusters.of[k];
        n[k] = c.normal_sum / glm::length(c.normal_sum);
        d[k] = c.offset_sum / c.count;
    }
    if (clusters.count == 1) return n[0] * (kTowardsTangents * d[0]);
    if (clusters.count == 2) {
        const float cosine = glm::dot(n[0], n[1]), sine2 = 1.0f - cosine * cosine;
        if (sine2 < kLeastSine2) return std::nullopt;
        return (n[0] * (d[0] - cosine * d[1]) + n[1] * (d[1] - cosine * d[0])) / sine2;
    }
    const Vec3f across = glm::cross(n[1], n[2]);
    const float volume = glm::dot(n[0], across);
    if (std::abs(volume) < kLeastVolume) return std::nullopt;
    return (across * d[0] + glm::cross(n[2], n[0]) * d[1] + glm::cross(n[0], n[1]) * d[2]) / volume;
}

// The same for any planes at all: the pseudo-inverse of their normal equations.
Vec3f offset_by_eigenvalues(std::span<const Crossing> crossings, const Vec3f& mean_position) {
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
    return offset;
}

}  // namespace

Vec3f feature_point(std::span<const Crossing> crossings) {
    Vec3f mean_position(0.0f);
    for (const Crossing& c : crossings) mean_position += c.position;
    mean_position /= static_cast<float>(crossings.size());
    const std::optional<Vec3f> offset = offset_to_planes(find_clusters(crossings, mean_position));
    const Vec3f p = mean_position + (offset ? *offset : offset_by_eigenvalues(crossings, mean_position));
    return glm::clamp(p, Vec3f(-kOutside), Vec3f(1.0f + kOutside));
}

}  // namespace burin
