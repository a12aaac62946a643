// SPDX-License-Identifier: MIT
#include "compute/mesher/surface.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <tuple>

#include "geometry/mesh/distinct_positions.hpp"

namespace burin::compute {

void Surface::subtract_changed() {
    for (const std::uint32_t t : changed_tiles_) {
        triangles_ -= tile(t).triangles();
        disagreeing_edges_ -= tile(t).disagreeing_edges;
    }
    work_.resize(changed_tiles_.size());
}

RemeshStats Surface::add_changed() {
    RemeshStats stats;
    stats.tiles = changed_tiles_.size();
    for (std::size_t i = 0; i < changed_tiles_.size(); ++i) {
        const TileMesh& mesh = tile(changed_tiles_[i]);
        stats.cells += work_[i].cells;
        stats.triangles += work_[i].triangles;
        triangles_ += mesh.triangles();
        disagreeing_edges_ += mesh.disagreeing_edges;
    }
    return stats;
}

void Surface::replace(std::size_t i, TileWork work, std::shared_ptr<TileMesh> fresh) {
    work_[i] = work;
    if (fresh->indices.empty()) fresh.reset();
    tiles_[changed_tiles_[i]] = std::move(fresh);
}

void Surface::mesh(std::size_t i, const Solid& solid, const CellMask& dirty) {
    const std::uint32_t t = changed_tiles_[i];
    auto fresh = std::make_shared<TileMesh>();
    const TileWork work = mesh_tile(solid, grid_, t, dirty, tile(t), *fresh);
    replace(i, work, std::move(fresh));
}

bool Surface::compose(std::size_t i, const Solid& solid, const MadeCells& made) {
    const shared::MadeTile& part = made.tiles[made_order_[i] & 0xffffffffu];
    auto fresh = std::make_shared<TileMesh>();
    const std::optional<TileWork> work = compose_tile(solid, grid_, made, part, tile(part.tile), *fresh);
    if (!work) return false;
    replace(i, *work, std::move(fresh));
    return true;
}

template <typename MaskOf>
RemeshStats Surface::mesh_tiles(const Solid& solid, MaskOf&& mask_of, WorkerPool& pool, WorkWatch* watch) {
    subtract_changed();
    std::atomic<std::size_t> done{0};
    pool.run(changed_tiles_.size(), [&](std::size_t i) {
        const double count = static_cast<double>(changed_tiles_.size());
        if (watch != nullptr && !watch->go_on(static_cast<double>(++done) / count)) return;
        mesh(i, solid, mask_of(changed_tiles_[i]));
    });
    return add_changed();
}

RemeshStats Surface::mesh_all(const Solid& solid, WorkerPool& pool, WorkWatch* watch) {
    changed_tiles_.resize(tiles_.size());
    std::iota(changed_tiles_.begin(), changed_tiles_.end(), 0u);
    CellMask all;
    all.set_all();
    return mesh_tiles(solid, [&](std::uint32_t) -> const CellMask& { return all; }, pool, watch);
}

RemeshStats Surface::update(const Solid& solid, const Changes& changes, WorkerPool& pool, const MadeCells* made) {
    if (made != nullptr && list_tiles(*made)) return compose_tiles(solid, changes, *made, pool);
    dirty_.sort(changes, pool);
    changed_tiles_.assign(dirty_.tiles().begin(), dirty_.tiles().end());
    return mesh_tiles(solid, [&](std::uint32_t tile) { return dirty_.mask(tile); }, pool);
}

bool Surface::list_tiles(const MadeCells& made) {
    made_order_.clear();
    for (std::size_t i = 0; i < made.tiles.size(); ++i)
        made_order_.push_back(std::uint64_t{made.tiles[i].tile} << 32 | i);
    std::ranges::sort(made_order_);
    changed_tiles_.clear();
    for (const std::uint64_t tile : made_order_) changed_tiles_.push_back(static_cast<std::uint32_t>(tile >> 32));
    return (changed_tiles_.empty() || changed_tiles_.back() < tiles_.size()) &&
           std::ranges::adjacent_find(changed_tiles_) == changed_tiles_.end();
}

RemeshStats Surface::compose_tiles(const Solid& solid, const Changes& changes, const MadeCells& made,
                                   WorkerPool& pool) {
    subtract_changed();
    std::vector<char> composed(changed_tiles_.size());
    pool.run(composed.size(), [&](std::size_t i) { composed[i] = compose(i, solid, made) ? 1 : 0; });
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < composed.size(); ++i) {
        if (composed[i] == 0) left.push_back(i);
    }
    if (!left.empty()) {
        dirty_.sort(changes, pool);
        pool.run(left.size(), [&](std::size_t k) { mesh(left[k], solid, dirty_.mask(changed_tiles_[left[k]])); });
    }
    return add_changed();
}

