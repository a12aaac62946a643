// SPDX-License-Identifier: MIT
// The panel's painter and the panel that stands in the scene, on the GPU, pixel by pixel against what is worked out
// here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/frame/frame_targets.hpp"
#include "renderer/frame/pipelines.hpp"
#include "renderer/output/compose.hpp"
#include "renderer/output/eye_images.hpp"
#include "renderer/panel/panel_quad.hpp"
#include "tests/gpu/test_device.hpp"
#include "tests/renderer/output/output_pictures.hpp"
#include "tests/renderer/panel/panel_pictures.hpp"

namespace burin::renderer {

namespace {

std::array<int, 4> at(const Image& image, std::uint32_t x, std::uint32_t y) {
    const std::uint8_t* p = image.pixel(x, y);
    return {p[0], p[1], p[2], p[3]};
}

// Each channel within a step: the device rounds once.
void expect_near(const std::array<int, 4>& shown, const std::array<double, 4>& expected, const char* what) {
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(shown[k], expected[k], 1.01) << what << ", channel " << k;
}

}  // namespace

class PanelPainterTest : public gpu::DeviceTest {
protected:
    PanelPainter make(ImageSize size = {64, 48}) {
        auto painter = PanelPainter::create(device(), size, plain_atlas());
        EXPECT_TRUE(painter) << painter.error().line();
        return std::move(*painter);
    }
    bool paint(PanelPainter& painter, const PanelMesh& mesh) {
        auto commands = gpu::Commands::begin(device());
        const auto painted = painter.record(*commands, mesh);
        EXPECT_TRUE(painted) << painted.error().line();
        auto submission = std::move(*commands).submit();
        EXPECT_TRUE(submission && submission->wait());
        return painted && *painted;
    }
    Image read(const PanelPainter& painter) {
        auto image = read_back(device(), painter.image(), painter.size(), VK_FORMAT_R8G8B8A8_UNORM,
                               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        EXPECT_TRUE(image) << image.error().line();
        return std::move(*image);
    }
};

TEST_F(PanelPainterTest, MixesColoursAsSrgbValuesAndPremultipliesThem) {
    PanelMesh mesh;
    add_box(mesh, {4, 4, 40, 30}, rgba(46, 49, 53, 226));
    add_box(mesh, {10, 10, 10, 10}, rgba(222, 225, 228, 255));
    add_box(mesh, {22, 10, 10, 10}, rgba(222, 225, 228, 255), kThird);
    PanelPainter painter = make();
    EXPECT_TRUE(paint(painter, mesh));
    const Image shown = read(painter);
    const double ground = 226.0 / 255.0, third = 85.0 / 255.0;
    expect_near(at(shown, 0, 0), {0, 0, 0, 0}, "outside");
    expect_near(at(shown, 6, 6), {46 * ground, 49 * ground, 53 * ground, 226}, "the ground");
    expect_near(at(shown, 15, 15), {222, 225, 228, 255}, "what is covered");
    const auto mixed = [&](double light, double dark) { return light * third + dark * ground * (1.0 - third); };
    expect_near(at(shown, 27, 15),
                {mixed(222, 46), mixed(225, 49), mixed(228, 53), 255 * (third + ground * (1 - third))},
                "a letter's edge");
    // To the pixel.
    expect_near(at(shown, 9, 15), {46 * ground, 49 * ground, 53 * ground, 226}, "left of the box");
    expect_near(at(shown, 10, 15), {222, 225, 228, 255}, "its first column");
    expect_near(at(shown, 19, 19), {222, 225, 228, 255}, "its last pixel");
    expect_near(at(shown, 20, 15), {46 * ground, 49 * ground, 53 * ground, 226}, "right of the box");
}

TEST_F(PanelPainterTest, PaintsWithinTheClipAlone) {
    PanelMesh mesh;
    add_box(mesh, {0, 0, 64, 48}, rgba(200, 100, 50, 255), kCovered, {8, 6, 20, 10});
    add_box(mesh, {0, 0, 64, 48}, rgba(0, 255, 0, 255), kCovered, {60, 40, 1000, 1000});
    add_box(mesh, {0, 0, 64, 48}, rgba(0, 0, 255, 255), kCovered, {70, 0, 10, 10});  // beyond the panel
    PanelPainter painter = make();
    EXPECT_TRUE(paint(painter, mesh));
    const Image shown = read(painter);
    for (std::uint32_t y = 0; y < 48; ++y) {
        for (std::uint32_t x = 0; x < 64; ++x) {
            const bool first = x >= 8 && x < 28 && y >= 6 && y < 16, second = x >= 60 && y >= 40;
            const std::array<int, 4> expected = first    ? std::array{200, 100, 50, 255}
                                                : second ? std::array{0, 255, 0, 255}
                                                         : std::array{0, 0, 0, 0};
            ASSERT_EQ(at(shown, x, y), expected) << x << ", " << y;
        }
    }
}

TEST_F(PanelPainterTest, PaintsOnlyWhatHasChanged) {
    PanelMesh mesh;
    add_box(mesh, {4, 4, 20, 20}, rgba(200, 100, 50, 255));
    PanelPainter painter = make();
    EXPECT_TRUE(paint(painter, mesh));
    EXPECT_FALSE(paint(painter, mesh));
    EXPECT_FALSE(paint(painter, PanelMesh(mesh)));
    EXPECT_EQ(painter.painted(), 1u);
    EXPECT_EQ(painter.skipped(), 2u);
    const Image before = read(painter);
    mesh.vertices[0].rgba ^= 1;
    EXPECT_TRUE(paint(painter, mesh));
    painter.forget();
    EXPECT_TRUE(paint(painter, mesh));
    EXPECT_TRUE(paint(painter, {}));  // nothing is shown any more
    const Image empty = read(painter);
    EXPECT_TRUE(std::ranges::all_of(empty.rgba, [](std::uint8_t v) { return v == 0; }));
    EXPECT_GT(greatest_difference(before, empty), 100);
}

TEST_F(PanelPainterTest, TakesLargerMeshesAndSizesAsTheyCome) {
    PanelPainter painter = make({16, 16});
    PanelMesh mesh;
    add_box(mesh, {0, 0, 64, 48}, rgba(10, 20, 30, 255));
    EXPECT_TRUE(paint(painter, mesh));
    ASSERT_TRUE(painter.resize({64, 48}));
    for (std::uint32_t i = 0; i < 400; ++i) {
        add_box(mesh, {i % 60, i / 60 * 4, 4, 4}, rgba(i % 251, 20, 30, 255));
        if (i % 40 == 0) {
            EXPECT_TRUE(paint(painter, mesh));
        }
    }
    EXPECT_TRUE(paint(painter, mesh));
    ASSERT_TRUE(painter.resize({64, 48}));
    EXPECT_FALSE(paint(painter, mesh)) << "of the same size nothing is lost";
    const Image shown = read(painter);
    EXPECT_EQ(at(shown, 63, 47), (std::array{10, 20, 30, 255}));
    EXPECT_EQ(at(shown, 42, 27), (std::array{399 % 251, 20, 30, 255}));  // the last box, 39 columns in, and 3 more
}

TEST_F(PanelPainterTest, IsLaidOverTheEyesAsTheReferenceDoesIt) {
    PanelMesh mesh;
    add_box(mesh, {0, 0, 64, 48}, rgba(46, 49, 53, 226));
    add_box(mesh, {10, 10, 20, 20}, rgba(222, 163, 96, 255), kThird);
    PanelPainter painter = make();
    EXPECT_TRUE(paint(painter, mesh));
    const ImageSize eye{100, 80};
    const Image left = marked_gradient(eye, wall::Eye::left), right = marked_gradient(eye, wall::Eye::right);
    const OverlayView view = painter.overlay(30, 20);
    wall::OutputSettings settings;
    settings.mode = wall::StereoMode::left;
    const wall::OutputPlace place{.size = eye};
    auto eyes = upload_eyes(device(), left, right);
    auto target =
        gpu::Image::create(device(), {.width = eye.width,
                                      .height = eye.height,
                                      .format = VK_FORMAT_R8G8B8A8_UNORM,
                                      .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
    auto stage = OutputStage::create(device(), VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    ASSERT_TRUE(eyes && target && stage);
    auto commands = gpu::Commands::begin(device());
    ASSERT_TRUE(stage->record(*commands, {eyes->view(), eye}, {target->view(), place}, settings, view));
    auto submission = std::move(*commands).submit();
    ASSERT_TRUE(submission && submission->wait());
    const auto shown =
        read_back(device(), target->raw(), eye, VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    ASSERT_TRUE(shown);
    const Overlay overlay{read(painter), view.place, view.colour};
    EXPECT_LE(greatest_difference(*shown, compose(left, right, settings, place, &overlay)), 1);
}

// A standing panel with a colour in each quarter, seen by two eyes.
class PanelQuadTest : public PanelPainterTest {
protected:
    static constexpr ImageSize kView{96, 72};
    static constexpr std::array<std::array<int, 3>, 4> kQuarters{
        {{200, 60, 40}, {60, 200, 40}, {40, 60, 200}, {200, 200, 60}}};

    // The eye at x, looking along -Z; its picture's y is down.
    static glm::mat4 eye_at(double x) {
        constexpr double kNear = 0.1, kFar = 10.0;
        Mat4 clip(0.0);
        clip[0][0] = 1.5;
        clip[1][1] = -2.0;
        clip[2][2] = kFar / (kNear - kFar);
        clip[3][2] = kNear * kFar / (kNear - kFar);
        clip[2][3] = -1.0;
        Mat4 eye_from_world(1.0);
        eye_from_world[3] = {-x, 0.0, 0.0, 1.0};
        return glm::mat4(clip * eye_from_world);
    }
    const std::array<glm::mat4, 2> eyes_{eye_at(-0.05), eye_at(0.05)};

    static Vec2 pixel_of_point(const glm::mat4& clip_from_world, const Vec3& p) {
        const glm::dvec4 c = Mat4(clip_from_world) * glm::dvec4(p, 1.0);
        return {(0.5 + 0.5 * c.x / c.w) * kView.width, (0.5 + 0.5 * c.y / c.w) * kView.height};
    }

    // Both eyes' pictures, side by side as the device has them.
    StereoImage draw(std::span<const picture::PanelStand> stands, const PanelPainter& painter, std::uint32_t samples) {
        auto targets = FrameTargets::create(device(), kView, samples);
        EXPECT_TRUE(targets) << targets.error().line();
        auto pipelines = Pipelines::create(device());
        EXPECT_TRUE(pipelines) << pipelines.error().line();
        auto quad = PanelQuad::create(
            device(), {targets->whole_pass.raw(), targets->samples, targets->encodes, false, pipelines->set_layout()});
        EXPECT_TRUE(quad) << quad.error().line();
        EXPECT_TRUE(quad->show(painter.view()));
        auto commands = gpu::Commands::begin(device());
        shared::FrameUniforms frame{};
        for (std::size_t i = 0; i < 2; ++i) frame.clip_from_world[i] = eyes_[i];
        commands->upload(pipelines->uniforms(), 0, gpu::bytes_of(frame));
        commands->barrier();
        std::array<VkClearValue, 3> clears{};
        clears[1].depthStencil.depth = 1.0f;
        auto begin = gpu::structure<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
        begin.renderPass = targets->whole_pass.raw();
        begin.framebuffer = targets->framebuffer.raw();
        begin.renderArea = {{0, 0}, {kView.width, kView.height}};
        begin.clearValueCount = 3;
        begin.pClearValues = clears.data();
        const VolkDeviceTable& vk = device().core()->vk;
        vk.vkCmdBeginRenderPass(commands->raw(), &begin, VK_SUBPASS_CONTENTS_INLINE);
        const VkViewport viewport{0.0f, 0.0f, static_cast<float>(kView.width), static_cast<float>(kView.height),
                                  0.0f, 1.0f};
        vk.vkCmdSetViewport(commands->raw(), 0, 1, &viewport);
        vk.vkCmdSetScissor(commands->raw(), 0, 1, &begin.renderArea);
        for (const picture::PanelStand& stand : stands) quad->record(commands->raw(), stand, pipelines->set());
        vk.vkCmdEndRenderPass(commands->raw());
        auto submission = std::move(*commands).submit();
        EXPECT_TRUE(submission && submission->wait());
        return {show(*targets, wall::StereoMode::left), show(*targets, wall::StereoMode::right)};
    }

    Image show(const FrameTargets& targets, wall::StereoMode mode) {
        wall::OutputSettings settings;
        settings.mode = mode;
        auto target = gpu::Image::create(
            device(), {.width = kView.width,
                       .height = kView.height,
                       .format = VK_FORMAT_R8G8B8A8_SRGB,
                       .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
        auto stage = OutputStage::create(device(), VK_FORMAT_R8G8B8A8_SRGB, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        EXPECT_TRUE(target && stage);
        auto commands = gpu::Commands::begin(device());
        EXPECT_TRUE(
            stage->record(*commands, {targets.both_eyes.raw(), kView}, {target->view(), {.size = kView}}, settings));
        auto submission = std::move(*commands).submit();
        EXPECT_TRUE(submission && submission->wait());
        auto image =
            read_back(device(), target->raw(), kView, VK_FORMAT_R8G8B8A8_SRGB, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        EXPECT_TRUE(image);
        return std::move(*image);
    }

    PanelPainter quarters() {
        PanelMesh mesh;
        for (std::uint32_t i = 0; i < 4; ++i) {
            const auto& c = kQuarters[i];
            add_box(mesh, {32 * (i % 2), 24 * (i / 2), 32, 24},
                    rgba(static_cast<std::uint32_t>(c[0]), static_cast<std::uint32_t>(c[1]),
                         static_cast<std::uint32_t>(c[2]), 255));
        }
        PanelPainter painter = make();
        EXPECT_TRUE(paint(painter, mesh));
        return painter;
    }

    static void expect_quarter(const Image& shown, const Vec2& at_px, std::size_t quarter, const char* eye) {
        const auto colour = at(shown, static_cast<std::uint32_t>(at_px.x), static_cast<std::uint32_t>(at_px.y));
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(colour[k], kQuarters[quarter][k], 2) << eye << " " << quarter;
    }
};

TEST_F(PanelQuadTest, StandsWhereBothEyesExpectIt) {
    const PanelPainter painter = quarters();
    const picture::PanelStand stand{{{0.03, -0.05, -1.2}, glm::angleAxis(0.4, Vec3(0.0, 1.0, 0.0))}, {0.5, 0.4}};
    for (const std::uint32_t samples : {1u, device().capabilities().msaa_samples}) {
        const StereoImage shown = draw(std::span(&stand, 1), painter, samples);
        for (std::size_t i = 0; i < 4; ++i) {
            const Vec3 middle_panel((i % 2 == 0 ? -0.25 : 0.25) * stand.size_m.x,
                                    (i < 2 ? 0.25 : -0.25) * stand.size_m.y, 0.0);
            const Vec3 middle = stand.world_from_panel * middle_panel;
            const Vec2 left = pixel_of_point(eyes_[0], middle), right = pixel_of_point(eyes_[1], middle);
            ASSERT_GT(left.x - right.x, 3.0) << "the eyes see the same";
            expect_quarter(shown.left, left, i, "left");
            expect_quarter(shown.right, right, i, "right");
        }
        EXPECT_EQ(at(shown.left, 0, 0), (std::array{0, 0, 0, 255})) << "beside the panel";
    }
}

TEST_F(PanelQuadTest, HidesAndIsHiddenByDepth) {
    const PanelPainter painter = quarters();
    const picture::PanelStand near{{{0.0, 0.0, -1.0}, Quat(1.0, 0.0, 0.0, 0.0)}, {0.3, 0.2}};
    const picture::PanelStand far{{{0.0, 0.0, -2.0}, Quat(1.0, 0.0, 0.0, 0.0)}, {2.0, 1.6}};
    const Vec3 upper_left_of_near(-0.075, 0.05, -1.0);
    const Vec3 on_far_alone(0.8, 0.6, -2.0);
    const StereoImage near_first = draw(std::array{near, far}, painter, 1);
    const StereoImage far_first = draw(std::array{far, near}, painter, 1);
    for (const StereoImage* shown : {&near_first, &far_first}) {
        // To the right eye the far panel's other quarter lies behind this point.
        expect_quarter(shown->left, pixel_of_point(eyes_[0], upper_left_of_near), 0, "left");
        expect_quarter(shown->right, pixel_of_point(eyes_[1], upper_left_of_near), 0, "right");
        expect_quarter(shown->left, pixel_of_point(eyes_[0], on_far_alone), 1, "left");
    }
    EXPECT_EQ(greatest_difference(near_first.left, far_first.left), 0);
    EXPECT_EQ(greatest_difference(near_first.right, far_first.right), 0);
}

}  // namespace burin::renderer
