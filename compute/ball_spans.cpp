// SPDX-License-Identifier: MIT
// Compiled with -fno-math-errno, without which sqrt is a call for each ray; no result depends on it.
#include "compute/ball_spans.hpp"

#include <cmath>

#include "shaders/shared/dexel.h"

namespace burin {
namespace {

// One text; each instruction set compiles its own copy of it and vectorizes the loop for itself.
[[gnu::always_inline]] inline void half_spans(std::int64_t row_radius2, std::int32_t first_offset_u, std::int32_t count,
                                              std::int32_t* half) {
    const auto radius2 = static_cast<double>(row_radius2);
    for (std::int32_t i = 0; i < count; ++i) {
        const double u = first_offset_u + i * shared::kUnitsPerCell;
        half[i] = static_cast<std::int32_t>(std::sqrt(radius2 - u * u));
    }
}

using Kernel = void (*)(std::int64_t, std::int32_t, std::int32_t, std::int32_t*);

void baseline(std::int64_t row_radius2, std::int32_t first_offset_u, std::int32_t count, std::int32_t* half) {
    half_spans(row_radius2, first_offset_u, count, half);
}

#ifdef __x86_64__
[[gnu::target("avx2")]] void avx2(std::int64_t row_radius2, std::int32_t first_offset_u, std::int32_t count,
                                  std::int32_t* half) {
    half_spans(row_radius2, first_offset_u, count, half);
}

[[gnu::target("avx512f,avx512dq,avx512vl")]] void avx512(std::int64_t row_radius2, std::int32_t first_offset_u,
                                                         std::int32_t count, std::int32_t* half) {
    half_spans(row_radius2, first_offset_u, count, half);
}
#endif

struct Choice {
    Kernel kernel;
    const char* name;
};

Choice choose() {
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
        return {avx512, "avx512"};
    }
    if (__builtin_cpu_supports("avx2")) return {avx2, "avx2"};
#endif
    return {baseline, "baseline"};
}

const Choice& chosen() {
    static const Choice choice = choose();
    return choice;
}

}  // namespace

void ball_half_spans(std::int64_t row_radius2, std::int32_t first_offset_u, std::int32_t count, std::int32_t* half) {
    chosen().kernel(row_radius2, first_offset_u, count, half);
}

const char* vector_unit() { return chosen().name; }

}  // namespace burin
