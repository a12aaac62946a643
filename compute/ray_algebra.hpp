// SPDX-License-Identifier: MIT
// Set algebra of one ray: what it holds (a) against what a tool or another solid covers of it (b). Exact: depths are whole
// numbers and are compared, never computed.
//
// Both lists are those of a ray (shaders/shared/dexel.h): sorted, strictly increasing, even in number; an interval is the
// depths lo <= d < hi. So is every result. An end of `a` that still bounds the result stays as it is, with its normal and
// material, also where an end of `b` coincides with it; only where a border of `b` bounds the result does a new end appear.
// shaders/shared/span_edit.h does the same for one span at a time, so a tool gives the same bits by either way.
// Therefore (a - b) - b = a - b to the bit, and a - b and a n b hold together exactly what a held.
#pragma once

#include <span>
#include <vector>

#include "shaders/shared/dexel.h"

namespace burin {

using RayEnds = std::span<const shared::DexelEnd>;

// Each appends its result to `to`; linear in the ends.

// a - b, a cut. New ends take b's material and the opposite of b's normal: b's outside is what is left.
void append_difference(RayEnds a, RayEnds b, std::vector<shared::DexelEnd>& to);
// a u b, filling. New ends are b's. Intervals that touch become one.
void append_union(RayEnds a, RayEnds b, std::vector<shared::DexelEnd>& to);
// a n b. New ends are b's.
void append_intersection(RayEnds a, RayEnds b, std::vector<shared::DexelEnd>& to);
// The ends of a, those at lo <= d <= hi of an interval of b with b's material (that of its lower end).
void append_painted(RayEnds a, RayEnds b, std::vector<shared::DexelEnd>& to);

[[nodiscard]] bool same_ends(RayEnds a, RayEnds b);

}  // namespace burin
