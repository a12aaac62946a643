// SPDX-License-Identifier: MIT
#include "compute/mend_intersections.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "compute/self_intersections.hpp"
#include "geometry/triangle_contact.hpp"
#include "geometry/triangle_tree.hpp"
#include "shaders/shared/octahedral.h"

namespace burin {
namespace {

constexpr int kRounds = 14;
constexpr int kMostRings = 5;  // of neighbours that are moved at once
// An attempt takes a millisecond or two where everything is at fault; what random noise has beyond this is left and counted.
constexpr std::uint64_t kMostAttempts = 20000;
// A vertex that is moved keeps off its cell's faces by this much, so that vertices of two cells do not come to one place.
constexpr double kInset = 1.0 / 256.0;
constexpr int kFirstFaceSlot = 4;  // of a key (tile_mesher.hpp): two slots for each of the cell's lower faces
// A turned diagonal changes the surface by the gap between the diagonals; in cells.
constexpr double kMostGap = 0.1;
// A vertex nearer to a plane than this, in cells, was placed on it.
constexpr double kOwnPlane = 0.5;
constexpr std::array kShares{0.125, 0.25, 0.5, 0.75, 1.0};

// What a remedy may cost in accuracy, in cells: little at first, and anything rather than a fault in the end.
double most_deviation(int round) {
    constexpr std::array kMost{0.05, 0.1, 0.1, 0.1, 0.2, 0.4};
    return static_cast<std::size_t>(round) < kMost.size() ? kMost[static_cast<std::size_t>(round)] : 2.0;
}
constexpr int kAnywhere = 5;  // from this round on a vertex may go to any part of its cell
constexpr int kCureOnly = 2;  // rounds in which a remedy must leave no fault behind

// The triangles around each vertex: those of the start in one array, changed fans beside it.
class Fans {
public:
    explicit Fans(const TriangleMesh& mesh)
        : first_(mesh.positions_m.size() + 1), triangles_(mesh.triangles.size() * 3) {
        for (const VertexTriple& t : mesh.triangles) {
            for (const std::uint32_t v : t) ++first_[v + 1];
        }
        for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            for (const std::uint32_t v : mesh.triangles[t]) triangles_[next[v]++] = t;
        }
    }
    [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t vertex) const {
        const auto changed = changed_.find(vertex);
        if (changed != changed_.end()) return changed->second;
        return std::span(triangles_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
    }
    void add(std::uint32_t vertex, std::uint32_t triangle) {
        std::vector<std::uint32_t>& fan = own(vertex);
        fan.insert(std::ranges::lower_bound(fan, triangle), triangle);
    }
    void remove(std::uint32_t vertex, std::uint32_t triangle) { std::erase(own(vertex), triangle); }

private:
    std::vector<std::uint32_t>& own(std::uint32_t vertex) {
        const std::span<const std::uint32_t> now = of(vertex);
        return changed_.try_emplace(vertex, now.begin(), now.end()).first->second;
    }
    std::vector<std::uint32_t> first_, triangles_;
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> changed_;
};

void sort_unique(std::vector<std::uint32_t>& list) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

// What a remedy changes; applied by exchanging it with the mesh, and undone by doing so again.
struct Remedy {
    std::vector<std::pair<std::uint32_t, Vec3>> places;
    std::vector<std::pair<std::uint32_t, VertexTriple>> triangles;
    double deviation_m = 0.0;
};

// Of the welded vertices: they are sorted by key, one for each.
std::vector<std::uint64_t> keys_of(const Surface& surface) {
    std::vector<std::uint64_t> keys;
    for (std::uint32_t t = 0; t < surface.tile_count(); ++t) {
        const std::vector<std::uint64_t> of_tile =
            vertex_keys(surface.lattice(), surface.grid().first_node(t), surface.tile(t));
        keys.insert(keys.end(), of_tile.begin(), of_tile.end());
    }
    std::ranges::sort(keys);
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    return keys;
}

struct TangentPlane {
    Vec3 point_m, normal;
};

class Mender {
public:
    Mender(TriangleMesh& mesh, const Surface& surface, const Solid& solid)
        : mesh_(mesh),
          solid_(solid),
          lattice_(solid.lattice),
          shift_(solid.lattice.fits_floats() ? Vec3(0.0) : solid.lattice.origin_object),
          before_(mesh.positions_m),
          triangles_before_(mesh.triangles),
          keys_(keys_of(surface)),
          fans_(mesh),
          tree_(before_, triangles_before_) {}

