// SPDX-License-Identifier: MIT
#include "compute/tools/smooth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "compute/rays/set_algebra.hpp"
#include "compute/tools/smooth_field.hpp"

namespace burin::compute {
namespace {

using shared::DexelEnd;
using shared::kUnitsPerCell;
using shared::SmoothEdge;
using shared::Smoothing;
using shared::SmoothPath;
using Node = std::array<int, 3>;

// The variance of the kernel, in squares of the ball's radius, for a path of one radius past a place at strength 1.
constexpr double kVarianceAPath = 0.18;
constexpr double kStampPath = 0.25;        // the path, in radii, for which a stamp counts
constexpr double kKernelVariances = 10.0;  // width^2 of a kernel over its variance

// State of a lattice node before and after smoothing.
struct NodeState {
    bool was_inside = false, is_inside = false;
    bool weighs = false;    // the tool reaches it
    bool is_known = false;  // `field` has been computed
    double field = 0.0;
};

// Values at the lattice nodes of a box.
class NodeGrid {
public:
    NodeGrid(const Node& lo, const Node& hi) : lo_(lo), hi_(hi) {
        for (std::size_t a = 0; a < 3; ++a) size_[a] = static_cast<std::size_t>(hi[a] - lo[a] + 1);
        values_.resize(size_[0] * size_[1] * size_[2]);
    }
    [[nodiscard]] bool holds(const Node& n) const {
        for (std::size_t a = 0; a < 3; ++a)
            if (n[a] < lo_[a] || n[a] > hi_[a]) return false;
        return true;
    }
    [[nodiscard]] NodeState& operator[](const Node& n) { return values_[index(n)]; }
    [[nodiscard]] const NodeState& operator[](const Node& n) const { return values_[index(n)]; }
    [[nodiscard]] const Node& lo() const { return lo_; }
    [[nodiscard]] const Node& hi() const { return hi_; }

private:
    [[nodiscard]] std::size_t index(const Node& n) const {
        return (static_cast<std::size_t>(n[2] - lo_[2]) * size_[1] + static_cast<std::size_t>(n[1] - lo_[1])) *
                   size_[0] +
               static_cast<std::size_t>(n[0] - lo_[0]);
    }
    Node lo_, hi_;
    std::array<std::size_t, 3> size_{};
    std::vector<NodeState> values_;
};

[[nodiscard]] Node beside(Node n, std::size_t axis, int by) {
    n[axis] += by;
    return n;
}
[[nodiscard]] Vec3 place_of(const Node& n) { return {n[0], n[1], n[2]}; }

class Smoother {
public:
    Smoother(const Solid& solid, const SmoothBall& ball, WorkerPool& pool)
        : solid_(solid),
          lattice_(solid.lattice),
          ball_(ball),
          pool_(pool),
          region_(smooth_region(solid.lattice, ball)),
          path_(region_.path),
          lo_(region_.lo),
          hi_(region_.hi) {}

    RayBatch run() {
        if (region_.is_empty()) return {};
        const SmoothField field(points_within(region_.reach()), region_.most_width);
        NodeGrid nodes(grown(lo_, -1), grown(hi_, 1));
        set_signs(nodes);
        move_nodes(field, nodes);
        return rebuilt(field, nodes);
    }

private:
    [[nodiscard]] static Node grown(const Node& n, int by) { return {n[0] + by, n[1] + by, n[2] + by}; }

    [[nodiscard]] Smoothing smoothing_at(const Vec3& place) const { return shared::smoothing_at(path_, place); }

    [[nodiscard]] RayEnds ends(int axis, int u, int v) const {
        if (u < 0 || v < 0 || u >= lattice_.rays_u(axis) || v >= lattice_.rays_v(axis)) return {};
        return solid_.sets[static_cast<std::size_t>(axis)].ends(u, v);
    }

    // Returns the ends on the lattice edge from `low` one cell along the axis: above its lower node, not above its
    // upper one.
    [[nodiscard]] RayEnds ends_on_edge(int axis, const Node& low) const {
        const auto s = static_cast<std::size_t>(axis);
        const RayEnds all = ends(axis, low[(s + 1) % 3], low[(s + 2) % 3]);
        std::size_t from = 0;
        while (from < all.size() && depth_of(all[from]) <= low[s] * kUnitsPerCell) ++from;
        std::size_t to = from;
        while (to < all.size() && depth_of(all[to]) <= (low[s] + 1) * kUnitsPerCell) ++to;
        return all.subspan(from, to - from);
    }

