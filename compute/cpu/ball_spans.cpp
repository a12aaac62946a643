// SPDX-License-Identifier: MIT
// Ball sections and direction codes, compiled for several instruction sets. The file is compiled with -fno-math-errno,
// without which sqrt is a call for each ray; no result depends on it.
#include "compute/cpu/ball_spans.hpp"

#include <cmath>

#include "shaders/shared/dexel.h"
#include "shaders/shared/direction_code.h"

namespace burin::compute {
namespace {

// Written once; each instruction set compiles its own copy and vectorizes the loop for itself.
[[gnu::always_inline]] inline void half_spans(std::int64_t row_radius2, std::int32_t first_offset_u, std::int32_t count,
                                              std::int32_t* half) {
    const auto radius2 = static_cast<double>(row_radius2);
    for (std::int32_t i = 0; i < count; ++i) {
        const double u = first_offset_u + i * shared::kUnitsPerCell;
        half[i] = static_cast<std::int32_t>(std::sqrt(radius2 - u * u));
    }
}

[[gnu::always_inline]] inline void codes(std::int32_t count, const std::int32_t* x, const std::int32_t* y,
                                         const std::int32_t* z, std::uint32_t* code) {
    for (std::int32_t i = 0; i < count; ++i) code[i] = shared::direction_code(x[i], y[i], z[i]);
}

using HalfSpans = void (*)(std::int64_t, std::int32_t, std::int32_t, std::int32_t*);
using Codes = void (*)(std::int32_t, const std::int32_t*, const std::int32_t*, const std::int32_t*, std::uint32_t*);

// Defines the two functions above for one instruction set.
#define BURIN_FOR_INSTRUCTIONS(name, ...)                                                                         \
    __VA_ARGS__ void half_spans_##name(std::int64_t row_radius2, std::int32_t first_offset_u, std::int32_t count, \
                                       std::int32_t* half) {                                                      \
        half_spans(row_radius2, first_offset_u, count, half);                                                     \
    }                                                                                                             \
    __VA_ARGS__ void codes_##name(std::int32_t count, const std::int32_t* x, const std::int32_t* y,               \
                                  const std::int32_t* z, std::uint32_t* code) {                                   \
        codes(count, x, y, z, code);                                                                              \
    }

BURIN_FOR_INSTRUCTIONS(baseline)
#ifdef __x86_64__
BURIN_FOR_INSTRUCTIONS(avx2, [[gnu::target("avx2")]])
// GCC takes half as wide vectors unless it is told; Clang, which only tests are compiled with, does not know the word.
#ifdef __clang__
#define BURIN_WIDE ""
#else
#define BURIN_WIDE ",prefer-vector-width=512"
#endif
BURIN_FOR_INSTRUCTIONS(avx512, [[gnu::target("avx512f,avx512dq,avx512vl" BURIN_WIDE)]])
#endif

struct Choice {
    HalfSpans half_spans;
    Codes codes;
    const char* name;
};

Choice choose() {
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
        return {half_spans_avx512, codes_avx512, "avx512"};
    }
    if (__builtin_cpu_supports("avx2")) return {half_spans_avx2, codes_avx2, "avx2"};
#endif
    return {half_spans_baseline, codes_baseline, "baseline"};
}

const Choice& chosen() {
    static const Choice choice = choose();
    return choice;
}

}  // namespace

void ball_half_spans(std::int64_t row_radius2, std::int32_t first_offset_u, std::int32_t count, std::int32_t* half) {
    chosen().half_spans(row_radius2, first_offset_u, count, half);
}

void direction_codes(std::int32_t count, const std::int32_t* x, const std::int32_t* y, const std::int32_t* z,
                     std::uint32_t* code) {
    chosen().codes(count, x, y, z, code);
}

const char* vector_unit() { return chosen().name; }

}  // namespace burin::compute
