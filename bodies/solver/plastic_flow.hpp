// SPDX-License-Identifier: MIT
// Plastic flow: beyond yield the rest shape of each element follows, at its volume.
//
// F = Fe Fp, det Fp = 1: the stress is that of Fe, so an element's energy depends on Fp by the metric M = inverse of
// Fp' Fp alone, through the grams g_i' M g_k; J, and with it the volume, stays F's. With b = F M F' = Fe Fe' the
// Kirchhoff stress has the deviator mu dev b, and von Mises' stress is q = mu sqrt(3/2) |dev b|. Where q is above yield
// the part beyond falls by exp(-dt / relaxes_s) (Perzyna's viscoplasticity, integrated exactly for a strain that is
// kept), and b is mapped back:
//   b' = s dev b + p I,  s = q' / q,  p the largest root of det b' = det b   (after Simo 1992, for a determinant kept)
//   M' = inverse of F . b' . inverse of F' = s M + (p - s tr b / 3) inverse of F' F
// So below yield nothing moves, however long a finger stays: this is no creep. There is no hardening.
//
// Hardest case: a body that is kneaded flat. An element whose rest shape would become worse than kLeastQuality does not
// flow that way: it is elastic from there on, is counted as stopped, and may flow back. One that is squeezed to less
// than kLeastVolume of its own, or inside out, does not flow while it is, so that no inverted shape becomes a rest
// shape.
// Units: SI. Pure in the state; deterministic; no heap. About 0.1 ms for 5,000 elements of which few flow.
#pragma once

#include "bodies/solver/soft_body.hpp"

namespace burin::bodies {

// Of a rest shape, as worst_quality() has it, and of an element's volume over its own at rest.
constexpr double kLeastPlasticQuality = 0.1, kLeastPlasticVolume = 0.1;

// Lets a body flow for a time. Requires a plastic body and a state of it.
void flow(const SoftBody& body, SoftState& state, double dt_s);

// Gives a plastic body's elements the rest shapes of these metrics, one for each; none counts as stopped.
void take_rest_shapes(const SoftBody& body, SoftState& state, std::span<const glm::dmat3> metrics);

// Sets the places to which a plastic body's corners are drawn (SoftStepInput::held_at_m) to where the corners are, but
// for the rigid motion that all that are held have made since the beginning. So springs hold where the body is and how
// it is turned, and do not draw it back into the shape that it had.
void follow_shape(const SoftBody& body, const SoftState& state, std::span<const double> holds_N_per_m,
                  std::span<Vec3> held_at_m);

// Returns von Mises' stress of each element, Pa (Kirchhoff's: over the volume at rest).
[[nodiscard]] std::vector<double> stresses_of(const SoftBody& body, const SoftState& state);
// Returns the worst quality of the elements' rest shapes now.
[[nodiscard]] double worst_rest_quality(const SoftBody& body, const SoftState& state);

}  // namespace burin::bodies
