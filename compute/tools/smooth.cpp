// SPDX-License-Identifier: MIT
#include "compute/tools/smooth.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "compute/rays/normal_code.hpp"
#include "compute/rays/set_algebra.hpp"

namespace burin::compute {
namespace {

using shared::DexelEnd;
using shared::kUnitsPerCell;
using Node = std::array<int, 3>;

constexpr int kBand = 4;    // nodes; an end farther away than this is not considered for a node
constexpr int kKernel = 2;  // nodes to each side that the filter reads

// Values at the lattice nodes of a box.
template <typename T>
class NodeGrid {
public:
    NodeGrid(const Node& lo, const Node& hi, const T& value) : lo_(lo) {
        for (std::size_t a = 0; a < 3; ++a) size_[a] = hi[a] - lo[a] + 1;
        values_.assign(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
                           static_cast<std::size_t>(size_[2]),
                       value);
    }
    [[nodiscard]] bool holds(const Node& n) const {
        for (std::size_t a = 0; a < 3; ++a)
            if (n[a] < lo_[a] || n[a] >= lo_[a] + size_[a]) return false;
        return true;
    }
    [[nodiscard]] T& operator[](const Node& n) { return values_[index(n)]; }
    [[nodiscard]] const T& operator[](const Node& n) const { return values_[index(n)]; }
    [[nodiscard]] const Node& lo() const { return lo_; }
    [[nodiscard]] Node hi() const { return {lo_[0] + size_[0] - 1, lo_[1] + size_[1] - 1, lo_[2] + size_[2] - 1}; }

private:
    [[nodiscard]] std::size_t index(const Node& n) const {
        return (static_cast<std::size_t>(n[2] - lo_[2]) * static_cast<std::size_t>(size_[1]) +
                static_cast<std::size_t>(n[1] - lo_[1])) *
                   static_cast<std::size_t>(size_[0]) +
               static_cast<std::size_t>(n[0] - lo_[0]);
    }
    Node lo_, size_{};
    std::vector<T> values_;
};

// Calls f(node) for the nodes of a box; layers of z are distributed over the pool.
template <typename F>
void for_nodes(const Node& lo, const Node& hi, WorkerPool& pool, F f) {
    pool.run(static_cast<std::size_t>(std::max(0, hi[2] - lo[2] + 1)), [&](std::size_t layer) {
        const int z = lo[2] + static_cast<int>(layer);
        for (int y = lo[1]; y <= hi[1]; ++y)
            for (int x = lo[0]; x <= hi[0]; ++x) f(Node{x, y, z});
    });
}

Vec3 decoded(std::uint32_t code) {
    const shared::Direction d = shared::decode_normal(code);
    return {d.x, d.y, d.z};
}

// A point of the surface, in cells from the lattice origin.
struct SurfacePoint {
    Vec3 place, normal;
    std::uint8_t material;
};

struct Nearest {
    double distance2 = 1e300;
    double plane = 0.0;  // signed distance from the plane of the nearest point
    std::uint8_t material = 0;
};

class Smoother {
public:
    Smoother(const Solid& solid, const SmoothBall& ball, WorkerPool& pool)
        : solid_(solid), lattice_(solid.lattice), ball_(ball), pool_(pool) {
        start_ = lattice_.units_from_object(ball.start_object_m) / double(kUnitsPerCell);
        along_ = lattice_.units_from_object(ball.end_object_m) / double(kUnitsPerCell) - start_;
        radius_ = ball.radius_m / lattice_.spacing_m;
        const Vec3 lo = glm::min(start_, start_ + along_) - radius_, hi = glm::max(start_, start_ + along_) + radius_;
        for (int a = 0; a < 3; ++a) {
            const auto s = static_cast<std::size_t>(a);
            // Excludes nodes on the lattice's border, which have no weight.
            lo_[s] = static_cast<int>(std::clamp(std::ceil(lo[a]), 1.0, double(lattice_.cells[s])));
            hi_[s] = static_cast<int>(std::clamp(std::floor(hi[a]), 0.0, double(lattice_.cells[s] - 1)));
        }
    }

