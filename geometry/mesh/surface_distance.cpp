// SPDX-License-Identifier: MIT
#include "geometry/mesh/surface_distance.hpp"

#include <algorithm>
#include <cmath>

namespace burin::geometry {
namespace {

constexpr std::size_t kTrianglesATask = 2048;

using Polygon = std::vector<Vec3>;  // convex

struct Plane {
    Vec3 point_m, normal;  // not of unit length
};

Vec3 middle_of(const Polygon& polygon) {
    Vec3 sum(0.0);
    for (const Vec3& p : polygon) sum += p;
    return sum / static_cast<double>(polygon.size());
}

// Cuts the polygon at the plane. Both parts keep the points on the plane, so that together they cover the polygon.
void cut(const Polygon& polygon, const Plane& plane, Polygon& behind, Polygon& ahead) {
    behind.clear();
    ahead.clear();
    const auto height = [&](const Vec3& p) { return glm::dot(p - plane.point_m, plane.normal); };
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double ha = height(a), hb = height(b);
        if (ha <= 0.0) behind.push_back(a);
        if (ha >= 0.0) ahead.push_back(a);
        if ((ha < 0.0 && hb > 0.0) || (ha > 0.0 && hb < 0.0)) {
            const Vec3 crossing = a + (b - a) * (ha / (ha - hb));
            behind.push_back(crossing);
            ahead.push_back(crossing);
        }
    }
    if (behind.size() < 3) behind.clear();
    if (ahead.size() < 3) ahead.clear();
}

class Comparison {
public:
    Comparison(const TriangleMesh& to, const TriangleTree& tree, double tolerance_m)
        : to_(to), tree_(tree), tolerance_m_(tolerance_m) {}

    struct Found {
        std::uint32_t triangle;
        double bound_m;
    };
    // Returns the bound for one triangle and adds the triangles it was compared with to found().
    double run(const std::array<Vec3, 3>& triangle) {
        pieces_.assign(1, Polygon(triangle.begin(), triangle.end()));
        double worst = 0.0;
        while (!pieces_.empty()) {
            const Polygon piece = std::move(pieces_.back());
            pieces_.pop_back();
            worst = std::max(worst, bound_or_divide(piece));
        }
        return worst;
    }
    [[nodiscard]] const std::vector<Found>& found() const { return found_; }

private:
    [[nodiscard]] std::array<Vec3, 3> corners(std::uint32_t t) const {
        const auto [a, b, c] = to_.triangles[t];
        return {to_.positions_m[a], to_.positions_m[b], to_.positions_m[c]};
    }
    struct Corner {
        double distance_m;
        Vec3 place_m;
    };
    [[nodiscard]] static Corner farthest_corner(const Polygon& piece, const std::array<Vec3, 3>& triangle) {
        Corner farthest{-1.0, Vec3(0.0)};
        for (const Vec3& p : piece) {
            const Vec3 gap = nearest_point(triangle, p) - p;
            if (glm::dot(gap, gap) > farthest.distance_m) farthest = {glm::dot(gap, gap), p};
        }
        farthest.distance_m = std::sqrt(farthest.distance_m);
        return farthest;
    }
    double settle(std::uint32_t triangle, double bound_m) {
        hint_ = triangle;
        // Neighbouring pieces mostly meet the same triangle.
        if (!found_.empty() && found_.back().triangle == triangle) {
            found_.back().bound_m = std::max(found_.back().bound_m, bound_m);
        } else {
            found_.push_back({triangle, bound_m});
        }
        return bound_m;
    }

    // Returns the bound if it is close enough; else divides the piece and returns 0.
    double bound_or_divide(const Polygon& piece) {
        if (hint_ < to_.triangles.size()) {
            const double by_hint_m = farthest_corner(piece, corners(hint_)).distance_m;
            if (by_hint_m <= tolerance_m_) return settle(hint_, by_hint_m);
        }
        const std::uint32_t t = tree_.nearest(middle_of(piece), hint_, tolerance_m_).triangle;
        const std::array<Vec3, 3> nearest = corners(t);
        const Corner farthest = farthest_corner(piece, nearest);
        if (farthest.distance_m <= tolerance_m_) return settle(t, farthest.distance_m);
        // The bound is close enough when no other triangle is much nearer to that corner.
        const double much_nearer_m = farthest.distance_m - tolerance_m_;
        const TriangleTree::Near nearer = tree_.nearest(farthest.place_m, t, much_nearer_m);
        if (nearer.distance_m > much_nearer_m) return settle(t, farthest.distance_m);
        hint_ = nearer.triangle;
        if (!cut_at_borders(piece, nearest)) halve(piece);
        return 0.0;
    }

