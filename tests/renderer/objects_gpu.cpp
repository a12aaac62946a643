// SPDX-License-Identifier: MIT
// Objects come into a scene, more than the buffers hold: the picture is that of a renderer that has never seen others.
#include "picture/frame_setup.hpp"
#include "tests/renderer/test_scene.hpp"

namespace burin::renderer {

using Objects = PictureTest;

namespace {

// A strip of so many squares across the picture's middle.
std::shared_ptr<const picture::DrawnMesh> strip(int squares, double height_m) {
    geometry::TriangleMesh mesh;
    for (int i = 0; i <= squares; ++i)
        for (const double y : {height_m, height_m + 0.02})
            mesh.positions_m.push_back({0.3 * i / squares - 0.15, y, 0.02 * (i % 2)});
    for (int i = 0; i < squares; ++i) {
        const auto at = static_cast<std::uint32_t>(2 * i);
        mesh.triangles.push_back({at, at + 2, at + 1});
        mesh.triangles.push_back({at + 1, at + 2, at + 3});
    }
    return picture::drawn_mesh(mesh);
}

}  // namespace

TEST_F(Objects, AFewThatFitAndOneThatDoesNotComeTogether) {
    const auto first = strip(4, 0.05), small = strip(6, 0.1), large = strip(9000, 0.15);
    const auto show = [&](const std::vector<std::shared_ptr<const picture::DrawnMesh>>& meshes) {
        picture::Picture picture = bare_scene();
        for (const auto& mesh : meshes) picture.objects.push_back({mesh, {}, {0.8, 0.3, 0.2}});
        return render(picture).left.rgba;
    };
    const auto alone = show({first});
    // The small one fits into the buffers there are; the large one needs others.
    const auto all = show({first, small, large});
    EXPECT_FALSE(all == alone);
    EXPECT_TRUE(show({first}) == alone);
    EXPECT_TRUE(show({large, small, first}) == all) << "whatever their order in the buffers";
}

// A red strip behind one of blue glass: both colours are in the picture where they cross, the glass alone hides
// nothing, and it makes no difference which of them comes first in the scene.
TEST_F(Objects, BehindClearOnesOthersAreSeen) {
    const auto strips = strip(1, 0.1);
    const auto show = [&](double opacity, bool clear_first) {
        picture::Picture picture = bare_scene();
        const picture::DrawnObject red{strips, {{0.0, 0.0, -0.03}, {1, 0, 0, 0}, 1.0}, {0.9, 0.1, 0.1}};
        const picture::DrawnObject blue{strips, {{0.0, 0.0, 0.03}, {1, 0, 0, 0}, 1.0}, {0.1, 0.1, 0.9}, opacity};
        if (opacity > 0.0 && clear_first) picture.objects = {blue, red};
        if (opacity > 0.0 && !clear_first) picture.objects = {red, blue};
        if (opacity == 0.0) picture.objects = {red};
        return render(picture).left;
    };
    const Image hidden = show(1.0, true), through = show(0.4, true), bare = show(0.0, true);
    EXPECT_TRUE(show(0.4, false).rgba == through.rgba);
    std::size_t mixed = 0, red = 0;
    for (std::size_t i = 0; i < bare.rgba.size(); i += 4) {
        const bool is_red = bare.rgba[i] > bare.rgba[i + 2] + 40;
        red += is_red ? 1 : 0;
        mixed += is_red && through.rgba[i] < bare.rgba[i] && through.rgba[i] > hidden.rgba[i] + 10 &&
                         through.rgba[i + 2] > bare.rgba[i + 2]
                     ? 1
                     : 0;
    }
    ASSERT_GT(red, 100u);
    EXPECT_GT(mixed, red / 2);
}

// A mesh that changes from frame to frame: each is put where the one before was, and is drawn as if it were the first.
TEST_F(Objects, AMeshThatChangesIsDrawnAsItIsNow) {
    const auto still = strip(5, 0.02);
    const auto show = [&](double height_m) {
        picture::Picture picture = bare_scene();
        picture.objects = {{still, {}, {0.2, 0.3, 0.8}}, {strip(7, height_m), {}, {0.8, 0.3, 0.2}}};
        return render(picture).left.rgba;
    };
    const auto low = show(0.08), high = show(0.2);
    EXPECT_FALSE(low == high);
    for (int i = 0; i < 5; ++i) {
        EXPECT_TRUE(show(0.08) == low);
        EXPECT_TRUE(show(0.2) == high);
    }
}

namespace {

// A wall behind the screen, and before it what casts a shadow on it.
constexpr double kWallZ_m = -0.05;
picture::Picture before_a_wall(const std::vector<picture::PictureCapsule>& capsules) {
    geometry::TriangleMesh wall;
    wall.positions_m = {{-0.3, -0.2, kWallZ_m}, {0.3, -0.2, kWallZ_m}, {0.3, 0.5, kWallZ_m}, {-0.3, 0.5, kWallZ_m}};
    wall.triangles = {{0, 1, 2}, {0, 2, 3}};
    picture::Picture picture = bare_scene();
    picture.viewer.interpupillary_m = 0.0;
    picture.objects = {{picture::drawn_mesh(wall), {}, {0.8, 0.8, 0.8}}};
    picture.capsules = capsules;
    return picture;
}

// Where the lamp's line through a place meets the wall, in pixels.
Vec2 shadow_px(const picture::Picture& picture, const Vec3& place) {
    const Vec3 down = picture::direction_to_light() * ((place.z - kWallZ_m) / picture::direction_to_light().z);
    const Vec2 at = wall::point_on_screen(picture.screen, picture.viewer.head_world.position_m, place - down);
    return {at.x / picture.wall.width_m * kTestSize.width, (1.0 - at.y / picture.wall.height_m) * kTestSize.height};
}

}  // namespace

TEST_F(Objects, CapsulesCastTheirShadowWhereTheLampsLinesMeetAWall) {
    const picture::PictureCapsule capsule{{-0.03, 0.2, 0.0}, {0.05, 0.23, 0.0}, 0.006};
    const picture::Picture picture = before_a_wall({capsule});
    const Image lit = render(before_a_wall({})).left, shaded = render(picture).left;
    Vec2 sum(0.0);
    double weight = 0.0;
    for (std::uint32_t y = 0; y < kTestSize.height; ++y)
        for (std::uint32_t x = 0; x < kTestSize.width; ++x) {
            const std::size_t at = 4 * (std::size_t{y} * kTestSize.width + x);
            const double dark = int{lit.rgba[at + 1]} - int{shaded.rgba[at + 1]};
            EXPECT_GE(dark, -2.0);  // dithered
            if (dark < 12.0) continue;
            sum += dark * Vec2(x + 0.5, y + 0.5);
            weight += dark;
        }
    ASSERT_GT(weight, 1000.0);
    const Vec2 middle = 0.5 * (shadow_px(picture, capsule.from_world) + shadow_px(picture, capsule.to_world));
    EXPECT_LT(glm::length(sum / weight - middle), 2.0);
}

// A tool within the workpiece or behind it could not be found.
TEST_F(Objects, AToolBehindSomethingIsSeenAsAnOutline) {
    const auto show = [&](double z_m, bool shown) {
        picture::Picture picture = before_a_wall({});
        picture.tool.center_world = {0.0, 0.15, z_m};
        picture.tool.radius_m = 0.02;
        picture.tool.visible = shown;
        picture.tool.stylus_world = {{0.0, 0.15, z_m}, glm::angleAxis(0.5 * std::numbers::pi, Vec3(-1.0, 0.0, 0.0))};
        return render(picture).left;
    };
    constexpr double kBehind_m = kWallZ_m - 0.05, kFar_m = kWallZ_m - 0.2;
    const Image without = show(kBehind_m, false), hidden = show(kBehind_m, true), seen = show(0.0, true);
    // Along a line across its middle: what it changes of the wall is most at its rim.
    const auto change = [&](const Image& image, double x_m, double z_m) {
        const picture::Picture picture = before_a_wall({});
        const Vec2 at =
            wall::point_on_screen(picture.screen, picture.viewer.head_world.position_m, Vec3(x_m, 0.15, z_m));
        const auto x = static_cast<std::uint32_t>(at.x / picture.wall.width_m * kTestSize.width);
        const auto y = static_cast<std::uint32_t>((1.0 - at.y / picture.wall.height_m) * kTestSize.height);
        int most = 0;
        for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(image.pixel(x, y)[c] - without.pixel(x, y)[c]));
        return most;
    };
    const int rim = change(hidden, 0.0185, kBehind_m), middle = change(hidden, 0.0, kBehind_m);
    EXPECT_GT(rim, 25);
    EXPECT_GT(middle, 3);
    EXPECT_GT(rim, 2 * middle);
    EXPECT_LE(change(hidden, 0.03, kBehind_m), 2) << "nothing beside it";
    EXPECT_GT(change(seen, 0.0, 0.0), 40);
    EXPECT_GT(change(show(kFar_m, true), 0.0185, kFar_m), 10) << "however far behind";
}