    // One attempt at each pair. Returns the pairs there are afterwards, in ascending order.
    std::vector<TrianglePair> treat(const std::vector<TrianglePair>& pairs, int round) {
        changed_.clear();
        for (const TrianglePair& pair : pairs) {
            if (attempts_ < kMostAttempts && meet(pair[0], pair[1])) treat(pair, round), ++attempts_;
        }
        sort_unique(changed_);
        // Pairs without a changed triangle are as before.
        std::vector<TrianglePair> now;
        const auto is_changed = [&](std::uint32_t t) { return std::ranges::binary_search(changed_, t); };
        for (const TrianglePair& pair : pairs) {
            if (!is_changed(pair[0]) && !is_changed(pair[1])) now.push_back(pair);
        }
        for_each_fault(changed_, [&](const TrianglePair& pair) {
            now.push_back(pair);
            return true;
        });
        std::ranges::sort(now);
        return now;
    }
    void report(MendingReport& report) {
        sort_unique(moved_);
        report.vertices_moved = moved_.size();
        report.moved = moved_;
        report.diagonals_turned = turned_;
        report.deviation_max_m = deviation_m_;
    }

private:
    [[nodiscard]] bool meet(std::uint32_t a, std::uint32_t b) const {
        return meet_beyond_shared(mesh_.positions_m, mesh_.triangles[a], mesh_.triangles[b]);
    }

    void treat(const TrianglePair& pair, int round) {
        std::vector<Remedy> remedies = remedies_for(pair, round);
        const double allowed_m = most_deviation(round) * lattice_.spacing_m;
        std::erase_if(remedies, [&](Remedy& r) {
            exchange(r);
            r.deviation_m = deviation(r);
            exchange(r);
            return r.deviation_m > allowed_m;
        });
        // The first that cures, from the mildest on; in the later rounds else the one that leaves least.
        std::ranges::stable_sort(remedies, {}, &Remedy::deviation_m);
        Remedy* best = nullptr;
        std::size_t best_left = std::numeric_limits<std::size_t>::max();
        for (Remedy& r : remedies) {
            const std::size_t left = left_after(r, pair, round < kCureOnly ? 1 : best_left);
            if (left < best_left) best = &r, best_left = left;
            if (best_left == 0) break;
        }
        if (best != nullptr && (best_left == 0 || round >= kCureOnly)) take(*best);
    }

    [[nodiscard]] std::vector<Remedy> remedies_for(const TrianglePair& pair, int round) const {
        std::vector<Remedy> remedies;
        const auto add = [&](Remedy&& r) {
            if (!r.places.empty() || !r.triangles.empty()) remedies.push_back(std::move(r));
        };
        std::vector<std::uint32_t> vertices;
        for (const std::uint32_t t : pair) {
            for (std::size_t k = 0; k < 3; ++k) {
                vertices.push_back(mesh_.triangles[t][k]);
                add(turned_diagonal(t, k, round < kAnywhere ? kMostGap : 1.0));
            }
        }
        sort_unique(vertices);
        for (const std::uint32_t v : vertices) {
            for (const double share : kShares) add(towards_neighbours({&v, 1}, share));
            for (const double share : kShares) add(homewards({&v, 1}, share));
            // Along an edge of the mesh a vertex stays on the surface, or on the crease that the edge follows.
            for (const std::uint32_t w : neighbours(v)) {
                for (const double share : kShares) add(along_edge(v, w, share));
            }
        }
        for (int i = 0; round >= kAnywhere && i < 27; ++i) {
            const Vec3 shares = Vec3(i % 3, i / 3 % 3, i / 9) * 0.4 + 0.1;
            for (const std::uint32_t v : vertices) add(within_cells({&v, 1}, shares));
        }
        // From the second round on several vertices at once, then their neighbours too, and so on.
        for (int ring = 1; ring <= std::min(round, kMostRings); ++ring) {
            for (const double share : kShares) add(towards_neighbours(vertices, share));
            for (const double share : kShares) add(homewards(vertices, share));
            if (round >= kAnywhere) add(within_cells(vertices, Vec3(0.5)));
            add_neighbours(vertices);
        }
        return remedies;
    }

