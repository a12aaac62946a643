// SPDX-License-Identifier: MIT
#include "compute/light/surface_light.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

namespace burin::compute {
namespace {

// Bounds the distance, in cells, from a changed node to a vertex whose open light it alters: the range, the ray's start
// off the surface, the reach of the clearance, and the cell in which it is interpolated.
constexpr int kOpenReach = static_cast<int>(kOpenRange) + 1 + Clearance::kReach + Clearance::kBlur + 1;
// The vertices of a tile lie in the cells that it sees, or half a cell beside them: nodes -2 .. kTileCells + 1 around
// it.
constexpr int kVertexMargin = 2;
constexpr std::uint64_t kStepsBetweenBoxes = 32;

bool same_place(const shared::SurfaceVertex& a, const shared::SurfaceVertex& b) {
    return std::memcmp(&a, &b, 3 * sizeof(float)) == 0 && a.normal == b.normal;
}

float distance_sq(const shared::SurfaceVertex& a, const shared::SurfaceVertex& b) {
    const float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    return x * x + y * y + z * z;
}

std::size_t nearest(const shared::SurfaceVertex& vertex, const std::vector<shared::SurfaceVertex>& among) {
    std::size_t best = 0;
    float least = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < among.size(); ++i) {
        const float d = distance_sq(vertex, among[i]);
        if (d < least) {
            least = d;
            best = i;
        }
    }
    return best;
}

// Tells whether rays from some point of `from` towards the lamp pass through `what`. A ray deviates from the direction
// to the lamp's centre by up to the tangent, so at a distance t along that direction they meet when the boxes are no
// farther apart on any axis than t * tangent.
bool shades(const NodeBox& what, const NodeBox& from, const Vec3& towards, double tangent) {
    double t_lo = 0.0, t_hi = std::numeric_limits<double>::infinity();
    for (int a = 0; a < 3; ++a) {
        const auto i = static_cast<std::size_t>(a);
        // from.lo + t towards <= what.hi + t tangent, and from.hi + t towards >= what.lo - t tangent
        const auto keep_below = [&](double slope, double limit) {  // slope * t <= limit
            if (slope > 0.0) {
                t_hi = std::min(t_hi, limit / slope);
            } else if (slope < 0.0) {
                t_lo = std::max(t_lo, limit / slope);
            } else if (limit < 0.0) {
                t_hi = -1.0;
            }
        };
        keep_below(towards[a] - tangent, what.hi[i] - from.lo[i]);
        keep_below(-towards[a] - tangent, from.hi[i] - what.lo[i]);
    }
    return t_lo <= t_hi;
}

}  // namespace

std::vector<geometry::VertexLight> carried_over(const geometry::SurfaceTile& mesh, const geometry::SurfaceTile* before,
                                                const TileLight* light_before) {
    std::vector<geometry::VertexLight> light(mesh.vertices.size());
    if (before == nullptr || light_before == nullptr || before->vertices.empty()) return light;
    // The old and the new mesh list their vertices in the order of cells, so one pass finds each remaining vertex.
    const std::vector<shared::SurfaceVertex>& old = before->vertices;
    constexpr std::size_t kAhead = 12;
    std::size_t next = 0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        const shared::SurfaceVertex& vertex = mesh.vertices[i];
        std::size_t at = next;
        const std::size_t end = std::min(next + kAhead, old.size());
        while (at < end && !same_place(vertex, old[at])) ++at;
        if (at < end) {
            next = at + 1;
        } else {
            at = nearest(vertex, old);
            next = std::max(next, at);  // the search resumes from about there
        }
        light[i] = light_before->vertices[at];
    }
    return light;
}

SurfaceLight::SurfaceLight(const Lattice& lattice, const Lamp& lamp)
    : lattice_(lattice),
      grid_(lattice),
      lamp_(lamp),
      occupancy_(lattice),
      clearance_(lattice),
      inner_boxes_(lattice),
      meshes_(grid_.count()),
      lights_(grid_.count()),
      needs_(grid_.count(), 0),
      baked_(grid_.count(), 0) {
    lamp_.direction_object = glm::normalize(lamp.direction_object);
}