TEST_F(Objects, CapsulesKeepNoLightOffWhatTheyStandFor) {
    picture::Picture picture = before_a_wall({{{-0.03, 0.2, 0.0}, {0.05, 0.23, 0.0}, 0.006}});
    const auto lit = render(before_a_wall({})).left.rgba;
    EXPECT_FALSE(render(picture).left.rgba == lit);
    for (const std::int32_t own : {picture::kAllCapsules, 0}) {
        picture.objects.front().own_capsule = own;
        EXPECT_TRUE(render(picture).left.rgba == lit) << own;
    }
    picture.objects.front().own_capsule = 1;
    EXPECT_FALSE(render(picture).left.rgba == lit);
}

TEST_F(Objects, WithoutCapsulesNoShaderKnowsThem) {
    const auto compiled_for = [&](const picture::Picture& picture) {
        auto fresh = Renderer::create(device(), kTestSize);
        EXPECT_TRUE(fresh);
        EXPECT_TRUE(fresh->render(picture));
        return fresh->stats().pipelines;
    };
    EXPECT_EQ(compiled_for(before_a_wall({})), 1u);
    EXPECT_EQ(compiled_for(before_a_wall({{{0.0, 0.2, 0.0}, {0.0, 0.2, 0.0}, 0.01}})), 1u);
}

}  // namespace burin::renderer
