// SPDX-License-Identifier: MIT
// The deformations of the third paper (Popescu, Burdea, Bouzit 1999, "Virtual Reality Simulation Modeling for a Haptic
// Glove", section 3.3), for comparison with a body that is solved: as they are printed, and corrected.
//
//   global  (G7) places, normals and colours between those of an open and of a closed hand, by the fingers' angles
//   local   (G8) a vertex near a point of the finger moves by D = max over points m of k max(0, <P - P_m, N>) along -N,
//           k = 1 - (|P - P_m| / radius)^2
//   elastic, plastic (G9) the reference stays, or is what the frame before has left
// Printed so, a finger above a curved body dents it before it touches, since beside it the surface falls away from the
// tangent; and a finger that rests in plastic bodies digs on with every frame, until all within the radius has come to
// its tangent. Corrected, only points inside act, none deeper than it is; a plastic dent is measured from the surface
// as it was when the contact began; and what is pushed in comes out elsewhere, to first order.
// Units: metres; frame: the body's own. Pure; any thread. Allocates.
#pragma once

#include <span>
#include <vector>

#include "base/space.hpp"

namespace burin::bodies {

// A surface as the paper's models see it: vertices alone. Requires unit normals out of the body and as many of each.
struct PaperSurface {
    std::vector<Vec3> places_m, normals;
    std::vector<double> areas_m2;  // of each vertex
};

// Returns the share by which a hand is closed, 0 to 1: the sum of its angles over the largest that there is.
[[nodiscard]] double closed_share(std::span<const double> angles_rad, double largest_sum_rad);
// Returns what lies at that share from open to closed: of places, colours, or normals, which are made unit ones.
[[nodiscard]] std::vector<Vec3> between(std::span<const Vec3> open, std::span<const Vec3> closed, double share);
[[nodiscard]] std::vector<Vec3> normals_between(std::span<const Vec3> open, std::span<const Vec3> closed, double share);

enum class PaperForm { printed, corrected };

// Returns how far each vertex moves along its normal, inwards. The radius of influence is the largest side of the
// fingertip's bounding box.
[[nodiscard]] std::vector<double> dents_m(const PaperSurface& surface, std::span<const Vec3> points_m, double radius_m,
                                          PaperForm form);
// Returns the surface dented so; corrected, with the rest of it moved outwards by the volume that was pushed in.
// Normals stay.
[[nodiscard]] PaperSurface dented(const PaperSurface& surface, std::span<const double> dents_m, PaperForm form);

// A plastic body, a frame at a time.
struct PaperPutty {
    PaperSurface reference;
    std::vector<double> dents_m;  // corrected: of the contact under way; empty: there is none
    [[nodiscard]] PaperSurface shape(PaperForm form) const;
};
[[nodiscard]] PaperPutty step_putty_of_paper(PaperPutty putty, std::span<const Vec3> points_m, double radius_m,
                                             PaperForm form);

}  // namespace burin::bodies
