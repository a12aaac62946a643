// SPDX-License-Identifier: MIT
#include "compute/rays/extent.hpp"

#include <gtest/gtest.h>

#include "compute/rays/room.hpp"

namespace burin::compute {
namespace {

void expect_size(const Solid& solid, const Vec3& right_m, double tolerance_cells) {
    const Vec3 size = material_bounds(solid).extent();
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(size[axis], right_m[axis], tolerance_cells * solid.lattice.spacing_m)
            << "axis " << axis << ", " << solid.lattice.spacing_m << " m a cell";
}

}  // namespace

TEST(MaterialBounds, OfABlockAreItsSidesWhateverTheLattice) {
    for (const int resolution : {16, 96, 111, 256}) {
        auto block = make_block({0.12, 0.08, 0.0091}, resolution, {});
        ASSERT_TRUE(block) << block.error().line();
        expect_size(*block, {0.12, 0.08, 0.0091}, 2.0 / shared::kUnitsPerCell);
        const auto roomy = with_room(std::move(*block), 7);
        ASSERT_TRUE(roomy) << roomy.error().line();
        expect_size(*roomy, {0.12, 0.08, 0.0091}, 2.0 / shared::kUnitsPerCell);
        const Box bounds = material_bounds(*roomy);
        for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(bounds.lo[axis], 0.0, 1e-3 * roomy->lattice.spacing_m);
    }
}

// No ray meets the poles of a ball.
TEST(MaterialBounds, OfABallAreItsDiameter) {
    for (const int resolution : {16, 33, 96, 256}) {
        const auto ball = make_ball(0.03, resolution, {});
        ASSERT_TRUE(ball) << ball.error().line();
        expect_size(*ball, Vec3(0.06), 0.001);
    }
}

TEST(MaterialBounds, AreThoseOfWhatIsLeft) {
    auto block = make_block({0.1, 0.1, 0.1}, 64, {});
    ASSERT_TRUE(block) << block.error().line();
    // All rays along x lose what lies above the middle of the block.
    const auto& lattice = block->lattice;
    const int middle = static_cast<int>(lattice.units_from_object(Vec3(0.05)).x);
    DexelSet& set = block->sets[0];
    for (std::size_t ray = 0; ray < set.ray_count(); ++ray) {
        const auto ends = set.ends(ray);
        if (ends.empty()) continue;
        const std::array<shared::DexelEnd, 2> left{
            ends[0], shared::make_end(middle, shared::material_of(ends[1]), ends[1].normal)};
        set.replace(ray, left);
    }
    EXPECT_NEAR(material_bounds(*block).extent().x, 0.05, lattice.unit_m());
    for (DexelSet& each : block->sets)
        for (std::size_t ray = 0; ray < each.ray_count(); ++ray) each.replace(ray, {});
    EXPECT_TRUE(material_bounds(*block).empty());
}

// The rays along a plate thinner than a cell pass beside it: its sides are those of the rays through it.
TEST(MaterialBounds, OfAPlateThinnerThanACellAreItsOwn) {
    auto plate = make_block({0.1, 0.1, 0.1}, 64, {});
    ASSERT_TRUE(plate) << plate.error().line();
    const int low = 30 * shared::kUnitsPerCell + 100, high = low + 400;
    for (DexelSet& set : plate->sets)
        for (std::size_t ray = 0; ray < set.ray_count(); ++ray) {
            const auto ends = set.ends(ray);
            if (ends.empty()) continue;
            const std::array<shared::DexelEnd, 2> thin{shared::make_end(low, 0, ends[0].normal),
                                                       shared::make_end(high, 0, ends[1].normal)};
            const bool is_through = &set == &plate->sets[2];
            set.replace(ray,
                        is_through ? std::span<const shared::DexelEnd>(thin) : std::span<const shared::DexelEnd>());
        }
    const Vec3 size = material_bounds(*plate).extent();
    EXPECT_NEAR(size.z, 400.0 * plate->lattice.unit_m(), 0.5 * plate->lattice.unit_m());
    for (const double side : {size.x, size.y}) {
        EXPECT_LE(side, 0.1);
        EXPECT_GT(side, 0.1 - 1.01 * plate->lattice.spacing_m);
    }
}

}  // namespace burin::compute
