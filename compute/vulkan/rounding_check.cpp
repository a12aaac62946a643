// SPDX-License-Identifier: MIT
#include "compute/vulkan/rounding_check.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <utility>

#include "base/try.hpp"
#include "gpu/buffer.hpp"
#include "gpu/commands.hpp"
#include "gpu/pipelines.hpp"
#include "shaders/round_doubles.comp.spv.hpp"
#include "shaders/shared/capsule.h"

namespace burin::compute {
namespace {

constexpr int kCases = 4096;
constexpr std::uint32_t kRoundingGroup = 64;  // invocations in a work group
constexpr int kMantissa = 53;                 // bits of a double

// Returns the number that gives 1 when multiplied by an odd one, modulo 2^64.
std::uint64_t inverse_of_odd(std::uint64_t odd) {
    std::uint64_t inverse = odd;  // right in the lowest three bits; each step doubles their number
    for (int step = 0; step < 5; ++step) inverse *= 2 - odd * inverse;
    return inverse;
}

struct Quotient {
    double a = 0.0, b = 0.0;
};

// Returns a quotient just above or below half-way. With M odd and of 54 bits, M / 2^53 is half-way between two doubles.
// For the M with b M = -1 or 1 modulo 2^53 there is a whole a for which a / b = M / 2^53 + 1 / (2^53 b), or less by it.
Quotient next_to_half_way(std::uint64_t odd, bool is_above) {
    constexpr std::uint64_t kHighest = std::uint64_t{1} << kMantissa;
    for (std::uint64_t b = odd;; b -= 2) {
        const std::uint64_t inverse = inverse_of_odd(b);
        const std::uint64_t m = kHighest + ((is_above ? 0 - inverse : inverse) & (kHighest - 1));
        const shared::Wide product = shared::multiply_wide(b, m);
        const std::uint64_t down = product.high << (64 - kMantissa) | product.low >> kMantissa;
        const std::uint64_t a = is_above ? down + 1 : down;
        if (a < kHighest) return {static_cast<double>(a), static_cast<double>(b)};
    }
}

// Returns a number of 53 bits, odd and from the upper half of them, that a multiplicative sequence picks.
std::uint64_t odd_number(int i) {
    const std::uint64_t bits = static_cast<std::uint64_t>(i + 1) * 0x9e3779b97f4a7c15u;
    return (bits >> (65 - kMantissa)) | std::uint64_t{1} << (kMantissa - 1) | 1;
}

// Returns a number whose root is next to half-way: M^2 - r with M odd and of 54 bits, where M is a root of r modulo
// 2^55. Such an M exists for r = 1 modulo 8, and is found bit by bit.
double radicand_next_to_half_way(std::int64_t r) {
    const auto remainder = static_cast<std::uint64_t>(r);
    std::uint64_t m = 1;
    for (int bit = 3; bit < 55; ++bit) {  // m^2 = r modulo 2^bit
        if (((m * m - remainder) >> bit & 1) != 0) m += std::uint64_t{1} << (bit - 1);
    }
    // Bits from 2^54 on do not change the square modulo 2^55, and neither does the sign; one of m and -m has 54 bits.
    constexpr std::uint64_t kAll = std::uint64_t{1} << 54;
    m &= kAll - 1;
    if (m < kAll / 2) m = kAll - m;
    const shared::Wide square = shared::multiply_wide(m, m);
    std::uint64_t high = square.high, low = square.low - remainder;
    if (r > 0 && square.low < remainder) --high;
    if (r < 0 && low < square.low) ++high;
    const std::uint64_t shifted = high << 10 | low >> 54;  // an even number of at most 54 bits
    return std::ldexp(static_cast<double>(shifted), 54);
}

// A number with all its bits.
std::string bits_text(double x) {
    std::ostringstream text;
    text << std::hexfloat << x;
    return text.str();
}

// Says what differs; empty when nothing does.
std::string result_difference(const std::string& what, double expected, double found) {
    if (std::bit_cast<std::uint64_t>(found) == std::bit_cast<std::uint64_t>(expected)) return "";
    return what + " is " + bits_text(found) + " in place of " + bits_text(expected);
}

std::string rounding_difference(const CheckedRounding& of, const shared::RoundedDoubles& found) {
    const std::string a = bits_text(of.numbers.a), b = bits_text(of.numbers.b);
    for (const std::string& difference :
         {result_difference(a + " / " + b, of.rounded.quotient, found.quotient),
          result_difference("the root of " + bits_text(of.numbers.radicand), of.rounded.root, found.root),
          result_difference(a + " x " + b, of.rounded.product, found.product),
          result_difference(a + " + " + b, of.rounded.sum, found.sum)}) {
        if (!difference.empty()) return difference;
    }
    return "";
}

}  // namespace

std::vector<CheckedRounding> hard_roundings() {
    std::vector<CheckedRounding> cases;
    for (int i = 0; i < kCases; ++i) {
        const Quotient quotient = next_to_half_way(odd_number(i), i % 4 < 2);
        // Numbers of either sign and of many sizes: scaling by powers of two keeps a quotient next to half-way.
        const int size = i % 64 - 32;
        shared::RoundingCase numbers{std::ldexp(quotient.a, size), quotient.b,
                                     radicand_next_to_half_way(1 + 8 * (static_cast<std::int64_t>(i) - kCases / 2))};
        if (i % 2 != 0) numbers.a = -numbers.a;
        cases.push_back({numbers, shared::rounded_doubles(numbers)});
    }
    return cases;
}

Result<void> check_rounding(const gpu::Device& on, std::span<const CheckedRounding> cases) {
    gpu::Device device = on;
    const auto count = static_cast<std::uint32_t>(cases.size());
    std::vector<shared::RoundingCase> numbers;
    for (const CheckedRounding& one : cases) numbers.push_back(one.numbers);
    BURIN_TRY(kernel, gpu::ComputePipeline::create(device, {.spirv = k_round_doubles_comp,
                                                            .storage_buffers = 2,
                                                            .push_constant_bytes = sizeof(count),
                                                            .name = "rounding check"}));
    const std::uint64_t in_bytes = numbers.size() * sizeof(shared::RoundingCase),
                        out_bytes = numbers.size() * sizeof(shared::RoundedDoubles);
    BURIN_TRY(in, gpu::Buffer::create(device, gpu::BufferUse::device_storage, in_bytes, "numbers to round"));
    BURIN_TRY(out, gpu::Buffer::create(device, gpu::BufferUse::device_storage, out_bytes, "rounded numbers"));
    BURIN_TRY(home, gpu::Buffer::create(device, gpu::BufferUse::readback, out_bytes, "rounded numbers"));
    BURIN_TRY(commands, gpu::Commands::begin(device));
    commands.upload(in, 0, std::as_bytes(std::span(numbers)));
    commands.barrier();
    commands.dispatch(kernel, {in, out}, gpu::bytes_of(count), {(count + kRoundingGroup - 1) / kRoundingGroup, 1, 1});
    commands.barrier();
    commands.copy(out, 0, home, 0, out_bytes);
    BURIN_TRY(submission, std::move(commands).submit());
    BURIN_TRY_DO(submission.wait());
    const auto rounded = home.mapped_as<shared::RoundedDoubles>();
    for (std::size_t i = 0; i < cases.size(); ++i) {
        if (std::memcmp(&cases[i].rounded, &rounded[i], sizeof(shared::RoundedDoubles)) == 0) continue;
        return fail(on.info().name,
                    "rounds doubles otherwise than the processor: " + rounding_difference(cases[i], rounded[i]),
                    "compute the spans of cylinders, cones, bull-noses and boxes on the processor");
    }
    return {};
}

}  // namespace burin::compute
