// SPDX-License-Identifier: MIT
#include "compute/light/tile_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "shaders/shared/octahedral.h"

namespace burin::compute {
namespace {

// Distance of a ray's start from the surface, in cells: large enough that the corners of its first cell are outside.
constexpr float kStart = 1.0f;
// A node's clearance counts from the nearest node inside, and the surface lies half a cell nearer on average.
constexpr float kHalfCell = 0.5f;
// Clearance below this is material: with the blur (clearance.hpp), a sheet of two nodes has a quarter in it, and no
// lookup may miss it.
constexpr float kHit = 0.45f;
// Error of the vertices and normals of a plane, in cells: 2^-12 and 24 * 6e-5 (octahedral.h).
constexpr float kSlack = 0.05f;
// Beyond this width the clearance only states "far".
constexpr float kWidest = Clearance::kReach - kHalfCell - kSlack;
constexpr float kFirst = 0.5f;  // distance along the ray of the first lookup
// Step as a share of the clearance: less than all of it, so that the nearest pass is sampled well.
constexpr float kStep = 0.9f;
// Part of the least step that grows with the cone, as a share of its width: what a wide cone just misses with one step
// it sees with the next.
constexpr float kStepOfCone = 0.4f;
constexpr float kBlurGrowth = 0.35f;
// Shadows of near objects are no sharper than the lattice; otherwise its steps would show in them.
constexpr float kSunBlur = 1.25f;
// Cosine to the normal below which a direction is ignored: its cone stays narrow, so it detects little, and late.
constexpr float kLowest = 0.08f;
constexpr float kShortestStep = 0.6f;  // in cells; no node inside fits between two lookups this near each other

struct Cone {
    Vec3f direction;    // unit
    Vec3f one_over;     // reciprocals of the components; large where they are 0
    float tangent = 0;  // tangent of half the cone's angle
};

Cone cone_of(const Vec3& direction, double tangent) {
    Cone cone{Vec3f(direction), {}, static_cast<float>(tangent)};
    for (int a = 0; a < 3; ++a) {
        const float d = cone.direction[a];
        cone.one_over[a] = std::abs(d) < 1e-9f ? std::copysign(1e9f, d) : 1.0f / d;
    }
    return cone;
}

// The region where the clearance may be looked up.
struct Bounds {
    Vec3f lo, hi;
};

Bounds bounds_of(const Lattice& lattice) {
    // The last cell's upper nodes are read with it, hence the region ends just below the lattice's upper faces.
    const Vec3f cells(lattice.cells[0], lattice.cells[1], lattice.cells[2]);
    return {Vec3f(0.0f), cells - Vec3f(1.0f / 1024.0f)};
}

struct Stretch {
    float from, to;
};
// Returns the part of a ray within the bounds; none when from > to.
[[gnu::always_inline]] inline Stretch within(const Bounds& bounds, const Vec3f& start, const Cone& cone, float range) {
    const Vec3f a = (bounds.lo - start) * cone.one_over, b = (bounds.hi - start) * cone.one_over;
    const Vec3f enters = glm::min(a, b), leaves = glm::max(a, b);
    return {std::max({enters.x, enters.y, enters.z, kFirst}), std::min({leaves.x, leaves.y, leaves.z, range})};
}

// Rays that step through the clearance side by side: each step of a ray depends on its last lookup, and meanwhile the
// processor works on the others.
class Rays {
public:
    static constexpr std::size_t kMost = kOpenDirections;

    Rays(const Clearance& clearance, const Bounds& bounds) : clearance_(clearance), bounds_(bounds) {}

