// SPDX-License-Identifier: MIT
// Lists of ends for some of a solid's rays, and the record of how an update changed rays. A batch describes what a tool
// covers or the ends that rays are to hold; from the record the surface is updated and strokes are undone.
// Plain data; the ends of one ray are sorted, strictly increasing and even in number, as in a solid
// (shaders/shared/dexel.h).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compute/rays/dexel_set.hpp"
#include "compute/rays/lattice.hpp"
#include "shaders/shared/cut_job.h"
#include "shaders/shared/dexel.h"

namespace burin::compute {

// Identifies a ray by its axis and position; index() is its index in the DexelSet of that axis.
struct RayPlace {
    int axis = 0, u = 0, v = 0;
    [[nodiscard]] std::size_t index(const Lattice& lattice) const {
        return static_cast<std::size_t>(v) * static_cast<std::size_t>(lattice.rays_u(axis)) +
               static_cast<std::size_t>(u);
    }
    [[nodiscard]] std::uint32_t code() const { return shared::ray_code(axis, u, v); }
};
[[nodiscard]] inline RayPlace place_of(std::uint32_t ray_code) {
    return {shared::axis_of(ray_code), shared::u_of(ray_code), shared::v_of(ray_code)};
}

struct RayBatch {
    struct Ray {
        std::uint32_t code = 0;  // shared::ray_code(axis, u, v)
        std::uint32_t first = 0, count = 0;
    };
    std::vector<Ray> rays;               // each ray at most once
    std::vector<shared::DexelEnd> ends;  // of all rays, one ray after the other

    [[nodiscard]] std::span<const shared::DexelEnd> ends_of(const Ray& ray) const {
        return std::span(ends).subspan(ray.first, ray.count);
    }
    void add(std::uint32_t code, std::span<const shared::DexelEnd> ray_ends) {
        rays.push_back({code, static_cast<std::uint32_t>(ends.size()), static_cast<std::uint32_t>(ray_ends.size())});
        ends.insert(ends.end(), ray_ends.begin(), ray_ends.end());
    }
};

// Record of the changes to rays since it was last taken: one entry for each change, those of one ray in order of time.
// `first` and `count` of an entry say which elements of `before` the ray held before that change; changed_lo and
// changed_hi are depths between which its intervals, normals or materials differ.
struct Changes {
    std::vector<shared::ChangedRay> rays;
    std::vector<shared::DexelEnd> before;

    [[nodiscard]] bool empty() const { return rays.empty(); }
    [[nodiscard]] std::span<const shared::DexelEnd> before_of(const shared::ChangedRay& ray) const {
        return std::span(before).subspan(ray.first, ray.count);
    }
    // Records that the ray, which holds `ends`, is about to change between the two depths.
    void record(const RayPlace& place, int changed_lo, int changed_hi, std::span<const shared::DexelEnd> ends) {
        rays.push_back({place.code(), static_cast<std::uint32_t>(before.size()),
                        static_cast<std::uint32_t>(ends.size()), changed_lo, changed_hi});
        // A loop is faster than one call of insert here, as most rays have two ends.
        for (const shared::DexelEnd& end : ends) before.push_back(end);
    }
    void append(const Changes& later);
    // Returns all changes and leaves an empty record with the same capacity reserved, since successive updates are of
    // similar size.
    [[nodiscard]] Changes take();
};

// Replaces the ends of a ray and records what it held. Returns false, and records nothing, when the ends are the same.
bool assign_ray(DexelSet& set, const RayPlace& place, std::span<const shared::DexelEnd> ends, Changes& changes);

}  // namespace burin::compute
