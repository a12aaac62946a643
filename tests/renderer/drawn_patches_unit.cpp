// SPDX-License-Identifier: MIT
// What a picture of the surface has to draw again when patches change.
#include "renderer/surface/drawn_patches.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace burin::renderer {
namespace {

PatchStore::Patch patch_in(std::uint32_t slot, const Box& bounds) {
    PatchStore::Patch patch;
    patch.slot = slot;
    patch.shape.bounds = bounds;
    return patch;
}

bool has(const std::vector<Box>& boxes, const Box& box) {
    return std::ranges::any_of(boxes, [&](const Box& b) { return b.lo == box.lo && b.hi == box.hi; });
}

const Box kBefore{Vec3(0.0), Vec3(1.0)}, kAfter{Vec3(0.5), Vec3(3.0)}, kChanged{Vec3(0.9), Vec3(3.0)};

}  // namespace

// The triangles of a coarser level are others than those that changed, and the finest level takes its place.
TEST(DrawnPatches, OfACoarserLevelAreDrawnAgainWhereTheyWereAndWhereTheyAre) {
    PatchStore store;
    DrawnPatches drawn(store);
    drawn.slot_taken(0);
    const PatchStore::Patch was = patch_in(0, kBefore), now = patch_in(0, kAfter);
    drawn.of(was).level = 2;
    drawn.changed({was, now, kChanged, true});
    const DrawnPatches::Changes changes = drawn.take_changes();
    EXPECT_FALSE(changes.whole);
    EXPECT_TRUE(has(changes.boxes, kBefore));
    EXPECT_TRUE(has(changes.boxes, kAfter));
    EXPECT_EQ(drawn.of(now).level, 0u);
    EXPECT_TRUE(drawn.of(now).wanted) << "it was in view";
}

TEST(DrawnPatches, OfTheFinestLevelAreDrawnAgainWhereTheyChanged) {
    PatchStore store;
    DrawnPatches drawn(store);
    drawn.slot_taken(0);
    const PatchStore::Patch was = patch_in(0, kBefore), now = patch_in(0, kAfter);
    drawn.changed({was, now, kChanged, false});
    const DrawnPatches::Changes changes = drawn.take_changes();
    ASSERT_EQ(changes.boxes.size(), 1u);
    EXPECT_TRUE(has(changes.boxes, kChanged));
    EXPECT_FALSE(drawn.of(now).wanted) << "another light brings nothing into view";
    EXPECT_TRUE(drawn.take_changes().boxes.empty());
}

}  // namespace burin::renderer
