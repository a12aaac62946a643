// SPDX-License-Identifier: MIT
// List surgery of one ray against set subtraction on plain intervals.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <tuple>
#include <vector>

#include "shaders/shared/dexel.h"

namespace burin::test {
namespace {

using shared::DexelEnd;
using shared::RaySpan;
using shared::uint;

// More cases than the library's 100, and the same ones every time; RC_PARAMS from outside still wins.
[[maybe_unused]] const int kConfigured = setenv("RC_PARAMS", "seed=20 max_success=5000", 0);

// A ray in the middle of a store, with other rays' ends on both sides that no cut may touch.
constexpr uint kFirst = 7;
constexpr uint kForeign = 0xabcd1234u;

struct Ray {
    std::vector<DexelEnd> ends;
    [[nodiscard]] DexelEnd load_end(uint i) const { return ends.at(i); }
    void store_end(uint i, DexelEnd end) { ends.at(i) = end; }
#include "shaders/shared/cut_ray.h"
};

bool same(const DexelEnd& a, const DexelEnd& b) { return a.depth_material == b.depth_material && a.normal == b.normal; }

bool same(const std::vector<DexelEnd>& a, const std::vector<DexelEnd>& b) {
    return std::ranges::equal(a, b, [](const DexelEnd& x, const DexelEnd& y) { return same(x, y); });
}

DexelEnd tool_end(int depth, uint tool) { return shared::make_end(depth, 200 + tool, 0x70000000u + tool); }

struct Cut {
    std::vector<DexelEnd> ends;
    std::optional<std::pair<int, int>> changed;
};

Cut carve(const std::vector<DexelEnd>& ends, RaySpan span, uint tool) {
    const auto count = static_cast<uint>(ends.size());
    Ray ray;
    ray.ends.assign(kFirst, {kForeign, 1});
    ray.ends.insert(ray.ends.end(), ends.begin(), ends.end());
    const auto plan = ray.plan_cut(kFirst, count, span);
    if (plan.removed == 0) return {ends, std::nullopt};
    const uint after = ray.count_after(count, plan);
    RC_ASSERT(after <= count + 2);
    ray.ends.resize(kFirst + std::max(after, count), {0, 0});
    ray.ends.insert(ray.ends.end(), 5, {kForeign, 2});
    const DexelEnd none{0xdeaddeadu, 0xdeaddeadu};
    ray.apply_cut(kFirst, count, plan, plan.kept_low != 0 ? tool_end(span.lo, tool) : none,
                  plan.kept_high != 0 ? tool_end(span.hi, tool) : none);
    for (uint i = 0; i < kFirst; ++i) RC_ASSERT(same(ray.ends[i], DexelEnd{kForeign, 1}));
    for (uint i = 0; i < 5; ++i) RC_ASSERT(same(ray.ends[ray.ends.size() - 1 - i], DexelEnd{kForeign, 2}));
    return {{ray.ends.begin() + kFirst, ray.ends.begin() + kFirst + after},
            std::pair{plan.changed_lo, plan.changed_hi}};
}

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

TEST(CutRay, EqualsSetSubtraction) {
    EXPECT_TRUE(rc::check([] {
        std::vector<DexelEnd> ends = *any_ray();
        const auto spans = *rc::gen::container<std::vector<RaySpan>>(any_span());
        uint tool = 0;
        for (const RaySpan span : spans) {
            const auto expected = subtract(ends, span, tool % 50);
            const Cut cut = carve(ends, span, tool % 50);
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

TEST(CutRay, CuttingTwiceChangesNothingMore) {
    EXPECT_TRUE(rc::check([] {
        const auto ends = *any_ray();
        const RaySpan span = *any_span();
        const auto once = carve(ends, span, 1).ends;
        const Cut twice = carve(once, span, 2);
        RC_ASSERT(same(twice.ends, once));
        RC_ASSERT(!twice.changed);
    }));
}

TEST(CutRay, OrderOfCutsThatDoNotTouchDoesNotMatter) {
    EXPECT_TRUE(rc::check([] {
        const auto ends = *any_ray();
        const RaySpan a = *any_span(), b = *any_span();
        RC_PRE(a.lo < a.hi && b.lo < b.hi && (a.hi < b.lo || b.hi < a.lo));
        RC_ASSERT(same(carve(carve(ends, a, 1).ends, b, 2).ends, carve(carve(ends, b, 2).ends, a, 1).ends));
    }));
}

TEST(CutRay, CoincidentFacesLeaveNoSliver) {
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

TEST(CutRay, TwoHundredPlatesAreCutOneByOneAndAllAtOnce) {
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

}  // namespace burin::test
