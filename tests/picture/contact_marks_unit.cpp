// SPDX-License-Identifier: MIT
// The signs of a contact stand where the contact is, clear of the tool, and are of a length that can be read.
#include "picture/contact_marks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "picture/frame_setup.hpp"

namespace burin::picture {
namespace {

// A ball of 2 cm that rests on a slope.
Picture touching(double force_N) {
    Picture picture;
    const Vec3 normal = glm::normalize(Vec3(0.3, 1.0, 0.5)), point(0.1, 1.0, -0.2);
    picture.tool.radius_m = 0.02;
    picture.tool.center_world = point + 0.02 * normal;
    picture.tool.stylus_world.position_m = picture.tool.center_world;
    picture.tool.visible = true;
    picture.contact.point_world = point;
    picture.contact.normal_world = 7.0 * normal;
    picture.contact.force_N = force_N * glm::normalize(Vec3(0.5, 1.0, 0.4));
    picture.contact.metres_per_N = 0.03;
    picture.contact.visible = true;
    return picture;
}

Vec3 tip_of(const ForceArrow& a) { return a.from_world + a.length_m * a.direction_world; }

bool holds(const Box& box, const Vec3& p) {
    constexpr double kRounding_m = 1e-12;
    for (int i = 0; i < 3; ++i)
        if (p[i] < box.lo[i] - kRounding_m || p[i] > box.hi[i] + kRounding_m) return false;
    return true;
}

}  // namespace

TEST(ContactMarks, ThereAreNoneWithoutContactOrWithNumbersThatAreNone) {
    Picture picture = touching(1.0);
    ASSERT_TRUE(contact_marks(picture).arrow && contact_marks(picture).ring);
    picture.contact.visible = false;
    EXPECT_EQ(contact_marks(picture), ContactMarks{});
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        picture = touching(1.0);
        picture.contact.force_N.y = bad;
        EXPECT_EQ(contact_marks(picture), ContactMarks{});
        picture = touching(1.0);
        picture.contact.metres_per_N = bad;
        EXPECT_EQ(contact_marks(picture), ContactMarks{});
    }
    picture = touching(1.0);
    picture.contact.normal_world = Vec3(0.0);
    EXPECT_FALSE(contact_marks(picture).ring);
    EXPECT_TRUE(contact_marks(picture).arrow);
}

TEST(ContactMarks, TheArrowIsAsLongAsTheForceIsStrongBetweenBounds) {
    for (const double force_N : {0.6, 1.0, 2.2, 4.0}) {
        EXPECT_NEAR(contact_marks(touching(force_N)).arrow->length_m, 0.03 * force_N, 1e-12) << force_N;
    }
    EXPECT_FALSE(contact_marks(touching(0.0)).arrow);
    EXPECT_FALSE(contact_marks(touching(0.049)).arrow);
    const double least = contact_marks(touching(0.051)).arrow->length_m,
                 most = contact_marks(touching(500.0)).arrow->length_m;
    EXPECT_NEAR(least, 0.6 * 0.03, 1e-12);
    EXPECT_NEAR(most, 4.0 * 0.03, 1e-12);
    for (double force_N = 0.051; force_N < 6.0; force_N += 0.01) {
        const ForceArrow a = *contact_marks(touching(force_N)).arrow;
        EXPECT_LT(a.head_m, 0.7 * a.length_m) << "a shaft is left at " << force_N;
        EXPECT_GT(a.head_radius_m, 2.0 * a.shaft_radius_m);
        EXPECT_GE(a.head_m, 0.25 * 0.03) << "the head can be seen at " << force_N;
    }
}

TEST(ContactMarks, TheArrowLiesOnTheForcesLineThroughTheContactAndOutsideTheBall) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int i = 0; i < 500; ++i) {
        Picture picture = touching(1.0);
        picture.contact.force_N = {any(random), any(random), any(random)};
        const auto arrow = contact_marks(picture).arrow;
        if (!arrow) continue;
        EXPECT_NEAR(glm::dot(arrow->direction_world, glm::normalize(picture.contact.force_N)), 1.0, 1e-12);
        const Vec3 offset = arrow->from_world - picture.contact.point_world;
        EXPECT_GE(glm::dot(offset, arrow->direction_world), 0.0);
        EXPECT_LT(glm::length(glm::cross(offset, arrow->direction_world)), 1e-12);
        for (int step = 0; step <= 20; ++step) {
            const Vec3 p = glm::mix(arrow->from_world, tip_of(*arrow), step / 20.0);
            EXPECT_GE(glm::length(p - picture.tool.center_world), picture.tool.radius_m);
        }
    }
}

TEST(ContactMarks, WithoutATouchingBallTheyStandAtThePointItself) {
    Picture picture = touching(1.0);
    picture.tool.visible = false;
    EXPECT_EQ(contact_marks(picture).arrow->from_world, picture.contact.point_world);
    const double bare = contact_marks(picture).ring->radius_m;
    picture.tool.visible = true;
    EXPECT_GT(contact_marks(picture).ring->radius_m, picture.tool.radius_m) << "shows around the ball";
    picture.tool.center_world.x += 1.0;
    EXPECT_EQ(contact_marks(picture).ring->radius_m, bare);
}

// What the picture is drawn from lies within the bounds that a redraw goes by.
TEST(ContactMarks, AllVerticesLieWithinTheBoxes) {
    const Primitives primitives = make_primitives();
    std::mt19937 random(4);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int i = 0; i < 20; ++i) {
        Picture picture = touching(1.0);
        picture.show_wall_frame = picture.tool.visible = false;
        picture.contact.normal_world = {any(random), any(random), any(random)};
        picture.contact.force_N = Vec3{any(random), any(random), any(random)} + Vec3(0.1);
        const std::array boxes = boxes_of(contact_marks(picture));
        const Shapes shapes = shapes_of(picture, primitives);
        ASSERT_EQ(shapes.solid.size(), 3u);
        for (const Shape& shape : shapes.solid) {
            for (std::uint32_t k = 0; k < shape.range.index_count; ++k) {
                const shared::SurfaceVertex& v = primitives.vertices[primitives.indices[shape.range.first_index + k]];
                const Vec3 p(Mat4(shape.constants.world_from_local) * glm::dvec4(v.x, v.y, v.z, 1.0));
                const auto in = [&](Box box) {  // float's rounding
                    box.lo -= Vec3(1e-6), box.hi += Vec3(1e-6);
                    return holds(box, p);
                };
                ASSERT_TRUE(in(boxes[0]) || in(boxes[1])) << i;
            }
        }
    }
}

}  // namespace burin::picture
