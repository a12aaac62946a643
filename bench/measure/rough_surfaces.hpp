// SPDX-License-Identifier: MIT
// Generated meshes with detail that is hard to touch: noise and ridges as fine as the triangles, teeth, needles, and a
// machined part in the long thin triangles of a CAD system.
//
// All are closed, two-manifold and turned outwards, about 100 mm in their largest extent unless stated otherwise, in
// metres. The same arguments give the same bits wherever doubles round as IEEE says, since nothing but the four
// operations and the square root is used.
#pragma once

#include <cstdint>

#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::bench {

// Noise of octaves from the longest wave to the shortest, each half as long as the one before. The height of each is
// its wavelength times `slope`, so that the fine ones are as steep as the coarse ones. In every second octave the waves
// end in sharp ridges. On top each vertex is moved by up to `jitter` mean edges.
struct Roughness {
    double slope = 0.12;
    double longest_m = 0.02;
    double shortest_m = 0.0;  // 0: three mean edges
    double jitter = 0.25;
    std::uint64_t seed = 1;
};

// A ball of 100 mm with noise, of about so many triangles.
[[nodiscard]] geometry::TriangleMesh rough_ball(std::size_t triangles, const Roughness& roughness = {});

// A plate of 100 by 100 by 20 mm with noise on both sides, of about so many triangles.
[[nodiscard]] geometry::TriangleMesh rough_plate(std::size_t triangles, const Roughness& roughness = {});

// A file: a plate with saw teeth on both sides, whose backs are steep, crossed by shallower notches. The triangles are
// as long as the teeth and much thinner across them: the back of a tooth is a twelfth of its pitch.
[[nodiscard]] geometry::TriangleMesh file_plate(double pitch_m = 0.0012, double tooth_m = 0.0006);

// A plate of 100 by 60 by 20 mm with holes, countersunk ones, bosses, ribs and slots, in the triangles that join a few
// far corners to round edges of so many sides (a multiple of 8): up to 20 mm long, a few tenths of a millimetre wide.
[[nodiscard]] geometry::TriangleMesh machined_part(std::uint32_t sides = 64);

// A plate of needles: so many in a row and column, 8 mm high, each a pyramid of four sides.
[[nodiscard]] geometry::TriangleMesh needle_comb(std::uint32_t needles = 40);

}  // namespace burin::bench
