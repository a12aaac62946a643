// SPDX-License-Identifier: MIT
// The shape that is felt of random tools, against the tools' own in closed form. Making one takes most of a second.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "haptics/contact/separation.hpp"
#include "tests/compute/effort.hpp"
#include "tests/support/property_cases.hpp"
#include "toolbox/felt_tool.hpp"

namespace burin::toolbox {

// What is felt of a tool, against the tool's own shape in closed form: the place of the felt surface farthest along a
// direction, and that of the tool.
TEST(FeltShape, IsFeltAsItIsToWithinATwentiethOfItsWidth) {
    const auto reaches = [](const haptics::ToolShape& shape, const Vec3& along) {
        double most = -HUGE_VAL;
        for (std::uint32_t i = 0; i < shape.piece_count; ++i)
            most = std::max(most, -haptics::lowest(shape, shape.pieces[i], -along));
        return most + shape.rounding_m;
    };
    const auto of_cylinder = [](double radius_m, double length_m, const Vec3& n) {
        return radius_m * std::hypot(n.x, n.z) + std::max(0.0, n.y * length_m);
    };
    compute::test::Random random(5);
    for (int i = 0; i < burin::test::costly_cases(40); ++i) {
        const double radius_m = random.between(0.001, 0.005), length_m = random.between(0.001, 0.02);
        const FeltTool mill = felt_tool(compute::CylinderTool{radius_m, length_m});
        const Vec3 half(random.between(0.0005, 0.005), random.between(0.0005, 0.005), random.between(0.0005, 0.005));
        const FeltTool box = felt_tool(compute::BoxTool{half});
        const double corner_m = random.between(0.1, 0.9) * radius_m;
        const FeltTool bull = felt_tool(compute::BullNoseTool{radius_m, corner_m, length_m + corner_m});
        const double tip_m = random.between(0.0, 0.5) * radius_m;
        const FeltTool cone = felt_tool(compute::ConeTool{tip_m, radius_m, length_m});
        for (int k = 0; k < 200; ++k) {
            const Vec3 n = glm::normalize(Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)));
            const double width_m = std::min(2.0 * radius_m, length_m);
            EXPECT_NEAR(reaches(mill.shape, n), of_cylinder(radius_m, length_m, n), 0.05 * width_m);
            EXPECT_NEAR(reaches(box.shape, n), glm::dot(glm::abs(n), half), 0.1 * std::min({half.x, half.y, half.z}));
            const double across = std::hypot(n.x, n.z);
            const double nose = std::max({(radius_m - corner_m) * across - corner_m * -n.y + corner_m,
                                          radius_m * across + n.y * (length_m + corner_m)});
            EXPECT_NEAR(reaches(bull.shape, n), n.y > 0.0 ? radius_m * across + n.y * (length_m + corner_m) : nose,
                        0.05 * std::min(2.0 * radius_m, length_m + corner_m));
            const double pointed = std::max(tip_m * across, radius_m * across + n.y * length_m);
            EXPECT_NEAR(reaches(cone.shape, n), pointed, std::max(0.05 * width_m, cone.differs_m));
        }
        EXPECT_LE(mill.differs_m, 0.05 * std::min(2.0 * radius_m, length_m));
        EXPECT_LE(box.differs_m, 0.1 * std::min({half.x, half.y, half.z}));
    }
}

}  // namespace burin::toolbox