    // Adds a ray from `start`, which is above the tangent plane by kStart at its start and by `rise` more per cell of
    // its way.
    void begin(const Vec3f& start, const Cone& cone, float rise, float range, float weight) {
        const Stretch ray = within(bounds_, start, cone, range);
        if (ray.from < ray.to)
            rays_[count_++] = {start, cone.direction, ray.from, ray.to, cone.tangent, rise, weight, 0.0f};
    }
    // Runs all rays and returns the sum of the cones' weights times the share of each that is blocked; a hit counts
    // fade(its distance), which must not increase. `blur` makes cones wider by up to that much, in cells, from a few
    // cells on.
    template <typename Fade>
    [[nodiscard]] float blocked(float blur, Fade&& fade) {
        float sum = 0.0f;
        for (std::size_t left = count_; left > 0;) {
            std::size_t still = 0;
            for (std::size_t i = 0; i < left; ++i) {
                Ray& ray = rays_[i];
                if (step(ray, blur, fade)) {
                    if (still != i) rays_[still] = ray;
                    ++still;
                } else {
                    sum += ray.weight * ray.most;
                }
            }
            left = still;
        }
        count_ = 0;
        return sum;
    }

private:
    struct Ray {
        Vec3f start, direction;
        float t, to;
        float tangent, rise, weight;
        float most;  // largest share blocked so far
    };

    // Returns false when the ray is finished.
    template <typename Fade>
    [[gnu::always_inline]] inline bool step(Ray& ray, float blur, Fade&& fade) const {
        const float t = ray.t;
        const float clear = clearance_.at(ray.start + ray.direction * t);
        const float cone = ray.tangent * t + (blur > 0.0f ? std::min(kBlurGrowth * t, blur) : 0.0f);
        const float above_plane = kStart - kHalfCell - kSlack + ray.rise * t;
        const float width = std::min(std::min(cone, above_plane), kWidest) + kHalfCell;
        if (clear < width) {
            const float share = std::min((width - clear) / (width - kHit), 1.0f), counts = fade(t);
            ray.most = std::max(ray.most, share * counts);
            if (ray.most >= counts) return false;  // nothing farther away can count for more
        }
        ray.t += std::max(clear * kStep, kShortestStep + kStepOfCone * cone);
        return ray.t < ray.to;
    }

    const Clearance& clearance_;
    const Bounds& bounds_;
    std::array<Ray, kMost> rays_;
    std::size_t count_ = 0;
};

struct Place {
    Vec3f start, normal;
};
Place place_in_cells(const shared::SurfaceVertex& vertex, float cells_per_m) {
    const shared::Direction n = shared::decode_normal(vertex.normal);
    const Vec3f normal(n.x, n.y, n.z);
    return {Vec3f(vertex.x, vertex.y, vertex.z) * cells_per_m + normal * kStart, normal};
}

std::uint8_t code_of(float share) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0f, 1.0f) * 255.0f));
}

// Returns even directions over the sphere: a spiral from pole to pole that turns by the golden angle (Vogel's, on the
// sphere). The axis is tilted out of the lattice's directions, in which edges lie.
std::array<Cone, kOpenDirections> open_cones() {
    std::array<Cone, kOpenDirections> cones;
    const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
    const Vec3 axis = glm::normalize(Vec3(0.27, 0.85, 0.46));
    const Vec3 side = glm::normalize(glm::cross(axis, Vec3(1.0, 0.0, 0.0))), third = glm::cross(axis, side);
    // A disc with the share of the sphere that one direction stands for has the sine 2 / sqrt(n) (4 pi / n = pi sin^2).
    // The cones get three quarters of that: what just enters a cone darkens it, so wide ones would see less of the sky
    // than there is.
    const double sine = 1.5 / std::sqrt(kOpenDirections);
    for (int i = 0; i < kOpenDirections; ++i) {
        const double height = 1.0 - (2.0 * i + 1.0) / kOpenDirections, radius = std::sqrt(1.0 - height * height);
        const double turn = golden_angle * i;
        cones[static_cast<std::size_t>(i)] =
            cone_of(axis * height + (side * std::cos(turn) + third * std::sin(turn)) * radius, sine);
    }
    return cones;
}

constexpr std::size_t kSunCones = 7;

