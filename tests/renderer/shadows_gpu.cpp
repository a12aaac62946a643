// SPDX-License-Identifier: MIT
// The shadows that objects cast on others, on themselves and on the floor, drawn through a map of depths.
#include <tuple>

#include "picture/frame_setup.hpp"
#include "picture/lamp_view.hpp"
#include "tests/renderer/test_scene.hpp"

namespace burin::renderer {

using ObjectShadows = PictureTest;

namespace {

constexpr double kGround_m = 0.05;

std::shared_ptr<const picture::DrawnMesh> level_plate(double half_m) {
    geometry::TriangleMesh mesh;
    mesh.positions_m = {{-half_m, 0, half_m}, {half_m, 0, half_m}, {half_m, 0, -half_m}, {-half_m, 0, -half_m}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return picture::drawn_mesh(mesh);
}

std::shared_ptr<const picture::DrawnMesh> round_ball(double radius_m) {
    geometry::TriangleMesh mesh;
    constexpr int kRings = 24, kAround = 48;
    for (int i = 0; i <= kRings; ++i)
        for (int j = 0; j < kAround; ++j) {
            const double up = std::numbers::pi * (1.0 * i / kRings - 0.5), a = 2.0 * std::numbers::pi * j / kAround;
            mesh.positions_m.push_back(radius_m *
                                       Vec3(std::cos(up) * std::cos(a), std::sin(up), -std::cos(up) * std::sin(a)));
        }
    for (int i = 0; i < kRings; ++i)
        for (int j = 0; j < kAround; ++j) {
            const auto at = [&](int ring, int k) { return static_cast<std::uint32_t>(ring * kAround + k % kAround); };
            mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
        }
    return picture::drawn_mesh(mesh);
}

constexpr double kBall_m = 0.02;

// A wide plate, and a ball above it.
picture::Picture above_ground(const Vec3& ball_world, bool casts = true, double opacity = 1.0) {
    static const auto ground = level_plate(0.16), ball = round_ball(kBall_m);
    picture::Picture picture = bare_scene();
    picture.viewer.head_world.position_m = {0.0, 0.45, 0.6};
    picture.viewer.interpupillary_m = 0.0;
    picture.objects = {{ground, {{0.0, kGround_m, -0.1}, {1, 0, 0, 0}, 1.0}, {0.7, 0.7, 0.7}},
                       {ball, {ball_world, {1, 0, 0, 0}, 1.0}, {0.8, 0.3, 0.2}, opacity}};
    for (picture::DrawnObject& object : picture.objects) object.casts_shadow = casts;
    return picture;
}

Vec2 place_px(const picture::Picture& picture, const Vec3& place) {
    const Vec2 at = wall::point_on_screen(picture.screen, middle_of(wall::eyes_of(picture.viewer)), place);
    return {at.x / picture.wall.width_m * kTestSize.width, (1.0 - at.y / picture.wall.height_m) * kTestSize.height};
}

// Where the lamp's line through a place meets the ground.
Vec3 below(const Vec3& place) {
    return place - picture::direction_to_light() * ((place.y - kGround_m) / picture::direction_to_light().y);
}

int green_at(const Image& image, const Vec2& px) {
    return image.pixel(static_cast<std::uint32_t>(px.x), static_cast<std::uint32_t>(px.y))[1];
}

const Vec3 kBallPlace{-0.04, 0.13, -0.1};

}  // namespace

TEST_F(ObjectShadows, LieWhereTheLampsLinesThroughAnObjectMeetTheGround) {
    const picture::Picture picture = above_ground(kBallPlace);
    const Image shaded = render(picture).left, lit = render(above_ground(kBallPlace, false)).left;
    Vec2 sum(0.0);
    double weight = 0.0;
    const Vec2 ball = place_px(picture, kBallPlace);
    for (std::uint32_t y = 0; y < kTestSize.height; ++y)
        for (std::uint32_t x = 0; x < kTestSize.width; ++x) {
            if (glm::length(Vec2(x, y) - ball) < 18.0) continue;  // its own dark side
            const int dark = int{lit.pixel(x, y)[1]} - int{shaded.pixel(x, y)[1]};
            if (dark < 12) continue;
            sum += double(dark) * Vec2(x + 0.5, y + 0.5);
            weight += dark;
        }
    ASSERT_GT(weight, 2000.0) << "there is no shadow";
    EXPECT_LT(glm::length(sum / weight - place_px(picture, below(kBallPlace))), 2.0);
}

TEST_F(ObjectShadows, AreNoneOfWhatOneSeesThrough) {
    const picture::Picture clear = above_ground(kBallPlace, true, 0.4);
    const Vec2 there = place_px(clear, below(kBallPlace));
    const Image lit = render(above_ground(kBallPlace, false)).left;
    EXPECT_LT(green_at(render(above_ground(kBallPlace)).left, there), green_at(lit, there) - 40);
    EXPECT_NEAR(green_at(render(clear).left, there), green_at(lit, there), 2);
}

// The map is kept from frame to frame, and is drawn anew when an object has moved.
TEST_F(ObjectShadows, FollowAnObjectThatMoves) {
    render(above_ground(kBallPlace));
    const Vec3 elsewhere = kBallPlace + Vec3(0.08, 0.02, 0.03);
    const Image moved = render(above_ground(elsewhere)).left;
    auto fresh = Renderer::create(device(), kTestSize);
    ASSERT_TRUE(fresh);
    EXPECT_TRUE(fresh->render(above_ground(elsewhere))->left.rgba == moved.rgba);
    picture::Picture gone = above_ground(elsewhere);
    gone.objects.pop_back();
    const Vec2 there = place_px(gone, below(elsewhere));
    EXPECT_GT(green_at(render(gone).left, there), green_at(moved, there) + 40) << "hidden objects cast none";
}

// Where the tool alone has moved a part of the picture is drawn, with the shadows of all objects in it.
TEST_F(ObjectShadows, AreInAPartOfThePictureAsInTheWhole) {
    const auto with_tool = [&](double x_m) {
        picture::Picture picture = above_ground(kBallPlace);
        picture.tool.visible = true;
        picture.tool.radius_m = 0.01;
        picture.tool.center_world = below(kBallPlace) + Vec3(x_m, 0.02, 0.0);
        picture.tool.stylus_world.position_m = picture.tool.center_world;
        return picture;
    };
    render(with_tool(0.0));
    const Image in_part = render(with_tool(0.02)).left;
    EXPECT_FALSE(renderer().stats().whole);
    renderer().forget_picture();
    EXPECT_TRUE(render(with_tool(0.02)).left.rgba == in_part.rgba);
}

// No stripes on what faces the lamp or is seen by it aslant.
TEST_F(ObjectShadows, LeaveALitSurfaceWithoutStripes) {
    const picture::Picture picture = above_ground(kBallPlace);
    const Image shaded = render(picture).left, lit = render(above_ground(kBallPlace, false)).left;
    std::size_t darker = 0, seen = 0;
    const Vec2 there = place_px(picture, below(kBallPlace));
    for (std::uint32_t y = 0; y < kTestSize.height; ++y)
        for (std::uint32_t x = 0; x < kTestSize.width; ++x) {
            if (glm::length(Vec2(x, y) - there) < 36.0) continue;
            const bool is_ball = glm::length(Vec2(x, y) - place_px(picture, kBallPlace)) < 18.0;
            // Of the ball, what the lamp sees by far.
            if (is_ball && y > place_px(picture, kBallPlace).y) continue;
            ++seen;
            darker += int{lit.pixel(x, y)[1]} - int{shaded.pixel(x, y)[1]} > 3 ? 1 : 0;
        }
    EXPECT_GT(seen, 20'000u);
    EXPECT_EQ(darker, 0u);
}

TEST_F(ObjectShadows, LieAtOnePlaceForBothEyes) {
    picture::Picture picture = above_ground(kBallPlace);
    picture.viewer.interpupillary_m = 0.06;
    const StereoImage both = render(picture);
    const wall::Eyes eyes = wall::eyes_of(picture.viewer);
    picture::Picture bare = above_ground(kBallPlace, false);
    bare.viewer.interpupillary_m = 0.06;
    const StereoImage lit = render(bare);
    for (const auto& [eye, image, without] :
         {std::tuple(eyes.left_world, &both.left, &lit.left), std::tuple(eyes.right_world, &both.right, &lit.right)}) {
        const Vec2 at = wall::point_on_screen(picture.screen, eye, below(kBallPlace));
        const Vec2 px{at.x / picture.wall.width_m * kTestSize.width,
                      (1.0 - at.y / picture.wall.height_m) * kTestSize.height};
        EXPECT_LT(green_at(*image, px), green_at(*without, px) - 40);
    }
}

// The floor's pixels without a shadow have a shader of their own: none of an object's shadow may be among them.
TEST_F(ObjectShadows, OnTheFloorAreWholeWhereItIsDrawnInPlainParts) {
    auto plain = Renderer::create(device(), kTestSize, {.samples = 1, .savings = {.plain_room = true}}),
         full = Renderer::create(device(), kTestSize, {.samples = 1, .savings = {.plain_room = false}});
    ASSERT_TRUE(plain && full);
    for (const Vec3& place : {Vec3(0.0, 0.1, -0.3), Vec3(0.2, 0.3, -0.6), Vec3(-0.3, 0.05, -0.8)}) {
        picture::Picture picture = above_ground(place);
        picture.objects.erase(picture.objects.begin());
        picture.show_grid = true;
        const auto in_parts = plain->render(picture), whole = full->render(picture);
        ASSERT_TRUE(in_parts && whole);
        EXPECT_GT(plain->stats().plain_room, 0u);
        for (std::size_t i = 0; i < whole->left.rgba.size(); i += 4)
            ASSERT_TRUE(same_colour(&in_parts->left.rgba[i], &whole->left.rgba[i], 1)) << i / 4;
        picture.objects.front().casts_shadow = false;
        EXPECT_FALSE(full->render(picture)->left.rgba == whole->left.rgba) << "there is a shadow on the floor";
    }
}

TEST(LampView, HoldsAllThatCastsShadowsAndNothingWhereNothingDoes) {
    EXPECT_FALSE(picture::lamp_view(above_ground(kBallPlace, false)));
    const picture::Picture picture = above_ground(kBallPlace);
    const auto view = picture::lamp_view(picture);
    ASSERT_TRUE(view);
    for (const picture::DrawnObject& object : picture.objects) {
        const Box box = picture::bounds_world(object);
        for (const Vec3& corner : {box.lo, box.hi}) {
            const glm::dvec4 at = view->map_from_world * glm::dvec4(corner, 1.0);
            EXPECT_LE(std::max(std::abs(at.x), std::abs(at.y)), 1.0);
            EXPECT_TRUE(at.z >= 0.0 && at.z <= 1.0) << at.z;
        }
    }
    // A little motion of one object moves neither the map's size nor its texels.
    const auto moved = picture::lamp_view(above_ground(kBallPlace + Vec3(0.001, 0.0, 0.0)));
    EXPECT_TRUE(moved->map_from_world == view->map_from_world);
}

}  // namespace burin::renderer