    // Returns the ends no farther from the ball's path than `reach`, in the order of their rays.
    [[nodiscard]] std::vector<SurfacePoint> points_within(double reach) const {
        std::vector<SurfacePoint> points;
        const Vec3 end = path_.start + path_.along, lo = glm::min(path_.start, end) - reach,
                   hi = glm::max(path_.start, end) + reach;
        for (int axis = 0; axis < 3; ++axis) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            for (int rv = static_cast<int>(std::ceil(lo[v])); rv <= static_cast<int>(std::floor(hi[v])); ++rv) {
                for (int ru = static_cast<int>(std::ceil(lo[u])); ru <= static_cast<int>(std::floor(hi[u])); ++ru) {
                    for (const DexelEnd& end : ends(axis, ru, rv)) {
                        const Vec3 place = shared::place_on_ray(axis, ru, rv, depth_of(end)),
                                   off = off_path(path_, place);
                        if (shared::dot3(off, off) > reach * reach) continue;
                        const Vec3 normal = shared::decoded_normal(end.normal);
                        points.push_back({place, normal, shared::area_of_end(normal, axis), 0.0,
                                          static_cast<std::uint8_t>(material_of(end))});
                    }
                }
            }
        }
        return points;
    }

    // Sets which nodes were inside, by the rays along z, and which ones the tool reaches.
    void set_signs(NodeGrid& nodes) const {
        const Node &lo = nodes.lo(), &hi = nodes.hi();
        pool_.run(static_cast<std::size_t>(hi[1] - lo[1] + 1), [&](std::size_t row) {
            const int y = lo[1] + static_cast<int>(row);
            for (int x = lo[0]; x <= hi[0]; ++x) {
                const RayEnds ray = ends(2, x, y);
                std::size_t below = 0;
                for (int z = lo[2]; z <= hi[2]; ++z) {
                    while (below < ray.size() && depth_of(ray[below]) <= z * kUnitsPerCell) ++below;
                    NodeState& node = nodes[{x, y, z}];
                    node.was_inside = node.is_inside = below % 2 != 0;
                    bool within = true;
                    for (std::size_t a = 0; a < 3; ++a) {
                        const int n = Node{x, y, z}[a];
                        within = within && n >= lo_[a] && n <= hi_[a];
                    }
                    const Vec3 off = off_path(path_, Vec3(x, y, z));
                    node.weighs = within && shared::dot3(off, off) < path_.radius * path_.radius;
                }
            }
        });
    }

    // Moves nodes to the other side of the surface where the field says so: first those next to the surface, then the
    // neighbours of those that have moved, and so on.
    void move_nodes(const SmoothField& field, NodeGrid& nodes) const {
        std::vector<Node> wave = nodes_at_surface(nodes);
        for (int i = 0; i < shared::kMostWaves && !wave.empty(); ++i) {
            constexpr std::size_t kNodesATask = 64;
            pool_.run((wave.size() + kNodesATask - 1) / kNodesATask, [&](std::size_t task) {
                const std::size_t end = std::min(wave.size(), (task + 1) * kNodesATask);
                for (std::size_t n = task * kNodesATask; n < end; ++n) set_side(field, wave[n], nodes[wave[n]]);
            });
            std::vector<Node> next;
            for (const Node& n : wave) {
                if (nodes[n].is_inside == nodes[n].was_inside) continue;
                for_neighbours(n, [&](const Node& m) {
                    NodeState& state = nodes[m];
                    if (!state.weighs || state.is_known || state.was_inside != nodes[n].was_inside) return;
                    state.is_known = true;
                    next.push_back(m);
                });
            }
            wave = std::move(next);
        }
    }

    template <typename F>
    static void for_neighbours(const Node& n, F f) {
        for (std::size_t a = 0; a < 3; ++a) {
            f(beside(n, a, -1));
            f(beside(n, a, 1));
        }
    }

    [[nodiscard]] std::vector<Node> nodes_at_surface(NodeGrid& nodes) const {
        std::vector<Node> found;
        for (int z = lo_[2]; z <= hi_[2]; ++z) {
            for (int y = lo_[1]; y <= hi_[1]; ++y) {
                for (int x = lo_[0]; x <= hi_[0]; ++x) {
                    const Node n{x, y, z};
                    NodeState& node = nodes[n];
                    if (!node.weighs) continue;
                    bool crossed = false;
                    for_neighbours(n, [&](const Node& m) { crossed |= nodes[m].was_inside != node.was_inside; });
                    if (!crossed) continue;
                    node.is_known = true;
                    found.push_back(n);
                }
            }
        }
        return found;
    }

    void set_side(const SmoothField& field, const Node& n, NodeState& node) const {
        const Smoothing smoothing = smoothing_at(place_of(n));
        const SmoothField::Value value = field.at(place_of(n), smoothing.width, false);
        node.field = before(n, node.was_inside);
        if (!value.known) return;
        node.field = shared::part_of_way(node.field, smoothing.share, value.distance);
        node.is_inside = node.field < 0.0;
    }

