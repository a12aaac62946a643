// SPDX-License-Identifier: MIT
// Set algebra of rays, exact, because depths are whole numbers that are only compared: of the intervals that one ray
// holds (a) and those that a tool or another solid covers of it (b), and of two solids, ray by ray.
//
// The rays' arguments are lists of ends of one ray (shaders/shared/dexel.h): sorted, strictly increasing and even in
// number; an interval is the depths lo <= d < hi. The same holds for every result. An end of `a` that still bounds the
// result keeps its normal and material, even where an end of `b` coincides with it. A new end appears only where a
// border of `b` bounds the result. shaders/shared/span_edit.h applies the same rules to one span at a time, so a tool
// gives the same bits either way.
// Therefore (a - b) - b = a - b to the bit, and a - b and the intersection of a and b together hold exactly what a
// held.
#pragma once

#include <span>
#include <vector>

#include "base/worker_pool.hpp"
#include "compute/rays/solid.hpp"
#include "shaders/shared/dexel.h"

namespace burin::compute {

using RayEnds = std::span<const shared::DexelEnd>;

// Each of these functions appends its result to `to`, in time linear in the number of ends.

// Appends a - b, a cut. New ends take b's material and the opposite of b's normal, since the material that is left lies
// outside b.
void append_difference(RayEnds a, RayEnds b, std::vector<shared::DexelEnd>& to);
// Appends the union of a and b, a fill. New ends are those of b. Intervals that touch are joined.
void append_union(RayEnds a, RayEnds b, std::vector<shared::DexelEnd>& to);
// Appends the intersection of a and b. New ends are those of b.
void append_intersection(RayEnds a, RayEnds b, std::vector<shared::DexelEnd>& to);
// Appends the ends of a. Those at lo <= d <= hi of an interval of b take the material of that interval's lower end.
void append_painted(RayEnds a, RayEnds b, std::vector<shared::DexelEnd>& to);

[[nodiscard]] bool same_ends(RayEnds a, RayEnds b);

enum class Combination { unite, subtract, intersect };

// Returns the union, the difference a - b or the intersection of two solids, which may be empty. The result's materials
// are those of a, followed by those of b that a lacks; each end keeps the material of the solid it comes from. Where
// faces of both coincide, the end of a is kept. Fails when the lattices differ, or when the solids have more than 255
// materials together. The result does not depend on the number of threads.
[[nodiscard]] Result<Solid> combine(const Solid& a, const Solid& b, Combination operation, WorkerPool& pool);

}  // namespace burin::compute
