// SPDX-License-Identifier: MIT
#include "compute/rays/dexel_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/compute/effort.hpp"

namespace burin::compute::test {
namespace {

using shared::DexelEnd;
using EndsOfRays = std::vector<std::vector<DexelEnd>>;

std::vector<DexelEnd> random_ends(Random& random, int most) {
    std::vector<DexelEnd> ends(static_cast<std::size_t>(2 * random.small(0, most / 2)));
    for (DexelEnd& e : ends) e = {static_cast<std::uint32_t>(random.bits()), static_cast<std::uint32_t>(random.bits())};
    return ends;
}

void assign(DexelSet& set, const EndsOfRays& rays) {
    std::vector<std::uint32_t> counts;
    std::vector<DexelEnd> all;
    for (const auto& ends : rays) {
        counts.push_back(static_cast<std::uint32_t>(ends.size()));
        all.insert(all.end(), ends.begin(), ends.end());
    }
    set.assign(counts, all);
}

bool holds(const DexelSet& set, const EndsOfRays& rays) {
    for (std::size_t r = 0; r < rays.size(); ++r) {
        if (!std::ranges::equal(set.ends(r), rays[r], [](const DexelEnd& a, const DexelEnd& b) {
                return a.depth_material == b.depth_material && a.normal == b.normal;
            })) {
            return false;
        }
    }
    return set.ray_count() == rays.size();
}

DexelSet row_of(std::size_t rays) { return DexelSet(static_cast<int>(rays), 1); }

}  // namespace

TEST(DexelSet, StartsEmpty) {
    const DexelSet set(7, 3);
    EXPECT_EQ(set.ray_count(), 21u);
    for (std::size_t r = 0; r < 21; ++r) EXPECT_TRUE(set.ends(r).empty());
    for (int v = 0; v < 3; ++v) EXPECT_FALSE(set.page_held(6, v));
    EXPECT_TRUE(set.same_content(DexelSet(7, 3)));
    EXPECT_FALSE(set.same_content(DexelSet(3, 7)));
    EXPECT_LT(set.bytes(), 100u);
}

TEST(DexelSet, KeepsContentsThroughReplacingAndGrowing) {
    Random random(1);
    for (int i = 0; i < repeated(50); ++i) {
        const int width = random.small(1, 200), rows = random.small(1, 4);
        EndsOfRays rays(static_cast<std::size_t>(width * rows));
        for (auto& ends : rays) ends = random_ends(random, random.chance(0.3) ? 0 : 6);
        DexelSet set(width, rows);
        assign(set, rays);
        ASSERT_TRUE(holds(set, rays));
        for (int k = 0; k < 300; ++k) {
            const auto r = static_cast<std::size_t>(random.small(0, static_cast<int>(rays.size()) - 1));
            rays[r] = random_ends(random, random.chance(0.05) ? 5000 : 12);
            set.replace(r, rays[r]);
            if (k % 30 == 0) {
                ASSERT_TRUE(holds(set, rays));
            }
        }
        ASSERT_TRUE(holds(set, rays));
        std::size_t ends = 0;
        for (const auto& ray : rays) ends += ray.size();
        ASSERT_EQ(set.end_count(), ends);
        DexelSet again(width, rows);
        assign(again, rays);
        ASSERT_TRUE(again.same_content(set));
    }
}

TEST(DexelSet, SplicesAsAVectorDoes) {
    Random random(2);
    DexelSet set = row_of(100);
    EndsOfRays rays(100);
    for (int k = 0; k < repeated(20000); ++k) {
        const int u = random.small(0, 99);
        auto& ray = rays[static_cast<std::size_t>(u)];
        const int from = random.small(0, static_cast<int>(ray.size())),
                  removed = random.small(0, static_cast<int>(ray.size()) - from);
        const auto inserted = random_ends(random, ray.size() > 40 ? 1 : 4);
        set.splice(u, 0, static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(removed), inserted);
        ray.erase(ray.begin() + from, ray.begin() + from + removed);
        ray.insert(ray.begin() + from, inserted.begin(), inserted.end());
    }
    EXPECT_TRUE(holds(set, rays));
}

TEST(DexelSet, EmptiedPagesAreGivenBack) {
    DexelSet set(1000, 10);
    const std::size_t empty = set.bytes();
    const std::vector<DexelEnd> two{{1, 2}, {3, 4}};
    for (std::size_t r = 0; r < set.ray_count(); ++r) set.replace(r, two);
    EXPECT_GT(set.bytes(), 10000u * 20u);
    EXPECT_LT(set.bytes(), 10000u * 24u);
    for (std::size_t r = 0; r < set.ray_count(); ++r) set.replace(r, {});
    EXPECT_EQ(set.bytes(), empty);
}

TEST(DexelSet, SeesEveryKindOfDifference) {
    const std::vector<DexelEnd> two{{1, 2}, {3, 4}};
    DexelSet set = row_of(2), other = row_of(2);
    set.replace(0, two);
    other.replace(0, two);
    EXPECT_TRUE(set.same_content(other));
    other.replace(0, std::vector<DexelEnd>{{1, 2}, {3, 5}});
    EXPECT_FALSE(set.same_content(other));
    other.replace(0, std::vector<DexelEnd>{{1, 2}, {7, 4}});
    EXPECT_FALSE(set.same_content(other));
    other.replace(0, two);
    other.replace(1, two);
    EXPECT_FALSE(set.same_content(other));
    other.replace(0, {});
    EXPECT_FALSE(set.same_content(other));
}

TEST(DexelSet, CopiesStandAlone) {
    DexelSet set = row_of(70);
    const std::vector<DexelEnd> two{{1, 2}, {3, 4}};
    set.replace(69, two);
    const DexelSet copy = set;
    DexelSet moved = std::move(set);
    EXPECT_TRUE(copy.same_content(moved));
    moved.replace(69, {});
    EXPECT_FALSE(copy.same_content(moved));
    EXPECT_EQ(copy.ends(69, 0).size(), 2u);
}

}  // namespace burin::compute::test
