// SPDX-License-Identifier: MIT
// Emptying and filling spans of one ray against set algebra on plain intervals.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <tuple>
#include <vector>

#include "shaders/shared/dexel.h"

namespace burin::compute::test {
namespace {

using shared::DexelEnd;
using shared::RaySpan;
using shared::uint;

struct Ray {
    const std::vector<DexelEnd>& ends;
    [[nodiscard]] DexelEnd load_end(uint i) const { return ends.at(i); }
#include "shaders/shared/span_edit.h"
};

bool same(const DexelEnd& a, const DexelEnd& b) { return a.depth_material == b.depth_material && a.normal == b.normal; }

bool same(const std::vector<DexelEnd>& a, const std::vector<DexelEnd>& b) {
    return std::ranges::equal(a, b, [](const DexelEnd& x, const DexelEnd& y) { return same(x, y); });
}

DexelEnd tool_end(int depth, uint tool) { return shared::make_end(depth, 200 + tool, 0x70000000u + tool); }

struct Edited {
    std::vector<DexelEnd> ends;
    std::optional<std::pair<int, int>> changed;
};

Edited edit(const std::vector<DexelEnd>& ends, RaySpan span, uint inside, uint tool) {
    Ray ray{ends};
    const auto plan = ray.plan_span(static_cast<uint>(ends.size()), span, inside);
    if (!ray.changes_anything(plan)) return {ends, std::nullopt};
    std::vector<DexelEnd> after(ends.begin(), ends.begin() + plan.from);
    if (plan.insert_lo != 0) after.push_back(tool_end(span.lo, tool));
    if (plan.insert_hi != 0) after.push_back(tool_end(span.hi, tool));
    after.insert(after.end(), ends.begin() + plan.to, ends.end());
    RC_ASSERT(after.size() == ray.count_after(static_cast<uint>(ends.size()), plan));
    RC_ASSERT(after.size() <= ends.size() + 2u);
    return {after, std::pair{plan.changed_lo, plan.changed_hi}};
}

Edited carve(const std::vector<DexelEnd>& ends, RaySpan span, uint tool) { return edit(ends, span, 0, tool); }
Edited fill(const std::vector<DexelEnd>& ends, RaySpan span, uint tool) { return edit(ends, span, 1, tool); }

// The same by set subtraction, interval by interval.
std::vector<DexelEnd> subtract(const std::vector<DexelEnd>& ends, RaySpan span, uint tool) {
    if (span.lo >= span.hi) return ends;
    std::vector<DexelEnd> rest;
    for (std::size_t i = 0; i < ends.size(); i += 2) {
        const int lo = depth_of(ends[i]), hi = depth_of(ends[i + 1]);
        if (hi <= span.lo || lo >= span.hi) {
            rest.insert(rest.end(), {ends[i], ends[i + 1]});
            continue;
        }
        if (lo < span.lo) rest.insert(rest.end(), {ends[i], tool_end(span.lo, tool)});
        if (hi > span.hi) rest.insert(rest.end(), {tool_end(span.hi, tool), ends[i + 1]});
    }
    return rest;
}

// Union, interval by interval.
std::vector<DexelEnd> unite(const std::vector<DexelEnd>& ends, RaySpan span, uint tool) {
    if (span.lo >= span.hi) return ends;
    DexelEnd lo = tool_end(span.lo, tool), hi = tool_end(span.hi, tool);
    std::vector<DexelEnd> before, after;
    for (std::size_t i = 0; i < ends.size(); i += 2) {
        if (depth_of(ends[i + 1]) < span.lo) {
            before.insert(before.end(), {ends[i], ends[i + 1]});
        } else if (depth_of(ends[i]) > span.hi) {
            after.insert(after.end(), {ends[i], ends[i + 1]});
        } else {
            if (depth_of(ends[i]) <= depth_of(lo)) lo = ends[i];
            if (depth_of(ends[i + 1]) >= depth_of(hi)) hi = ends[i + 1];
        }
    }
    before.insert(before.end(), {lo, hi});
    before.insert(before.end(), after.begin(), after.end());
    return before;
}

// Sorted ends with small gaps, so that coincident and touching faces are common.
rc::Gen<std::vector<DexelEnd>> any_ray() {
    return rc::gen::map(rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 4)), [](const std::vector<int>& gaps) {
        std::vector<DexelEnd> ends;
        int depth = 0;
        for (std::size_t i = 0; i < gaps.size(); ++i) {
            depth += gaps[i];
            ends.push_back(shared::make_end(depth, static_cast<uint>(i % 100), 1000u + static_cast<uint>(i)));
        }
        if (ends.size() % 2 != 0) ends.pop_back();
        return ends;
    });
}

