// SPDX-License-Identifier: MIT
// Each float operation of a shader of the engine rounds by itself and as the host's does: a device must not fuse two
// of them, since the host does not, and must not divide or take a root of floats, since Vulkan lets it err there. Read
// from the SPIR-V that the program carries; numbers are those of the SPIR-V specification 1.5.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "shaders/cover_rays.comp.spv.hpp"
#include "shaders/cut_covered.comp.spv.hpp"
#include "shaders/cut_rays.comp.spv.hpp"
#include "shaders/find_crossings.comp.spv.hpp"
#include "shaders/list_cells.comp.spv.hpp"
#include "shaders/make_cells.comp.spv.hpp"
#include "shaders/mark_cells.comp.spv.hpp"
#include "shaders/patch_rays.comp.spv.hpp"
#include "shaders/round_doubles.comp.spv.hpp"
#include "tests/compute/effort.hpp"

namespace burin::compute {
namespace {

using Spirv = std::span<const std::uint32_t>;

const std::vector<std::pair<const char*, Spirv>>& exact_shaders() {
    static const std::vector<std::pair<const char*, Spirv>> all{
        {"cover_rays", k_cover_rays_comp},         {"cut_covered", k_cut_covered_comp},
        {"cut_rays", k_cut_rays_comp},             {"find_crossings", k_find_crossings_comp},
        {"list_cells", k_list_cells_comp},         {"make_cells", k_make_cells_comp},
        {"mark_cells", k_mark_cells_comp},         {"patch_rays", k_patch_rays_comp},
        {"round_doubles", k_round_doubles_comp}};
    return all;
}

// Calls visit(operation, words) for each instruction; words[0] holds the operation's number and length.
template <typename Visit>
void for_each_instruction(Spirv spirv, const Visit& visit) {
    constexpr std::size_t kHeaderWords = 5;
    for (std::size_t at = kHeaderWords; at < spirv.size();) {
        const std::uint32_t operation = spirv[at] & 0xffffu, words = spirv[at] >> 16;
        if (words == 0 || words > spirv.size() - at) break;
        visit(operation, spirv.subspan(at, words));
        at += words;
    }
}

struct FloatOperations {
    std::size_t all = 0, free = 0;  // free: a device may fuse it with another
};

FloatOperations float_operations(Spirv spirv) {
    constexpr std::uint32_t kDecorate = 71, kNoContraction = 42;
    // FNegate, FAdd, FSub, FMul, FDiv, FRem, FMod, VectorTimesScalar to OuterProduct, Dot
    const std::set<std::uint32_t> floats{127, 129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148};
    std::set<std::uint32_t> results, kept;
    for_each_instruction(spirv, [&](std::uint32_t operation, Spirv words) {
        if (floats.contains(operation)) results.insert(words[2]);
        if (operation == kDecorate && words[2] == kNoContraction) kept.insert(words[1]);
    });
    FloatOperations found{results.size(), 0};
    for (const std::uint32_t result : results) found.free += !kept.contains(result);
    return found;
}

struct Divisions {
    std::size_t wide = 0;        // quotients, roots and the like of doubles
    std::size_t inexact = 0;     // of floats of fewer bits, or vectors of them: the device rounds them as it likes
    std::uint32_t instance = 0;  // the result of an inexact one
};

// Counts the operations that Vulkan lets err, by the bits of their results. Of the functions of GLSL.std.450 those that
// only choose, clear or cut off bits are exact.
Divisions divisions(Spirv spirv) {
    constexpr std::uint32_t kExtInst = 12, kTypeFloat = 22, kTypeVector = 23, kTypeMatrix = 24;
    // FDiv, FRem, FMod
    const std::set<std::uint32_t> quotients{136, 140, 141};
    // Trunc, FAbs, FSign, Floor, Ceil, FMin, FMax, FClamp, NMin, NMax, NClamp
    const std::set<std::uint32_t> exact_functions{3, 4, 6, 8, 9, 37, 40, 43, 79, 80, 81};
    std::map<std::uint32_t, std::uint32_t> bits;  // of the types of floats and of vectors of them
    Divisions found;
    for_each_instruction(spirv, [&](std::uint32_t operation, Spirv words) {
        if (operation == kTypeFloat) bits[words[1]] = words[2];
        if ((operation == kTypeVector || operation == kTypeMatrix) && bits.contains(words[2]))
            bits[words[1]] = bits[words[2]];
        const bool is_function = operation == kExtInst && !exact_functions.contains(words[4]);
        if (!is_function && !quotients.contains(operation)) return;
        const auto type = bits.find(words[1]);
        if (type == bits.end()) return;  // of whole numbers
        if (type->second >= 64) {
            ++found.wide;
        } else {
            ++found.inexact;
            found.instance = words[2];
        }
    });
    return found;
}

}  // namespace

TEST(Contraction, NoFloatOperationOfAShaderMayBeFused) {
    std::size_t all = 0;
    for (const auto& [name, spirv] : exact_shaders()) {
        const FloatOperations found = float_operations(spirv);
        EXPECT_EQ(found.free, 0u) << name;
        all += found.all;
    }
    EXPECT_GT(all, 100u) << "there are such operations";
}

TEST(Contraction, NoQuotientOrRootOfFloatsIsLeftToTheDevice) {
    std::size_t wide = 0;
    for (const auto& [name, spirv] : exact_shaders()) {
        const Divisions found = divisions(spirv);
        EXPECT_EQ(found.inexact, 0u) << name << ", %" << found.instance;
        wide += found.wide;
    }
    EXPECT_GT(wide, 10u) << "there are quotients and roots of doubles";
}

TEST(Contraction, AQuotientOrARootOfFloatsIsFound) {
    // %1 float, %2 vec3, %3 double, %4 GLSL.std.450
    const std::vector<std::uint32_t> types{0x07230203, 0x10500,      0, 20, 0, 3 << 16 | 22, 1, 32, 4 << 16 | 23, 2, 1,
                                           3,          3 << 16 | 22, 3, 64};
    const auto with = [&](std::initializer_list<std::uint32_t> instruction) {
        std::vector<std::uint32_t> module = types;
        module.insert(module.end(), instruction);
        return divisions(module);
    };
    EXPECT_EQ(with({5 << 16 | 136, 1, 9, 8, 7}).inexact, 1u) << "a quotient";
    EXPECT_EQ(with({5 << 16 | 136, 2, 9, 8, 7}).inexact, 1u) << "three quotients";
    EXPECT_EQ(with({5 << 16 | 136, 3, 9, 8, 7}).inexact, 0u) << "a quotient of doubles";
    EXPECT_EQ(with({5 << 16 | 136, 3, 9, 8, 7}).wide, 1u) << "a quotient of doubles";
    for (const std::uint32_t function : {31u, 32u, 66u, 67u, 69u})  // Sqrt, InverseSqrt, Length, Distance, Normalize
        EXPECT_EQ(with({6 << 16 | 12, 1, 9, 4, function, 8}).inexact, 1u) << function;
    EXPECT_EQ(with({6 << 16 | 12, 2, 9, 4, 4, 8}).inexact, 0u) << "FAbs";
}

// What portable.h says of quotients and roots: doubles that are off by a unit in the last place either way still give
// the float that IEEE 754 asks for.
TEST(ExactRounding, DoublesGiveTheQuotientsAndRootsOfFloats) {
    test::Random random(61);
    const auto any_float = [&] {
        return std::ldexp(static_cast<float>(random.whole(1 << 23, (1 << 24) - 1)), random.small(-40, 10));
    };
    const auto expect_rounds_to = [](double wide, float narrow) {
        for (const double off : {wide, std::nextafter(wide, 0.0), std::nextafter(wide, HUGE_VAL)})
            ASSERT_EQ(static_cast<float>(off), narrow);
    };
    for (int i = 0; i < test::repeated(500'000); ++i) {
        const float a = any_float(), b = any_float();
        // Where a float holds the result, a double that is off by a unit rounds to it as well.
        ASSERT_NO_FATAL_FAILURE(expect_rounds_to(double{a} / double{b}, a / b)) << a << " / " << b;
        ASSERT_NO_FATAL_FAILURE(expect_rounds_to(std::sqrt(double{a}), std::sqrt(a))) << a;
    }
    // The roots nearest to half-way: of whole numbers next to squares of numbers with 25 bits.
    for (int i = 0; i < test::repeated(100'000); ++i) {
        const std::int64_t half_way = 2 * random.whole(1 << 23, (1 << 24) - 1) + 1;
        const auto near = static_cast<float>(half_way * half_way);
        for (const float x : {near, std::nextafter(near, 0.0f), std::nextafter(near, HUGE_VALF)})
            ASSERT_NO_FATAL_FAILURE(expect_rounds_to(std::sqrt(double{x}), std::sqrt(x))) << x;
    }
}

}  // namespace burin::compute
