// SPDX-License-Identifier: MIT
// Vectorized sections of a resting ball with a row of rays; the whole depths equal those of shaders/shared/capsule.h.
//
// Doubles are exact here: squares stay below 2^53, and the correctly rounded root of a whole number below 2^52 has the
// same whole part as the true root (the next whole root is at least one step of a double away).
#pragma once

#include <cstdint>

namespace burin::compute {

// Sets half[i] to floor(sqrt(row_radius2 - offset_u^2)), half the length of the ball's span on ray i of `count`, which
// lies at offset_u = first_offset_u + i * 4096 units from the ball's centre along u. Every ray must meet the ball, so
// the radicand must be a number from 0 to 2^50. Uses the widest vector unit of the machine; the result does not depend
// on it.
void ball_half_spans(std::int64_t row_radius2, std::int32_t first_offset_u, std::int32_t count, std::int32_t* half);

// Sets code[i] to the code of the direction (x[i], y[i], z[i]), which must not be zero and have components within
// +-2^26. The codes equal those of shared::encode_normal, without its 64-bit divisions.
void direction_codes(std::int32_t count, const std::int32_t* x, const std::int32_t* y, const std::int32_t* z,
                     std::uint32_t* code);

// Returns the vector unit in use: "avx512", "avx2" or "baseline".
[[nodiscard]] const char* vector_unit();

}  // namespace burin::compute