    // Returns a node's signed distance from the surface as it was: from the nearest plane of an end on its edges, or a
    // cell where there is none.
    [[nodiscard]] double before(const Node& n, bool inside) const {
        double distance = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto s = static_cast<std::size_t>(axis);
            for (const int by : {-1, 0}) {
                for (const DexelEnd& end : ends_on_edge(axis, beside(n, s, by)))
                    distance = std::min(distance, shared::distance_of_end(end, axis, n[s]));
            }
        }
        return inside ? -distance : distance;
    }

    RayBatch rebuilt(const SmoothField& field, const NodeGrid& nodes) const {
        RayBatch batch;
        for (int axis = 0; axis < 3; ++axis) {
            const auto u = static_cast<std::size_t>((axis + 1) % 3), v = static_cast<std::size_t>((axis + 2) % 3);
            std::vector<RayBatch> rows(static_cast<std::size_t>(hi_[v] - lo_[v] + 1));
            pool_.run(rows.size(), [&](std::size_t row) {
                std::vector<DexelEnd> fresh;
                const int rv = lo_[v] + static_cast<int>(row);
                for (int ru = lo_[u]; ru <= hi_[u]; ++ru) {
                    const RayEnds held = ends(axis, ru, rv);
                    fresh.clear();
                    append_ray(axis, ru, rv, held, field, nodes, fresh);
                    if (!same_ends(held, fresh)) rows[row].add(shared::ray_code(axis, ru, rv), fresh);
                }
            });
            for (const RayBatch& row : rows)
                for (const RayBatch::Ray& ray : row.rays) batch.add(ray.code, row.ends_of(ray));
        }
        return batch;
    }

    void append_ray(int axis, int ru, int rv, RayEnds held, const SmoothField& field, const NodeGrid& nodes,
                    std::vector<DexelEnd>& to) const {
        const auto s = static_cast<std::size_t>(axis);
        Node low{};
        low[(s + 1) % 3] = ru;
        low[(s + 2) % 3] = rv;
        std::size_t next = 0;
        // Sign of the lower node: taken from the ray's own ends where the tool does not reach the node, and from the
        // smoothed field where it does.
        bool low_inside = false;
        for (int k = lo_[s] - 1; k <= hi_[s]; ++k) {
            low[s] = k;
            const Node high = beside(low, s, 1);
            const NodeState &below = nodes[low], &above = nodes[high];
            if (!below.weighs && !above.weighs) continue;
            // The ends of this edge lie above its lower node and not above its upper one. Earlier ends are kept.
            while (next < held.size() && depth_of(held[next]) <= k * kUnitsPerCell) to.push_back(held[next++]);
            std::size_t last = next;
            while (last < held.size() && depth_of(held[last]) <= (k + 1) * kUnitsPerCell) ++last;
            if (!below.weighs) low_inside = next % 2 != 0;
            const bool high_inside = above.weighs ? above.is_inside : last % 2 != 0;
            append_edge({{axis, ru, rv, k}, low_inside, high_inside, below, above}, held.subspan(next, last - next),
                        next % 2 != 0, field, to);
            next = last;
            low_inside = high_inside;
        }
        to.insert(to.end(), held.begin() + static_cast<std::ptrdiff_t>(next), held.end());
    }

    struct Edge {
        SmoothEdge at;
        bool low_inside, high_inside;
        const NodeState &below, &above;
    };

    void append_edge(const Edge& e, RayEnds held, bool held_low_inside, const SmoothField& field,
                     std::vector<DexelEnd>& to) const {
        const bool crossed = e.low_inside != e.high_inside;
        const bool same_way = held_low_inside == e.low_inside;
        if (held.empty() && same_way && !crossed) return;
        if (same_way && (held.size() % 2 != 0) == crossed) {
            append_moved(e, held, field, to);
        } else if (crossed) {
            to.push_back(made(e, field));
        }
    }

    // Appends the ends of an edge, moved. Two that meet, or between which the field sees nothing, are dropped.
    void append_moved(const Edge& e, RayEnds held, const SmoothField& field, std::vector<DexelEnd>& to) const {
        const std::size_t first = to.size();
        for (std::size_t i = 0; i < held.size(); ++i) {
            const bool inside_between = e.low_inside == (i % 2 != 0);
            if (i + 1 < held.size() && is_gone(e, held[i], held[i + 1], inside_between, field)) {
                ++i;
                continue;
            }
            const DexelEnd end = moved(e, held[i], field);
            if (to.size() > first && depth_of(to.back()) >= depth_of(end))
                to.pop_back();
            else
                to.push_back(end);
        }
    }