    // Cuts the piece along the planes that stand on the triangle's edges; false when it lies on one side of each.
    bool cut_at_borders(const Polygon& piece, const std::array<Vec3, 3>& triangle) {
        const Vec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
        Polygon rest = piece, inside, outside;
        bool divided = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const Plane border{triangle[k], glm::cross(triangle[(k + 1) % 3] - triangle[k], normal)};
            if (!reaches_well_over(rest, border)) continue;
            cut(rest, border, inside, outside);
            if (inside.empty() || outside.empty()) continue;
            pieces_.push_back(std::move(outside));
            rest = std::move(inside);
            divided = true;
        }
        if (divided) pieces_.push_back(std::move(rest));
        return divided;
    }
    // Tells whether the piece reaches to both sides by more than rounding, so that every cut makes two smaller pieces.
    [[nodiscard]] bool reaches_well_over(const Polygon& piece, const Plane& plane) const {
        double lowest = 0.0, highest = 0.0;
        for (const Vec3& p : piece) {
            const double height = glm::dot(p - plane.point_m, plane.normal);
            lowest = std::min(lowest, height);
            highest = std::max(highest, height);
        }
        const double little = 1e-6 * tolerance_m_ * glm::length(plane.normal);
        return lowest < -little && highest > little;
    }
    void halve(const Polygon& piece) {
        std::size_t longest = 0;
        double longest2 = -1.0;
        for (std::size_t i = 0; i < piece.size(); ++i) {
            const Vec3 edge = piece[(i + 1) % piece.size()] - piece[i];
            if (glm::dot(edge, edge) > longest2) longest2 = glm::dot(edge, edge), longest = i;
        }
        const Vec3 &a = piece[longest], &b = piece[(longest + 1) % piece.size()];
        Polygon behind, ahead;
        cut(piece, {(a + b) * 0.5, b - a}, behind, ahead);
        for (Polygon* part : {&behind, &ahead}) {
            if (!part->empty()) pieces_.push_back(std::move(*part));
        }
    }

    const TriangleMesh& to_;
    const TriangleTree& tree_;
    const double tolerance_m_;
    std::uint32_t hint_ = std::numeric_limits<std::uint32_t>::max();
    std::vector<Polygon> pieces_;
    std::vector<Found> found_;
};

}  // namespace

void one_by_one(std::size_t count, const std::function<void(std::size_t)>& task) {
    for (std::size_t i = 0; i < count; ++i) task(i);
}

SurfaceDistance distance_from(std::span<const Vec3> from_positions, std::span<const VertexTriple> from_triangles,
                              const TriangleMesh& to, const TriangleTree& to_tree, double tolerance_m,
                              const ForEach& for_each) {
    SurfaceDistance distance;
    distance.of_from_m.resize(from_triangles.size());
    distance.attributed_m.resize(to.triangles.size());
    const std::size_t tasks = (from_triangles.size() + kTrianglesATask - 1) / kTrianglesATask;
    std::vector<std::vector<Comparison::Found>> found(tasks);
    for_each(tasks, [&](std::size_t task) {
        Comparison comparison(to, to_tree, tolerance_m);
        const std::size_t first = task * kTrianglesATask;
        for (std::size_t t = first; t < std::min(first + kTrianglesATask, from_triangles.size()); ++t) {
            const auto [a, b, c] = from_triangles[t];
            distance.of_from_m[t] = comparison.run({from_positions[a], from_positions[b], from_positions[c]});
        }
        found[task] = comparison.found();
    });
    for (const auto& of_task : found) {
        for (const Comparison::Found& f : of_task) {
            distance.attributed_m[f.triangle] = std::max(distance.attributed_m[f.triangle], f.bound_m);
            distance.largest_m = std::max(distance.largest_m, f.bound_m);
        }
    }
    return distance;
}

}  // namespace burin::geometry
