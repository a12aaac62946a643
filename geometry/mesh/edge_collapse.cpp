// SPDX-License-Identifier: MIT
#include "geometry/mesh/edge_collapse.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>

namespace burin::geometry {
namespace {

// The quadric of area-weighted planes (Garland and Heckbert), about an origin near the mesh to avoid cancellation.
struct Quadric {
    std::array<double, 6> a{};  // xx xy xz yy yz zz
    Vec3 b{0.0};
    double c = 0.0;

    void add_plane(const Vec3& normal, double offset, double weight) {
        const std::array<double, 6> products{normal.x * normal.x, normal.x * normal.y, normal.x * normal.z,
                                             normal.y * normal.y, normal.y * normal.z, normal.z * normal.z};
        for (std::size_t i = 0; i < 6; ++i) a[i] += weight * products[i];
        b += normal * (offset * weight);
        c += weight * offset * offset;
    }
    void add(const Quadric& other) {
        for (std::size_t i = 0; i < 6; ++i) a[i] += other.a[i];
        b += other.b;
        c += other.c;
    }
    [[nodiscard]] double at(const Vec3& p) const {
        const double squares = p.x * p.x * a[0] + p.y * p.y * a[3] + p.z * p.z * a[5];
        const double mixed = p.x * p.y * a[1] + p.x * p.z * a[2] + p.y * p.z * a[4];
        return std::max(0.0, squares + 2.0 * mixed + 2.0 * glm::dot(b, p) + c);
    }
};

struct Step {
    double cost;
    std::uint32_t vertex, target;
    std::uint32_t stamp;  // the vertex' stamp when the step was listed; a step with an older stamp is void
};
// Orders the heap by cost, cheapest on top; ties by index, so that the result does not depend on the heap.
struct Dearer {
    bool operator()(const Step& a, const Step& b) const {
        if (a.cost != b.cost) return a.cost > b.cost;
        return a.vertex != b.vertex ? a.vertex > b.vertex : a.target > b.target;
    }
};

// A fan about to be replaced: ring[0] is the vertex' target; old_fan[i] is the triangle (vertex, ring[i], ring[i + 1]).
struct Fan {
    std::vector<std::uint32_t> ring;
    std::vector<std::uint32_t> old_fan;
};

struct Change {
    double motion_m = 0.0, colour = 0.0;  // the largest over all points
};

class Collapser {
public:
    Collapser(CollapseState& state, double bound_m)
        : state_(state), mesh_(state.mesh), bound_m_(bound_m), fans_(mesh_.positions_m.size()), stamps_(fans_.size()) {
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            for (const std::uint32_t v : mesh_.triangles[t]) fans_[v].push_back(t);
        }
        if (!mesh_.triangles.empty()) origin_m_ = mesh_.positions_m[mesh_.triangles[0][0]];
        make_quadrics();
    }

    std::size_t run(const std::function<void(double)>& show) {
        for (std::uint32_t v = 0; v < fans_.size(); ++v) list_next(v, -1.0, 0);
        std::size_t gone = 0, looked_at = 0;
        while (!steps_.empty()) {
            const Step step = steps_.top();
            steps_.pop();
            if (step.stamp != stamps_[step.vertex]) continue;
            if (++looked_at % 4096 == 0) show(static_cast<double>(gone) / static_cast<double>(fans_.size()));
            if (collapse(step)) {
                ++gone;
            } else {
                list_next(step.vertex, step.cost, step.target);
            }
        }
        compact();
        return gone;
    }

private:
    [[nodiscard]] const Vec3& at(std::uint32_t v) const { return mesh_.positions_m[v]; }

