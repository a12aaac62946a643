// SPDX-License-Identifier: MIT
#include "compute/repair/oriented_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace burin::compute {
namespace {

// From so many triangles on, those of a fan are kept together.
constexpr std::size_t kLargeFan = 32;
// Of sums and products of some coordinates, as a share of the longest, with a wide margin.
constexpr double kOfBoxes = 1e-12, kOfTriangles = 1e-14;

// A symmetric matrix by its upper half: xx, yy, zz, yz, xz, xy.
using Symmetric = std::array<double, 6>;

// Turns the two axes so that the matrix's element between them vanishes (Jacobi).
void rotate(double& pp, double& qq, double& pq, double& rp, double& rq, Vec3& p, Vec3& q) {
    if (std::abs(pq) <= 1e-18 * (std::abs(pp) + std::abs(qq))) return;
    const double theta = 0.5 * (qq - pp) / pq;
    const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
    const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
    pp -= t * pq;
    qq += t * pq;
    pq = 0.0;
    const double old_rp = rp;
    rp = c * old_rp - s * rq;
    rq = s * old_rp + c * rq;
    const Vec3 old_p = p;
    p = c * old_p - s * q;
    q = s * old_p + c * q;
}

// Returns the axes of inertia of the points of this covariance, at right angles to a few units in the last place.
std::array<Vec3, 3> principal_axes(Symmetric m) {
    std::array<Vec3, 3> axes{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    auto& [xx, yy, zz, yz, xz, xy] = m;
    for (int sweep = 0; sweep < 4; ++sweep) {
        rotate(xx, yy, xy, xz, yz, axes[0], axes[1]);
        rotate(xx, zz, xz, xy, yz, axes[0], axes[2]);
        rotate(yy, zz, yz, xy, xz, axes[1], axes[2]);
    }
    return axes;
}

// How far a box reaches from its middle along a direction.
double radius_along(const OrientedBox& box, const Vec3& direction) {
    return box.half.x * std::abs(glm::dot(box.axes[0], direction)) +
           box.half.y * std::abs(glm::dot(box.axes[1], direction)) +
           box.half.z * std::abs(glm::dot(box.axes[2], direction));
}

bool is_parted_along(const Vec3& axis, const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double reach) {
    const double a0 = glm::dot(axis, a[0]), a1 = glm::dot(axis, a[1]), a2 = glm::dot(axis, a[2]);
    const double b0 = glm::dot(axis, b[0]), b1 = glm::dot(axis, b[1]), b2 = glm::dot(axis, b[2]);
    const double a_lo = std::min({a0, a1, a2}), a_hi = std::max({a0, a1, a2});
    const double b_lo = std::min({b0, b1, b2}), b_hi = std::max({b0, b1, b2});
    const double gap = std::max(b_lo - a_hi, a_lo - b_hi);
    return gap > 0.0 && gap * gap > reach * reach * glm::dot(axis, axis);
}

}  // namespace

bool may_meet(const OrientedBox& a, const OrientedBox& b) {
    const Vec3 way = b.middle - a.middle;
    const double reach = a.reach + b.reach;
    // The axes are of unit length, and their cross products no longer.
    const auto parts = [&](const Vec3& axis) {
        return std::abs(glm::dot(way, axis)) > radius_along(a, axis) + radius_along(b, axis) + reach;
    };
    for (const Vec3& axis : a.axes)
        if (parts(axis)) return false;
    for (const Vec3& axis : b.axes)
        if (parts(axis)) return false;
    return true;
}

bool may_meet(const OrientedBox& box, const std::array<Vec3, 3>& triangle, double reach) {
    const Vec3 a = triangle[0] - box.middle, b = triangle[1] - box.middle, c = triangle[2] - box.middle;
    for (int k = 0; k < 3; ++k) {
        const Vec3& axis = box.axes[static_cast<std::size_t>(k)];
        const double at_a = glm::dot(a, axis), at_b = glm::dot(b, axis), at_c = glm::dot(c, axis);
        const double most = box.half[k] + box.reach + reach;
        if (std::min({at_a, at_b, at_c}) > most || std::max({at_a, at_b, at_c}) < -most) return false;
    }
    return true;
}

bool are_apart(const std::array<Vec3, 3>& first, const std::array<Vec3, 3>& second, double reach) {
    std::array<Vec3, 3> a, b, along_a, along_b;
    for (std::size_t k = 0; k < 3; ++k) {
        a[k] = first[k] - first[0];
        b[k] = second[k] - first[0];
    }
    double size2 = 0.0;
    for (std::size_t k = 0; k < 3; ++k) size2 = std::max({size2, glm::dot(a[k], a[k]), glm::dot(b[k], b[k])});
    reach += kOfTriangles * std::sqrt(size2);
    for (std::size_t k = 0; k < 3; ++k) {
        along_a[k] = a[(k + 1) % 3] - a[k];
        along_b[k] = b[(k + 1) % 3] - b[k];
    }
    const Vec3 up_a = glm::cross(along_a[0], along_a[1]), up_b = glm::cross(along_b[0], along_b[1]);
    if (is_parted_along(up_a, a, b, reach) || is_parted_along(up_b, a, b, reach)) return true;
    for (const Vec3& edge : along_a)
        if (is_parted_along(glm::cross(up_a, edge), a, b, reach)) return true;
    for (const Vec3& edge : along_b)
        if (is_parted_along(glm::cross(up_b, edge), a, b, reach)) return true;
    for (const Vec3& edge : along_a)
        for (const Vec3& other : along_b)
            if (is_parted_along(glm::cross(edge, other), a, b, reach)) return true;
    return false;
}

bool OrientedTree::Node::has_in_common_with(const Node& other) const {
    return std::ranges::any_of(common, [&](std::uint32_t v) {
        return v != kNoVertex && std::ranges::find(other.common, v) != other.common.end();
    });
}

// Halves the triangles again and again where their keys lie farthest apart: the vertex of a large fan, else the middle.
class OrientedTree::Builder {
public:
    Builder(OrientedTree& tree, const geometry::TriangleMesh& mesh, const Fans& fans, std::span<const double> reach)
        : tree_(tree),
          mesh_(mesh),
          reach_(reach),
          origin_(mesh.positions_m.empty() ? Vec3(0.0) : mesh.positions_m.front()),
          keys_(mesh.triangles.size()),
          middles_(mesh.triangles.size()) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const geometry::VertexTriple& triangle = mesh.triangles[t];
            if (geometry::names_a_vertex_twice(triangle)) continue;
            tree.order_.push_back(t);
            middles_[t] = (corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3.0;
            const std::uint32_t largest =
                std::ranges::max(triangle, {}, [&](std::uint32_t v) { return fans.of(v).size(); });
            keys_[t] = fans.of(largest).size() >= kLargeFan ? mesh.positions_m[largest] : middles_[t];
        }
    }