    // How many faults a remedy leaves where it changes something, counted up to `enough`; no number when it does not part
    // the pair or leaves no fewer than there were.
    [[nodiscard]] std::size_t left_after(Remedy& remedy, const TrianglePair& pair, std::size_t enough) {
        constexpr std::size_t kNoGood = std::numeric_limits<std::size_t>::max();
        exchange(remedy);
        std::size_t left = kNoGood;
        std::vector<std::uint32_t> touched;
        if (!meet(pair[0], pair[1])) {
            touched = triangles_of(remedy);
            left = faults_at(touched, enough);
            if (left >= enough) left = kNoGood;
        }
        exchange(remedy);
        if (left != kNoGood && left > 0 && faults_at(touched, left + 1) <= left) left = kNoGood;
        return left;
    }

    // Calls visit(pair) for each fault in which one of the triangles (in ascending order) takes part, until it returns false.
    template <typename Visit>
    void for_each_fault(std::span<const std::uint32_t> touched, Visit&& visit) const {
        double reach_m = reach_m_;
        for (const std::uint32_t t : touched) reach_m = std::max(reach_m, strayed(t));
        bool go_on = true;
        for (std::size_t i = 0; i < touched.size() && go_on; ++i) {
            const std::uint32_t t = touched[i];
            Box box = box_of(t);
            const TreeBox exact = tree_.box_of(box);
            box.lo -= reach_m;
            box.hi += reach_m;
            tree_.for_each_meeting(tree_.box_of(box), 0, [&](std::size_t place) {
                const std::uint32_t other = tree_.triangle_at(place);
                // Of two touched triangles the lower one finds the pair.
                if (!go_on || other == t || (other < t && std::ranges::binary_search(touched, other))) return;
                if (!tree_.box_of(box_of(other)).meets(exact) || !meet(t, other)) return;
                go_on = visit(TrianglePair{std::min(t, other), std::max(t, other)});
            });
        }
    }
    [[nodiscard]] std::size_t faults_at(std::span<const std::uint32_t> touched, std::size_t enough) const {
        std::size_t count = 0;
        for_each_fault(touched, [&](const TrianglePair&) { return ++count < enough; });
        return count;
    }
    // By how much a triangle's box sticks out of the one it had when the tree was made.
    [[nodiscard]] double strayed(std::uint32_t t) const {
        Box first;
        for (const std::uint32_t v : triangles_before_[t]) first.include(before_[v]);
        const Box now = box_of(t);
        const Vec3 out = glm::max(first.lo - now.lo, now.hi - first.hi);
        return std::max({out.x, out.y, out.z});
    }
    [[nodiscard]] Box box_of(std::uint32_t t) const {
        Box box;
        for (const Vec3& p : corners(t)) box.include(p);
        return box;
    }

