// SPDX-License-Identifier: MIT
// Steps of undo as pages: one that is larger than a page may be is whole again when it is read.
#include "workpiece/saved_changes.hpp"

#include <gtest/gtest.h>

#include "workpiece/saved_solid.hpp"

namespace burin::workpiece {

TEST(SavedChanges, OfAHugeStrokeAreWholeInSeveralPages) {
    compute::Solid solid;
    solid.lattice.spacing_m = 0.001;
    solid.lattice.cells = {700, 700, 700};
    solid.materials.resize(1);
    compute::RayBatch stroke;
    for (int axis = 0; axis < 2; ++axis) {
        for (int v = 0; v <= 700; ++v) {
            for (int u = 0; u <= 700; ++u) {
                const std::array ends{shared::make_end(u, 0, 0), shared::make_end(u + 1 + v, 0, 7)};
                stroke.add(shared::ray_code(axis, u, v), ends);
            }
        }
    }
    compute::History history;
    ASSERT_TRUE(history.put_before(stroke));
    scene::Pages pages;
    save_steps(history, pages);
    ASSERT_TRUE(pages.steps);
    EXPECT_EQ(pages.steps->pages.size(), 2u);
    scene::Pages step;
    for (const auto& [name, bytes] : pages.steps->pages) {
        EXPECT_LT(bytes.size(), kMostRayBytes + 100);
        EXPECT_EQ(name.number, history.done());
        step.pages[{name.kind, 0}] = bytes;
    }
    const auto read = step_in(solid, step, "work.burin");
    ASSERT_TRUE(read) << read.error().line();
    ASSERT_EQ(read->rays.size(), stroke.rays.size());
    for (std::size_t ray = 0; ray < stroke.rays.size(); ++ray) {
        ASSERT_EQ(read->rays[ray].code, stroke.rays[ray].code);
        ASSERT_EQ(read->rays[ray].count, 2u);
        ASSERT_EQ(read->ends_of(read->rays[ray])[1].depth_material, stroke.ends_of(stroke.rays[ray])[1].depth_material);
        ASSERT_EQ(read->ends_of(read->rays[ray])[1].normal, stroke.ends_of(stroke.rays[ray])[1].normal);
    }
    // A ray twice, or one that is none of the solid's, is no step.
    step.pages[{"rays 2", 0}] = step.pages[{"rays", 0}];
    EXPECT_FALSE(step_in(solid, step, "work.burin"));
    solid.lattice.cells[0] = 50;
    EXPECT_FALSE(step_in(solid, step, "work.burin"));
}

TEST(SavedChanges, WithoutBytesAreNone) {
    compute::Solid solid;
    solid.lattice.spacing_m = 0.001;
    solid.lattice.cells = {16, 16, 16};
    solid.materials.resize(1);
    const scene::Pages step{.part = std::string(kSolidPart), .whole = false, .pages = {{{"rays", 0}, {}}}};
    EXPECT_FALSE(step_in(solid, step, "work.burin"));
}

}  // namespace burin::workpiece