    // Sums over corners, relative to the origin.
    struct Moments {
        double count = 0.0;
        Vec3 sum{0.0};
        Symmetric squares{};
    };

    Moments add(std::uint32_t first, std::uint32_t last) {
        const std::size_t at = tree_.nodes_.size();
        tree_.nodes_.push_back({{}, first, last, 0, common_of(first, last)});
        Moments moments;
        if (tree_.nodes_[at].is_leaf()) {
            moments = moments_of(first, last);
            tree_.nodes_[at].box = box_of(first, last, axes_of(moments));
        } else {
            const std::uint32_t half = first + (last - first) / 2;
            split(first, half, last);
            moments = add(first, half);
            const std::size_t right = tree_.nodes_.size();
            const Moments more = add(half, last);
            moments.count += more.count;
            moments.sum += more.sum;
            for (std::size_t i = 0; i < moments.squares.size(); ++i) moments.squares[i] += more.squares[i];
            tree_.nodes_[at].box = box_around(tree_.nodes_[at + 1].box, tree_.nodes_[right].box, axes_of(moments));
        }
        tree_.nodes_[at].behind = static_cast<std::uint32_t>(tree_.nodes_.size());
        return moments;
    }

private:
    [[nodiscard]] const Vec3& corner(std::uint32_t t, std::size_t k) const {
        return mesh_.positions_m[mesh_.triangles[t][k]];
    }
    [[nodiscard]] std::span<std::uint32_t> places(std::uint32_t first, std::uint32_t last) const {
        return std::span(tree_.order_).subspan(first, last - first);
    }

    void split(std::uint32_t first, std::uint32_t half, std::uint32_t last) {
        const auto box_of_points = [&](const std::vector<Vec3>& points) {
            Box box;
            for (const std::uint32_t t : places(first, last)) box.include(points[t]);
            return box.extent();
        };
        Vec3 extent = box_of_points(keys_);
        const bool is_one_fan = extent == Vec3(0.0);
        if (is_one_fan) extent = box_of_points(middles_);
        const std::vector<Vec3>& points = is_one_fan ? middles_ : keys_;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        const std::span<std::uint32_t> order = places(first, last);
        std::ranges::nth_element(order, order.begin() + (half - first), [&](std::uint32_t a, std::uint32_t b) {
            return points[a][axis] != points[b][axis] ? points[a][axis] < points[b][axis] : a < b;
        });
    }

