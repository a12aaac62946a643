// SPDX-License-Identifier: MIT
#include "compute/repair/remedies.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace burin::compute {
namespace {

constexpr int kMostRings = 5;  // rings of neighbours that are moved at once
// Distance that a moved vertex keeps from its cell's faces, in cells, so that vertices of two cells never coincide.
constexpr double kInset = 1.0 / 256.0;
// First slot of a key (tile_mesher.hpp) that names an extra vertex: two slots for each of the cell's lower faces.
constexpr int kFirstFaceSlot = 4;
// Largest gap between the two diagonals, in cells, for which a diagonal is turned; the surface changes by that gap.
constexpr double kMostGap = 0.1;
constexpr std::array kShares{0.125, 0.25, 0.5, 0.75, 1.0};

// Returns the keys of the welded vertices, which are sorted by key, one vertex for each.
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

}  // namespace

Fans::Fans(const geometry::TriangleMesh& mesh)
    : first_(mesh.positions_m.size() + 1), triangles_(mesh.triangles.size() * 3) {
    for (const geometry::VertexTriple& t : mesh.triangles) {
        for (const std::uint32_t v : t) ++first_[v + 1];
    }
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t v : mesh.triangles[t]) triangles_[next[v]++] = t;
    }
}

std::span<const std::uint32_t> Fans::of(std::uint32_t vertex) const {
    const auto changed = changed_.find(vertex);
    if (changed != changed_.end()) return changed->second;
    return std::span(triangles_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
}

void Fans::add(std::uint32_t vertex, std::uint32_t triangle) {
    std::vector<std::uint32_t>& fan = own(vertex);
    fan.insert(std::ranges::lower_bound(fan, triangle), triangle);
}

std::vector<std::uint32_t>& Fans::own(std::uint32_t vertex) {
    const std::span<const std::uint32_t> now = of(vertex);
    return changed_.try_emplace(vertex, now.begin(), now.end()).first->second;
}

void sort_unique(std::vector<std::uint32_t>& list) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

Remedies::Remedies(const geometry::TriangleMesh& mesh, const Fans& fans, const Surface& surface, LengthUnit unit)
    : mesh_(mesh),
      fans_(fans),
      lattice_(in_unit(surface.lattice(), unit)),
      shift_(lattice_.fits_floats() ? Vec3(0.0) : lattice_.origin_object),
      keys_(keys_of(surface)) {}

std::vector<Remedy> Remedies::remedies_for(const TrianglePair& pair, int round) const {
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
        // A vertex that moves along an edge of the mesh stays on the surface, or on the crease that the edge follows.
        for (const std::uint32_t w : neighbours(v)) {
            for (const double share : kShares) add(along_edge(v, w, share));
        }
    }
    for (int i = 0; round >= kAnywhere && i < 27; ++i) {
        const Vec3 shares = Vec3(i % 3, i / 3 % 3, i / 9) * 0.4 + 0.1;
        for (const std::uint32_t v : vertices) add(within_cells({&v, 1}, shares));
    }
    // From the second round on, moves several vertices at once, then also their neighbours, and so on.
    for (int ring = 1; ring <= std::min(round, kMostRings); ++ring) {
        for (const double share : kShares) add(towards_neighbours(vertices, share));
        for (const double share : kShares) add(homewards(vertices, share));
        if (round >= kAnywhere) add(within_cells(vertices, Vec3(0.5)));
        add_neighbours(vertices);
    }
    return remedies;
}

// Returns the remedy that replaces the edge from corner k of t by the edge between the other corners of its two
// triangles.
Remedy Remedies::turned_diagonal(std::uint32_t t, std::size_t k, double most_gap_cells) const {
    const std::uint32_t u = mesh_.triangles[t][k], v = mesh_.triangles[t][(k + 1) % 3],
                        a = mesh_.triangles[t][(k + 2) % 3];
    std::uint32_t other = t, b = a;
    for (const std::uint32_t candidate : fans_.of(u)) {
        const geometry::VertexTriple& c = mesh_.triangles[candidate];
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
        return {};  // the new triangles would fold over
    }
    return {{}, {{t, {a, u, b}}, {other, {b, v, a}}}, 0.0};
}

// Moves each vertex towards the mean of its neighbours.
Remedy Remedies::towards_neighbours(std::span<const std::uint32_t> vertices, double share) const {
    Remedy remedy;
    for (const std::uint32_t v : vertices) {
        Vec3 sum(0.0);
        const std::vector<std::uint32_t> around = neighbours(v);
        for (const std::uint32_t w : around) sum += mesh_.positions_m[w];
        move(v, sum / static_cast<double>(around.size()), share, remedy);
    }
    return remedy;
}
Remedy Remedies::along_edge(std::uint32_t v, std::uint32_t w, double share) const {
    Remedy remedy;
    move(v, mesh_.positions_m[w], share, remedy);
    return remedy;
}
void Remedies::move(std::uint32_t v, const Vec3& target, double share, Remedy& remedy) const {
    const Vec3& old = mesh_.positions_m[v];
    const Vec3 place = allowed(v, old + (target - old) * share);
    if (place != old) remedy.places.emplace_back(v, place);
}

std::vector<std::uint32_t> Remedies::neighbours(std::uint32_t v) const {
    std::vector<std::uint32_t> around;
    for (const std::uint32_t t : fans_.of(v)) {
        for (const std::uint32_t w : mesh_.triangles[t]) {
            if (w != v) around.push_back(w);
        }
    }
    sort_unique(around);
    return around;
}

// Returns the point nearest to p that a vertex may have, rounded as the mesh stores it: within its cell, or on the way
// back to the cell if it lies outside. A vertex on a face stays in that face.
Vec3 Remedies::allowed(std::uint32_t v, const Vec3& p) const {
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
// Returns the part of its cell in which the vertex may lie; the cell follows from the vertex's key.
Box Remedies::home_of(std::uint32_t v) const {
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
// Moves vertices that the mesher placed outside their cell back towards the cell's border.
Remedy Remedies::homewards(std::span<const std::uint32_t> vertices, double share) const {
    Remedy remedy;
    for (const std::uint32_t v : vertices) {
        const Box home = home_of(v);
        move(v, glm::clamp(mesh_.positions_m[v], home.lo, home.hi), share, remedy);
    }
    return remedy;
}
// Moves each vertex to the same point of its cell, in shares of its width. With all vertices in the middle of their
// cells the surface consists of whole squares.
Remedy Remedies::within_cells(std::span<const std::uint32_t> vertices, const Vec3& shares) const {
    Remedy remedy;
    for (const std::uint32_t v : vertices) {
        const Box home = home_of(v);
        move(v, home.lo + home.extent() * shares, 1.0, remedy);
    }
    return remedy;
}

void Remedies::add_neighbours(std::vector<std::uint32_t>& vertices) const {
    std::vector<std::uint32_t> more;
    for (const std::uint32_t v : vertices) {
        for (const std::uint32_t t : fans_.of(v))
            more.insert(more.end(), mesh_.triangles[t].begin(), mesh_.triangles[t].end());
    }
    sort_unique(more);
    vertices = std::move(more);
}

}  // namespace burin::compute
