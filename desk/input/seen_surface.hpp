// SPDX-License-Identifier: MIT
// The carved surface as the frames know it, for what the mouse points at: where a ray meets it, and which way it faces
// around there.
//
// Data flow: SurfaceUpdate (the tiles that changed, never to change again) -> take() -> first_hit() and the rest. A
// copy shares the tiles and costs no more than a pointer: what is taken later changes the original alone. So a stroke
// keeps the surface as it was when it began (surface_hand.hpp), and a replay, whose frames take the same updates as the
// recorded ones did, finds the same bits.
// Frame: object, metres. Thread: one for each copy. Cost of a ray: a test of the box of each tile that has a surface,
// and of each triangle of the few tiles whose boxes it meets before the surface: 10 to 60 us at 256 cells.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/space.hpp"
#include "compute/mesher/tile_grid.hpp"
#include "scene/surface_update.hpp"

namespace burin::session {

struct Ray {
    Vec3 origin{0.0};
    Vec3 direction{0.0, 0.0, -1.0};  // unit
};

struct SurfaceHit {
    Vec3 place_object_m{0.0};
    Vec3 normal_object{0.0};  // of the triangle; unit, out of the material
    double distance_m = 0.0;  // from the ray's origin
};

class SeenSurface {
public:
    // Knows nothing: no ray hits.
    SeenSurface() = default;
    explicit SeenSurface(const compute::Lattice& lattice);

    // Takes over the tiles that changed.
    void take(const scene::SurfaceUpdate& update);

    // Returns where a ray first meets a triangle that faces it; nothing where it passes by.
    [[nodiscard]] std::optional<SurfaceHit> first_hit(const Ray& ray_object) const;
    // Returns which way the surface faces around a place, unit: the mean of the triangles within the radius that face
    // as `towards` does within 80 degrees, weighted by area and nearness. Falls off to nothing at the radius, so that
    // it turns evenly where the place moves on. The radius counts as 1.5 cells at least and 24 at most. `towards` where
    // there is none.
    [[nodiscard]] Vec3 facing_around(const Vec3& place_object_m, double radius_m, const Vec3& towards) const;
    // Returns how far its lowest point is along a direction from the object's origin; nothing where there is none.
    // Looks at the vertices of the few tiles whose boxes reach down so far.
    [[nodiscard]] std::optional<double> lowest_along_m(const Vec3& up_object) const;
    // Returns whether no triangle is nearer to a place than the radius.
    [[nodiscard]] bool has_room(const Vec3& middle_object_m, double radius_m) const;

private:
    struct Tiles {
        std::vector<std::shared_ptr<const geometry::SurfaceTile>> of_grid;  // null: no surface
        std::vector<std::uint32_t> with_surface;                            // rising
    };
    [[nodiscard]] Box box_of(std::uint32_t tile) const;  // relative to the lattice's origin

    compute::Lattice lattice_;
    std::shared_ptr<Tiles> tiles_;  // written by take() where no copy shares them
};

}  // namespace burin::session