    [[nodiscard]] Moments moments_of(std::uint32_t first, std::uint32_t last) const {
        Moments moments{.count = 3.0 * (last - first)};
        for (const std::uint32_t t : places(first, last))
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 p = corner(t, k) - origin_;
                moments.sum += p;
                const Symmetric of_p{p.x * p.x, p.y * p.y, p.z * p.z, p.y * p.z, p.x * p.z, p.x * p.y};
                for (std::size_t i = 0; i < of_p.size(); ++i) moments.squares[i] += of_p[i];
            }
        return moments;
    }

    static std::array<Vec3, 3> axes_of(const Moments& moments) {
        const Vec3 &sum = moments.sum, mean = sum / moments.count;
        const Symmetric of_sum{sum.x * mean.x, sum.y * mean.y, sum.z * mean.z,
                               sum.y * mean.z, sum.x * mean.z, sum.x * mean.y};
        Symmetric m = moments.squares;
        for (std::size_t i = 0; i < m.size(); ++i) m[i] -= of_sum[i];
        return principal_axes(m);
    }

    // Returns the box around all triangles from first on.
    [[nodiscard]] OrientedBox box_of(std::uint32_t first, std::uint32_t last, const std::array<Vec3, 3>& axes) const {
        const Vec3 origin = corner(tree_.order_[first], 0);
        double reach = 0.0;
        Box extent;
        for (const std::uint32_t t : places(first, last))
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 p = corner(t, k) - origin;
                extent.include({glm::dot(p, axes[0]), glm::dot(p, axes[1]), glm::dot(p, axes[2])});
                reach = std::max(reach, reach_[mesh_.triangles[t][k]]);
            }
        return with_middle(origin, extent, axes, reach);
    }

    static OrientedBox box_around(const OrientedBox& a, const OrientedBox& b, const std::array<Vec3, 3>& axes) {
        const Vec3 way = b.middle - a.middle;
        Box extent{Vec3(0.0), Vec3(0.0)};
        for (int k = 0; k < 3; ++k) {
            const Vec3& axis = axes[static_cast<std::size_t>(k)];
            const double at_b = glm::dot(way, axis), of_a = radius_along(a, axis), of_b = radius_along(b, axis);
            extent.lo[k] = std::min(-of_a, at_b - of_b);
            extent.hi[k] = std::max(of_a, at_b + of_b);
        }
        return with_middle(a.middle, extent, axes, std::max(a.reach, b.reach));
    }

    static OrientedBox with_middle(const Vec3& origin, const Box& extent, const std::array<Vec3, 3>& axes,
                                   double reach) {
        const Vec3 middle = extent.center();
        OrientedBox box{origin + middle.x * axes[0] + middle.y * axes[1] + middle.z * axes[2], axes,
                        0.5 * extent.extent(), reach};
        const Vec3 size = glm::abs(box.middle) + box.half;
        box.reach += kOfBoxes * (size.x + size.y + size.z);
        return box;
    }

    [[nodiscard]] std::array<std::uint32_t, 3> common_of(std::uint32_t first, std::uint32_t last) const {
        std::array<std::uint32_t, 3> common = mesh_.triangles[tree_.order_[first]];
        for (const std::uint32_t t : places(first, last)) {
            if (common == std::array{kNoVertex, kNoVertex, kNoVertex}) break;
            for (std::uint32_t& v : common)
                if (v != kNoVertex && std::ranges::find(mesh_.triangles[t], v) == mesh_.triangles[t].end())
                    v = kNoVertex;
        }
        return common;
    }

    OrientedTree& tree_;
    const geometry::TriangleMesh& mesh_;
    const std::span<const double> reach_;
    const Vec3 origin_;
    std::vector<Vec3> keys_, middles_;
};

OrientedTree::OrientedTree(const geometry::TriangleMesh& mesh, const Fans& fans, std::span<const double> reach) {
    Builder builder(*this, mesh, fans, reach);
    nodes_.reserve(order_.size());
    if (!order_.empty()) builder.add(0, static_cast<std::uint32_t>(order_.size()));
}

}  // namespace burin::compute