    // The two triangles at the edge from corner k of t, with the edge between their other corners instead.
    [[nodiscard]] Remedy turned_diagonal(std::uint32_t t, std::size_t k, double most_gap_cells) const {
        const std::uint32_t u = mesh_.triangles[t][k], v = mesh_.triangles[t][(k + 1) % 3],
                            a = mesh_.triangles[t][(k + 2) % 3];
        std::uint32_t other = t, b = a;
        for (const std::uint32_t candidate : fans_.of(u)) {
            const VertexTriple& c = mesh_.triangles[candidate];
            for (std::size_t i = 0; i < 3; ++i) {
                if (c[i] == v && c[(i + 1) % 3] == u) other = candidate, b = c[(i + 2) % 3];
            }
        }
        if (other == t || a == b || fans_.of(u).size() < 4 || fans_.of(v).size() < 4) return {};
        for (const std::uint32_t near_a : fans_.of(a)) {
            if (std::ranges::find(mesh_.triangles[near_a], b) != mesh_.triangles[near_a].end()) return {};
        }
        const Vec3 &pu = mesh_.positions_m[u], &pv = mesh_.positions_m[v], &pa = mesh_.positions_m[a],
                   &pb = mesh_.positions_m[b];
        const Vec3 across = glm::cross(pv - pu, pb - pa);
        const double length = glm::length(across);
        if (!(std::abs(glm::dot(across, pa - pu)) <= most_gap_cells * lattice_.spacing_m * length)) return {};
        const Vec3 normal = glm::cross(pv - pu, pa - pu) + glm::cross(pb - pu, pv - pu);
        if (!(glm::dot(glm::cross(pu - pa, pb - pa), normal) > 0.0 &&
              glm::dot(glm::cross(pv - pb, pa - pb), normal) > 0.0)) {
            return {};  // it would fold over
        }
        return {{}, {{t, {a, u, b}}, {other, {b, v, a}}}, 0.0};
    }

    // Each vertex towards the middle of its neighbours.
    [[nodiscard]] Remedy towards_neighbours(std::span<const std::uint32_t> vertices, double share) const {
        Remedy remedy;
        for (const std::uint32_t v : vertices) {
            Vec3 sum(0.0);
            const std::vector<std::uint32_t> around = neighbours(v);
            for (const std::uint32_t w : around) sum += mesh_.positions_m[w];
            move(v, sum / static_cast<double>(around.size()), share, remedy);
        }
        return remedy;
    }
    [[nodiscard]] Remedy along_edge(std::uint32_t v, std::uint32_t w, double share) const {
        Remedy remedy;
        move(v, mesh_.positions_m[w], share, remedy);
        return remedy;
    }
    void move(std::uint32_t v, const Vec3& target, double share, Remedy& remedy) const {
        const Vec3& old = mesh_.positions_m[v];
        const Vec3 place = allowed(v, old + (target - old) * share);
        if (place != old) remedy.places.emplace_back(v, place);
    }

    [[nodiscard]] std::vector<std::uint32_t> neighbours(std::uint32_t v) const {
        std::vector<std::uint32_t> around;
        for (const std::uint32_t t : fans_.of(v)) {
            for (const std::uint32_t w : mesh_.triangles[t]) {
                if (w != v) around.push_back(w);
            }
        }
        sort_unique(around);
        return around;
    }