    void make_quadrics() {
        quadrics_.resize(fans_.size());
        for (const VertexTriple& t : mesh_.triangles) {
            const Vec3 a = at(t[0]) - origin_m_;
            const Vec3 cross = glm::cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
            const double twice_area = glm::length(cross);
            if (!(twice_area > 0.0)) continue;
            const Vec3 normal = cross / twice_area;
            for (const std::uint32_t v : t) quadrics_[v].add_plane(normal, -glm::dot(normal, a), twice_area / 6.0);
        }
    }
    // Prefers short edges where the quadrics are 0, in a plane: that keeps the triangles well shaped.
    [[nodiscard]] double cost(std::uint32_t v, std::uint32_t target) const {
        const Vec3 edge = at(target) - at(v), p = at(target) - origin_m_;
        const double length2 = glm::dot(edge, edge);
        return quadrics_[v].at(p) + quadrics_[target].at(p) + 1e-6 * length2 * length2;
    }
    // Lists the vertex' cheapest step that costs more than the refused one.
    void list_next(std::uint32_t v, double refused_cost, std::uint32_t refused) {
        if (state_.kept[v]) return;
        Step best{std::numeric_limits<double>::infinity(), v, v, stamps_[v]};
        for (const std::uint32_t t : fans_[v]) {
            for (const std::uint32_t w : mesh_.triangles[t]) {
                if (w == v) continue;
                const double c = cost(v, w);
                if (c < refused_cost || (c == refused_cost && w <= refused)) continue;
                if (c < best.cost || (c == best.cost && w < best.target)) best.cost = c, best.target = w;
            }
        }
        if (best.target != v) steps_.push(best);
    }

    bool collapse(const Step& step) {
        const std::optional<Fan> fan = fan_around(step.vertex, step.target);
        if (!fan || !keeps_topology(*fan)) return false;
        double moved_m = 0.0, colour = 0.0;
        for (const std::uint32_t t : fan->old_fan) {
            moved_m = std::max(moved_m, state_.moved_m[t]);
            colour = std::max(colour, state_.colour_change[t]);
        }
        const std::optional<Change> change =
            change_by(step.vertex, *fan, {bound_m_ - moved_m, kMostColourChange - colour});
        if (!change) return false;
        moved_m += change->motion_m;
        colour += change->colour;
        if (!(moved_m <= bound_m_ && colour <= kMostColourChange)) return false;
        replace(step.vertex, *fan, moved_m, colour);
        return true;
    }

    // Returns the fan of triangles around the vertex; nothing when they do not form one closed fan.
    [[nodiscard]] std::optional<Fan> fan_around(std::uint32_t v, std::uint32_t target) const {
        const std::vector<std::uint32_t>& around = fans_[v];
        Fan fan;
        std::uint32_t rim = target;
        do {
            std::uint32_t next = v;
            for (const std::uint32_t t : around) {
                const VertexTriple& c = mesh_.triangles[t];
                const std::size_t k = c[0] == v ? 0u : c[1] == v ? 1u : 2u;
                if (c[(k + 1) % 3] != rim) continue;
                if (next != v) return std::nullopt;  // two triangles leave by one edge
                next = c[(k + 2) % 3];
                fan.old_fan.push_back(t);
            }
            if (next == v || fan.old_fan.size() > around.size()) return std::nullopt;
            fan.ring.push_back(rim);
            rim = next;
        } while (rim != target);
        if (fan.ring.size() != around.size() || fan.ring.size() < 3) return std::nullopt;
        return fan;
    }

    // Tests the link condition: the two ends of the edge have no common neighbours but the two beside it, and each of
    // those keeps more than two triangles.
    [[nodiscard]] bool keeps_topology(const Fan& fan) const {
        const std::uint32_t target = fan.ring.front(), left = fan.ring[1], right = fan.ring.back();
        if (fans_[left].size() < 4 || fans_[right].size() < 4) return false;
        if (fans_[target].size() + fan.ring.size() > kMostSpokes) return false;
        for (const std::uint32_t t : fans_[target]) {
            for (const std::uint32_t w : mesh_.triangles[t]) {
                if (w == target || w == left || w == right) continue;
                if (std::ranges::find(fan.ring, w) != fan.ring.end()) return false;
            }
        }
        return true;
    }

    [[nodiscard]] Vec3 colour(std::uint32_t v) const {
        if (mesh_.colours.empty()) return Vec3(0.0);
        const auto [red, green, blue] = mesh_.colours[v];
        return {red, green, blue};
    }

    // A point on one of the fans, with its colour.
    struct Place {
        Vec3 point_m;
        Vec3 colour;
    };
    [[nodiscard]] Place between(std::uint32_t a, std::uint32_t b, double share) const {
        return {glm::mix(at(a), at(b), share), glm::mix(colour(a), colour(b), share)};
    }
    static void compare(const Place& a, const Place& b, Change& change) {
        const Vec3 colours = glm::abs(a.colour - b.colour);
        change.motion_m = std::max(change.motion_m, glm::length(a.point_m - b.point_m));
        change.colour = std::max({change.colour, colours.x, colours.y, colours.z});
    }