Result<void> SurfaceLight::set_lamp(const Lamp& lamp) {
    const double length = glm::length(lamp.direction_object);
    if (!std::isfinite(length) || length == 0.0) {
        return fail("lamp", "its direction has no length", "give a direction towards the lamp");
    }
    if (!(lamp.tangent >= 0.002 && lamp.tangent <= 0.5)) {
        return fail("lamp", "the tangent of half its angle is not within 0.002 to 0.5", "the sky's sun has 0.0047");
    }
    const Lamp unit{lamp.direction_object / length, lamp.tangent};
    if (unit == lamp_) return {};
    lamp_ = unit;
    for (std::uint32_t t = 0; t < meshes_.size(); ++t) need(t, kSun);
    return {};
}

void SurfaceLight::need(std::uint32_t tile, std::uint8_t what) {
    if (meshes_[tile] == nullptr) return;
    if (needs_[tile] == 0) ++pending_;
    needs_[tile] |= what;
}

void SurfaceLight::follow(const Solid& solid, const Surface& surface, WorkerPool& pool) {
    std::vector<std::uint32_t> every;
    if (!followed_) {
        every.resize(meshes_.size());
        std::iota(every.begin(), every.end(), 0u);
        followed_ = true;
    }
    const std::span<const std::uint32_t> changed =
        every.empty() ? surface.changed_tiles() : std::span(std::as_const(every));
    std::vector<std::optional<NodeBox>> boxes(changed.size());
    std::vector<std::uint8_t> was_full(changed.size());
    pool.run(changed.size(), [&](std::size_t i) {
        was_full[i] = occupancy_.state(changed[i]) == Occupancy::Tile::full;
        boxes[i] = occupancy_.update(changed[i], solid, surface.shared_tile(changed[i]).get());
    });
    take_meshes(surface, changed, pool);
    std::optional<NodeBox> all;
    for (std::size_t i = 0; i < changed.size(); ++i) {
        if (!boxes[i]) continue;
        const bool is_full = occupancy_.state(changed[i]) == Occupancy::Tile::full;
        full_tiles_changed_ |= is_full != (was_full[i] != 0);
        clearance_.mark(*boxes[i]);
        if (all) {
            all->include(*boxes[i]);
        } else {
            all = boxes[i];
        }
    }
    if (!all) return;
    need_open_near(*all);
    need_sun_behind(*all);
    inner_boxes_.keep_true(occupancy_);
}

void SurfaceLight::take_meshes(const Surface& surface, std::span<const std::uint32_t> changed, WorkerPool& pool) {
    pool.run(changed.size(), [&](std::size_t i) {
        const std::uint32_t t = changed[i];
        const std::shared_ptr<const TileMesh>& mesh = surface.shared_tile(t);
        std::shared_ptr<TileLight> light;
        if (mesh != nullptr) {
            light = std::make_shared<TileLight>();
            light->vertices = carried_over(*mesh, meshes_[t].get(), lights_[t].get());
        }
        meshes_[t] = mesh;
        lights_[t] = std::move(light);
    });
    for (const std::uint32_t t : changed) {
        if (meshes_[t] == nullptr && needs_[t] != 0) {
            needs_[t] = 0;
            --pending_;
        }
        need(t, kOpen | kSun | kNewMesh);
    }
}

void SurfaceLight::need_open_near(const NodeBox& changed) {
    const NodeBox reached = changed.grown(kOpenReach + kVertexMargin);
    std::array<int, 3> from{}, to{};
    for (std::size_t a = 0; a < 3; ++a) {
        from[a] = std::max(reached.lo[a], 0) / kTileCells;
        to[a] = std::min(std::max(reached.hi[a], 0) / kTileCells, grid_.tiles[a] - 1);
    }
    for (int z = from[2]; z <= to[2]; ++z)
        for (int y = from[1]; y <= to[1]; ++y)
            for (int x = from[0]; x <= to[0]; ++x) need(grid_.index(x, y, z), kOpen);
}

