// SPDX-License-Identifier: MIT
// Drawing into the outputs that a session's stage has: one frame, and what of it each output shows.
#include <algorithm>

#include "app/session/session_stage.hpp"
#include "renderer/png.hpp"

namespace burin {
namespace {

bool is_empty(ImageSize size) { return size.width == 0 || size.height == 0; }

bool same_place(const OutputPlace& a, const OutputPlace& b, const OutputSettings& settings) {
    if (a.size != b.size) return false;
    return !needs_of(settings.mode).monitor_pixels || (a.monitor_x == b.monitor_x && a.monitor_y == b.monitor_y);
}

std::filesystem::path named_after(const std::filesystem::path& path, const std::string& screen) {
    std::filesystem::path named = path;
    named.replace_filename(path.stem().string() + "-" + screen + path.extension().string());
    return named;
}

}  // namespace

// ---- One frame

bool SessionStage::takes_turns(const LiveSession& session) const {
    if (!shows()) return false;
    for (std::size_t i = 0; i < screens_.size(); ++i)
        if (session.output_on(i).mode == StereoMode::frame_sequential) return true;
    return false;
}

Result<bool> SessionStage::draw(LiveSession& session, Nanoseconds frame_ns) {
    std::vector<SessionPicture*> pictures;
    for (ScreenStage& screen : screens_) pictures.push_back(&*screen.picture);
    session.give_news(pictures);
    bool any = false;
    for (std::size_t i = 0; i < screens_.size(); ++i) {
        const Result<bool> drawn = draw_screen(i, session, frame_ns);
        if (!drawn) return drawn;
        any = any || *drawn;
    }
    if (session.wants_screenshots()) {
        const std::vector<std::filesystem::path> paths = session.take_screenshots();
        for (std::size_t i = 0; i < screens_.size(); ++i) photograph(i, session, paths);
    }
    if (any) losses_ = 0;
    return any;
}

Result<void> SessionStage::fit_mode(std::size_t i, StereoMode mode) {
    ScreenStage& screen = screens_[i];
    if (!screen.output || mode == screen.shown.mode) return {};
    const ModeNeeds needs = needs_of(mode);
    if (needs.two_windows && screen.window == nullptr) {
        return fail("screen " + wall_->screens[i].name, "it is driven directly, so that the right eye has no window",
                    "choose two_layers, or a screen in a window");
    }
    const std::uint32_t layers = needs.two_layers ? 2 : 1;
    const std::uint32_t layers_before = std::max(screen.output->layers(), 1u);
    if (layers_before != layers) {
        const auto images = screen.output->open_images(*device_, layers);
        if (!images) {
            if (const auto back = screen.output->open_images(*device_, layers_before); !back) return back;
            return images;
        }
    }
    if (!needs.two_windows) screen.right_window.reset();
    if (!needs.two_windows || screen.right_window) return {};
    auto right = SessionWindow::open("Burin, right eye", {}, screen.place.size);
    if (!right) return std::unexpected(right.error());
    screen.right_window = std::move(*right);
    const auto images = screen.right_window->open_images(*device_, 1);
    if (!images) screen.right_window.reset();
    return images;
}

Result<bool> SessionStage::draw_screen(std::size_t i, LiveSession& session, Nanoseconds frame_ns) {
    ScreenStage& screen = screens_[i];
    if (is_empty(screen.place.size)) return false;  // minimised
    if (const auto fits = fit_mode(i, session.output_on(i).mode); !fits) {
        if (device_->lost()) return std::unexpected(fits.error());
        session.refuse_mode(screen.shown.mode, fits.error());
    }
    const OutputSettings settings = session.output_on(i);
    const OutputPlace place = screen.place;
    auto commands = gpu::Commands::begin(*device_);
    if (!commands) return std::unexpected(commands.error());
    if (const auto drawn = session.draw(*commands, i, *screen.picture, place.size); !drawn)
        return std::unexpected(drawn.error());
    session.times().reached(FrameStage::record);
    const bool anew = note_changes(screen, settings, place);
    const bool turns = screen.output && settings.mode == StereoMode::frame_sequential;
    if (anew || screen.picture->stats().uploaded_bytes > 0) {
        auto submission = std::move(*commands).submit();
        if (!submission) return std::unexpected(submission.error());
        if (const auto done = submission->wait(); !done) return std::unexpected(done.error());
    }
    session.times().reached(FrameStage::draw);
    if (screen.output && (anew || turns)) {
        if (const auto shown = show(screen, settings, frame_ns); !shown) return std::unexpected(shown.error());
    }
    session.times().reached(FrameStage::show);
    return anew;
}

// Whether the outputs have to be shown something.
bool SessionStage::note_changes(ScreenStage& screen, const OutputSettings& settings, const OutputPlace& place) {
    bool whole = settings != screen.shown || !same_place(place, screen.shown_place, settings);
    for (SessionOutput* output : outputs_of(screen))
        if (output != nullptr && output->needs_showing()) whole = true;
    screen.shown = settings;
    screen.shown_place = place;
    const std::vector<PixelRect> parts = screen.picture->changed(place, settings);
    for (PresentedParts* images_parts : {&screen.parts, &screen.right_parts}) {
        if (whole) images_parts->change_all();
        for (const PixelRect& part : parts) images_parts->change(part);
    }
    return whole || !parts.empty();
}

// ---- Showing

Result<void> SessionStage::show(ScreenStage& screen, const OutputSettings& settings, Nanoseconds frame_ns) {
    Outlet outlet{screen.output.get(), Eye::left, &screen.parts};
    if (settings.mode == StereoMode::frame_sequential) {
        outlet.eye = eye_in_turn(screen, settings, frame_ns);
        screen.parts.change_all();
    }
    const auto shown = show_in(screen, outlet, settings);
    if (!shown || !screen.right_window) return shown;
    return show_in(screen, {screen.right_window.get(), Eye::right, &screen.right_parts}, settings);
}

// Without a count of the display's own, by the clock: eyes may then be exchanged now and then.
Eye SessionStage::eye_in_turn(ScreenStage& screen, const OutputSettings& settings, Nanoseconds frame_ns) {
    const auto counted = screen.output->vblank_count();
    const auto by_clock = static_cast<std::uint64_t>(std::max(0.0, seconds(frame_ns) * screen.output->refresh_Hz()));
    const FieldChoice choice = choose_field(screen.parity, counted.value_or(by_clock), settings.first_eye);
    screen.parity = choice.state;
    return choice.eye;
}

Result<void> SessionStage::show_in(ScreenStage& screen, const Outlet& outlet, const OutputSettings& settings) {
    const gpu::SwapchainFrame frame = outlet.output->acquire();
    gpu::FrameAnswer answer = frame.answer;
    if (answer == gpu::FrameAnswer::presented) {
        auto commands = gpu::Commands::begin(*device_);
        if (!commands) return std::unexpected(commands.error());
        OutputPlace place = screen.shown_place;
        place.size = {frame.width, frame.height};
        place.eye = outlet.eye;
        PresentedParts::Parts parts = outlet.parts->since(frame.age);
        if (place.size != screen.shown_place.size) parts = {};  // the output has just grown
        Result<void> recorded = screen.picture->show(*commands, {.view = frame.views[0], .place = place},
                                                     outlet.output->format(), settings, parts);
        if (recorded && frame.views[1] != VK_NULL_HANDLE) {
            place.eye = Eye::right;
            recorded = screen.picture->show(*commands, {.view = frame.views[1], .place = place},
                                            outlet.output->format(), settings, parts);
        }
        if (!recorded) {
            outlet.output->abandon(frame);
            return recorded;
        }
        auto submission = std::move(*commands).submit(frame.sync);
        if (submission) {
            if (const auto done = submission->wait(); !done) return done;
        }
        answer = submission ? outlet.output->present(frame) : outlet.output->abandon(frame);
        if (submission && answer == gpu::FrameAnswer::presented) outlet.parts->presented();
    }
    if (answer == gpu::FrameAnswer::device_lost) return fail("graphics device", "it was lost", "");
    if (answer == gpu::FrameAnswer::surface_lost)
        return outlet.output->reopen_images(*device_, outlet.output->layers());
    if (answer == gpu::FrameAnswer::resized) outlet.output->show_again();
    return {};
}

// Where each eye has a display or a turn of its own, the picture has both side by side.
void SessionStage::photograph(std::size_t i, LiveSession& session, const std::vector<std::filesystem::path>& paths) {
    ScreenStage& screen = screens_[i];
    OutputSettings settings = screen.shown;
    OutputPlace place = screen.shown_place;
    if (is_empty(place.size)) return;
    if (shows_one_eye_at_a_time(settings.mode) && needs_of(settings.mode).both_eyes) {
        settings.mode = StereoMode::side_by_side;
        place.size = output_size(settings.mode, screen.picture->eye());
    }
    const Result<Image> image = screen.picture->photograph(place, settings);
    for (const std::filesystem::path& name : paths) {
        const std::filesystem::path path = screens_.size() > 1 ? named_after(name, wall_->screens[i].name) : name;
        const Result<void> written = image ? write_png(path, *image) : std::unexpected(image.error());
        session.hear(written ? "wrote " + path.string() : written.error().line());
    }
}

}  // namespace burin
