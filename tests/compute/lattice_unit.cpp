// SPDX-License-Identifier: MIT
#include "compute/rays/lattice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "compute/rays/solid.hpp"
#include "tests/compute/effort.hpp"

namespace burin::compute::test {
namespace {

double distance_to_node(double cells) { return std::abs(cells - std::round(cells)); }

std::string refusal(const Box& bounds, int resolution) {
    const auto lattice = lattice_around(bounds, resolution);
    return lattice ? "" : lattice.error().line();
}

}  // namespace

TEST(Lattice, FacesStayClearOfNodesAndOneEmptyCellLiesAround) {
    Random random(1);
    for (int i = 0; i < repeated(200000); ++i) {
        Box bounds;
        const double size = std::pow(10.0, random.between(-4, 3));
        const Vec3 at = Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)) *
                        (size * std::pow(10.0, random.between(-2, 4)));
        Vec3 extent;
        const int resolution = random.small(16, 2048);
        for (int a = 0; a < 3; ++a) {
            extent[a] = random.chance(0.3) ? size : size * random.unit();
            if (random.chance(0.2)) extent[a] = size * random.small(0, resolution) / resolution;  // whole cells
        }
        extent[random.small(0, 2)] = size;
        bounds.include(at);
        bounds.include(at + extent);
        const auto lattice = lattice_around(bounds, resolution);
        ASSERT_TRUE(lattice.has_value()) << lattice.error().line();
        for (int a = 0; a < 3; ++a) {
            const double lo = lattice->units_from_object(bounds.lo)[a] / 4096,
                         hi = lattice->units_from_object(bounds.hi)[a] / 4096;
            const int cells = lattice->cells[static_cast<std::size_t>(a)];
            ASSERT_GE(distance_to_node(lo), 0.2);
            ASSERT_GE(distance_to_node(hi), 0.2);
            ASSERT_GE(lo, 1.0);
            ASSERT_LE(hi, cells - 1.0);
            ASSERT_LE(cells, shared::kMaxCells);
            ASSERT_LE(cells, (hi - lo) + 4.0);  // and hardly more than asked for
        }
    }
}

TEST(Lattice, RefusesResolutionsOutsideItsRange) {
    const Box cube{Vec3(0), Vec3(1)};
    for (const int resolution : {-1, 0, 15, 2049, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
        EXPECT_NE(refusal(cube, resolution).find("16 to 2048"), std::string::npos);
    }
    EXPECT_EQ(refusal(cube, 16), "");
    EXPECT_EQ(refusal(cube, 2048), "");
}

TEST(Lattice, RefusesBoundsThatAreEmptyFlatOrNotFinite) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    EXPECT_NE(refusal(Box{}, 64), "");
    EXPECT_NE(refusal(Box{Vec3(3), Vec3(3)}, 64), "");
    for (int axis = 0; axis < 3; ++axis) {
        for (const double bad : {nan, inf}) {
            Box box{Vec3(0), Vec3(1)};
            box.hi[axis] = bad;
            EXPECT_NE(refusal(box, 64), "") << axis;
            box = {Vec3(0), Vec3(1)};
            box.lo[axis] = bad == inf ? -inf : bad;
            EXPECT_NE(refusal(box, 64), "") << axis;
        }
    }
    EXPECT_NE(refusal(Box{Vec3(0), Vec3(1e300)}, 64), "");
    EXPECT_NE(refusal(Box{Vec3(0), Vec3(1e-300)}, 64), "");
    EXPECT_EQ(refusal(Box{Vec3(0), Vec3(1, 0, 0)}, 64), "");
}

TEST(Lattice, RefusesAWorkpieceTooFarFromTheOriginToKeepItsShape) {
    EXPECT_NE(refusal(Box{Vec3(1e12), Vec3(1e12 + 1)}, 64).find("origin"), std::string::npos);
    EXPECT_EQ(refusal(Box{Vec3(1e6), Vec3(1e6 + 1)}, 64), "");
}

TEST(Blocks, RefuseSizesThatLeaveNothing) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    for (const Vec3& size : {Vec3(0, 1, 1), Vec3(1, -1, 1), Vec3(1, 1, nan), Vec3(inf, 1, 1), Vec3(1, 1, 0.001)}) {
        const auto block = make_block(size, 64, {"block", {}});
        ASSERT_FALSE(block.has_value());
        EXPECT_FALSE(block.error().remedy.empty());
    }
    for (const double radius : {0.0, -1.0, nan, inf, 1e300, 1e-300}) {
        EXPECT_FALSE(make_ball(radius, 64, {"ball", {}}).has_value()) << radius;
    }
}

TEST(Blocks, AreWellFormedAndHoldTheirVolumeOnEveryAxis) {
    Random random(2);
    for (int i = 0; i < repeated(40); ++i) {
        const Vec3 size(random.between(0.2, 1), random.between(0.2, 1), random.between(0.2, 1));
        const int resolution = random.small(16, 70);
        const auto block = make_block(size, resolution, {"block", {}});
        ASSERT_TRUE(block.has_value());
        ASSERT_TRUE(well_formed(*block));
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            std::size_t hit = 0;
            for (std::size_t r = 0; r < block->sets[a].ray_count(); ++r) {
                const auto ends = block->sets[a].ends(r);
                if (ends.empty()) continue;
                ++hit;
                ASSERT_EQ(ends.size(), 2u);
                ASSERT_NEAR((depth_of(ends[1]) - depth_of(ends[0])) * block->lattice.unit_m(), size[axis],
                            block->lattice.unit_m());
            }
            const double h = block->lattice.spacing_m;
            const double across = size[(axis + 1) % 3] * size[(axis + 2) % 3];
            EXPECT_NEAR(static_cast<double>(hit) * h * h, across, 2.1 * h);
        }
    }
}

}  // namespace burin::compute::test