void SurfaceLight::need_sun_behind(const NodeBox& changed) {
    const NodeBox passed = changed.grown(Clearance::kReach + Clearance::kBlur + 1);
    for (std::uint32_t t = 0; t < meshes_.size(); ++t) {
        if (meshes_[t] == nullptr || (needs_[t] & kSun) != 0) continue;
        NodeBox tile{grid_.first_node(t), grid_.first_node(t)};
        for (int& hi : tile.hi) hi += kTileCells;
        // Rays start one cell off the surface.
        if (shades(passed, tile.grown(kVertexMargin + 1), lamp_.direction_object, lamp_.tangent)) need(t, kSun);
    }
}

std::vector<SurfaceLight::Waiting> SurfaceLight::next_to_bake(const Vec3& near_object, std::size_t most) const {
    const Vec3 near = (near_object - lattice_.origin_object) / (lattice_.spacing_m * kTileCells);
    std::vector<Waiting> waiting;
    waiting.reserve(pending_);
    for (std::uint32_t t = 0; t < needs_.size(); ++t) {
        if (needs_[t] == 0) continue;
        const std::array<int, 3> at = grid_.position(t);
        const Vec3 way = Vec3(at[0], at[1], at[2]) + 0.5 - near;
        waiting.push_back({(needs_[t] & kNewMesh) == 0, glm::dot(way, way), t});
    }
    const std::size_t count = std::min(most, waiting.size());
    std::ranges::partial_sort(waiting, waiting.begin() + static_cast<std::ptrdiff_t>(count));
    waiting.resize(count);
    return waiting;
}

void SurfaceLight::bake(std::uint32_t tile) {
    auto light = std::make_shared<TileLight>(*lights_[tile]);
    if ((needs_[tile] & kOpen) != 0) bake_open(clearance_, lattice_, *meshes_[tile], light->vertices);
    if ((needs_[tile] & kSun) != 0) bake_sun(clearance_, lattice_, *meshes_[tile], lamp_, light->vertices);
    lights_[tile] = std::move(light);
}

std::size_t SurfaceLight::step(const Vec3& near_object, std::size_t most_tiles, WorkerPool& pool) {
    ++steps_;
    if (full_tiles_changed_ && (boxes_found_at_ == 0 || steps_ - boxes_found_at_ >= kStepsBetweenBoxes)) {
        inner_boxes_.find(occupancy_);
        boxes_found_at_ = steps_;
        full_tiles_changed_ = false;
    }
    if (pending_ == 0 || most_tiles == 0) return 0;
    clearance_.refresh(occupancy_, pool);
    const std::vector<Waiting> now = next_to_bake(near_object, most_tiles);
    pool.run(now.size(), [&](std::size_t i) { bake(now[i].tile); });
    for (const Waiting& done : now) {
        needs_[done.tile] = 0;
        baked_[done.tile] = 1;
    }
    pending_ -= now.size();
    return now.size();
}

std::vector<std::uint32_t> SurfaceLight::take_baked() {
    std::vector<std::uint32_t> baked;
    for (std::uint32_t t = 0; t < baked_.size(); ++t) {
        if (baked_[t] != 0) baked.push_back(t);
        baked_[t] = 0;
    }
    return baked;
}

std::size_t SurfaceLight::bytes() const {
    std::size_t bytes = occupancy_.bytes() + clearance_.bytes();
    for (const auto& light : lights_) {
        if (light != nullptr) bytes += sizeof(TileLight) + light->vertices.capacity() * sizeof(geometry::VertexLight);
    }
    return bytes;
}

}  // namespace burin::compute