    // The point nearest to p that a vertex may have, in numbers as the mesh has them: within its cell, or on the way back
    // there. What lies on a face stays there.
    [[nodiscard]] Vec3 allowed(std::uint32_t v, const Vec3& p) const {
        const Vec3& old = mesh_.positions_m[v];
        Vec3 place = old;
        const Box home = home_of(v);
        const int slot = static_cast<int>(keys_[v] % 16);
        for (int k = 0; k < 3; ++k) {
            if (slot >= kFirstFaceSlot && (slot - kFirstFaceSlot) / 2 == k) continue;
            const double within = std::clamp(p[k], std::min(home.lo[k], old[k]), std::max(home.hi[k], old[k]));
            place[k] = shift_[k] + static_cast<double>(static_cast<float>(within - shift_[k]));
        }
        return place;
    }
    // The box that the vertex' cell leaves to it, by its name.
    [[nodiscard]] Box home_of(std::uint32_t v) const {
        Box home{Vec3(0.0), Vec3(0.0)};
        std::uint64_t cell = keys_[v] / 16;
        for (int k = 0; k < 3; ++k) {
            const auto along = static_cast<std::uint64_t>(lattice_.cells[static_cast<std::size_t>(k)] + 2);
            const double lower_cells = static_cast<double>(cell % along) - 1.0;
            cell /= along;
            home.lo[k] = lattice_.origin_object[k] + (lower_cells + kInset) * lattice_.spacing_m;
            home.hi[k] = lattice_.origin_object[k] + (lower_cells + 1.0 - kInset) * lattice_.spacing_m;
        }
        return home;
    }
    // Back to where the cell begins, for what the mesher put beside its cell.
    [[nodiscard]] Remedy homewards(std::span<const std::uint32_t> vertices, double share) const {
        Remedy remedy;
        for (const std::uint32_t v : vertices) {
            const Box home = home_of(v);
            move(v, glm::clamp(mesh_.positions_m[v], home.lo, home.hi), share, remedy);
        }
        return remedy;
    }
    // To one place in each cell, in shares of its width: all in the middle, the surface is made of whole squares.
    [[nodiscard]] Remedy within_cells(std::span<const std::uint32_t> vertices, const Vec3& shares) const {
        Remedy remedy;
        for (const std::uint32_t v : vertices) {
            const Box home = home_of(v);
            move(v, home.lo + home.extent() * shares, 1.0, remedy);
        }
        return remedy;
    }

    void add_neighbours(std::vector<std::uint32_t>& vertices) const {
        std::vector<std::uint32_t> more;
        for (const std::uint32_t v : vertices) {
            for (const std::uint32_t t : fans_.of(v))
                more.insert(more.end(), mesh_.triangles[t].begin(), mesh_.triangles[t].end());
        }
        sort_unique(more);
        vertices = std::move(more);
    }

    void exchange(Remedy& remedy) {
        for (auto& [v, place] : remedy.places) std::swap(mesh_.positions_m[v], place);
        for (auto& [t, triangle] : remedy.triangles) std::swap(mesh_.triangles[t], triangle);
    }

    void take(Remedy& remedy) {
        const std::vector<std::uint32_t> touched = triangles_of(remedy);
        changed_.insert(changed_.end(), touched.begin(), touched.end());
        for (const auto& [t, triangle] : remedy.triangles) {
            for (const std::uint32_t v : mesh_.triangles[t]) fans_.remove(v, t);
        }
        exchange(remedy);
        for (const auto& [t, triangle] : remedy.triangles) {
            for (const std::uint32_t v : mesh_.triangles[t]) fans_.add(v, t);
        }
        for (const auto& [v, place] : remedy.places) moved_.push_back(v);
        for (const std::uint32_t t : touched) reach_m_ = std::max(reach_m_, strayed(t));
        turned_ += remedy.triangles.size() / 2;
        deviation_m_ = std::max(deviation_m_, remedy.deviation_m);
    }

    [[nodiscard]] std::vector<std::uint32_t> triangles_of(const Remedy& remedy) const {
        std::vector<std::uint32_t> touched;
        for (const auto& [t, triangle] : remedy.triangles) touched.push_back(t);
        for (const auto& [v, place] : remedy.places)
            touched.insert(touched.end(), fans_.of(v).begin(), fans_.of(v).end());
        sort_unique(touched);
        return touched;
    }
    [[nodiscard]] std::array<Vec3, 3> corners(std::uint32_t t) const {
        const auto [a, b, c] = mesh_.triangles[t];
        return {mesh_.positions_m[a], mesh_.positions_m[b], mesh_.positions_m[c]};
    }
    // With the remedy exchanged into the mesh: how much farther than at first its vertices are from the planes around. 0
    // for a turned diagonal, whose gap is small.
    [[nodiscard]] double deviation(const Remedy& exchanged) const {
        double worst = 0.0;
        for (const auto& [v, place] : exchanged.places) {
            for (const TangentPlane& plane : planes_at(v)) {
                const double at_first = std::abs(glm::dot(plane.normal, before_[v] - plane.point_m));
                const double now = std::abs(glm::dot(plane.normal, mesh_.positions_m[v] - plane.point_m));
                // What the vertex was far from belongs to another sheet, or to a feature that a cell cannot show.
                if (at_first < kOwnPlane * lattice_.spacing_m) worst = std::max(worst, now - at_first);
            }
        }
        return worst;
    }

