// SPDX-License-Identifier: MIT
// How a ball that presses one place of a body of elements is borne there, so that ball and body together follow Hertz.
//
// Elements cannot show a dent that is smaller than themselves: a mesh gives by a fixed compliance c where a point
// presses it, while a body gives by d = (F / H)^(2/3), H = 4/3 E* sqrt(r), to a ball (Hertz 1881; Johnson 1985,
// "Contact Mechanics", eq. 4.23): the more, in proportion, the less it is pressed. So the contact itself gives by what
// the mesh lacks,
//   depth = (F / H)^(2/3) - c F,
// until it would be stiffer than its bound; from there on it is a spring, and the mesh tells.
// Units: SI. Pure; any thread. + - * / and sqrt alone.
#pragma once

namespace burin::bodies {

struct DentForce {
    double force_N = 0.0, slope_N_per_m = 0.0;  // slope: with the depth
};

struct DentLaw {
    double stiffest_N_per_m = 0.0;
    double hertz_N_per_m32 = 0.0;  // H; 0: a spring of the bound from the first touch
    double mesh_m_per_N = 0.0;     // c

    // Returns 0 outside, where depth_m is 0 or less.
    [[nodiscard]] DentForce at(double depth_m) const noexcept;
};

}  // namespace burin::bodies