    // Returns the largest motion and change of colour; nothing when the fans cannot be mapped onto each other or a
    // limit in `most` is exceeded.
    [[nodiscard]] std::optional<Change> change_by(std::uint32_t v, const Fan& fan, const Change& most) const {
        const auto too_much = [&](const Change& c) { return c.motion_m > most.motion_m || c.colour > most.colour; };
        const std::vector<std::uint32_t>& ring = fan.ring;
        const std::size_t n = ring.size();
        const std::uint32_t u = ring[0];
        // Twice the area vector of the ring, the same for every surface that fills it.
        Vec3 normal(0.0);
        for (std::size_t i = 0; i < n; ++i) normal += glm::cross(at(ring[i]) - at(v), at(ring[(i + 1) % n]) - at(v));
        const auto faces_outwards = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            const Vec3 cross = glm::cross(at(b) - at(a), at(c) - at(a));
            return glm::dot(cross, normal) >
                   kLeastCosine * std::sqrt(glm::dot(cross, cross) * glm::dot(normal, normal));
        };
        for (std::size_t i = 0; i < n; ++i) {
            if (!faces_outwards(v, ring[i], ring[(i + 1) % n])) return std::nullopt;
        }
        for (std::size_t i = 1; i + 1 < n; ++i) {
            if (!faces_outwards(u, ring[i], ring[i + 1])) return std::nullopt;
        }

        Change change;
        if (!compare_vertex(v, ring, normal, change) || !keep_materials(v, fan, change)) return std::nullopt;
        if (too_much(change)) return std::nullopt;
        // Compares the fans where old spokes v - ring[j] cross new ones u - ring[i].
        for (std::size_t i = 2; i + 1 < n; ++i) {
            const Vec3 new_spoke = at(ring[i]) - at(u);
            for (std::size_t j = 1; j < n; ++j) {
                if (j == i) continue;
                const Vec3 old_spoke = at(ring[j]) - at(v), start = at(v) - at(u);
                const double parallel = glm::dot(glm::cross(new_spoke, old_spoke), normal);
                const double along_new = glm::dot(glm::cross(start, old_spoke), normal) / parallel;
                const double along_old = glm::dot(glm::cross(start, new_spoke), normal) / parallel;
                constexpr double kSlack = 1e-9;
                // true for NaN too, where parallel is 0
                if (!(along_new >= -kSlack && along_new <= 1.0 + kSlack)) continue;
                if (!(along_old >= -kSlack && along_old <= 1.0 + kSlack)) continue;
                compare(between(u, ring[i], along_new), between(v, ring[j], along_old), change);
                if (too_much(change)) return std::nullopt;
            }
        }
        return change;
    }