double Surface::volume_m3() const {
    double six_volumes = 0.0;
    for (std::uint32_t t = 0; t < tile_count(); ++t) {
        const TileMesh& tile = this->tile(t);
        const auto corner = [&](std::size_t i) {
            const shared::SurfaceVertex& v = tile.vertices[tile.indices[i]];
            return Vec3(v.x, v.y, v.z);
        };
        double of_tile = 0.0;
        for (std::size_t i = 0; i < tile.indices.size(); i += 3) {
            of_tile += glm::dot(corner(i), glm::cross(corner(i + 1), corner(i + 2)));
        }
        six_volumes += of_tile;
    }
    return six_volumes / 6.0;
}

geometry::TriangleMesh Surface::welded(LengthUnit unit) const {
    struct Place {
        std::uint64_t key;
        std::uint32_t tile, vertex;
    };
    std::vector<Place> places;
    std::vector<std::vector<std::uint32_t>> welded_index(tiles_.size());
    for (std::uint32_t t = 0; t < tiles_.size(); ++t) {
        const std::vector<std::uint64_t> keys = vertex_keys(lattice_, grid_.first_node(t), tile(t));
        welded_index[t].resize(keys.size());
        for (std::uint32_t v = 0; v < keys.size(); ++v) places.push_back({keys[v], t, v});
    }
    std::ranges::sort(places, [](const Place& a, const Place& b) {
        return std::tie(a.key, a.tile, a.vertex) < std::tie(b.key, b.tile, b.vertex);
    });

    geometry::TriangleMesh mesh;
    // Positions are rounded to floats in the object frame, as most files hold them; where that is too coarse, relative
    // to the lattice's origin.
    const Vec3 shift_m = lattice_.fits_floats() ? Vec3(0.0) : lattice_.origin_object;
    const Vec3 shift = from_metres(shift_m, unit);
    std::vector<Vec3f> welded_places;
    for (std::size_t from = 0, to = 0; from < places.size(); from = to) {
        std::array<std::uint32_t, 3> colour{};
        do {
            const std::uint32_t c = tile(places[to].tile).vertices[places[to].vertex].colour;
            for (std::size_t k = 0; k < 3; ++k) colour[k] += c >> (8 * k) & 0xffu;
            welded_index[places[to].tile][places[to].vertex] = static_cast<std::uint32_t>(welded_places.size());
            ++to;
        } while (to < places.size() && places[to].key == places[from].key);
        const shared::SurfaceVertex& v = tile(places[from].tile).vertices[places[from].vertex];
        welded_places.emplace_back(from_metres(lattice_.origin_object - shift_m + Vec3(v.x, v.y, v.z), unit));
        const auto count = static_cast<std::uint32_t>(to - from);
        const auto mean = [&](std::size_t k) { return static_cast<std::uint8_t>((colour[k] + count / 2) / count); };
        mesh.colours.push_back({mean(0), mean(1), mean(2)});
    }
    // Two sheets in one cell may have vertices at one position.
    geometry::make_distinct(welded_places);
    for (const Vec3f& place : welded_places) mesh.positions_m.push_back(shift + Vec3(place));
    for (std::uint32_t t = 0; t < tiles_.size(); ++t) {
        const std::vector<std::uint32_t>& index = welded_index[t];
        const TileMesh& tile = this->tile(t);
        for (std::size_t i = 0; i < tile.indices.size(); i += 3) {
            const std::uint32_t* corner = &tile.indices[i];
            mesh.triangles.push_back({index[corner[0]], index[corner[1]], index[corner[2]]});
        }
    }
    return mesh;
}

}  // namespace burin::compute
