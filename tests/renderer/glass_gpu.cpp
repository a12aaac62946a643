// SPDX-License-Identifier: MIT
// Objects through which one sees: light adds up as linear light, whatever the format it is drawn in and however many
// samples a pixel has, and what is nearer lies over what is farther.
#include "picture/frame_setup.hpp"
#include "tests/renderer/test_scene.hpp"

namespace burin::renderer {

namespace {

constexpr Vec3 kMiddle{0.0, 0.15, 0.0};

std::shared_ptr<const picture::DrawnMesh> block(const Vec3& half_m) {
    geometry::TriangleMesh mesh;
    for (const double z : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0})
            for (const double x : {-1.0, 1.0}) mesh.positions_m.push_back(Vec3(x, y, z) * half_m);
    mesh.triangles = {{4, 5, 7}, {4, 7, 6}, {1, 0, 2}, {1, 2, 3}, {5, 1, 3}, {5, 3, 7},
                      {0, 4, 6}, {0, 6, 2}, {6, 7, 3}, {6, 3, 2}, {0, 1, 5}, {0, 5, 4}};
    return picture::drawn_mesh(mesh);
}

picture::DrawnObject plate(const Vec3& center, double turn_rad, const Vec3& colour, double opacity) {
    static const auto kPlate = block({0.03, 0.05, 0.003});
    const Quat turned{std::cos(0.5 * turn_rad), 0, std::sin(0.5 * turn_rad), 0};
    return {kPlate, {center, turned, 1.0}, colour, opacity};
}

// A board that fills the middle of the picture, behind all plates.
picture::DrawnObject board(const Vec3& colour) {
    static const auto kBoard = block({0.25, 0.2, 0.001});
    return {kBoard, {kMiddle - Vec3(0, 0, 0.12), {1, 0, 0, 0}, 1.0}, colour};
}

}  // namespace

class Glass : public PictureTest {
protected:
    Image shown_with(std::uint32_t samples, const picture::Picture& picture) {
        auto renderer = Renderer::create(device(), kTestSize, {.samples = samples});
        EXPECT_TRUE(renderer) << renderer.error().line();
        if (!renderer) return {};
        auto shown = renderer->render(picture);
        EXPECT_TRUE(shown) << shown.error().line();
        return shown ? std::move(shown->left) : Image{};
    }
    // Returns the linear light in the middle of the picture of these objects, drawn with one sample a pixel.
    Vec3 light_of(std::vector<picture::DrawnObject> objects) {
        picture::Picture picture = bare_scene();
        picture.viewer.interpupillary_m = 0.0;
        picture.objects = std::move(objects);
        const Image shown = shown_with(1, picture);
        if (shown.rgba.empty()) return {};
        const std::uint8_t* at = &shown.rgba[4 * (kTestSize.height / 2 * kTestSize.width + kTestSize.width / 2)];
        return picture::linear_of(Vec3(at[0], at[1], at[2]) / 255.0);
    }
};

// Pixels at an edge are mixed of several samples, and left out.
TEST_F(Glass, LooksWithOneSampleAPixelAsItDoesWithSeveral) {
    picture::Picture picture = bare_scene();
    picture.objects = {board({0.5, 0.5, 0.5}), plate(kMiddle - Vec3(0.1, 0, 0), 0.9, {0.6, 0.4, 0.2}, 0.4),
                       plate(kMiddle, 0.0, {0.6, 0.4, 0.2}, 0.4),
                       plate(kMiddle + Vec3(0.1, 0, 0), -0.9, {0.2, 0.9, 0.3}, 0.7)};
    picture.box.visible = true;
    picture.box.center_world = {kMiddle, {1, 0, 0, 0}};
    picture.box.size_m = {0.3, 0.2, 0.15};
    const Image one = shown_with(1, picture), several = shown_with(0, picture);
    ASSERT_EQ(one.rgba.size(), several.rgba.size());
    ASSERT_FALSE(one.rgba.empty());
    std::size_t judged = 0;
    int worst = 0;
    for (std::uint32_t y = 1; y + 1 < kTestSize.height; ++y)
        for (std::uint32_t x = 1; x + 1 < kTestSize.width; ++x) {
            const std::size_t at = 4 * (std::size_t{y} * kTestSize.width + x), row = 4 * std::size_t{kTestSize.width};
            bool is_even = true;
            for (const std::size_t beside :
                 {at - 4, at + 4, at - row, at + row, at - row - 4, at - row + 4, at + row - 4, at + row + 4})
                is_even = is_even && same_colour(&several.rgba[at], &several.rgba[beside], 3) &&
                          same_colour(&one.rgba[at], &one.rgba[beside], 3);
            if (!is_even) continue;
            ++judged;
            for (std::size_t c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(one.rgba[at + c] - several.rgba[at + c]));
        }
    EXPECT_GT(judged, kTestSize.width * kTestSize.height / 2);
    EXPECT_LE(worst, 2);
}

// What shines through is a fixed share of the light behind: the same one between black and grey as between grey and
// white. Of sRGB values the shares would be 20 % apart.
TEST_F(Glass, LetsThroughTheSameShareOfAnyLight) {
    const picture::DrawnObject clear = plate(kMiddle, 0.0, {0.6, 0.4, 0.2}, 0.4);
    const auto behind = [&](double grey) { return light_of({board(Vec3(grey))}); };
    const auto through = [&](double grey) { return light_of({board(Vec3(grey)), clear}); };
    const Vec3 dark = behind(0.0), middle = behind(0.6), light = behind(0.9);
    const Vec3 dark_through = through(0.0), middle_through = through(0.6), light_through = through(0.9);
    for (int c = 0; c < 3; ++c) {
        const double lower = (middle_through[c] - dark_through[c]) / (middle[c] - dark[c]);
        const double upper = (light_through[c] - middle_through[c]) / (light[c] - middle[c]);
        EXPECT_NEAR(lower, upper, 0.04) << "channel " << c;
        EXPECT_GT(lower, 0.3);
        EXPECT_LT(lower, 0.7);
    }
}

// The near plate adds its light and lets a share of what is behind it through, and so does the far one: as each of them
// does alone before a black and before a white board.
TEST_F(Glass, OfANearerObjectLiesOverAFartherOne) {
    const picture::DrawnObject near = plate(kMiddle + Vec3(0, 0, 0.04), 0.0, {0.1, 0.2, 0.9}, 0.6),
                               far = plate(kMiddle - Vec3(0, 0, 0.04), 0.0, {0.9, 0.2, 0.1}, 0.6);
    const Vec3 black = light_of({board(Vec3(0.0))}), white = light_of({board(Vec3(0.9))});
    const auto alone = [&](const picture::DrawnObject& object) {
        const Vec3 over_black = light_of({board(Vec3(0.0)), object}), over_white = light_of({board(Vec3(0.9)), object});
        const Vec3 share = (over_white - over_black) / (white - black);
        return std::pair(share, over_black - share * black);
    };
    const auto [near_share, near_light] = alone(near);
    const auto [far_share, far_light] = alone(far);
    const Vec3 right = near_light + near_share * (far_light + far_share * white);
    for (const auto& objects : {std::vector{board(Vec3(0.9)), near, far}, std::vector{board(Vec3(0.9)), far, near}}) {
        const Vec3 shown = light_of(objects);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], right[c], 0.012) << "channel " << c;
    }
}

}  // namespace burin::renderer