    RayBatch run() {
        if (ball_.strength <= 0.0 || lo_[0] > hi_[0] || lo_[1] > hi_[1] || lo_[2] > hi_[2]) return {};
        const Node lo = grown(lo_, -1 - kKernel), hi = grown(hi_, 1 + kKernel);
        NodeGrid<Nearest> nearest(lo, hi, {});
        find_nearest(nearest);
        NodeGrid<double> before(lo, hi, 0.0), after(lo, hi, 0.0);
        set_distances(nearest, before);
        filter(before, after);
        return rebuilt(nearest, before, after);
    }

private:
    [[nodiscard]] static Node grown(const Node& n, int by) { return {n[0] + by, n[1] + by, n[2] + by}; }

    [[nodiscard]] double weight(const Node& n) const {
        for (std::size_t a = 0; a < 3; ++a)
            if (n[a] < lo_[a] || n[a] > hi_[a]) return 0.0;
        const Vec3 p = Vec3(n[0], n[1], n[2]) - start_;
        const double length2 = glm::dot(along_, along_);
        const double t = length2 > 0.0 ? std::clamp(glm::dot(p, along_) / length2, 0.0, 1.0) : 0.0;
        const Vec3 off = p - t * along_;
        const double inside = 1.0 - glm::dot(off, off) / (radius_ * radius_);
        return inside > 0.0 ? ball_.strength * inside * inside : 0.0;
    }

    [[nodiscard]] RayEnds ends(int axis, int u, int v) const {
        if (u < 0 || v < 0 || u >= lattice_.rays_u(axis) || v >= lattice_.rays_v(axis)) return {};
        return solid_.sets[static_cast<std::size_t>(axis)].ends(u, v);
    }

    // Returns whether a node is inside, which it is when the number of ends at or below it is odd.
    [[nodiscard]] static bool inside(RayEnds ends, int node) {
        bool in = false;
        for (std::size_t i = 0; i < ends.size() && depth_of(ends[i]) <= node * kUnitsPerCell; ++i) in = !in;
        return in;
    }

    // Finds the nearest end of each node. Every layer of nodes visits the ends near it in a fixed order, so that the
    // result does not depend on threads.
    void find_nearest(NodeGrid<Nearest>& nearest) const {
        const Node lo = nearest.lo(), hi = nearest.hi();
        std::vector<std::vector<SurfacePoint>> points(static_cast<std::size_t>(hi[2] - lo[2] + 1 + 2 * kBand));
        for (int axis = 0; axis < 3; ++axis) {
            const auto s = static_cast<std::size_t>(axis), u = (s + 1) % 3, v = (s + 2) % 3;
            for (int rv = lo[v] - kBand; rv <= hi[v] + kBand; ++rv) {
                for (int ru = lo[u] - kBand; ru <= hi[u] + kBand; ++ru) {
                    for (const DexelEnd& end : ends(axis, ru, rv)) {
                        Vec3 place(0.0);
                        place[axis] = depth_of(end) / double(kUnitsPerCell);
                        place[(axis + 1) % 3] = ru;
                        place[(axis + 2) % 3] = rv;
                        const int layer = static_cast<int>(std::floor(place.z)) - lo[2] + kBand;
                        if (place[axis] < lo[s] - kBand || place[axis] > hi[s] + kBand) continue;
                        if (layer < 0 || layer >= static_cast<int>(points.size())) continue;
                        points[static_cast<std::size_t>(layer)].push_back(
                            {place, decoded(end.normal), static_cast<std::uint8_t>(material_of(end))});
                    }
                }
            }
        }
        pool_.run(static_cast<std::size_t>(hi[2] - lo[2] + 1), [&](std::size_t layer) {
            for (std::size_t l = layer; l <= layer + 2 * kBand; ++l) {
                for (const SurfacePoint& point : points[l]) offer(point, lo[2] + static_cast<int>(layer), nearest);
            }
        });
    }

