// SPDX-License-Identifier: MIT
// What may be done about a fault of a welded surface (mend_intersections.hpp), and what each remedy would change. Nothing is
// changed here.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "compute/self_intersections.hpp"
#include "compute/surface.hpp"
#include "geometry/edge_table.hpp"

namespace burin {

// The triangles around each vertex: those of the start in one array, changed fans beside it.
class Fans {
public:
    explicit Fans(const TriangleMesh& mesh);
    [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t vertex) const;
    void add(std::uint32_t vertex, std::uint32_t triangle);
    void remove(std::uint32_t vertex, std::uint32_t triangle) { std::erase(own(vertex), triangle); }

private:
    std::vector<std::uint32_t>& own(std::uint32_t vertex);
    std::vector<std::uint32_t> first_, triangles_;
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> changed_;
};

// What a remedy changes; applied by exchanging it with the mesh, and undone by doing so again.
struct Remedy {
    std::vector<std::pair<std::uint32_t, Vec3>> places;
    std::vector<std::pair<std::uint32_t, VertexTriple>> triangles;
    double deviation_m = 0.0;
};

// In ascending order, each once.
void sort_unique(std::vector<std::uint32_t>& list);

// For the faults of one mesh, which must be surface.welded() but for what remedies have changed. Mesh and fans are read each time.
class Remedies {
public:
    // From this round on a vertex may go to any part of its cell.
    static constexpr int kAnywhere = 5;

    Remedies(const TriangleMesh& mesh, const Fans& fans, const Surface& surface);

    // The more the later the round.
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

    const TriangleMesh& mesh_;
    const Fans& fans_;
    Lattice lattice_;
    Vec3 shift_;                       // what the mesh's floats are relative to (surface.cpp)
    std::vector<std::uint64_t> keys_;  // of the vertices (tile_mesher.hpp)
};

}  // namespace burin
