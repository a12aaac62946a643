// SPDX-License-Identifier: MIT
// Set algebra of rays against sets of depths, one by one.
#include "compute/rays/set_algebra.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cstdlib>

#include "shaders/shared/octahedral.h"

namespace burin::compute::test {
namespace {

using shared::DexelEnd;
using shared::RaySpan;
using shared::uint;
using Ends = std::vector<DexelEnd>;

constexpr int kDeepest = 48;

// Short rays with small gaps, so that ends of both lists coincide and touch all the time.
Ends any_ends(std::uint32_t material, int intervals) {
    const auto gaps = *rc::gen::container<std::vector<int>>(
        static_cast<std::size_t>(2 * *rc::gen::inRange(0, intervals)), rc::gen::inRange(1, 5));
    Ends ends;
    int depth = -1;
    for (const int gap : gaps) {
        depth += gap;
        if (depth >= kDeepest) break;
        const shared::IntVector n{*rc::gen::inRange(-9, 10), *rc::gen::inRange(-9, 10), *rc::gen::inRange(-9, 10)};
        ends.push_back(shared::make_end(depth, material, shared::encode_normal(n)));
    }
    if (ends.size() % 2 != 0) ends.pop_back();
    return ends;
}

bool holds(RayEnds ends, int depth) {
    return std::ranges::count_if(ends, [&](const DexelEnd& e) { return depth_of(e) <= depth; }) % 2 != 0;
}

const DexelEnd* end_at(RayEnds ends, int depth) {
    const auto found = std::ranges::find_if(ends, [&](const DexelEnd& e) { return depth_of(e) == depth; });
    return found == ends.end() ? nullptr : &*found;
}

bool well_formed(RayEnds ends) {
    const auto not_above = [](const DexelEnd& x, const DexelEnd& y) { return depth_of(x) >= depth_of(y); };
    return ends.size() % 2 == 0 && std::ranges::adjacent_find(ends, not_above) == ends.end();
}

template <typename F>
Ends made(F append, RayEnds a, RayEnds b) {
    Ends to;
    append(a, b, to);
    return to;
}
Ends difference(RayEnds a, RayEnds b) { return made(append_difference, a, b); }
Ends united(RayEnds a, RayEnds b) { return made(append_union, a, b); }
Ends common(RayEnds a, RayEnds b) { return made(append_intersection, a, b); }
Ends painted(RayEnds a, RayEnds b) { return made(append_painted, a, b); }

// The result holds the right depths, and every end of it is a's where a has one there, else what b leaves.
template <typename Inside>
void expect_result(RayEnds result, RayEnds a, RayEnds b, Inside inside, bool opposite) {
    RC_ASSERT((well_formed(result)));
    for (int d = 0; d < kDeepest; ++d) RC_ASSERT((holds(result, d) == inside(holds(a, d), holds(b, d))));
    for (const DexelEnd& end : result) {
        const DexelEnd* from_a = end_at(a, depth_of(end));
        const DexelEnd* from_b = end_at(b, depth_of(end));
        if (from_a != nullptr) {
            RC_ASSERT((same_ends({&end, 1}, {from_a, 1})));
        } else {
            RC_ASSERT((from_b != nullptr && end.depth_material == from_b->depth_material));
            RC_ASSERT((end.normal == (opposite ? shared::opposite_normal(from_b->normal) : from_b->normal)));
        }
    }
}

}  // namespace

TEST(RayAlgebra, IsSetAlgebraOfDepthsAndKeepsEndsThatStay) {
    EXPECT_TRUE(rc::check([] {
        const Ends a = any_ends(1, 6), b = any_ends(2, 6);
        expect_result(difference(a, b), a, b, [](bool x, bool y) { return x && !y; }, true);
        expect_result(united(a, b), a, b, [](bool x, bool y) { return x || y; }, false);
        expect_result(common(a, b), a, b, [](bool x, bool y) { return x && y; }, false);
    }));
}

TEST(RayAlgebra, CuttingOrFillingTwiceIsOnceToTheBit) {
    EXPECT_TRUE(rc::check([] {
        const Ends a = any_ends(1, 6), b = any_ends(2, 6);
        const Ends cut = difference(a, b), filled = united(a, b), kept = common(a, b);
        RC_ASSERT((same_ends(difference(cut, b), cut)));
        RC_ASSERT((same_ends(united(filled, b), filled)));
        RC_ASSERT((same_ends(common(kept, b), kept)));
    }));
}

TEST(RayAlgebra, DifferenceAndIntersectionPartitionTheRay) {
    EXPECT_TRUE(rc::check([] {
        const Ends a = any_ends(1, 6), b = any_ends(2, 6);
        const Ends rest = difference(a, b), taken = common(a, b);
        RC_ASSERT((common(rest, taken).empty()));
        const Ends again = united(rest, taken);
        // The walls that b drew inside a are gone again: depths, and what bounds them, are a's.
        RC_ASSERT((same_ends(again, a)));
    }));
}

TEST(RayAlgebra, OrderOfDisjointToolsIsIrrelevantToTheBit) {
    EXPECT_TRUE(rc::check([] {
        const Ends a = any_ends(1, 6), b = any_ends(2, 6);
        Ends c;  // what lies at least one depth away from b
        for (int d = *rc::gen::inRange(0, 4); d + 1 < kDeepest; d += *rc::gen::inRange(2, 9)) {
            const bool free = !holds(b, d - 1) && !holds(b, d) && !holds(b, d + 1) && end_at(b, d + 1) == nullptr &&
                              end_at(b, d) == nullptr;
            if (free) c.insert(c.end(), {shared::make_end(d, 3, 5), shared::make_end(d + 1, 3, 6)});
        }
        RC_ASSERT((same_ends(difference(difference(a, b), c), difference(difference(a, c), b))));
        RC_ASSERT((same_ends(united(united(a, b), c), united(united(a, c), b))));
        RC_ASSERT((same_ends(difference(united(a, b), c), united(difference(a, c), b))));
    }));
}

TEST(RayAlgebra, PaintChangesMaterialsWithinTheToolAlone) {
    EXPECT_TRUE(rc::check([] {
        const Ends a = any_ends(1, 8), b = any_ends(2, 6);
        const Ends result = painted(a, b);
        RC_ASSERT((result.size() == a.size()));
        for (std::size_t i = 0; i < a.size(); ++i) {
            const int d = depth_of(a[i]);
            const bool covered = holds(b, d) || end_at(b, d) != nullptr;
            RC_ASSERT((depth_of(result[i]) == d && result[i].normal == a[i].normal));
            RC_ASSERT((material_of(result[i]) == (covered ? 2u : 1u)));
        }
    }));
}

// One interval is what shaders/shared/span_edit.h takes out or puts in.
struct HostRay {
    Ends held;
    [[nodiscard]] DexelEnd load_end(uint i) const { return held.at(i); }
#include "shaders/shared/span_edit.h"
};

TEST(RayAlgebra, AgreesWithTheEnginesEditOfASpan) {
    EXPECT_TRUE(rc::check([] {
        const Ends a = any_ends(1, 6), b = any_ends(2, 2);
        if (b.size() != 2) return;
        for (const bool fill : {false, true}) {
            HostRay ray{a};
            const auto edit = ray.plan_span(static_cast<uint>(a.size()), RaySpan{depth_of(b[0]), depth_of(b[1])}, fill);
            Ends edited(a.begin(), a.begin() + edit.from);
            const auto fresh = [&](const DexelEnd& end) {
                return DexelEnd{end.depth_material, fill ? end.normal : shared::opposite_normal(end.normal)};
            };
            if (edit.insert_lo != 0) edited.push_back(fresh(b[0]));
            if (edit.insert_hi != 0) edited.push_back(fresh(b[1]));
            edited.insert(edited.end(), a.begin() + edit.to, a.end());
            RC_ASSERT((same_ends(edited, fill ? united(a, b) : difference(a, b))));
        }
    }));
}

}  // namespace burin::compute::test
