// SPDX-License-Identifier: MIT
#include "desk/input/seen_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/contact/tile_block.hpp"
#include "geometry/mesh/triangle_tree.hpp"

namespace burin::session {
namespace {

// Of the length of a triangle's edges: by so much a ray may pass an edge and still hits, so that none slips between two
// triangles by rounding.
constexpr double kEdge = 1e-9;
// The least cosine between directions that count as the same side of a wall: 80 degrees.
constexpr double kSameSide = 0.17;
// In cells: a radius below sees too few triangles, one beyond too many for the many rays of a frame.
constexpr double kLeastAround = 1.5, kMostAround = 24.0;

struct Span {
    double from = 0.0, to = 0.0;
};

// Returns the distances between which a ray is in a box; to < from where it is not.
Span within(const Box& box, const Ray& ray) {
    Span span{0.0, std::numeric_limits<double>::infinity()};
    for (int axis = 0; axis < 3; ++axis) {
        const double d = ray.direction[axis], o = ray.origin[axis];
        if (d == 0.0) {
            if (o < box.lo[axis] || o > box.hi[axis]) return {1.0, 0.0};
            continue;
        }
        const double a = (box.lo[axis] - o) / d, b = (box.hi[axis] - o) / d;
        span.from = std::max(span.from, std::min(a, b));
        span.to = std::min(span.to, std::max(a, b));
    }
    return span;
}

geometry::Triangle triangle_of(const geometry::SurfaceTile& tile, std::size_t i) {
    const auto corner = [&](std::size_t k) { return Vec3(geometry::place_of(tile.vertices[tile.indices[3 * i + k]])); };
    return {corner(0), corner(1), corner(2)};
}

// Moeller and Trumbore 1997. Returns the distance at which a ray meets the front of a triangle.
std::optional<double> met(const geometry::Triangle& t, const Ray& ray) {
    const Vec3 ab = t.b - t.a, ac = t.c - t.a, across = glm::cross(ray.direction, ac);
    const double det = glm::dot(ab, across);
    if (!(det > 0.0)) return std::nullopt;
    const Vec3 from_a = ray.origin - t.a;
    const double u = glm::dot(from_a, across), least = -kEdge * det;
    if (u < least || u > det - least) return std::nullopt;
    const Vec3 q = glm::cross(from_a, ab);
    const double v = glm::dot(ray.direction, q);
    if (v < least || u + v > det - least) return std::nullopt;
    const double distance_m = glm::dot(ac, q) / det;
    return distance_m >= 0.0 ? std::optional(distance_m) : std::nullopt;
}

}  // namespace

SeenSurface::SeenSurface(const compute::Lattice& lattice) : lattice_(lattice), tiles_(std::make_shared<Tiles>()) {
    tiles_->of_grid.resize(compute::TileGrid(lattice).count());
}

void SeenSurface::take(const scene::SurfaceUpdate& update) {
    if (!tiles_ || update.tiles.empty()) return;
    if (tiles_.use_count() > 1) tiles_ = std::make_shared<Tiles>(*tiles_);
    bool came_or_went = false;
    for (const scene::TileUpdate& changed : update.tiles) {
        auto& tile = tiles_->of_grid.at(changed.tile);
        came_or_went = came_or_went || (tile == nullptr) != (changed.surface == nullptr);
        tile = changed.surface;
    }
    if (!came_or_went) return;
    tiles_->with_surface.clear();
    for (std::uint32_t i = 0; i < tiles_->of_grid.size(); ++i)
        if (tiles_->of_grid[i] != nullptr) tiles_->with_surface.push_back(i);
}

Box SeenSurface::box_of(std::uint32_t tile) const {
    return geometry::box_of_tile(lattice_.spacing_m, compute::TileGrid(lattice_).first_node(tile));
}

std::optional<SurfaceHit> SeenSurface::first_hit(const Ray& ray_object) const {
    if (!tiles_) return std::nullopt;
    const Ray ray{ray_object.origin - lattice_.origin_object, ray_object.direction};
    std::vector<std::pair<double, std::uint32_t>> on_the_way;
    for (const std::uint32_t tile : tiles_->with_surface)
        if (const Span span = within(box_of(tile), ray); span.from <= span.to) on_the_way.emplace_back(span.from, tile);
    std::ranges::sort(on_the_way);
    double nearest_m = std::numeric_limits<double>::infinity();
    SurfaceHit hit;
    for (const auto& [from_m, number] : on_the_way) {
        if (from_m > nearest_m) break;
        const geometry::SurfaceTile& tile = *tiles_->of_grid[number];
        for (std::size_t i = 0; i < tile.triangles(); ++i) {
            const geometry::Triangle t = triangle_of(tile, i);
            const auto distance_m = met(t, ray);
            if (!distance_m || *distance_m >= nearest_m) continue;
            nearest_m = *distance_m;
            hit.normal_object = glm::normalize(glm::cross(t.b - t.a, t.c - t.a));
        }
    }
    if (!std::isfinite(nearest_m)) return std::nullopt;
    hit.distance_m = nearest_m;
    hit.place_object_m = ray_object.origin + nearest_m * ray_object.direction;
    return hit;
}

std::optional<double> SeenSurface::lowest_along_m(const Vec3& up_object) const {
    if (!tiles_) return std::nullopt;
    std::vector<std::pair<double, std::uint32_t>> from_below;
    for (const std::uint32_t tile : tiles_->with_surface) {
        const Box box = box_of(tile);
        const Vec3 half = 0.5 * box.extent();
        from_below.emplace_back(glm::dot(box.center(), up_object) - glm::dot(half, glm::abs(up_object)), tile);
    }
    std::ranges::sort(from_below);
    double lowest_m = std::numeric_limits<double>::infinity();
    for (const auto& [bound_m, number] : from_below) {
        if (bound_m >= lowest_m) break;
        for (const auto& vertex : tiles_->of_grid[number]->vertices)
            lowest_m = std::min(lowest_m, glm::dot(Vec3(geometry::place_of(vertex)), up_object));
    }
    if (!std::isfinite(lowest_m)) return std::nullopt;
    return lowest_m + glm::dot(lattice_.origin_object, up_object);
}

Vec3 SeenSurface::facing_around(const Vec3& place_object_m, double radius_m, const Vec3& towards) const {
    if (!tiles_) return towards;
    radius_m = std::clamp(radius_m, kLeastAround * lattice_.spacing_m, kMostAround * lattice_.spacing_m);
    const Vec3 place = place_object_m - lattice_.origin_object;
    Vec3 sum(0.0);
    for (const std::uint32_t number : tiles_->with_surface) {
        const Box box = box_of(number);
        const Vec3 outside = glm::max(glm::max(box.lo - place, place - box.hi), Vec3(0.0));
        if (glm::dot(outside, outside) > radius_m * radius_m) continue;
        const geometry::SurfaceTile& tile = *tiles_->of_grid[number];
        for (std::size_t i = 0; i < tile.triangles(); ++i) {
            const geometry::Triangle t = triangle_of(tile, i);
            const Vec3 away = (t.a + t.b + t.c) / 3.0 - place;
            const double nearness = 1.0 - glm::dot(away, away) / (radius_m * radius_m);
            if (nearness <= 0.0) continue;
            const Vec3 area = glm::cross(t.b - t.a, t.c - t.a);
            if (glm::dot(area, towards) < kSameSide * glm::length(area)) continue;
            sum += nearness * nearness * area;
        }
    }
    const double length = glm::length(sum);
    return length > 0.0 ? sum / length : towards;
}

bool SeenSurface::has_room(const Vec3& middle_object_m, double radius_m) const {
    if (!tiles_) return true;
    const Vec3 middle = middle_object_m - lattice_.origin_object;
    for (const std::uint32_t number : tiles_->with_surface) {
        const Box box = box_of(number);
        const Vec3 outside = glm::max(glm::max(box.lo - middle, middle - box.hi), Vec3(0.0));
        if (glm::dot(outside, outside) > radius_m * radius_m) continue;
        const geometry::SurfaceTile& tile = *tiles_->of_grid[number];
        for (std::size_t i = 0; i < tile.triangles(); ++i) {
            const geometry::Triangle t = triangle_of(tile, i);
            const Vec3 away = geometry::nearest_point({t.a, t.b, t.c}, middle) - middle;
            if (glm::dot(away, away) < radius_m * radius_m) return false;
        }
    }
    return true;
}

}  // namespace burin::session