std::array<Cone, kSunCones> sun_cones(const Lamp& lamp) {
    const Vec3 middle = glm::normalize(lamp.direction_object);
    const Vec3 least = glm::abs(middle.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 side = glm::normalize(glm::cross(middle, least)), third = glm::cross(middle, side);
    std::array<Cone, kSunCones> cones;
    cones[0] = cone_of(middle, lamp.tangent / 3.0);
    for (std::size_t i = 1; i < kSunCones; ++i) {
        // Turned a little, so that no edge along the lattice passes two of them at once.
        const double turn = std::numbers::pi / 3.0 * static_cast<double>(i) + 0.2;
        const Vec3 around = side * std::cos(turn) + third * std::sin(turn);
        cones[i] = cone_of(glm::normalize(middle + around * (lamp.tangent * 2.0 / 3.0)), lamp.tangent / 3.0);
    }
    return cones;
}

// Returns the share of a cone above the horizon.
float above_horizon(float rise, float tangent) { return std::clamp(0.5f + 0.5f * rise / tangent, 0.0f, 1.0f); }

float sun_at(Rays& rays, const Place& place, const Cone& all, const std::array<Cone, kSunCones>& parts) {
    const auto every_hit = [](float) { return 1.0f; };
    constexpr float kFar = std::numeric_limits<float>::max();
    const float rise = glm::dot(place.normal, all.direction);
    if (rise <= -all.tangent) return 0.0f;
    const bool risen = rise >= all.tangent;
    if (risen) {  // usually the whole lamp is visible then
        rays.begin(place.start, all, rise, kFar, 1.0f);
        if (rays.blocked(kSunBlur, every_hit) == 0.0f) return 1.0f;
    }
    float seen = 0.0f;
    for (const Cone& part : parts) {
        const float part_rise = glm::dot(place.normal, part.direction);
        const float above = risen ? 1.0f : above_horizon(part_rise, part.tangent);
        if (above == 0.0f) continue;
        seen += above;
        rays.begin(place.start, part, std::max(part_rise, 0.0f), kFar, above);
    }
    return (seen - rays.blocked(kSunBlur, every_hit)) / kSunCones;
}

float open_at(Rays& rays, const Place& place, const std::array<Cone, kOpenDirections>& cones) {
    float all = 0.0f;
    for (const Cone& cone : cones) {
        const float rise = glm::dot(place.normal, cone.direction);
        if (rise <= kLowest) continue;
        all += rise - kLowest;
        rays.begin(place.start, cone, rise, kOpenRange, rise - kLowest);
    }
    return 1.0f - rays.blocked(0.0f, open_fade) / all;
}

}  // namespace

void bake_open(const Clearance& clearance, const Lattice& lattice, const geometry::SurfaceTile& tile,
               std::span<geometry::VertexLight> light) {
    static const std::array<Cone, kOpenDirections> cones = open_cones();
    const Bounds bounds = bounds_of(lattice);
    Rays rays(clearance, bounds);
    const auto cells_per_m = static_cast<float>(1.0 / lattice.spacing_m);
    for (std::size_t i = 0; i < tile.vertices.size(); ++i) {
        light[i].open = code_of(open_at(rays, place_in_cells(tile.vertices[i], cells_per_m), cones));
    }
}

void bake_sun(const Clearance& clearance, const Lattice& lattice, const geometry::SurfaceTile& tile, const Lamp& lamp,
              std::span<geometry::VertexLight> light) {
    const std::array<Cone, kSunCones> parts = sun_cones(lamp);
    const Cone all = cone_of(glm::normalize(lamp.direction_object), lamp.tangent);
    const Bounds bounds = bounds_of(lattice);
    Rays rays(clearance, bounds);
    const auto cells_per_m = static_cast<float>(1.0 / lattice.spacing_m);
    for (std::size_t i = 0; i < tile.vertices.size(); ++i) {
        light[i].sun = code_of(sun_at(rays, place_in_cells(tile.vertices[i], cells_per_m), all, parts));
    }
}

}  // namespace burin::compute
