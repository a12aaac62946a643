// SPDX-License-Identifier: MIT
#include "compute/dexel_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/compute/effort.hpp"

namespace burin::test {
namespace {

using shared::DexelEnd;
using Rays = std::vector<std::vector<DexelEnd>>;

std::vector<DexelEnd> random_ends(Random& random, int most) {
    std::vector<DexelEnd> ends(static_cast<std::size_t>(2 * random.small(0, most / 2)));
    for (DexelEnd& e : ends) e = {static_cast<std::uint32_t>(random.bits()), static_cast<std::uint32_t>(random.bits())};
    return ends;
}

void assign(DexelSet& set, const Rays& rays) {
    std::vector<std::uint32_t> counts;
    std::vector<DexelEnd> all;
    for (const auto& ends : rays) {
        counts.push_back(static_cast<std::uint32_t>(ends.size()));
        all.insert(all.end(), ends.begin(), ends.end());
    }
    set.assign(counts, all);
}

bool holds(const DexelSet& set, const Rays& rays) {
    for (std::size_t r = 0; r < rays.size(); ++r) {
        if (!std::ranges::equal(set.ends(r), rays[r], [](const DexelEnd& a, const DexelEnd& b) {
                return a.depth_material == b.depth_material && a.normal == b.normal;
            })) {
            return false;
        }
    }
    return set.ray_count() == rays.size();
}

// No two rays may share a place.
bool places_are_apart(const DexelSet& set) {
    std::vector<std::pair<std::size_t, std::size_t>> places;
    for (const shared::RayRef& ray : set.rays()) {
        if (count_of(ray) > 0) places.emplace_back(ray.first, ray.first + room_of(ray));
    }
    std::ranges::sort(places);
    for (std::size_t i = 1; i < places.size(); ++i) {
        if (places[i].first < places[i - 1].second) return false;
    }
    return places.empty() || places.back().second <= set.store().size();
}

}  // namespace

TEST(DexelSet, StartsEmpty) {
    const DexelSet set(7);
    for (std::size_t r = 0; r < 7; ++r) EXPECT_TRUE(set.ends(r).empty());
    EXPECT_TRUE(set.same_content(DexelSet(7)));
    EXPECT_FALSE(set.same_content(DexelSet(8)));
}

TEST(DexelSet, RoomIsTheNextPowerOfTwo) {
    for (std::uint32_t count = 1; count < 5000; ++count) {
        const shared::RayRef ray{0, DexelSet::count_room(count)};
        ASSERT_EQ(count_of(ray), count);
        ASSERT_GE(room_of(ray), count);
        ASSERT_TRUE(count < 2 || room_of(ray) < 2 * count);
    }
}

TEST(DexelSet, KeepsContentsThroughReplacingGrowingAndPacking) {
    Random random(1);
    for (int round = 0; round < repeated(60); ++round) {
        Rays rays(static_cast<std::size_t>(random.small(1, 40)));
        DexelSet set(rays.size());
        if (random.chance(0.7)) {
            for (auto& ends : rays) ends = random_ends(random, 12);
            assign(set, rays);
            ASSERT_TRUE(holds(set, rays));
        }
        for (int step = 0; step < 200; ++step) {
            const auto r = static_cast<std::size_t>(random.whole(0, static_cast<std::int64_t>(rays.size()) - 1));
            if (random.chance(0.05)) {
                set.make_space(static_cast<std::size_t>(random.small(0, 100)));
            } else {
                rays[r] = random_ends(random, random.chance(0.05) ? 600 : 20);
                set.replace(r, rays[r]);
            }
            ASSERT_TRUE(holds(set, rays)) << "round " << round << " step " << step;
            ASSERT_TRUE(places_are_apart(set));
        }
        DexelSet packed = set;
        packed.make_space(1000);
        EXPECT_TRUE(packed.same_content(set));
        EXPECT_NE(packed.claim(512), DexelSet::kNoPlace);
    }
}

TEST(DexelSet, SaysWhenItsSpareSpaceIsUsedUp) {
    DexelSet set(1);
    EXPECT_EQ(set.claim(4), DexelSet::kNoPlace);
    set.make_space(16);
    EXPECT_NE(set.claim(8), DexelSet::kNoPlace);
    EXPECT_NE(set.claim(8), DexelSet::kNoPlace);
    EXPECT_EQ(set.claim(2), DexelSet::kNoPlace);
    set.make_space(2);
    EXPECT_NE(set.claim(2), DexelSet::kNoPlace);
}

TEST(DexelSet, SeesEveryKindOfDifference) {
    const Rays rays{{shared::make_end(1, 0, 5), shared::make_end(9, 0, 6)}, {}};
    DexelSet set(2), other(2);
    assign(set, rays);
    const auto differs_with = [&](const std::vector<DexelEnd>& ends, std::size_t ray) {
        assign(other, rays);
        other.replace(ray, ends);
        return !set.same_content(other);
    };
    EXPECT_FALSE(differs_with(rays[0], 0));
    EXPECT_TRUE(differs_with({shared::make_end(2, 0, 5), shared::make_end(9, 0, 6)}, 0));
    EXPECT_TRUE(differs_with({shared::make_end(1, 1, 5), shared::make_end(9, 0, 6)}, 0));
    EXPECT_TRUE(differs_with({shared::make_end(1, 0, 5), shared::make_end(9, 0, 7)}, 0));
    EXPECT_TRUE(differs_with({}, 0));
    EXPECT_TRUE(differs_with(rays[0], 1));
}

TEST(DexelSet, MovingLeavesNothingBehindAndCopiesNothing) {
    DexelSet set(2);
    assign(set, {{shared::make_end(1, 0, 5), shared::make_end(9, 0, 6)}, {}});
    const DexelEnd* place = set.store().data();
    const DexelSet copy = set;
    const DexelSet moved = std::move(set);
    EXPECT_EQ(moved.store().data(), place);
    EXPECT_TRUE(moved.same_content(copy));
}

}  // namespace burin::test