    // Of the surface where rays cross it within a cell's width of the vertex, along each axis. Not only in the vertex' own
    // cell: a feature may lie in a cell that has no crossing.
    const std::vector<TangentPlane>& planes_at(std::uint32_t v) const {
        const auto [known, fresh] = planes_.try_emplace(v);
        if (!fresh) return known->second;
        const Vec3 cells = (before_[v] - lattice_.origin_object) / lattice_.spacing_m;
        for (int axis = 0; axis < 3; ++axis) {
            const double at_u = cells[(axis + 1) % 3], at_v = cells[(axis + 2) % 3];
            for (int ray_v = whole(at_v - 1.0) + 1; ray_v <= at_v + 1.0; ++ray_v) {
                for (int ray_u = whole(at_u - 1.0) + 1; ray_u <= at_u + 1.0; ++ray_u) {
                    add_crossings(axis, ray_u, ray_v, cells[axis], known->second);
                }
            }
        }
        return known->second;
    }
    [[nodiscard]] static int whole(double x) { return static_cast<int>(std::floor(x)); }
    void add_crossings(int axis, int u, int v, double at_cells, std::vector<TangentPlane>& planes) const {
        if (u < 0 || v < 0 || u >= lattice_.rays_u(axis) || v >= lattice_.rays_v(axis)) return;
        const std::size_t ray =
            static_cast<std::size_t>(v) * static_cast<std::size_t>(lattice_.rays_u(axis)) + static_cast<std::size_t>(u);
        for (const shared::DexelEnd& end : solid_.sets[static_cast<std::size_t>(axis)].ends(ray)) {
            const double depth = shared::depth_of(end);
            if (std::abs(depth - at_cells * shared::kUnitsPerCell) > shared::kUnitsPerCell) continue;
            Vec3 units;
            units[axis] = depth;
            units[(axis + 1) % 3] = static_cast<double>(u) * shared::kUnitsPerCell;
            units[(axis + 2) % 3] = static_cast<double>(v) * shared::kUnitsPerCell;
            const shared::Direction n = shared::decode_normal(end.normal);
            planes.push_back({lattice_.object_from_units(units), Vec3(n.x, n.y, n.z)});
        }
    }

    TriangleMesh& mesh_;
    const Solid& solid_;
    const Lattice& lattice_;
    const Vec3 shift_;  // what the mesh's floats are relative to (surface.cpp)
    const std::vector<Vec3> before_;
    const std::vector<VertexTriple> triangles_before_;
    const std::vector<std::uint64_t> keys_;  // of the vertices (tile_mesher.hpp)
    Fans fans_;
    TriangleTree tree_;
    double reach_m_ = 0.0;  // no triangle has strayed farther from where the tree has it
    double deviation_m_ = 0.0;
    std::uint64_t turned_ = 0, attempts_ = 0;
    mutable std::unordered_map<std::uint32_t, std::vector<TangentPlane>> planes_;  // of the vertices looked at
    std::vector<std::uint32_t> changed_, moved_;
};

}  // namespace

MendingReport mend_intersections(TriangleMesh& mesh, const Surface& surface, const Solid& solid, WorkerPool& pool) {
    MendingReport report;
    std::vector<TrianglePair> pairs = self_intersections(mesh, pool);
    report.found = report.left = pairs.size();
    if (pairs.empty()) return report;
    Mender mender(mesh, surface, solid);
    for (int round = 0; round < kRounds && !pairs.empty(); ++round) {
        pairs = mender.treat(pairs, round);
    }
    mender.report(report);
    report.left = pairs.size();
    return report;
}

}  // namespace burin
