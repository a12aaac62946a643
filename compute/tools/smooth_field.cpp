// SPDX-License-Identifier: MIT
#include "compute/tools/smooth_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace burin::compute {
namespace {

// The shares of the two terms of the field.
constexpr double kOfPlanes = 0.25, kOfMiddle = 1.0 - kOfPlanes;
// A level is used for widths of at least this many of its merged boxes.
constexpr double kBoxesAWidth = 3.0;

double facing_weight(double cosine) {
    const double t = std::clamp((cosine + 0.5) / 0.5, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

struct NearPoint {
    const SurfacePoint* point;
    Vec3 off;      // from the place to the point
    double ratio;  // squared distance over squared width
};

// Sums of the points near a place, each with its weight; the gradients of the sums of scalars by the place.
struct KernelSums {
    double weight = 0.0, height = 0.0;
    Vec3 normal{0.0}, off{0.0};
    Vec3 weight_by_place{0.0}, height_by_place{0.0};
    std::array<Vec3, 3> normal_by_place{}, off_by_place{};

    void add(const NearPoint& near, double facing) {
        const double u = 1.0 - near.ratio, g = near.point->area * facing * u * u * u;
        weight += g;
        height += g * (glm::dot(near.point->normal, near.off) + near.point->offset);
        normal += g * near.point->normal;
        off += g * near.off;
    }
    void add_gradient(const NearPoint& near, double facing, const SmoothField::Width& width) {
        const double u = 1.0 - near.ratio;
        const Vec3 by_place = near.point->area * facing * 6.0 * u * u *
                              (near.off / (width.value * width.value) + near.ratio / width.value * width.gradient);
        weight_by_place += by_place;
        height_by_place += (glm::dot(near.point->normal, near.off) + near.point->offset) * by_place;
        for (int c = 0; c < 3; ++c) {
            normal_by_place.at(static_cast<std::size_t>(c)) += near.point->normal[c] * by_place;
            off_by_place.at(static_cast<std::size_t>(c)) += near.off[c] * by_place;
        }
    }
    [[nodiscard]] double distance() const {
        return -(kOfPlanes * height + kOfMiddle * glm::dot(normal, off) / glm::length(normal)) / weight;
    }
    [[nodiscard]] Vec3 gradient() const {
        const double length = glm::length(normal);
        const Vec3 m = normal / length;
        const double along = glm::dot(m, off);
        Vec3 turning(0.0), m_by_normal(0.0), moving = -weight * m;
        for (int c = 0; c < 3; ++c) {
            const auto s = static_cast<std::size_t>(c);
            m_by_normal += m[c] * normal_by_place.at(s);
            moving += m[c] * off_by_place.at(s);
        }
        for (int c = 0; c < 3; ++c)
            turning += off[c] / length * (normal_by_place.at(static_cast<std::size_t>(c)) - m[c] * m_by_normal);
        return -(kOfPlanes * (height_by_place - normal) + kOfMiddle * (turning + moving)) / weight +
               (kOfPlanes * height + kOfMiddle * along) / (weight * weight) * weight_by_place;
    }
};

}  // namespace

SmoothField::SmoothField(std::vector<SurfacePoint> points, double most_width) {
    double box = 1.0;
    levels_.push_back(sorted(std::move(points), box));
    for (; most_width >= kBoxesAWidth * 2.0 * box; box *= 2.0)
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
        int axis = 0;
        for (int a = 1; a < 3; ++a)
            if (std::abs(p.normal[a]) > std::abs(p.normal[axis])) axis = a;
        const Vec3 at = glm::floor(p.place / box);
        keyed.push_back({{static_cast<int>(at.z), static_cast<int>(at.y), static_cast<int>(at.x),
                          2 * axis + (p.normal[axis] < 0.0 ? 1 : 0)},
                         &p});
    }
    std::ranges::stable_sort(keyed, {}, &Keyed::key);
    std::vector<SurfacePoint> result;
    for (std::size_t from = 0, to = 0; from < keyed.size(); from = to) {
        SurfacePoint sum{Vec3(0.0), Vec3(0.0), 0.0, 0.0, keyed[from].point->material};
        double height = 0.0;
        for (; to < keyed.size() && keyed[to].key == keyed[from].key; ++to) {
            const SurfacePoint& p = *keyed[to].point;
            sum.place += p.area * p.place;
            sum.normal += p.area * p.normal;
            sum.area += p.area;
            height += p.area * (glm::dot(p.normal, p.place - keyed[from].point->place) + p.offset);
        }
        if (!(sum.area > 0.0)) continue;
        sum.place /= sum.area;
        sum.normal /= sum.area;
        sum.offset = height / sum.area - glm::dot(sum.normal, sum.place - keyed[from].point->place);
        result.push_back(sum);
    }
    return result;
}

const SmoothField::Level& SmoothField::level_for(double width) const {
    std::size_t level = 0;
    while (level + 1 < levels_.size() && width >= kBoxesAWidth * levels_[level + 1].box) ++level;
    return levels_[level];
}

SmoothField::Value SmoothField::at(const Vec3& place, const Width& width, bool with_gradient) const {
    thread_local std::vector<NearPoint> near;
    near.clear();
    const double width2 = width.value * width.value;
    Vec3 mean_normal(0.0);
    level_for(width.value).for_near(place, width.value, [&](const SurfacePoint& p) {
        const Vec3 off = p.place - place;
        const double ratio = glm::dot(off, off) / width2;
        if (ratio >= 1.0) return;
        const double u = 1.0 - ratio;
        mean_normal += p.area * u * u * u * p.normal;
        near.push_back({&p, off, ratio});
    });
    const double length = glm::length(mean_normal);
    if (!(length > 0.0)) return {};
    KernelSums sums;
    for (const NearPoint& p : near) {
        const double facing = facing_weight(glm::dot(p.point->normal, mean_normal) / length);
        if (!(facing > 0.0)) continue;
        sums.add(p, facing);
        if (with_gradient) sums.add_gradient(p, facing, width);
    }
    if (!(sums.weight > 0.0) || !(glm::length(sums.normal) > 0.0)) return {};
    return {true, sums.distance(), with_gradient ? sums.gradient() : Vec3(0.0)};
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
