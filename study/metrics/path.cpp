// SPDX-License-Identifier: MIT
#include "study/metrics/path.hpp"

#include <algorithm>
#include <cmath>

#include "study/metrics/even_motion.hpp"
#include "study/statistics/outcome.hpp"

namespace burin::study {
namespace {

constexpr Distances kNoDistances{.mean_m = kUndefined, .largest_m = kUndefined};

bool is_path(std::span<const Vec3> points) {
    return !points.empty() && std::ranges::all_of(points, [](const Vec3& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
}

double distance_to_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double squared = glm::dot(along, along);
    const double share = squared > 0.0 ? std::clamp(glm::dot(point - a, along) / squared, 0.0, 1.0) : 0.0;
    return glm::distance(point, a + share * along);
}

double distance_to_polyline(const Vec3& point, std::span<const Vec3> line) {
    double least = glm::distance(point, line.front());
    for (std::size_t i = 1; i < line.size(); ++i)
        least = std::min(least, distance_to_segment(point, line[i - 1], line[i]));
    return least;
}

Distances mean_and_largest(std::span<const double> distances, std::span<const double> weights = {}) {
    return {.mean_m = weighted_mean(distances, weights), .largest_m = std::ranges::max(distances)};
}

}  // namespace

double path_length_m(std::span<const Vec3> points_m) {
    if (!is_path(points_m)) return kUndefined;
    double length = 0.0;
    for (std::size_t i = 1; i < points_m.size(); ++i) length += glm::distance(points_m[i - 1], points_m[i]);
    return length;
}

double economy_of_path(std::span<const Vec3> points_m) {
    return points_m.empty() ? kUndefined : economy_of_path(points_m, glm::distance(points_m.front(), points_m.back()));
}

double economy_of_path(std::span<const Vec3> points_m, double ideal_length_m) {
    const double length = path_length_m(points_m);
    return length > 0.0 ? ideal_length_m / length : kUndefined;
}

Distances distances_to_centreline(std::span<const Vec3> points_m, std::span<const Vec3> centreline_m,
                                  std::span<const double> weights) {
    if (!is_path(points_m) || !is_path(centreline_m)) return kNoDistances;
    std::vector<double> distances;
    for (const Vec3& point : points_m) distances.push_back(distance_to_polyline(point, centreline_m));
    return mean_and_largest(distances, weights);
}

Distances arc_length_matched(std::span<const Vec3> points_m, std::span<const Vec3> centreline_m, std::size_t places) {
    if (!is_path(points_m) || !is_path(centreline_m) || places < 2) return kNoDistances;
    const std::vector<Vec3> path = resampled(points_m, places), line = resampled(centreline_m, places);
    std::vector<double> distances;
    for (std::size_t i = 0; i < places; ++i) distances.push_back(glm::distance(path[i], line[i]));
    return mean_and_largest(distances);
}

double frechet_distance_m(std::span<const Vec3> points_m, std::span<const Vec3> centreline_m) {
    if (!is_path(points_m) || !is_path(centreline_m)) return kUndefined;
    // coupled[k]: the distance of the beginnings up to the present point and up to k.
    std::vector<double> coupled(centreline_m.size());
    for (std::size_t i = 0; i < points_m.size(); ++i) {
        double diagonal = 0.0;
        for (std::size_t k = 0; k < centreline_m.size(); ++k) {
            const double above = coupled[k];
            double reached = 0.0;
            if (i > 0 && k > 0) {
                reached = std::min({above, coupled[k - 1], diagonal});
            } else if (i > 0) {
                reached = above;
            } else if (k > 0) {
                reached = coupled[k - 1];
            }
            coupled[k] = std::max(reached, glm::distance(points_m[i], centreline_m[k]));
            diagonal = above;
        }
    }
    return coupled.back();
}

std::vector<Vec3> resampled(std::span<const Vec3> points_m, std::size_t places) {
    std::vector<Vec3> result;
    const double length = path_length_m(points_m);
    if (std::isnan(length) || places < 2) return result;
    double before = 0.0;  // the length up to point i
    std::size_t i = 0;
    for (std::size_t k = 0; k + 1 < places; ++k) {
        const double wanted = length * static_cast<double>(k) / static_cast<double>(places - 1);
        double step = i + 1 < points_m.size() ? glm::distance(points_m[i], points_m[i + 1]) : 0.0;
        while (i + 2 < points_m.size() && before + step < wanted) {
            before += step;
            ++i;
            step = glm::distance(points_m[i], points_m[i + 1]);
        }
        const double share = step > 0.0 ? std::clamp((wanted - before) / step, 0.0, 1.0) : 0.0;
        result.push_back(step > 0.0 ? points_m[i] + share * (points_m[i + 1] - points_m[i]) : points_m[i]);
    }
    result.push_back(points_m.back());
    return result;
}

}  // namespace burin::study
