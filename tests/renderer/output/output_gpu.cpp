// SPDX-License-Identifier: MIT
// The output stage on the GPU, against the CPU reference. Modes that copy must agree in every byte. Where light is
// mixed one step of 255 is allowed: the reference mixes in double precision, the GPU in single, with the driver's own
// approximation of the sRGB curve, and a value near the middle between two steps may then fall to either side.
#include <map>
#include <optional>
#include <random>

#include "renderer/output/compose.hpp"
#include "renderer/output/eye_images.hpp"
#include "renderer/output/output_stage.hpp"
#include "shaders/shared/output_rules.h"
#include "tests/gpu/test_device.hpp"
#include "tests/renderer/output/output_pictures.hpp"
#include "wall/output_settings.hpp"

namespace burin::renderer {

namespace {

Image noise(ImageSize size, unsigned seed) {
    std::mt19937 random(seed);
    Image image = filled(size, 0, 0, 0);
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        if (i % 4 != 3) image.rgba[i] = static_cast<std::uint8_t>(random());
    }
    return image;
}

int tolerance_of(wall::StereoMode mode) {
    const bool mixes = shared::is_anaglyph_mode(mode_number(mode)) || mode == wall::StereoMode::side_by_side_half ||
                       mode == wall::StereoMode::top_bottom_half;
    return mixes ? 1 : 0;
}

}  // namespace

class OutputStageTest : public gpu::DeviceTest {
protected:
    static constexpr VkImageLayout kFinal = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;

    // One for each format: compiling takes longer than drawing.
    OutputStage& stage_for(VkFormat format) {
        const auto known = stages_.find(format);
        if (known != stages_.end()) return known->second;
        auto stage = OutputStage::create(device(), format, kFinal);
        EXPECT_TRUE(stage) << stage.error().line();
        return stages_.emplace(format, std::move(*stage)).first->second;
    }

    // Draws into a target of its own.
    Image show(const Image& left, const Image& right, const wall::OutputSettings& settings,
               const wall::OutputPlace& place, VkFormat format, const Overlay* overlay = nullptr) {
        target_ = make_target(place.size, format);
        draw(stage_for(format), left, right, settings, place, overlay, {});
        return read(place.size, format);
    }

