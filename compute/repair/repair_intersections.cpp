// SPDX-License-Identifier: MIT
#include "compute/repair/self_intersections.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "compute/repair/remedies.hpp"
#include "geometry/mesh/distinct_positions.hpp"
#include "geometry/mesh/triangle_contact.hpp"
#include "geometry/mesh/triangle_tree.hpp"
#include "shaders/shared/octahedral.h"

namespace burin::compute {
namespace {

constexpr int kRounds = 14;
// An attempt takes one or two milliseconds where faults are dense; what random noise has beyond this is left and
// counted.
constexpr std::uint64_t kMostAttempts = 20000;
// A vertex nearer to a plane than this, in cells, is taken to have been placed on it.
constexpr double kOwnPlane = 0.5;

// Returns the largest deviation that a remedy may cause, in cells: little at first, and in the end rather a deviation
// than a fault.
double most_deviation(int round) {
    constexpr std::array kMost{0.05, 0.1, 0.1, 0.1, 0.2, 0.4};
    return static_cast<std::size_t>(round) < kMost.size() ? kMost[static_cast<std::size_t>(round)] : 2.0;
}
constexpr int kCureOnly = 2;  // number of first rounds in which a remedy must leave no fault behind

struct TangentPlane {
    Vec3 point, normal;
};

// Finds the tangent planes that a solid's rays give around the vertices of its mesh, and caches them by vertex; the
// deviation of a moved vertex is measured against them. Frame: the object frame; lengths in the mesh's unit. To be used
// from one thread.
class PlanesAround {
public:
    // Takes the vertices as they were meshed.
    PlanesAround(const Solid& solid, const Lattice& lattice, const std::vector<Vec3>& vertices)
        : solid_(solid), lattice_(lattice), vertices_(vertices) {}

    // Returns the tangent planes at the ends of rays within a cell's width of the vertex, along each axis. The search
    // is not limited to the vertex's own cell: a feature may lie in a cell that has no crossing.
    [[nodiscard]] const std::vector<TangentPlane>& at(std::uint32_t vertex);

private:
    void add_crossings(int axis, int u, int v, double at_cells, std::vector<TangentPlane>& planes) const;