rc::Gen<RaySpan> any_span() {
    return rc::gen::map(rc::gen::pair(rc::gen::inRange(-3, 120), rc::gen::inRange(-2, 60)),
                        [](const std::pair<int, int>& p) { return RaySpan{p.first, p.first + p.second}; });
}

std::vector<int> depths(const std::vector<DexelEnd>& ends) {
    std::vector<int> depths;
    for (const DexelEnd& end : ends) depths.push_back(depth_of(end));
    return depths;
}

long length(const std::vector<DexelEnd>& ends) {
    long sum = 0;
    for (std::size_t i = 0; i < ends.size(); i += 2) sum += depth_of(ends[i + 1]) - depth_of(ends[i]);
    return sum;
}

void assert_well_formed(const std::vector<DexelEnd>& ends) {
    RC_ASSERT(ends.size() % 2 == 0u);
    for (std::size_t i = 1; i < ends.size(); ++i) RC_ASSERT(depth_of(ends[i - 1]) < depth_of(ends[i]));
}

}  // namespace

TEST(SpanEdit, EqualsSetSubtraction) {
    EXPECT_TRUE(rc::check([] {
        std::vector<DexelEnd> ends = *any_ray();
        const auto spans = *rc::gen::container<std::vector<RaySpan>>(any_span());
        uint tool = 0;
        for (const RaySpan span : spans) {
            const auto expected = subtract(ends, span, tool % 50);
            const Edited cut = carve(ends, span, tool % 50);
            RC_ASSERT(same(cut.ends, expected));
            assert_well_formed(cut.ends);
            RC_ASSERT(length(cut.ends) <= length(ends));
            // What changed lies within what is reported as changed, and within the span.
            if (cut.changed) {
                RC_ASSERT(cut.changed->first >= span.lo);
                RC_ASSERT(cut.changed->second <= span.hi);
                RC_ASSERT(cut.changed->first < cut.changed->second);
                for (const DexelEnd& e : ends) {
                    const bool kept = std::ranges::any_of(cut.ends, [&](const DexelEnd& x) { return same(x, e); });
                    RC_ASSERT(kept || (depth_of(e) >= cut.changed->first && depth_of(e) <= cut.changed->second));
                }
            }
            ends = cut.ends;
            ++tool;
        }
    }));
}

TEST(SpanEdit, FillingEqualsSetUnion) {
    EXPECT_TRUE(rc::check([] {
        std::vector<DexelEnd> ends = *any_ray();
        uint tool = 0;
        for (const RaySpan any : *rc::gen::container<std::vector<RaySpan>>(any_span())) {
            const RaySpan span{std::max(any.lo, 0), any.hi};  // a depth below 0 cannot be stored
            const Edited filled = fill(ends, span, tool % 50);
            RC_ASSERT(same(filled.ends, unite(ends, span, tool % 50)));
            assert_well_formed(filled.ends);
            RC_ASSERT(length(filled.ends) >= length(ends));
            RC_ASSERT(filled.changed.has_value() == !same(filled.ends, ends));
            ends = filled.ends;
            ++tool;
        }
    }));
}

