// SPDX-License-Identifier: MIT
// Proposes remedies for a self-intersection of a welded surface (self_intersections.hpp), without applying any of
// them.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "compute/mesher/surface.hpp"
#include "compute/repair/self_intersections.hpp"
#include "geometry/mesh/edge_table.hpp"

namespace burin::compute {

// The triangles around each vertex: the initial ones in one array, changed fans beside it.
class Fans {
public:
    explicit Fans(const geometry::TriangleMesh& mesh);
    [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t vertex) const;
    void add(std::uint32_t vertex, std::uint32_t triangle);
    void remove(std::uint32_t vertex, std::uint32_t triangle) { std::erase(own(vertex), triangle); }

private:
    std::vector<std::uint32_t>& own(std::uint32_t vertex);
    std::vector<std::uint32_t> first_, triangles_;
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> changed_;
};

// The changes of one remedy. Exchanging it with the mesh applies it, and exchanging it again undoes it.
struct Remedy {
    std::vector<std::pair<std::uint32_t, Vec3>> places;
    std::vector<std::pair<std::uint32_t, geometry::VertexTriple>> triangles;
    double deviation = 0.0;
};

// Sorts the list in ascending order and removes duplicates.
void sort_unique(std::vector<std::uint32_t>& list);

// Proposes remedies for one mesh, which must be surface.welded(unit) except for what remedies have changed. Lengths are
// in that unit. Mesh and fans are read on each call.
class Remedies {
public:
    // From this round on a vertex may move to any part of its cell.
    static constexpr int kAnywhere = 5;

    Remedies(const geometry::TriangleMesh& mesh, const Fans& fans, const Surface& surface, LengthUnit unit);

    // Returns the remedies for a pair of intersecting triangles; later rounds return more of them.
    [[nodiscard]] std::vector<Remedy> remedies_for(const TrianglePair& pair, int round) const;

private:
    [[nodiscard]] Remedy turned_diagonal(std::uint32_t t, std::size_t k, double most_gap_cells) const;
    [[nodiscard]] Remedy towards_neighbours(std::span<const std::uint32_t> vertices, double share) const;
    [[nodiscard]] Remedy along_edge(std::uint32_t v, std::uint32_t w, double share) const;
    [[nodiscard]] Remedy homewards(std::span<const std::uint32_t> vertices, double share) const;
    [[nodiscard]] Remedy within_cells(std::span<const std::uint32_t> vertices, const Vec3& shares) const;
    void move(std::uint32_t v, const Vec3& target, double share, Remedy& remedy) const;
    [[nodiscard]] Vec3 allowed(std::uint32_t v, const Vec3& p) const;
    [[nodiscard]] Box home_of(std::uint32_t v) const;
    [[nodiscard]] std::vector<std::uint32_t> neighbours(std::uint32_t v) const;
    void add_neighbours(std::vector<std::uint32_t>& vertices) const;

    const geometry::TriangleMesh& mesh_;
    const Fans& fans_;
    Lattice lattice_;                  // in the mesh's unit
    Vec3 shift_;                       // origin that the mesh's floats are relative to (surface.cpp)
    std::vector<std::uint64_t> keys_;  // keys of the vertices (tile_mesher.hpp)
};

}  // namespace burin::compute
