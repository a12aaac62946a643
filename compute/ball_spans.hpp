// SPDX-License-Identifier: MIT
// A resting ball against a row of rays, several rays at a time: the same whole depths as shaders/shared/capsule.h gives.
//
// Doubles are exact here: squares stay below 2^53, and the correctly rounded root of a whole number below 2^52 has the whole
// part of the true one (the next whole root lies at least one step of a double away).
#pragma once

#include <cstdint>

namespace burin {

// For ray i of `count` at offset_u = first_offset_u + i * 4096 units from the ball's centre along u: half[i] is
// floor(sqrt(row_radius2 - offset_u^2)), half the length of the ball's span. Every ray must meet the ball: the root must be
// of a number from 0 to 2^50. Runs on the widest vector unit that the machine has; the result does not depend on it.
void ball_half_spans(std::int64_t row_radius2, std::int32_t first_offset_u, std::int32_t count, std::int32_t* half);

// code[i] is the code of the direction (x[i], y[i], z[i]), not zero, components within +-2^26: shared::encode_normal's, without
// its 64-bit divisions.
void direction_codes(std::int32_t count, const std::int32_t* x, const std::int32_t* y, const std::int32_t* z,
                     std::uint32_t* code);

// The vector unit in use: "avx512", "avx2" or "baseline".
[[nodiscard]] const char* vector_unit();

}  // namespace burin