TEST(SpanEdit, WhatIsFilledAndCutAgainIsWhatWasCut) {
    EXPECT_TRUE(rc::check([] {
        const auto ends = *any_ray();
        const RaySpan any = *any_span(), span{std::max(any.lo, 0), any.hi};
        // The depths: an end on the span's border is the tool's afterwards, where it would else have stayed.
        RC_ASSERT((depths(carve(fill(ends, span, 1).ends, span, 2).ends) == depths(carve(ends, span, 2).ends)));
        RC_ASSERT((depths(fill(carve(ends, span, 1).ends, span, 2).ends) == depths(fill(ends, span, 2).ends)));
    }));
}

TEST(SpanEdit, CuttingTwiceChangesNothingMore) {
    EXPECT_TRUE(rc::check([] {
        const auto ends = *any_ray();
        const RaySpan span = *any_span();
        const auto once = carve(ends, span, 1).ends;
        const Edited twice = carve(once, span, 2);
        RC_ASSERT(same(twice.ends, once));
        RC_ASSERT(!twice.changed);
    }));
}

TEST(SpanEdit, OrderOfCutsThatDoNotTouchDoesNotMatter) {
    EXPECT_TRUE(rc::check([] {
        const auto ends = *any_ray();
        const RaySpan a = *any_span(), b = *any_span();
        RC_PRE(a.lo < a.hi && b.lo < b.hi && (a.hi < b.lo || b.hi < a.lo));
        RC_ASSERT(same(carve(carve(ends, a, 1).ends, b, 2).ends, carve(carve(ends, b, 2).ends, a, 1).ends));
    }));
}

TEST(SpanEdit, CoincidentFacesLeaveNoSliver) {
    const std::vector<DexelEnd> block{shared::make_end(10, 0, 1), shared::make_end(20, 0, 2)};
    EXPECT_TRUE(carve(block, {10, 20}, 1).ends.empty());
    EXPECT_TRUE(carve(block, {9, 21}, 1).ends.empty());
    EXPECT_TRUE(same(carve(block, {20, 30}, 1).ends, block));
    EXPECT_TRUE(same(carve(block, {0, 10}, 1).ends, block));
    EXPECT_TRUE(same(carve(block, {15, 15}, 1).ends, block));
    EXPECT_TRUE(same(carve(block, {16, 14}, 1).ends, block));
    const auto lower = carve(block, {15, 20}, 1).ends;
    ASSERT_EQ(lower.size(), 2u);
    EXPECT_TRUE(same(lower[0], block[0]));
    EXPECT_EQ(depth_of(lower[1]), 15);
}

TEST(SpanEdit, TwoHundredPlatesAreCutOneByOneAndAllAtOnce) {
    std::vector<DexelEnd> plates;
    for (int i = 0; i < 200; ++i) {
        plates.push_back(shared::make_end(100 * i, 1, static_cast<uint>(2 * i)));
        plates.push_back(shared::make_end(100 * i + 2, 1, static_cast<uint>(2 * i + 1)));
    }
    EXPECT_EQ(carve(plates, {0, 100000}, 1).ends.size(), 0u);
    EXPECT_EQ(carve(plates, {1, 19901}, 1).ends.size(), 4u);
    std::vector<DexelEnd> halved = plates;
    for (int i = 0; i < 200; ++i) halved = carve(halved, {100 * i - 50, 100 * i + 1}, 3).ends;
    ASSERT_EQ(halved.size(), 400u);
    for (int i = 0; i < 200; ++i) {
        EXPECT_EQ(depth_of(halved[static_cast<std::size_t>(2 * i)]), 100 * i + 1);
        EXPECT_TRUE(same(halved[static_cast<std::size_t>(2 * i + 1)], plates[static_cast<std::size_t>(2 * i + 1)]));
    }
}

}  // namespace burin::compute::test
