// SPDX-License-Identifier: MIT
// The buffer in which the mesher assembles a tile's mesh before it is copied to a TileMesh, which holds no more memory
// than it needs.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "compute/mesher/cell_vertices.hpp"
#include "compute/mesher/tile_mesher.hpp"

namespace burin::compute {

// A tile's mesh under construction. Its lists are allocated for the largest possible mesh, so that adding needs no
// bounds check; pages that are never written take no physical memory. kFaces: a quad crosses four faces between cells,
// each of which may add one extra vertex and one triangle.
struct TileDraft {
    static constexpr std::size_t kCells = std::size_t{kSeenCells} * kSeenCells * kSeenCells,
                                 kQuads = std::size_t{3} * kTileCells * kTileCells * kTileCells, kFaces = 4;
    template <typename T>
    struct List {
        explicit List(std::size_t most) : items(std::make_unique_for_overwrite<T[]>(most)) {}
        std::unique_ptr<T[]> items;
        std::size_t count = 0;
        void push_back(const T& item) { items[count++] = item; }
        // Extends the list by `more` items, which the caller must write.
        [[nodiscard]] T* add(std::size_t more) { return &items[(count += more) - more]; }
        void append(const T* first, std::size_t more) { std::copy_n(first, more, add(more)); }
        void assign_to(std::vector<T>& out) const { out.assign(items.get(), items.get() + count); }
    };
    List<shared::SurfaceVertex> vertices{kCells * CellVertexMaker::kMost + kQuads * kFaces};
    List<TileMesh::Cell> cells{kCells};
    List<std::uint64_t> vertex_of_edge{kCells};
    List<std::uint16_t> quads{kQuads};
    List<std::uint32_t> indices{kQuads * (2 + kFaces) * 3};

    std::array<std::uint16_t, kCells> place_of_cell{};  // index into `cells`, by cell id

    void begin_cell(std::size_t id, std::size_t first_vertex) {
        place_of_cell[id] = static_cast<std::uint16_t>(cells.count);
        cells.push_back({static_cast<std::uint16_t>(id), static_cast<std::uint16_t>(first_vertex)});
    }
    void clear() { vertices.count = cells.count = vertex_of_edge.count = quads.count = indices.count = 0; }
};

}  // namespace burin::compute