    static void offer(const SurfacePoint& point, int z, NodeGrid<Nearest>& nearest) {
        const Node lo = nearest.lo(), hi = nearest.hi();
        const int near_x = static_cast<int>(std::floor(point.place.x)),
                  near_y = static_cast<int>(std::floor(point.place.y));
        for (int y = std::max(lo[1], near_y - kBand + 1); y <= std::min(hi[1], near_y + kBand); ++y) {
            for (int x = std::max(lo[0], near_x - kBand + 1); x <= std::min(hi[0], near_x + kBand); ++x) {
                const Vec3 off = Vec3(x, y, z) - point.place;
                const double distance2 = glm::dot(off, off);
                Nearest& best = nearest[Node{x, y, z}];
                if (distance2 < best.distance2) best = {distance2, glm::dot(off, point.normal), point.material};
            }
        }
    }

    void set_distances(const NodeGrid<Nearest>& nearest, NodeGrid<double>& field) const {
        for_nodes(field.lo(), field.hi(), pool_, [&](const Node& n) {
            const bool in_lattice = n[2] >= 0 && n[2] <= lattice_.cells[2];
            const double sign = in_lattice && inside(ends(2, n[0], n[1]), n[2]) ? -1.0 : 1.0;
            const double size =
                nearest[n].distance2 < 1e200 ? std::min(std::abs(nearest[n].plane), double(kBand)) : kBand;
            field[n] = sign * size;
        });
    }

    // Filters the nodes that have weight; all others keep their values.
    void filter(const NodeGrid<double>& before, NodeGrid<double>& after) const {
        constexpr std::array<double, 5> kWeights{-1.0 / 16, 4.0 / 16, 10.0 / 16, 4.0 / 16, -1.0 / 16};
        NodeGrid<double> along_x = before, along_y = before;
        const auto filtered = [&](const NodeGrid<double>& from, const Node& n, std::size_t axis) {
            double sum = 0.0;
            for (int k = -kKernel; k <= kKernel; ++k) {
                Node m = n;
                m[axis] += k;
                sum += kWeights[static_cast<std::size_t>(k + kKernel)] * from[m];
            }
            return sum;
        };
        const Node& a = lo_;
        const Node& b = hi_;
        for_nodes({a[0], a[1] - kKernel, a[2] - kKernel}, {b[0], b[1] + kKernel, b[2] + kKernel}, pool_,
                  [&](const Node& n) { along_x[n] = filtered(before, n, 0); });
        for_nodes({a[0], a[1], a[2] - kKernel}, {b[0], b[1], b[2] + kKernel}, pool_,
                  [&](const Node& n) { along_y[n] = filtered(along_x, n, 1); });
        after = before;
        for_nodes(a, b, pool_, [&](const Node& n) {
            const double w = weight(n);
            if (w > 0.0) after[n] = before[n] + w * (filtered(along_y, n, 2) - before[n]);
        });
    }

