// SPDX-License-Identifier: MIT
// Sections of rays with swept frustums and boxes, to the last bit, also as the device is sent them.
#include "compute/tools/convex_sweep.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "compute/rays/normal_code.hpp"
#include "shaders/shared/cover_job.h"

namespace burin::compute::test {
namespace {

struct GoldenSection {
    const char* name;
    double lo, hi;  // empty when lo > hi
    std::uint32_t code_lo, code_hi;
};

void expect_section(const GoldenSection& golden, const SweepSpan& span) {
    SCOPED_TRACE(golden.name);
    EXPECT_EQ(is_empty(span), golden.lo > golden.hi);
    if (is_empty(span)) return;
    EXPECT_EQ(span.lo, golden.lo);
    EXPECT_EQ(span.hi, golden.hi);
    EXPECT_EQ(normal_code(span.normal_lo), golden.code_lo);
    EXPECT_EQ(normal_code(span.normal_hi), golden.code_hi);
}

const Vec3 kSweptFrom(20000.25, 30000.5, 40000.75), kAslant(0.48, 0.6, 0.64), kUpright(0.0, 1.0, 0.0);
const Vec3 kSweptBy(9000.0, -3000.5, 1000.25), kAtRest(0.0);
constexpr double kUnitsACell = 4096.0;

}  // namespace

// The numbers come from the arithmetic as it was when carvings of it were first recorded. A recording is replayed to
// the bit only as long as they stay.
TEST(ConvexSweep, FrustumsHaveTheSectionsThatRecordingsWereMadeWith) {
    struct Case {
        GoldenSection golden;
        Frustum shape;
        Vec3 tip, axis, along;
        int ray_axis;
        double u, v;
    };
    const Frustum cylinder{5000, 5000, 12000}, cone{0, 6000, 15000}, slice{3000, 4000, 500, 2500, 1500};
    const std::vector<Case> cases{
        {{"cylinder stamped", 0x1.2b7f08dc0b3c5p+14, 0x1.cfc22aaaaaaacp+14, 0xae223881u, 0xaca5a3b7u},
         cylinder,
         kSweptFrom,
         kAslant,
         kAtRest,
         0,
         9 * kUnitsACell,
         11 * kUnitsACell},
        {{"cylinder moved", 0x1.861490bc59ebep+14, 0x1.1656fae91a8fap+15, 0x106340c4u, 0xe9f5d1d5u},
         cylinder,
         kSweptFrom,
         kAslant,
         kSweptBy,
         1,
         10 * kUnitsACell,
         7 * kUnitsACell},
        {{"cylinder along its axis", 0x1.d4c2p+14, 0x1.7ed1p+15, 0x00007fffu, 0xfffe7fffu},
         cylinder,
         kSweptFrom,
         kUpright,
         Vec3(0, 7000, 0),
         1,
         10 * kUnitsACell,
         5 * kUnitsACell},
        {{"cylinder on lattice planes", 0x1.4p+14, 0x1.cp+14, 0xfffefffeu, 0x7fff7fffu},
         {4096, 4096, 8192},
         kUnitsACell * Vec3(5, 5, 6),
         kUpright,
         Vec3(4096, 0, 0),
         2,
         5 * kUnitsACell,
         6 * kUnitsACell},
        {{"cone from a point", 0x1.5bf6ebc37a74ap+15, 0x1.6c87dp+15, 0xef0fe8f1u, 0xaca5a3b7u},
         cone,
         kSweptFrom,
         kAslant,
         kAtRest,
         2,
         7 * kUnitsACell,
         10 * kUnitsACell},
        {{"cone moved", 0x1.02749698e8f6fp+15, 0x1.10022ac681818p+15, 0x694c6ea7u, 0x58ca9d7au},
         {6000, 0, 15000},
         kSweptFrom,
         kAslant,
         kSweptBy,
         0,
         8 * kUnitsACell,
         12 * kUnitsACell},
        {{"cone through its tip", 0x1.d4c2p+14, 0x1.5f91p+15, 0x6deb05ddu, 0xfffe7fffu},
         cone,
         kSweptFrom,
         kUpright,
         kSweptBy,
         1,
         40000.75,
         20000.25},
        {{"frustum moved", 0x1.3b58017bbe08p+15, 0x1.67dc6p+15, 0xf0c1f3d2u, 0xaca5a3b7u},
         {2000, 7000, 9000},
         kSweptFrom,
         kAslant,
         kSweptBy,
         2,
         7 * kUnitsACell,
         9 * kUnitsACell},
        {{"slice of a corner", 0x1.be86p+14, 0x1.cb8b555555555p+14, 0x23b82ca6u, 0xaca5a3b7u},
         slice,
         kSweptFrom,
         kAslant,
         kAtRest,
         1,
         10 * kUnitsACell,
         20500},
        {{"slice of a corner moved", 0x1.373a2aaaaaaabp+14, 0x1.ae5dp+14, 0x23b82ca6u, 0xaca5a3b7u},
         slice,
         kSweptFrom,
         kAslant,
         kSweptBy,
         0,
         29000,
         41000},
        {{"slice at its rim", 0x1.2985a564b1321p+15, 0x1.328db796ce578p+15, 0xe7edc7aeu, 0xce819741u},
         slice,
         kSweptFrom,
         kAslant,
         kSweptBy,
         2,
         28000,
         30500},
        {{"missed", 1.0, 0.0, 0, 0}, cylinder, kSweptFrom, kAslant, kSweptBy, 2, 40 * kUnitsACell, 40 * kUnitsACell},
    };
    for (const Case& c : cases) {
        const FrustumSweep sweep(c.shape, c.tip, c.axis, c.along);
        expect_section(c.golden, sweep.span(c.ray_axis, c.u, c.v));
        const shared::CoverPiece sent = shared::packed_frustum({}, sweep.swept());
        expect_section(c.golden, shared::span_of_piece(sent, {c.ray_axis, c.u, c.v}));
    }
}

TEST(ConvexSweep, BoxesHaveTheSectionsThatRecordingsWereMadeWith) {
    struct Case {
        GoldenSection golden;
        Vec3 half_size;
        Quat orientation;
        Vec3 along;
        int ray_axis;
        double u, v;
    };
    const Vec3 half(5000, 3000, 4000);
    const Quat turned(0.8, 0.36, -0.48, 0.0), straight(1.0, 0.0, 0.0, 0.0);
    const std::vector<Case> cases{
        {{"box stamped", 0x1.f850255555556p+13, 0x1.9eeabd5555556p+14, 0x52994377u, 0xc376d298u},
         half,
         turned,
         kAtRest,
         0,
         7 * kUnitsACell,
         10 * kUnitsACell},
        {{"box moved", 0x1.688c66fc68a13p+14, 0x1.06ff8bb024773p+15, 0x19855308u, 0xd3079984u},
         half,
         turned,
         kSweptBy,
         1,
         10 * kUnitsACell,
         6 * kUnitsACell},
        {{"box moved, across", 0x1.0e2666c24bd55p+15, 0x1.6974c04213433p+15, 0x0310261fu, 0xa61e830fu},
         half,
         turned,
         kSweptBy,
         2,
         6 * kUnitsACell,
         7 * kUnitsACell},
        {{"box along the lattice", 0x1.18818p+15, 0x1.78818p+15, 0xfffefffeu, 0x7fff7fffu},
         {4096, 8192, 4096},
         straight,
         Vec3(0, 0, 4096),
         2,
         20000.25,
         7 * kUnitsACell},
        {{"missed", 1.0, 0.0, 0, 0}, half, turned, kSweptBy, 2, 40 * kUnitsACell, 40 * kUnitsACell},
    };
    for (const Case& c : cases) {
        const BoxSweep sweep(c.half_size, kSweptFrom, c.orientation, c.along);
        expect_section(c.golden, sweep.span(c.ray_axis, c.u, c.v));
        const shared::CoverPiece sent = shared::packed_box({}, sweep.swept());
        expect_section(c.golden, shared::span_of_piece(sent, {c.ray_axis, c.u, c.v}));
    }
}

}  // namespace burin::compute::test
