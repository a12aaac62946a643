// SPDX-License-Identifier: MIT
#include "desk/draw/session_picture.hpp"

#include <algorithm>
#include <utility>

#include "base/try.hpp"
#include "renderer/frame/redraw.hpp"
#include "renderer/output/canvas.hpp"
#include "renderer/output/compose.hpp"
#include "renderer/output/eye_images.hpp"
#include "renderer/output/test_pattern.hpp"

namespace burin::session {
namespace {

constexpr VkFormat kPhotoFormat = VK_FORMAT_R8G8B8A8_SRGB;
constexpr VkImageLayout kPhotoLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;

// Returns the views that the mode shows; others are not drawn.
Views views_shown(const wall::OutputSettings& settings) {
    if (wall::needs_of(settings.mode).both_eyes) return Views::both;
    const bool right =
        settings.mode != wall::StereoMode::mono && (settings.mode == wall::StereoMode::right) != settings.swap_eyes;
    return right ? Views::right : Views::left;
}

}  // namespace

Result<SessionPicture> SessionPicture::create(gpu::Device& device, std::uint32_t samples,
                                              std::shared_ptr<renderer::SurfaceStore> surface) {
    return SessionPicture(device, samples, std::move(surface));
}

Result<void> SessionPicture::fit(ImageSize output, const wall::OutputSettings& settings) {
    return fit_eye(wall::eye_size(settings.mode, output), views_shown(settings));
}

Result<void> SessionPicture::fit_eye(ImageSize eye, Views views) {
    if (renderer_ && eye == eye_ && views == views_) return {};
    if (renderer_) {
        const auto done = renderer_->resize(eye, views);
        if (!done) return done;
        eye_ = eye;
        views_ = views;
        return {};
    }
    BURIN_TRY(made, renderer::Renderer::create(
                        device_, eye, {.samples = samples_, .savings = {}, .views = views, .surface = surface_}));
    renderer_ = std::move(made);
    renderer_in_full_ = false;
    eye_ = eye;
    views_ = views;
    return {};
}

Result<void> SessionPicture::draw(gpu::Commands& commands, std::optional<picture::Picture> scene, ImageSize output,
                                  const wall::OutputSettings& settings, std::uint32_t pixel) {
    BURIN_TRY_DO(fit(output, settings));
    const bool was_dark = std::exchange(dark_, !scene.has_value());
    if (dark_) {
        stats_ = {};
        if (!was_dark) stats_.parts = {stats_.part = all_of(eye_)};
        scene_.reset();
        return {};
    }
    if (was_dark) renderer_->forget_picture();
    if (std::exchange(renderer_in_full_, full_) != full_) renderer_->set_savings({.coarser_levels = !full_});
    renderer_->show_panel(standing_ ? painter_->view() : VK_NULL_HANDLE);
    scene->panel = standing_;
    BURIN_TRY(recorded, renderer_->record(commands, *scene, pixel));
    stats_ = recorded;
    scene_ = std::move(scene);
    return {};
}

PictureChange SessionPicture::change_to(const std::optional<picture::Picture>& scene) const {
    if (!scene_ || !scene) return {};
    return {.room = !renderer::same_room(*scene_, *scene), .tool = scene_->tool != scene->tool};
}

Result<void> SessionPicture::paint(gpu::Commands& commands, const std::optional<PanelPicture>& panel) {
    const bool was_shown = std::exchange(panel_shown_, panel.has_value());
    panel_changed_ = was_shown != panel_shown_;
    panel_parts_before_ = std::exchange(panel_parts_, {});
    if (panel && !panel->stand) {
        const std::uint32_t left = eye_.width > panel->size.width ? eye_.width - panel->size.width : 0;
        panel_parts_ = panel->parts;
        if (panel_parts_.empty()) panel_parts_ = {all_of(panel->size)};
        for (PixelRect& part : panel_parts_) part.x += left;
    }
    standing_.reset();
    if (!panel) return {};
    if (!painter_ || atlases_ != panel->atlases) {
        atlases_ = panel->atlases;
        BURIN_TRY(made, renderer::PanelPainter::create(device_, panel->size, panel->atlas));
        painter_ = std::move(made);
    }
    BURIN_TRY_DO(painter_->resize(panel->size));
    BURIN_TRY(painted, painter_->record(commands, panel->mesh));
    panel_changed_ = panel_changed_ || painted;
    if (painted) ++paintings_;
    if (panel->stand) standing_ = picture::PicturePanel{*panel->stand, paintings_};
    return {};
}

std::vector<PixelRect> SessionPicture::changed(const wall::OutputPlace& place,
                                               const wall::OutputSettings& settings) const {
    std::vector<PixelRect> parts;
    const auto add = [&](const PixelRect& in_eye) {
        if (in_eye.empty()) return;
        const renderer::ChangedParts changed = renderer::changed_parts(in_eye, eye_, settings, place);
        parts.insert(parts.end(), changed.parts, changed.parts + changed.count);
    };
    for (const PixelRect& part : stats_.parts) add(part);
    if (panel_changed_ && painter_ && !standing_) {
        for (const auto* parts_of : {&panel_parts_before_, &panel_parts_})
            for (const PixelRect& part : *parts_of) add(common(part, {0, 0, eye_.width, eye_.height}));
    }
    return parts;
}

std::optional<renderer::OverlayView> SessionPicture::overlay() const {
    if (!painter_ || !panel_shown_ || standing_) return std::nullopt;
    return painter_->overlay(static_cast<int>(eye_.width) - static_cast<int>(painter_->size().width), 0);
}

// Returns what to show: the scene, or in its place a test pattern or darkness.
renderer::EyesView SessionPicture::eyes_to_show(const wall::OutputSettings& settings, Result<void>& failed) {
    if (settings.test_pattern == wall::TestPattern::none && !dark_) return {renderer_->both_eyes(), eye_};
    const bool fits = pattern_ && pattern_kind_ == settings.test_pattern && pattern_size_.width == eye_.width &&
                      pattern_size_.height == eye_.height;
    if (!fits) {
        StereoImage drawn;
        if (settings.test_pattern == wall::TestPattern::none) {
            drawn.left = drawn.right = renderer::Canvas(eye_, {0, 0, 0}).take();
        } else {
            drawn = renderer::draw_test_pattern(settings.test_pattern, {.pixels = eye_});
        }
        auto uploaded = renderer::upload_eyes(device_, drawn.left, drawn.right);
        if (!uploaded) {
            failed = std::unexpected(uploaded.error());
            return {};
        }
        pattern_ = std::move(*uploaded);
        pattern_kind_ = settings.test_pattern;
        pattern_size_ = eye_;
    }
    return {pattern_->view(), eye_};
}

Result<void> SessionPicture::show(gpu::Commands& commands, const renderer::OutputTarget& target, VkFormat format,
                                  const wall::OutputSettings& settings, const PresentedParts::Parts& parts) {
    if (!window_stage_ || window_stage_->format() != format) {
        BURIN_TRY(made, renderer::OutputStage::create(device_, format, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR));
        window_stage_ = std::move(made);
    }
    Result<void> done;
    const renderer::EyesView eyes = eyes_to_show(settings, done);
    if (!done) return done;
    if (parts.whole) return window_stage_->record(commands, eyes, target, settings, overlay());
    return window_stage_->record_parts(commands, eyes, target, settings, parts.parts, overlay());
}

Result<Image> SessionPicture::photograph(const wall::OutputPlace& place, const wall::OutputSettings& settings) {
    if (!photo_stage_) {
        BURIN_TRY(made, renderer::OutputStage::create(device_, kPhotoFormat, kPhotoLayout));
        photo_stage_ = std::move(made);
    }
    BURIN_TRY(image, gpu::Image::create(device_,
                                        {.width = place.size.width,
                                         .height = place.size.height,
                                         .format = kPhotoFormat,
                                         .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                                         .name = "photograph"}));
    Result<void> done;
    const renderer::EyesView eyes = eyes_to_show(settings, done);
    if (!done) return std::unexpected(done.error());
    BURIN_TRY(commands, gpu::Commands::begin(device_));
    done = photo_stage_->record(commands, eyes, {.view = image.view(), .place = place}, settings, overlay());
    if (!done) return std::unexpected(done.error());
    BURIN_TRY(submission, std::move(commands).submit());
    BURIN_TRY_DO(submission.wait());
    return renderer::read_back(device_, image.raw(), place.size, kPhotoFormat, kPhotoLayout);
}

}  // namespace burin::session