    RayBatch rebuilt(const NodeGrid<Nearest>& nearest, const NodeGrid<double>& before,
                     const NodeGrid<double>& after) const {
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
                    append_ray(axis, ru, rv, held, nearest, before, after, fresh);
                    if (!same_ends(held, fresh)) rows[row].add(shared::ray_code(axis, ru, rv), fresh);
                }
            });
            for (const RayBatch& row : rows)
                for (const RayBatch::Ray& ray : row.rays) batch.add(ray.code, row.ends_of(ray));
        }
        return batch;
    }

    void append_ray(int axis, int ru, int rv, RayEnds held, const NodeGrid<Nearest>& nearest,
                    const NodeGrid<double>& before, const NodeGrid<double>& after, std::vector<DexelEnd>& to) const {
        const auto s = static_cast<std::size_t>(axis);
        Node low{};
        low[(s + 1) % 3] = ru;
        low[(s + 2) % 3] = rv;
        std::size_t next = 0;
        // Whether the lower node is inside: by this ray's own ends where the node has no weight, by the new values
        // where it has.
        bool low_inside = false;
        for (int k = lo_[s] - 1; k <= hi_[s]; ++k) {
            low[s] = k;
            Node high = low;
            high[s] = k + 1;
            const bool low_weighs = weight(low) > 0.0, high_weighs = weight(high) > 0.0;
            if (!low_weighs && !high_weighs) continue;
            // The ends of this edge lie above its lower node and not above its upper one. Earlier ends are kept.
            while (next < held.size() && depth_of(held[next]) <= k * kUnitsPerCell) to.push_back(held[next++]);
            std::size_t last = next;
            while (last < held.size() && depth_of(held[last]) <= (k + 1) * kUnitsPerCell) ++last;
            if (!low_weighs) low_inside = next % 2 != 0;
            const bool high_inside = high_weighs ? after[high] < 0.0 : last % 2 != 0;
            append_edge({axis, low, high, low_inside, high_inside}, held.subspan(next, last - next), next % 2 != 0,
                        nearest, before, after, to);
            next = last;
            low_inside = high_inside;
        }
        to.insert(to.end(), held.begin() + static_cast<std::ptrdiff_t>(next), held.end());
    }

    struct Edge {
        int axis;
        Node low, high;
        bool low_inside, high_inside;
    };

    [[nodiscard]] static bool has_signs_of(const NodeGrid<double>& field, const Edge& e) {
        return (field[e.low] < 0.0) == e.low_inside && (field[e.high] < 0.0) == e.high_inside;
    }
    // Returns where a field crosses zero on an edge, from 0 to 1; 0.5 where the field's signs are not those of the
    // edge.
    [[nodiscard]] static double crossing(const NodeGrid<double>& field, const Edge& e) {
        return has_signs_of(field, e) ? field[e.low] / (field[e.low] - field[e.high]) : 0.5;
    }

    [[nodiscard]] static Vec3 gradient(const NodeGrid<double>& field, const Edge& e, double share) {
        Vec3 sum(0.0);
        for (std::size_t a = 0; a < 3; ++a) {
            const auto slope = [&](const Node& n) {
                Node below = n, above = n;
                --below[a];
                ++above[a];
                return 0.5 * (field[above] - field[below]);
            };
            sum[static_cast<int>(a)] = (1.0 - share) * slope(e.low) + share * slope(e.high);
        }
        return sum;
    }

    void append_edge(const Edge& e, RayEnds held, bool held_low_inside, const NodeGrid<Nearest>& nearest,
                     const NodeGrid<double>& before, const NodeGrid<double>& after, std::vector<DexelEnd>& to) const {
        const bool crossed = e.low_inside != e.high_inside;
        const bool same_way = held_low_inside == e.low_inside;
        if (same_way && (held.size() % 2 != 0) == crossed && held.size() != 1) {  // no ends, or slivers
            to.insert(to.end(), held.begin(), held.end());
            return;
        }
        if (!crossed) return;
        const int bottom = e.low[static_cast<std::size_t>(e.axis)] * kUnitsPerCell;
        const double share = crossing(after, e);
        const auto clamped = [&](double units) {
            return bottom + static_cast<int>(std::clamp(std::floor(units + 0.5), 1.0, double(kUnitsPerCell)));
        };
        if (held.size() != 1 || !same_way || !has_signs_of(before, e)) {
            const Nearest& near = nearest[nearest[e.low].distance2 <= nearest[e.high].distance2 ? e.low : e.high];
            const Vec3 normal = gradient(after, e, share);
            to.push_back(shared::make_end(clamped(share * kUnitsPerCell),
                                          near.distance2 < 1e200 ? near.material : ball_.material,
                                          normal_code(normal)));
            return;
        }
        const DexelEnd& old = held.front();
        const double old_share = crossing(before, e);
        const Vec3 turn = gradient(after, e, share) - gradient(before, e, old_share);
        const bool turns = glm::dot(turn, turn) > 1e-12;
        to.push_back(shared::make_end(clamped(depth_of(old) - bottom + (share - old_share) * kUnitsPerCell),
                                      material_of(old), turns ? normal_code(decoded(old.normal) + turn) : old.normal));
    }

    const Solid& solid_;
    const Lattice& lattice_;
    const SmoothBall& ball_;
    WorkerPool& pool_;
    Vec3 start_{0.0}, along_{0.0};  // in cells
    double radius_ = 0.0;
    Node lo_{}, hi_{};  // range of the nodes that may have weight
};

}  // namespace

RayBatch smoothed_rays(const Solid& solid, const SmoothBall& ball, WorkerPool& pool) {
    return Smoother(solid, ball, pool).run();
}

}  // namespace burin::compute
