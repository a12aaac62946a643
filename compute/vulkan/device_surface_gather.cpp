// SPDX-License-Identifier: MIT
// Data that a DeviceSurface sends to the host: the triangles near the tool and, for tests, the whole surface.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/try.hpp"
#include "compute/vulkan/device_surface.hpp"
#include "compute/vulkan/device_surface_buffers.hpp"

namespace burin::compute {

using shared::GatherParameters;
using shared::MeshCounters;
using shared::SurfaceVertex;
using shared::TileRange;

void DeviceSurface::record_gather(gpu::Commands& commands, const Ball& ball) {
    GatherParameters p{};
    p.vertex_address = vertices_.address();
    p.index_address = indices_.address();
    p.member_address = members_.address();
    p.radius_m = static_cast<float>(ball.radius_m);
    p.stamp = ++stamp_;
    p.spacing_m = static_cast<float>(lattice_.spacing_m);
    p.most_triangles = options_.ball_triangles;
    p.most_vertices = options_.ball_vertices;
    const Vec3 center = ball.center_object - lattice_.origin_object;
    const double tile_m = lattice_.spacing_m * kTileCells;
    for (int a = 0; a < 3; ++a) {
        const auto k = static_cast<std::size_t>(a);
        p.center[k] = center[a];
        p.center_float[k] = static_cast<float>(center[a]);
        p.tiles[k] = grid_.tiles[k];
        // Triangles of a tile reach up to two cells beyond its own cells.
        const double last = grid_.tiles[k] - 1, reach = ball.radius_m + 2.0 * lattice_.spacing_m;
        p.from[k] = static_cast<int>(std::clamp(std::floor((center[a] - reach) / tile_m), 0.0, last));
        p.count[k] = static_cast<int>(std::clamp(std::floor((center[a] + reach) / tile_m), 0.0, last)) - p.from[k] + 1;
    }
    const std::uint64_t shown = engine_.device().capabilities().max_storage_buffer_bytes;
    const bool bound = vertices_.size_bytes() <= shown;
    const std::array<gpu::BufferRange, 5> buffers{
        counters_.buffer(), ranges_, ball_places_.buffer(), ball_triangles_.buffer(),
        gpu::BufferRange(vertices_, 0, std::min<std::uint64_t>(vertices_.size_bytes(), shown))};
    const auto groups = static_cast<std::uint32_t>(p.count[0] * p.count[1] * p.count[2]);
    commands.dispatch(stages_[bound ? bound_ball : Stage::ball], buffers, gpu::bytes_of(p), {groups, 1, 1});
    commands.barrier();
    constexpr std::uint32_t kCornerGroups = 64;
    commands.dispatch(stages_[corners], buffers, gpu::bytes_of(p), {kCornerGroups, 1, 1});
    commands.barrier();
    ball_places_.fetch(commands, ball_places_.size_bytes());
    ball_triangles_.fetch(commands, ball_triangles_.size_bytes());
}

Result<void> DeviceSurface::gather_alone(const Ball& ball) {
    touched_ = ball;
    BURIN_TRY_DO(submit({}));
    return finish();
}

Result<void> DeviceSurface::local_surface(const Vec3& center_object, double radius_m, geometry::LocalSurface& out) {
    BURIN_TRY_DO(finish());
    for (double radius = radius_m;;) {
        if (!touched_ || touched_->center_object != center_object || touched_->radius_m != radius) {
            BURIN_TRY_DO(gather_alone({center_object, radius}));
        }
        const MeshCounters counters = counters_.from_device<MeshCounters>()[0];
        if (!holds_ball(counters)) {
            BURIN_TRY(grown, grow_ball(counters));
            if (!grown) radius *= 0.7;
            touched_.reset();  // what was gathered of it is no whole
            continue;
        }
        auto loose = std::make_shared<geometry::GriddedTriangles>();
        loose->positions_m.resize(counters.ball_vertices);
        loose->triangles.resize(counters.ball_triangles);
        // memcpy must not be called with null pointers, even for no bytes: there may be no triangle near the tool.
        if (counters.ball_triangles > 0) {
            std::memcpy(loose->positions_m.data(), ball_places_.from_device<Vec3f>().data(),
                        loose->positions_m.size() * sizeof(Vec3f));
            std::memcpy(loose->triangles.data(), ball_triangles_.from_device<std::uint32_t>().data(),
                        loose->triangles.size() * sizeof(loose->triangles[0]));
        }
        geometry::build_search(*loose);
        out.center_object = out.origin_object = center_object;
        out.radius_m = radius;
        out.tiles = {};
        out.loose = std::move(loose);
        return {};
    }
}

Result<std::vector<TileMesh>> DeviceSurface::download() {
    BURIN_TRY_DO(finish());
    BURIN_TRY(ranges, read_buffer<TileRange>(engine_.device(), ranges_, grid_.count()));
    BURIN_TRY(vertices, read_buffer<SurfaceVertex>(engine_.device(), vertices_, vertices_used_));
    BURIN_TRY(indices, read_buffer<std::uint32_t>(engine_.device(), indices_, indices_used_));
    std::vector<TileMesh> tiles(grid_.count());
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        const TileRange& range = ranges[t];
        if (range.index_count == 0) continue;
        const auto of_tile = std::span(vertices).subspan(static_cast<std::size_t>(range.first_vertex), range.vertices);
        const auto corners = std::span(indices).subspan(range.first_index, range.index_count);
        tiles[t].vertices.assign(of_tile.begin(), of_tile.end());
        tiles[t].indices.assign(corners.begin(), corners.end());
        tiles[t].disagreeing_edges = range.disagreeing;
    }
    return tiles;
}

}  // namespace burin::compute
