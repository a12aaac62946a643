// SPDX-License-Identifier: MIT
#include "compute/tools/smooth_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace burin::compute {

namespace {

using shared::KernelSlopes;
using shared::KernelSums;
using shared::NearPoint;

// A point near a place, as long as it is not known how much it counts.
struct Near {
    const SurfacePoint* point;
    Vec3 off;
    double ratio;
};

}  // namespace

SmoothField::SmoothField(std::vector<SurfacePoint> points, double most_width) {
    double box = 1.0;
    levels_.push_back(sorted(std::move(points), box));
    for (; most_width >= shared::kBoxesAWidth * 2.0 * box; box *= 2.0)
        levels_.push_back(sorted(merged(levels_.back().points, 2.0 * box), 2.0 * box));
}

template <typename F>
void SmoothField::Level::for_near(const Vec3& place, double width, F f) const {
    std::array<int, 3> from{}, to{};
    for (int a = 0; a < 3; ++a) {
        const auto s = static_cast<std::size_t>(a);
        const double last = boxes[s] - 1.0;
        from[s] = static_cast<int>(std::clamp(std::floor((place[a] - width - lo[a]) / box), 0.0, last + 1.0));
        to[s] = static_cast<int>(std::clamp(std::floor((place[a] + width - lo[a]) / box), -1.0, last));
    }
    if (from[0] > to[0]) return;
    for (int z = from[2]; z <= to[2]; ++z) {
        for (int y = from[1]; y <= to[1]; ++y) {
            const auto row = static_cast<std::size_t>((z * boxes[1] + y) * boxes[0]);
            const std::uint32_t end = first[row + static_cast<std::size_t>(to[0]) + 1];
            for (std::uint32_t i = first[row + static_cast<std::size_t>(from[0])]; i < end; ++i) f(points[i]);
        }
    }
}

SmoothField::Level SmoothField::sorted(std::vector<SurfacePoint> points, double box) {
    Level level;
    level.box = box;
    if (points.empty()) {
        level.first.assign(2, 0);
        return level;
    }
    Vec3 hi = points.front().place;
    level.lo = hi;
    for (const SurfacePoint& p : points) {
        level.lo = glm::min(level.lo, p.place);
        hi = glm::max(hi, p.place);
    }
    level.lo = glm::floor(level.lo / box) * box;  // boxes of all levels nest, wherever the tool is
    for (int a = 0; a < 3; ++a)
        level.boxes.at(static_cast<std::size_t>(a)) = 1 + static_cast<int>((hi[a] - level.lo[a]) / box);
    const auto index = [&](const SurfacePoint& p) {
        const Vec3 at = (p.place - level.lo) / box;
        return static_cast<std::size_t>((static_cast<int>(at.z) * level.boxes[1] + static_cast<int>(at.y)) *
                                            level.boxes[0] +
                                        static_cast<int>(at.x));
    };
    const auto count = static_cast<std::size_t>(level.boxes[0]) * static_cast<std::size_t>(level.boxes[1]) *
                       static_cast<std::size_t>(level.boxes[2]);
    level.first.assign(count + 1, 0);
    for (const SurfacePoint& p : points) ++level.first[index(p) + 1];
    for (std::size_t i = 1; i <= count; ++i) level.first[i] += level.first[i - 1];
    std::vector<std::uint32_t> next(level.first.begin(), level.first.end() - 1);
    level.points.resize(points.size());
    for (const SurfacePoint& p : points) level.points[next[index(p)]++] = p;
    return level;
}

// Merges the points of one box whose normals have the same largest component and sign.
std::vector<SurfacePoint> SmoothField::merged(const std::vector<SurfacePoint>& points, double box) {
    struct Keyed {
        std::array<int, 4> key;
        const SurfacePoint* point;
    };
    std::vector<Keyed> keyed;
    keyed.reserve(points.size());
    for (const SurfacePoint& p : points) {
        const Vec3 at = glm::floor(p.place / box);
        keyed.push_back(
            {{static_cast<int>(at.z), static_cast<int>(at.y), static_cast<int>(at.x), shared::facing_of(p.normal)},
             &p});
    }
    std::ranges::stable_sort(keyed, {}, &Keyed::key);
    std::vector<SurfacePoint> result;
    for (std::size_t from = 0, to = 0; from < keyed.size(); from = to) {
        shared::MergedSums sums = shared::nothing_merged();
        const SurfacePoint& first = *keyed[from].point;
        for (; to < keyed.size() && keyed[to].key == keyed[from].key; ++to) {
            const SurfacePoint& p = *keyed[to].point;
            sums = with_merged(sums, p.place, p.normal, p.area, p.offset, first.place);
        }
        if (!(sums.area > 0.0)) continue;
        const shared::MergedSums means = means_of(sums, first.place);
        result.push_back({means.place, means.normal, means.area, means.height, first.material});
    }
    return result;
}

const SmoothField::Level& SmoothField::level_for(double width) const {
    std::size_t level = 0;
    while (level + 1 < levels_.size() && width >= shared::kBoxesAWidth * levels_[level + 1].box) ++level;
    return levels_[level];
}

SmoothField::Value SmoothField::at(const Vec3& place, const Width& width, bool with_gradient) const {
    thread_local std::vector<Near> near;
    near.clear();
    const double width2 = width.value * width.value;
    Vec3 mean_normal(0.0);
    level_for(width.value).for_near(place, width.value, [&](const SurfacePoint& p) {
        const Vec3 off = p.place - place;
        const double ratio = shared::dot3(off, off) / width2;
        if (ratio >= 1.0) return;
        mean_normal = shared::with_mean_normal(mean_normal, p.normal, p.area, ratio);
        near.push_back({&p, off, ratio});
    });
    const double length = shared::length3(mean_normal);
    if (!(length > 0.0)) return {};
    KernelSums sums = shared::no_sums();
    KernelSlopes slopes = shared::no_slopes();
    for (const Near& n : near) {
        const double facing = shared::facing_weight(shared::dot3(n.point->normal, mean_normal) / length);
        if (!(facing > 0.0)) continue;
        const NearPoint p{n.point->normal, n.off, n.ratio, n.point->area, n.point->offset};
        sums = with_point(sums, p, facing);
        if (with_gradient) slopes = with_slope(slopes, p, facing, width);
    }
    if (!are_known(sums)) return {};
    return {true, distance_of(sums), with_gradient ? gradient_of(sums, slopes) : Vec3(0.0)};
}

std::uint8_t SmoothField::material_near(const Vec3& place, double width, std::uint8_t otherwise) const {
    double least2 = width * width;
    levels_.front().for_near(place, width, [&](const SurfacePoint& p) {
        const Vec3 off = p.place - place;
        if (glm::dot(off, off) >= least2) return;
        least2 = glm::dot(off, off);
        otherwise = p.material;
    });
    return otherwise;
}

}  // namespace burin::compute