    // Compares the vertex with the point of the new fan below or above it; false when there is none.
    [[nodiscard]] bool compare_vertex(std::uint32_t v, const std::vector<std::uint32_t>& ring, const Vec3& normal,
                                      Change& change) const {
        const std::uint32_t u = ring[0];
        double best = -std::numeric_limits<double>::infinity();
        Place best_place{};
        for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
            const std::array<std::uint32_t, 3> corner{u, ring[i], ring[i + 1]};
            std::array<double, 3> weight{};
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 &a = at(corner[(k + 1) % 3]), &b = at(corner[(k + 2) % 3]);
                weight[k] = glm::dot(glm::cross(a - at(v), b - at(v)), normal);
            }
            const double whole = weight[0] + weight[1] + weight[2];
            const double inside = std::min({weight[0], weight[1], weight[2]}) / whole;
            if (!(inside > best)) continue;
            best = inside;
            best_place = {Vec3(0.0), Vec3(0.0)};
            for (std::size_t k = 0; k < 3; ++k) {
                best_place.point_m += (at(corner[k]) - at(v)) * (weight[k] / whole);
                best_place.colour += colour(corner[k]) * (weight[k] / whole);
            }
            best_place.point_m += at(v);
        }
        if (!(best > -1e-9)) return false;  // the vertex lies outside the new fan
        compare(best_place, {at(v), colour(v)}, change);
        return true;
    }

    // A vertex on the border of two materials may only move along the border, which then is an edge of the new fan.
    [[nodiscard]] bool keep_materials(std::uint32_t v, const Fan& fan, Change& change) const {
        if (mesh_.triangle_materials.empty()) return true;
        const std::size_t n = fan.ring.size();
        const auto material = [&](std::size_t i) { return mesh_.triangle_materials[fan.old_fan[i]]; };
        std::size_t borders = 0, other = 0;
        bool at_target = false;
        for (std::size_t i = 0; i < n; ++i) {
            if (material(i) == material((i + n - 1) % n)) continue;
            ++borders;
            if (i == 0)
                at_target = true;
            else
                other = i;
        }
        if (borders == 0) return true;
        if (borders != 2 || !at_target || other < 2 || other + 1 >= n) return false;
        const Vec3 &a = at(fan.ring[0]), &b = at(fan.ring[other]);
        const double share = glm::dot(at(v) - a, b - a) / glm::dot(b - a, b - a);
        if (!(share >= 0.0 && share <= 1.0)) return false;
        change.motion_m = std::max(change.motion_m, glm::length(a + (b - a) * share - at(v)));
        return true;
    }

    void replace(std::uint32_t v, const Fan& fan, double moved_m, double colour_change) {
        const std::vector<std::uint32_t>& ring = fan.ring;
        const std::uint32_t u = ring[0], first = fan.old_fan.front(), last = fan.old_fan.back();
        // The two triangles at the edge vanish; the others keep their other corners and their material.
        std::erase(fans_[u], first);
        std::erase(fans_[u], last);
        std::erase(fans_[ring[1]], first);
        std::erase(fans_[ring.back()], last);
        mesh_.triangles[first] = mesh_.triangles[last] = {0, 0, 0};
        for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
            const std::uint32_t t = fan.old_fan[i];
            mesh_.triangles[t] = {u, ring[i], ring[i + 1]};
            state_.moved_m[t] = moved_m;
            state_.colour_change[t] = colour_change;
            fans_[u].push_back(t);
        }
        fans_[v].clear();
        ++stamps_[v];
        quadrics_[u].add(quadrics_[v]);
        for (const std::uint32_t w : ring) {
            ++stamps_[w];
            list_next(w, -1.0, 0);
        }
    }

    void compact() {
        std::vector<std::uint32_t> index(fans_.size());
        CollapseState now;
        now.mesh.materials = mesh_.materials;
        for (std::uint32_t v = 0; v < fans_.size(); ++v) {
            if (fans_[v].empty()) continue;
            index[v] = static_cast<std::uint32_t>(now.mesh.positions_m.size());
            now.mesh.positions_m.push_back(mesh_.positions_m[v]);
            if (!mesh_.colours.empty()) now.mesh.colours.push_back(mesh_.colours[v]);
            now.first_vertex.push_back(state_.first_vertex[v]);
            now.kept.push_back(state_.kept[v]);
        }
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            const auto [a, b, c] = mesh_.triangles[t];
            if (a == b && b == c) continue;
            now.mesh.triangles.push_back({index[a], index[b], index[c]});
            if (!mesh_.triangle_materials.empty()) now.mesh.triangle_materials.push_back(mesh_.triangle_materials[t]);
            now.moved_m.push_back(state_.moved_m[t]);
            now.colour_change.push_back(state_.colour_change[t]);
        }
        state_ = std::move(now);
    }

    // Limits the triangles at a vertex, since a vertex with many makes every step beside it expensive.
    static constexpr std::size_t kMostSpokes = 48;
    // Limits the slope of mapped triangles: rounding could flip steeper ones.
    static constexpr double kLeastCosine = 1e-3;

    CollapseState& state_;
    TriangleMesh& mesh_;
    const double bound_m_;
    Vec3 origin_m_{0.0};
    std::vector<std::vector<std::uint32_t>> fans_;
    std::vector<std::uint32_t> stamps_;
    std::vector<Quadric> quadrics_;
    std::priority_queue<Step, std::vector<Step>, Dearer> steps_;
};

}  // namespace

std::size_t collapse_edges(CollapseState& state, double bound_m, const std::function<void(double)>& show) {
    return Collapser(state, bound_m).run(show);
}

}  // namespace burin::geometry
