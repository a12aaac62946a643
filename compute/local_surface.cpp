// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include "compute/surface.hpp"

namespace burin {
namespace {

// Squared distance from p to the box around a triangle: never more than to the triangle itself.
float distance2_to_box(const Vec3f& p, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
    const Vec3f lo = glm::min(a, glm::min(b, c)), hi = glm::max(a, glm::max(b, c));
    const Vec3f outside = glm::max(glm::max(lo - p, p - hi), Vec3f(0.0f));
    return glm::dot(outside, outside);
}

// Tiles that may hold surface within the ball; positions are relative to the lattice origin.
struct TileRange {
    std::array<int, 3> from{}, to{};
};

TileRange tiles_around(const Surface& surface, const Vec3& center, double radius_m) {
    TileRange range;
    const double tile_m = surface.lattice().spacing_m * kTileCells;
    for (int a = 0; a < 3; ++a) {
        const auto k = static_cast<std::size_t>(a);
        const double last = surface.grid().tiles[k] - 1;
        // A tile's triangles reach one and a half cells below its own nodes, and half a cell beyond its last cell.
        const double spacing_m = surface.lattice().spacing_m;
        range.from[k] =
            static_cast<int>(std::clamp(std::floor((center[a] - radius_m - 0.5 * spacing_m) / tile_m), 0.0, last));
        range.to[k] =
            static_cast<int>(std::clamp(std::floor((center[a] + radius_m + 1.5 * spacing_m) / tile_m), 0.0, last));
    }
    return range;
}

// Where a triangle lies, as far as it takes no look at its corners.
enum class Where { outside, near_border, inside };

// The ball in the cells of one tile, counted from its first node.
class BallInCells {
public:
    BallInCells(const Vec3& center_m, double radius_m, double spacing_m, const std::array<int, 3>& first_node)
        : center_(center_m / spacing_m - Vec3(first_node[0], first_node[1], first_node[2])) {
        const auto radius = static_cast<float>(radius_m / spacing_m);
        outside2_ = (radius + kReach) * (radius + kReach);
        inside2_ = radius > kReach ? (radius - kReach) * (radius - kReach) : 0.0f;
    }

    // By the lattice edge that the triangle's quad surrounds.
    [[nodiscard]] Where of_quad(std::uint16_t quad) const {
        const int edge = quad & TileMesh::kQuadEdge;
        const Vec3f from_center = Vec3f(static_cast<float>(edge / kTileCells % kTileCells),
                                        static_cast<float>(edge / (kTileCells * kTileCells) % kTileCells),
                                        static_cast<float>(edge % kTileCells)) -
                                  center_;
        const float distance2 = glm::dot(from_center, from_center);
        return distance2 > outside2_ ? Where::outside : distance2 < inside2_ ? Where::inside : Where::near_border;
    }

private:
    // The corners are in the four cells around the edge or half a cell beside them: up to 1.5, 1.5 and 1.5 cells away from
    // the edge's lower node; rounded up.
    static constexpr float kReach = 2.7f;
    Vec3f center_;
    float outside2_, inside2_;
};

// Adds what fits of one tile, relative to `center` (in double: a float centre would shift the whole piece); returns how many
// triangles within the ball did not.
std::uint32_t add_tile(const TileMesh& tile, const BallInCells& ball, const Vec3& center, float radius_m,
                       LocalSurface& out, std::vector<std::uint32_t>& index_of_vertex) {
    constexpr std::uint32_t kNone = 0xffffffff;
    std::uint32_t left_out = 0;
    index_of_vertex.assign(tile.vertices.size(), kNone);
    const auto position = [&](std::uint32_t i) {
        return Vec3f(tile.vertices[i].x, tile.vertices[i].y, tile.vertices[i].z);
    };
    const bool only_quads = tile.indices.size() == tile.quads.size() * 6;
    for (std::size_t i = 0; i < tile.indices.size(); i += 3) {
        const Where where = only_quads ? ball.of_quad(tile.quads[i / 6]) : Where::near_border;
        if (where == Where::outside) {
            i += 3;  // the quad's other triangle
            continue;
        }
        const std::uint32_t* corner = &tile.indices[i];
        if (where == Where::near_border && distance2_to_box(Vec3f(center), position(corner[0]), position(corner[1]),
                                                            position(corner[2])) > radius_m * radius_m) {
            continue;
        }
        if (out.triangle_count == LocalSurface::kMaxTriangles || out.vertex_count + 3 > LocalSurface::kMaxVertices) {
            ++left_out;
            continue;
        }
        auto& triangle = out.triangles[out.triangle_count++];
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& index = index_of_vertex[corner[k]];
            if (index == kNone) {
                index = out.vertex_count;
                out.positions_m[out.vertex_count++] = Vec3f(Vec3(position(corner[k])) - center);
            }
            triangle[k] = index;
        }
    }
    return left_out;
}

}  // namespace

void gather_local_surface(const Surface& surface, const Vec3& center_object, double radius_m, LocalSurface& out) {
    thread_local std::vector<std::uint32_t> index_of_vertex;
    const Vec3 center = center_object - surface.lattice().origin_object;
    std::uint32_t within = 0;  // triangles in the ball that was asked for
    for (double radius = radius_m;; radius *= 0.7) {
        out.vertex_count = out.triangle_count = 0;
        out.center_object = center_object;
        out.origin_object = center_object;
        out.radius_m = radius;
        const TileRange range = tiles_around(surface, center, radius);
        std::uint32_t left_out = 0;
        for (int z = range.from[2]; z <= range.to[2]; ++z)
            for (int y = range.from[1]; y <= range.to[1]; ++y)
                for (int x = range.from[0]; x <= range.to[0]; ++x) {
                    const TileMesh& tile = surface.tile(surface.grid().index(x, y, z));
                    if (tile.indices.empty()) continue;
                    const BallInCells ball(center, radius, surface.lattice().spacing_m,
                                           {x * kTileCells, y * kTileCells, z * kTileCells});
                    left_out += add_tile(tile, ball, center, static_cast<float>(radius), out, index_of_vertex);
                }
        if (within == 0) within = out.triangle_count + left_out;
        out.dropped_triangles = within - out.triangle_count;
        if (left_out == 0) return;
    }
}

}  // namespace burin
