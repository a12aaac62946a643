// SPDX-License-Identifier: MIT
// The panel that stands in the scene as the renderer draws it: its colours, what hides it, when it is drawn anew.
#include <algorithm>

#include "tests/renderer/panel/panel_pictures.hpp"
#include "tests/renderer/test_scene.hpp"

namespace burin::renderer {
namespace {

constexpr ImageSize kPanel{64, 48};
constexpr PixelRect kPlace{90, 70, 64, 48};  // in the picture

double linear(double srgb) {
    const double c = srgb / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
double srgb(double linear) {
    return 255.0 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
}

// In the screen's plane, where both eyes see one of its pixels through one of the picture's.
picture::PanelStand stand_pixel_on_pixel(const picture::Picture& picture) {
    const double px = pixel_m(picture);
    const Vec3 corner = pixel_centre_world(picture, kPlace.x, kPlace.y) + Vec3(-0.5 * px, 0.5 * px, 0.0);
    const Vec2 size{px * kPanel.width, px * kPanel.height};
    return {{corner + Vec3(0.5 * size.x, -0.5 * size.y, 0.0), Quat{1, 0, 0, 0}}, size};
}

// A ground that lets a little through, a card, and things on them whose edges are letters'.
PanelMesh busy_mesh() {
    PanelMesh mesh;
    add_box(mesh, {0, 0, 64, 48}, rgba(38, 41, 45, 236));
    add_box(mesh, {4, 4, 30, 20}, rgba(226, 163, 96, 255));
    for (std::uint32_t i = 0; i < 12; ++i)  // lines of a pixel's width
        add_box(mesh, {6 + 2 * i, 6, 1, 16}, rgba(222, 225, 228, 255), i % 3 == 0 ? kThird : kCovered);
    add_box(mesh, {38, 4, 20, 20}, rgba(10, 250, 128, 90), kThird);
    return mesh;
}

PanelMesh plain_mesh(std::uint32_t colour) {
    PanelMesh mesh;
    add_box(mesh, {0, 0, 64, 48}, colour);
    return mesh;
}

class ScenePanelTest : public gpu::DeviceTest {
protected:
    PanelPainter painted(const PanelMesh& mesh) {
        auto painter = PanelPainter::create(device(), kPanel, plain_atlas());
        EXPECT_TRUE(painter) << painter.error().line();
        paint(*painter, mesh);
        return std::move(*painter);
    }
    void paint(PanelPainter& painter, const PanelMesh& mesh) {
        auto commands = gpu::Commands::begin(device());
        EXPECT_TRUE(painter.record(*commands, mesh));
        auto submission = std::move(*commands).submit();
        EXPECT_TRUE(submission && submission->wait());
    }
    Renderer make(std::uint32_t samples) {
        auto renderer = Renderer::create(device(), kTestSize, {.samples = samples});
        EXPECT_TRUE(renderer) << renderer.error().line();
        return std::move(*renderer);
    }
};

// The panel's colours with their alpha, painted over one another as toolkits mean it: sRGB values, premultiplied.
std::array<double, 4> over(std::array<double, 4> below, std::array<double, 4> above) {
    for (std::size_t k = 0; k < 4; ++k) below[k] = above[k] + below[k] * (1.0 - above[3]);
    return below;
}
std::array<double, 4> colour(double r, double g, double b, double a) { return {r * a, g * a, b * a, a}; }

// What busy_mesh() is at a pixel, worked out here.
std::array<double, 4> busy_at(std::uint32_t x, std::uint32_t y) {
    std::array<double, 4> c = colour(38, 41, 45, 236 / 255.0);
    if (x >= 4 && x < 34 && y >= 4 && y < 24) c = over(c, colour(226, 163, 96, 1.0));
    if (x >= 6 && x < 30 && (x - 6) % 2 == 0 && y >= 6 && y < 22)
        c = over(c, colour(222, 225, 228, (x - 6) / 2 % 3 == 0 ? 1.0 / 3.0 : 1.0));
    if (x >= 38 && x < 58 && y >= 4 && y < 24) c = over(c, colour(10, 250, 128, 90 / 255.0 / 3.0));
    return c;
}

}  // namespace

TEST_F(ScenePanelTest, HasTheOverlaysColoursWhereItsPixelsAreThePictures) {
    const PanelPainter painter = painted(busy_mesh());
    picture::Picture picture = bare_scene();
    picture.background = {0.56, 0.57, 0.59};
    picture.panel = picture::PicturePanel{stand_pixel_on_pixel(picture), 1};
    for (const std::uint32_t samples : {1u, device().capabilities().msaa_samples}) {
        Renderer renderer = make(samples);
        renderer.show_panel(painter.view());
        const auto shown = renderer.render(picture);
        ASSERT_TRUE(shown) << shown.error().line();
        for (const Image* image : {&shown->left, &shown->right}) {
            double worst = 0.0;
            for (std::uint32_t y = 0; y < kPanel.height; ++y) {
                for (std::uint32_t x = 0; x < kPanel.width; ++x) {
                    const std::array<double, 4> c = busy_at(x, y);
                    const std::uint8_t* pixel = image->pixel(kPlace.x + x, kPlace.y + y);
                    for (std::size_t k = 0; k < 3; ++k) {
                        const double behind = linear(255.0 * picture.background[static_cast<int>(k)]);
                        const double expected = srgb(linear(c[k] / c[3]) * c[3] + behind * (1.0 - c[3]));
                        worst = std::max(worst, std::abs(pixel[k] - expected));
                    }
                }
            }
            // A step in the panel's own picture, which is stored in 8 bits, and half a one in this.
            EXPECT_LE(worst, 1.6) << samples << " samples";
            const std::uint8_t* beside = image->pixel(kPlace.x - 1, kPlace.y);
            EXPECT_TRUE(same_colour(beside, image->pixel(0, 0))) << "to the pixel";
        }
    }
}

TEST_F(ScenePanelTest, IsNeitherLitNorShaded) {
    const PanelPainter painter = painted(plain_mesh(rgba(120, 200, 80, 255)));
    picture::Picture picture = bare_scene();
    const Vec3 middle{0.0, 0.15, 0.0};
    Renderer renderer = make(1);
    renderer.show_panel(painter.view());
    for (const double turn : {0.0, 0.9, -1.2}) {
        picture.panel = picture::PicturePanel{{{middle, glm::angleAxis(turn, Vec3(1, 0, 0))}, {0.1, 0.1}}, 1};
        // The tool right above it, between it and the lamp.
        const Vec3 above = middle + Vec3(0.0, 0.03, 0.02);
        picture.tool = {0.01, above, {0.9, 0.4, 0.1}, {above, glm::angleAxis(-1.5, Vec3{1, 0, 0})}, true};
        const auto shown = renderer.render(picture);
        ASSERT_TRUE(shown);
        const std::uint8_t* pixel = shown->left.pixel(kTestSize.width / 2, kTestSize.height / 2 + 2);
        constexpr std::array<std::uint8_t, 3> kOwn{120, 200, 80};
        EXPECT_TRUE(same_colour(pixel, kOwn.data(), 1)) << turn;
    }
}

TEST_F(ScenePanelTest, IsHiddenByWhatStandsNearerAndHidesWhatIsBehind) {
    const PanelPainter painter = painted(plain_mesh(rgba(0, 0, 255, 255)));
    for (const std::uint32_t samples : {1u, device().capabilities().msaa_samples}) {
        Renderer renderer = make(samples);
        renderer.show_panel(painter.view());
        Surface plate;
        plate.quad({0, 0.15, 0}, {0.04, 0, 0}, {0, 0.04, 0}, kRed);
        renderer.surface().set_patch(0, plate.vertices, plate.indices);
        picture::Picture picture = bare_scene();
        picture.show_grid = true;
        picture.bubble = {{0, 0.15, 0.1}, 0.03, {0.2, 0.8, 0.3}, false};
        for (const double z : {0.05, -0.05}) {
            picture.panel = picture::PicturePanel{{{{0, 0.15, z}, Quat{1, 0, 0, 0}}, {0.12, 0.12}}, 1};
            const auto shown = renderer.render(picture);
            ASSERT_TRUE(shown);
            for (const Image* image : {&shown->left, &shown->right}) {
                const std::uint8_t* middle = image->pixel(kTestSize.width / 2, kTestSize.height / 2);
                EXPECT_EQ(middle[2] > middle[0], z > 0.0) << z;
                const std::uint8_t* aside = image->pixel(kTestSize.width / 2 + 30, kTestSize.height / 2);
                EXPECT_GT(aside[2], aside[0] + 100) << "beside the plate the panel hides the room";
            }
        }
        // Glass before it tints it.
        picture.panel->stand.world_from_panel.position_m.z = 0.05;
        const auto bare = renderer.render(picture);
        picture.bubble.visible = true;
        const auto tinted = renderer.render(picture);
        ASSERT_TRUE(bare && tinted);
        const auto green = [](const StereoImage& s) {
            return s.left.pixel(kTestSize.width / 2, kTestSize.height / 2)[1];
        };
        EXPECT_GT(green(*tinted), green(*bare) + 5);
    }
}

// Each side of a panel before the screen stands where the formula of shaders/shared/parallax_fade.h has its points.
TEST_F(ScenePanelTest, ItsParallaxFadesTowardsTheScreensEdge) {
    const PanelPainter painter = painted(plain_mesh(rgba(0, 0, 255, 255)));
    Renderer renderer = make(1);
    renderer.show_panel(painter.view());
    constexpr double kBand = 0.5, kStrength = 1.0, kZ = 0.1;
    picture::Picture picture = bare_scene();
    picture.edge_fade = kStrength;
    picture.edge_fade_band = kBand;
    const Vec3 middle{0.07, 0.15, kZ};
    picture.panel = picture::PicturePanel{{{middle, Quat{1, 0, 0, 0}}, {0.12, 0.1}}, 1};
    const auto shown = renderer.render(picture);
    ASSERT_TRUE(shown);
    const wall::Eyes eyes = wall::eyes_of(picture.viewer);
    const auto expected_px = [&](const Vec3& eye, double x) {
        const auto seen = [&](const Vec3& from) {
            return 2.0 * point_on_screen(picture.screen, from, {x, middle.y, kZ}).x / picture.wall.width_m - 1.0;
        };
        const double m = seen(middle_of(eyes)), d = seen(eye) - m;
        const double t = std::clamp((kBand - (1.0 - std::abs(m))) / kBand, 0.0, 1.0);
        return (0.5 + 0.5 * (m + (1.0 - kStrength * t * t * (3.0 - 2.0 * t)) * d)) * kTestSize.width;
    };
    const std::array<std::pair<const Image*, Vec3>, 2> views{
        {{&shown->left, eyes.left_world}, {&shown->right, eyes.right_world}}};
    for (const auto& [image, eye] : views) {
        std::uint32_t first = kTestSize.width, last = 0;
        for (std::uint32_t x = 0; x < kTestSize.width; ++x) {
            if (image->pixel(x, kTestSize.height / 2)[2] < 250) continue;
            first = std::min(first, x);
            last = std::max(last, x);
        }
        EXPECT_NEAR(first, expected_px(eye, 0.01), 1.0);
        EXPECT_NEAR(last + 1.0, expected_px(eye, 0.13), 1.0);
    }
}

TEST_F(ScenePanelTest, IsDrawnAnewAloneWhenItsPictureChangesAndNotOtherwise) {
    PanelPainter painter = painted(plain_mesh(rgba(200, 40, 40, 255)));
    Renderer renderer = make(1);
    picture::Picture picture = bare_scene();
    picture.show_grid = true;
    ASSERT_TRUE(renderer.render(picture));
    const std::uint32_t pipelines = renderer.stats().pipelines;
    picture.panel = picture::PicturePanel{stand_pixel_on_pixel(picture), 1};
    ASSERT_TRUE(renderer.render(picture));
    EXPECT_EQ(renderer.stats().pipelines, pipelines) << "no picture, no panel, no pipeline";
    renderer.show_panel(painter.view());
    const auto red = renderer.render(picture);
    ASSERT_TRUE(red);
    EXPECT_EQ(renderer.stats().pipelines, pipelines + 1);
    EXPECT_GT(red->left.pixel(kPlace.x + 5, kPlace.y + 5)[0], 190);
    renderer.show_panel(painter.view());  // as a session does every frame
    ASSERT_TRUE(renderer.render(picture));
    EXPECT_TRUE(renderer.stats().part.empty());

    paint(painter, plain_mesh(rgba(40, 200, 40, 255)));
    ++picture.panel->version;
    const auto green = renderer.render(picture);
    ASSERT_TRUE(green);
    EXPECT_GT(green->left.pixel(kPlace.x + 5, kPlace.y + 5)[1], 190);
    const PixelRect& part = renderer.stats().part;
    EXPECT_LE(part.width, kPlace.width + 6);
    EXPECT_LE(part.height, kPlace.height + 6);
    EXPECT_GE(part.width, kPlace.width);

    // Of another size: another image, and its view is given anew.
    ASSERT_TRUE(painter.resize({32, 24}));
    paint(painter, plain_mesh(rgba(40, 40, 200, 255)));
    renderer.show_panel(painter.view());
    const auto blue = renderer.render(picture);
    ASSERT_TRUE(blue);
    EXPECT_GT(blue->right.pixel(kPlace.x + 60, kPlace.y + 40)[2], 190);
    renderer.show_panel(VK_NULL_HANDLE);
    const auto none = renderer.render(picture);
    ASSERT_TRUE(none);
    EXPECT_LT(none->right.pixel(kPlace.x + 60, kPlace.y + 40)[2], 190);
}

}  // namespace burin::renderer