    gpu::Image make_target(ImageSize size, VkFormat format) {
        auto target = gpu::Image::create(
            device(), {.width = size.width,
                       .height = size.height,
                       .format = format,
                       .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
        EXPECT_TRUE(target) << target.error().line();
        return std::move(*target);
    }

    void draw(OutputStage& stage, const Image& left, const Image& right, const wall::OutputSettings& settings,
              const wall::OutputPlace& place, const Overlay* overlay, std::span<const PixelRect> parts) {
        auto eyes = upload_eyes(device(), left, right);
        ASSERT_TRUE(eyes) << eyes.error().line();
        std::optional<gpu::Image> panel;
        std::optional<OverlayView> overlay_view;
        if (overlay != nullptr) {
            const bool linear = overlay->colour == wall::OverlayColour::linear;
            auto uploaded =
                upload_image(device(), overlay->image, linear ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM);
            ASSERT_TRUE(uploaded);
            panel = std::move(*uploaded);
            overlay_view = {panel->view(), overlay->place, overlay->colour};
        }
        auto commands = gpu::Commands::begin(device());
        ASSERT_TRUE(commands);
        const EyesView view{eyes->view(), left.size};
        const OutputTarget target{target_.view(), place};
        const auto done = parts.empty() ? stage.record(*commands, view, target, settings, overlay_view)
                                        : stage.record_parts(*commands, view, target, settings, parts, overlay_view);
        ASSERT_TRUE(done) << done.error().line();
        auto submission = std::move(*commands).submit();
        ASSERT_TRUE(submission) << submission.error().line();
        ASSERT_TRUE(submission->wait());
    }

    Image read(ImageSize size, VkFormat format) {
        auto image = read_back(device(), target_.raw(), size, format, kFinal);
        EXPECT_TRUE(image) << image.error().line();
        return image ? std::move(*image) : Image{};
    }

    void TearDown() override {
        target_ = {};
        stages_.clear();
        gpu::DeviceTest::TearDown();
    }

    gpu::Image target_;
    std::map<VkFormat, OutputStage> stages_;
};

constexpr std::array kFormats{VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_B8G8R8A8_SRGB, VK_FORMAT_R8G8B8A8_UNORM,
                              VK_FORMAT_B8G8R8A8_UNORM};

TEST_F(OutputStageTest, EqualsTheReferenceInEveryModeAndFormat) {
    unsigned variant = 0;
    for (const ImageSize eye : {ImageSize{32, 20}, ImageSize{33, 21}}) {
        const Image left = noise(eye, 1), right = noise(eye, 2);
        for (const wall::StereoMode mode : wall::stereo_modes()) {
            // Every mode in two formats, every format in eight modes: each pair takes a compilation of its own.
            {
                const VkFormat format = kFormats[(++variant + eye.width) % kFormats.size()];
                wall::OutputSettings settings;
                settings.mode = mode;
                settings.swap_eyes = variant % 2 == 0;
                settings.first_eye = variant % 3 == 0 ? wall::Eye::right : wall::Eye::left;
                const wall::OutputPlace place{.size = wall::output_size(mode, eye),
                                              .eye = variant % 5 < 2 ? wall::Eye::right : wall::Eye::left,
                                              .monitor_x = static_cast<int>(variant % 7) - 3,
                                              .monitor_y = static_cast<int>(variant % 4) - 2};
                const Image expected = compose(left, right, settings, place);
                EXPECT_LE(greatest_difference(show(left, right, settings, place, format), expected), tolerance_of(mode))
                    << file_name_of(mode) << " " << eye.width << " format " << format;
            }
        }
    }
}

TEST_F(OutputStageTest, GivesTheKeptPictures) {
    const ImageSize eye{33, 21};
    const Image left = marked_gradient(eye, wall::Eye::left), right = marked_gradient(eye, wall::Eye::right);
    for (const wall::StereoMode mode : wall::stereo_modes()) {
        wall::OutputSettings settings;
        settings.mode = mode;
        const wall::OutputPlace place{.size = wall::output_size(mode, eye)};
        Image shown = show(left, right, settings, place, VK_FORMAT_R8G8B8A8_SRGB);
        if (wall::shows_one_eye_at_a_time(mode)) {
            StereoImage both;
            both.left = std::move(shown);
            both.right = show(left, right, settings, {.size = eye, .eye = wall::Eye::right}, VK_FORMAT_R8G8B8A8_SRGB);
            shown = side_by_side(both);
        }
        EXPECT_LE(greatest_difference(shown, read_png(golden_path(mode))), tolerance_of(mode)) << file_name_of(mode);
    }
}

TEST_F(OutputStageTest, EqualsTheReferenceForTargetsOfAnotherSize) {
    const Image left = noise({30, 22}, 3), right = noise({30, 22}, 4);
    for (const wall::StereoMode mode : wall::stereo_modes()) {
        wall::OutputSettings settings;
        settings.mode = mode;
        for (const ImageSize size : {ImageSize{41, 17}, ImageSize{1, 1}, ImageSize{2, 64}}) {
            const wall::OutputPlace place{.size = size};
            const Image expected = compose(left, right, settings, place);
            EXPECT_LE(greatest_difference(show(left, right, settings, place, VK_FORMAT_B8G8R8A8_SRGB), expected),
                      tolerance_of(mode))
                << file_name_of(mode) << size.width;
        }
    }
}

TEST_F(OutputStageTest, WarpsBlendsAndOverlaysAsTheReferenceDoes) {
    const ImageSize eye{48, 36};
    const Image left = marked_gradient(eye, wall::Eye::left), right = marked_gradient(eye, wall::Eye::right);
    Overlay panel{noise({10, 8}, 5), {20, 12, 15, 8}};
    for (std::size_t i = 0; i < panel.image.rgba.size(); i += 4) {
        const auto alpha = static_cast<std::uint8_t>(i % 256);
        panel.image.rgba[i + 3] = alpha;
        for (std::size_t c = 0; c < 3; ++c) panel.image.rgba[i + c] = std::min(panel.image.rgba[i + c], alpha);
    }
    wall::OutputSettings settings;
    for (const wall::StereoMode mode :
         {wall::StereoMode::side_by_side_half, wall::StereoMode::top_bottom, wall::StereoMode::anaglyph_amber_blue}) {
        settings.mode = mode;
        const wall::OutputPlace place{.size = wall::output_size(mode, eye)};
        for (const VkFormat format : {VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_B8G8R8A8_UNORM}) {
            settings.homography.reset();
            settings.blend = {};
            for (const wall::OverlayColour colour : {wall::OverlayColour::linear, wall::OverlayColour::coded}) {
                panel.colour = colour;
                EXPECT_LE(greatest_difference(show(left, right, settings, place, format, &panel),
                                              compose(left, right, settings, place, &panel)),
                          1)
                    << file_name_of(mode) << " overlay";
            }
            settings.blend.left = 0.3;
            settings.blend.bottom = 0.2;
            EXPECT_LE(
                greatest_difference(show(left, right, settings, place, format), compose(left, right, settings, place)),
                1)
                << file_name_of(mode) << " blend";
            settings.blend = {};
            settings.homography =
                wall::homography_onto({Vec2{0.06, 0.1}, Vec2{0.9, 0.02}, Vec2{0.97, 0.9}, Vec2{0.1, 0.95}}).value();
            EXPECT_LE(greatest_difference(show(left, right, settings, place, format, &panel),
                                          compose(left, right, settings, place, &panel)),
                      1)
                << file_name_of(mode) << " warp";
        }
    }
}

TEST_F(OutputStageTest, DrawsOnlyTheChangedPartsWithTheSamePixels) {
    const ImageSize eye{40, 30};
    const Image left = noise(eye, 6), right = noise(eye, 7);
    Image new_left = left, new_right = right;
    const PixelRect changed{7, 5, 12, 9};
    for (std::uint32_t y = changed.y; y < changed.y + changed.height; ++y) {
        for (std::uint32_t x = changed.x; x < changed.x + changed.width; ++x) {
            pixel_of(new_left, x, y)[0] ^= 0x55;
            pixel_of(new_right, x, y)[1] ^= 0x55;
        }
    }
    OutputStage& stage = stage_for(VK_FORMAT_R8G8B8A8_SRGB);
    for (const wall::StereoMode mode : wall::stereo_modes()) {
        wall::OutputSettings settings;
        settings.mode = mode;
        const wall::OutputPlace place{.size = wall::output_size(mode, eye)};
        target_ = make_target(place.size, VK_FORMAT_R8G8B8A8_SRGB);
        draw(stage, left, right, settings, place, nullptr, {});
        const Image before = read(place.size, VK_FORMAT_R8G8B8A8_SRGB);
        const ChangedParts parts = changed_parts(changed, eye, settings, place);
        draw(stage, new_left, new_right, settings, place, nullptr,
             std::span(parts.parts, static_cast<std::size_t>(parts.count)));
        const Image partly = read(place.size, VK_FORMAT_R8G8B8A8_SRGB);
        draw(stage, new_left, new_right, settings, place, nullptr, {});
        EXPECT_EQ(greatest_difference(partly, read(place.size, VK_FORMAT_R8G8B8A8_SRGB)), 0) << file_name_of(mode);
        EXPECT_NE(partly.rgba, before.rgba);
    }
}

TEST_F(OutputStageTest, RefusesFormatsItDoesNotKnow) {
    const auto refused = OutputStage::create(device(), VK_FORMAT_R16G16B16A16_SFLOAT, kFinal);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().line().contains("output stage"));
}

}  // namespace burin::renderer