    // Tells whether what is between two ends on one edge has vanished: by the field in its middle.
    [[nodiscard]] bool is_gone(const Edge& e, const DexelEnd& from, const DexelEnd& to, bool inside,
                               const SmoothField& field) const {
        const double half = half_between(from, to);
        const Vec3 middle = place_on_edge(e.at, share_of_depth(e.at, depth_of(from)) + half);
        const Smoothing smoothing = smoothing_at(middle);
        if (!(smoothing.share > 0.0)) return false;
        const SmoothField::Value value = field.at(middle, smoothing.width, false);
        return value.known && has_vanished(e.at, from, half, inside, smoothing.share, value.distance);
    }

    struct Root {
        double share;
        Vec3 normal;
        bool found;
    };
    // Follows the field from a place on the edge to its zero on the edge's ray, in Newton steps of at most half a cell.
    [[nodiscard]] Root root_from(const Edge& e, double share, const SmoothField& field) const {
        Root root{share, Vec3(0.0), false};
        for (int step = 0; step < shared::kNewtonSteps; ++step) {
            const Vec3 place = place_on_edge(e.at, root.share);
            const SmoothField::Value value = field.at(place, smoothing_at(place).width, true);
            if (!value.known) return root;
            root.normal = value.gradient;
            root.found = true;
            if (step + 1 == shared::kNewtonSteps) break;
            const double by = shared::newton_step(value.distance, value.gradient[e.at.axis]);
            root.share += by;
            if (std::abs(by) < shared::kSmallStep) break;
        }
        return root;
    }

    // Moves an end by a share of its way to the zero of the field.
    [[nodiscard]] DexelEnd moved(const Edge& e, const DexelEnd& old, const SmoothField& field) const {
        const double was = share_of_depth(e.at, depth_of(old));
        const double by_share = smoothing_at(place_on_edge(e.at, was)).share;
        if (shared::is_too_weak(by_share)) return old;
        const Root root = root_from(e, was, field);
        return root.found ? moved_end(old, e.at.low, was, root.share, by_share, root.normal) : old;
    }

    // Makes an end on an edge that had none, or several.
    [[nodiscard]] DexelEnd made(const Edge& e, const SmoothField& field) const {
        double share = 0.5;
        if (e.below.is_known && e.above.is_known && (e.below.field < 0.0) == e.low_inside &&
            (e.above.field < 0.0) == e.high_inside) {
            share = e.below.field / (e.below.field - e.above.field);
            const Root root =
                smoothing_at(place_on_edge(e.at, share)).share < 1.0 ? Root{} : root_from(e, share, field);
            if (root.found) share = root.share;
        }
        const Vec3 place = place_on_edge(e.at, std::clamp(share, 0.0, 1.0));
        const Smoothing smoothing = smoothing_at(place);
        const SmoothField::Value value = field.at(place, smoothing.width, true);
        const std::uint32_t material = field.material_near(place, 2.0 * smoothing.width.value, ball_.material);
        return made_end(e.at, share, material, e.low_inside, value.known, value.gradient);
    }

    const Solid& solid_;
    const Lattice& lattice_;
    const SmoothBall& ball_;
    WorkerPool& pool_;
    const SmoothRegion region_;
    const SmoothPath& path_;
    const Node &lo_, &hi_;
};

}  // namespace

SmoothRegion smooth_region(const Lattice& lattice, const SmoothBall& ball) {
    SmoothRegion region;
    SmoothPath& path = region.path;
    path.start = lattice.units_from_object(ball.start_object_m) / double(kUnitsPerCell);
    path.along = lattice.units_from_object(ball.end_object_m) / double(kUnitsPerCell) - path.start;
    path.radius = ball.radius_m / lattice.spacing_m;
    const double length = glm::length(path.along) > 0.0 ? glm::length(path.along) / path.radius : kStampPath;
    path.most_width2 = kKernelVariances * kVarianceAPath * ball.strength * length * path.radius * path.radius;
    region.most_width = std::max(std::sqrt(path.most_width2), shared::kLeastWidth);
    const Vec3 end = path.start + path.along, lo = glm::min(path.start, end) - path.radius,
               hi = glm::max(path.start, end) + path.radius;
    for (int a = 0; a < 3; ++a) {
        const auto s = static_cast<std::size_t>(a);
        region.lo[s] = static_cast<int>(std::clamp(std::ceil(lo[a]), 1.0, double(lattice.cells[s])));
        region.hi[s] = static_cast<int>(std::clamp(std::floor(hi[a]), 0.0, double(lattice.cells[s] - 1)));
    }
    return region;
}

RayBatch smoothed_rays(const Solid& solid, const SmoothBall& ball, WorkerPool& pool) {
    return Smoother(solid, ball, pool).run();
}

}  // namespace burin::compute