    const Solid& solid_;
    const Lattice& lattice_;
    const std::vector<Vec3>& vertices_;
    std::unordered_map<std::uint32_t, std::vector<TangentPlane>> planes_;  // cache, by vertex
};

const std::vector<TangentPlane>& PlanesAround::at(std::uint32_t vertex) {
    const auto whole = [](double x) { return static_cast<int>(std::floor(x)); };
    const auto [known, fresh] = planes_.try_emplace(vertex);
    if (!fresh) return known->second;
    const Vec3 cells = (vertices_[vertex] - lattice_.origin_object) / lattice_.spacing_m;
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

void PlanesAround::add_crossings(int axis, int u, int v, double at_cells, std::vector<TangentPlane>& planes) const {
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

// Repairs one mesh. Lengths are in the mesh's unit.
class Repairer {
public:
    Repairer(geometry::TriangleMesh& mesh, const Surface& surface, const Solid& solid, LengthUnit unit)
        : mesh_(mesh),
          lattice_(in_unit(solid.lattice, unit)),
          before_(mesh.positions_m),
          triangles_before_(mesh.triangles),
          fans_(mesh),
          remedies_(mesh, fans_, surface, unit),
          planes_(solid, lattice_, before_),
          tree_(before_, triangles_before_) {}

    // Makes one attempt at each pair. Returns the pairs that intersect afterwards, in ascending order.
    std::vector<TrianglePair> treat(const std::vector<TrianglePair>& pairs, int round) {
        changed_.clear();
        for (const TrianglePair& pair : pairs) {
            if (attempts_ < kMostAttempts && meet(pair[0], pair[1])) treat(pair, round), ++attempts_;
        }
        sort_unique(changed_);
        // Pairs without a changed triangle still intersect.
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
    void report(RepairReport& report) {
        sort_unique(moved_);
        report.vertices_moved = moved_.size();
        report.moved = moved_;
        report.diagonals_turned = turned_;
        report.deviation_max_m = deviation_;
    }

private:
    [[nodiscard]] bool meet(std::uint32_t a, std::uint32_t b) const {
        return geometry::meet_beyond_shared(mesh_.positions_m, mesh_.triangles[a], mesh_.triangles[b]);
    }

    void treat(const TrianglePair& pair, int round) {
        std::vector<Remedy> remedies = remedies_.remedies_for(pair, round);
        const double allowed = most_deviation(round) * lattice_.spacing_m;
        std::erase_if(remedies, [&](Remedy& r) {
            exchange(r);
            r.deviation = deviation(r);
            exchange(r);
            return r.deviation > allowed;
        });
        // Takes the first remedy without a remaining fault, in order of deviation; in the later rounds otherwise the
        // one that leaves the fewest.
        std::ranges::stable_sort(remedies, {}, &Remedy::deviation);
        Remedy* best = nullptr;
        std::size_t best_left = std::numeric_limits<std::size_t>::max();
        for (Remedy& r : remedies) {
            const std::size_t left = left_after(r, pair, round < kCureOnly ? 1 : best_left);
            if (left < best_left) best = &r, best_left = left;
            if (best_left == 0) break;
        }
        if (best != nullptr && (best_left == 0 || round >= kCureOnly)) take(*best);
    }

    // Counts the faults that a remedy leaves among the triangles it changes, up to `enough`. Returns the largest number
    // (kNoGood) when the remedy does not separate the pair or leaves no fewer faults than before.
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

    // Calls visit(pair) for each fault that involves one of the given triangles (in ascending order), until it returns
    // false.
    template <typename Visit>
    void for_each_fault(std::span<const std::uint32_t> touched, Visit&& visit) const {
        double reach = reach_;
        for (const std::uint32_t t : touched) reach = std::max(reach, strayed(t));
        bool go_on = true;
        for (std::size_t i = 0; i < touched.size() && go_on; ++i) {
            const std::uint32_t t = touched[i];
            Box box = box_of(t);
            const geometry::TreeBox exact = tree_.box_of(box);
            box.lo -= reach;
            box.hi += reach;
            tree_.for_each_meeting(tree_.box_of(box), 0, [&](std::size_t place) {
                const std::uint32_t other = tree_.triangle_at(place);
                // Reports a pair of touched triangles once, from the one with the lower index.
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
    // Returns by how much a triangle's box extends beyond the one it had when the tree was built.
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
        for (const std::uint32_t t : touched) reach_ = std::max(reach_, strayed(t));
        turned_ += remedy.triangles.size() / 2;
        deviation_ = std::max(deviation_, remedy.deviation);
    }

    [[nodiscard]] std::vector<std::uint32_t> triangles_of(const Remedy& remedy) const {
        std::vector<std::uint32_t> touched;
        touched.reserve(remedy.triangles.size());
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
    // Returns how much farther than at first the remedy's vertices are from the planes around, with the remedy
    // exchanged into the mesh. 0 for a turned diagonal, whose gap is small.
    [[nodiscard]] double deviation(const Remedy& exchanged) const {
        double worst = 0.0;
        for (const auto& [v, place] : exchanged.places) {
            for (const TangentPlane& plane : planes_.at(v)) {
                const double at_first = std::abs(glm::dot(plane.normal, before_[v] - plane.point));
                const double now = std::abs(glm::dot(plane.normal, mesh_.positions_m[v] - plane.point));
                // A plane far from the original vertex belongs to another sheet, or to a feature that a cell cannot
                // represent.
                if (at_first < kOwnPlane * lattice_.spacing_m) worst = std::max(worst, now - at_first);
            }
        }
        return worst;
    }

    geometry::TriangleMesh& mesh_;
    const Lattice lattice_;
    const std::vector<Vec3> before_;
    const std::vector<geometry::VertexTriple> triangles_before_;
    Fans fans_;
    Remedies remedies_;
    mutable PlanesAround planes_;
    geometry::TriangleTree tree_;
    double reach_ = 0.0;  // largest distance of any triangle beyond its box in the tree
    double deviation_ = 0.0;
    std::uint64_t turned_ = 0, attempts_ = 0;
    std::vector<std::uint32_t> changed_, moved_;
};

// Moves vertices apart that a remedy has moved onto each other; returns whether there were any. Positions that are not
// floats belong to formats with shared vertices, which keep such vertices apart.
bool separate_vertices(geometry::TriangleMesh& mesh, const Lattice& lattice) {
    if (!lattice.fits_floats()) return false;
    std::vector<Vec3f> places(mesh.positions_m.begin(), mesh.positions_m.end());
    if (geometry::make_distinct(places) == 0) return false;
    std::ranges::transform(places, mesh.positions_m.begin(), [](const Vec3f& p) { return Vec3(p); });
    return true;
}

}  // namespace

RepairReport repair_intersections(geometry::TriangleMesh& mesh, const Surface& surface, const Solid& solid,
                                  WorkerPool& pool, LengthUnit unit) {
    RepairReport report;
    std::vector<TrianglePair> pairs = self_intersections(mesh, pool);
    report.found = report.left = pairs.size();
    if (pairs.empty()) return report;
    Repairer repairer(mesh, surface, solid, unit);
    for (int round = 0; round < kRounds && !pairs.empty(); ++round) {
        pairs = repairer.treat(pairs, round);
    }
    repairer.report(report);
    report.deviation_max_m = to_metres(report.deviation_max_m, unit);
    report.left = separate_vertices(mesh, surface.lattice()) ? self_intersections(mesh, pool).size() : pairs.size();
    return report;
}

}  // namespace burin::compute
