// SPDX-License-Identifier: MIT
// Draws one frame into a presenter's outputs, and in each output only the parts that changed.
#include <algorithm>

#include "desk/present/presenter.hpp"

#include "base/try.hpp"
#include "desk/live/desk.hpp"
#include "desk/timing/session_times.hpp"
#include "session/state/session_orders.hpp"

namespace burin::session {
namespace {

bool same_place(const wall::OutputPlace& a, const wall::OutputPlace& b, const wall::OutputSettings& settings) {
    if (a.size != b.size) return false;
    return !wall::needs_of(settings.mode).monitor_pixels || (a.monitor_x == b.monitor_x && a.monitor_y == b.monitor_y);
}

std::string named_after(const std::string& name, const std::string& screen) {
    const std::filesystem::path path = name;
    return (path.parent_path() / (path.stem().string() + "-" + screen + path.extension().string())).string();
}

}  // namespace

// ---- One frame

bool Presenter::takes_turns(const Desk& desk) const {
    if (!shows()) return false;
    for (std::size_t i = 0; i < screens_.size(); ++i)
        if (desk.output_on(i).mode == wall::StereoMode::frame_sequential) return true;
    return false;
}

Result<bool> Presenter::draw(Desk& desk, Nanoseconds frame_ns) {
    const Nanoseconds began_ns = clock_.now_ns();
    surface_.take(desk.take_surface_updates(), desk.lattice_origin_object());
    BURIN_TRY_DO(fit_modes(desk));
    const Result<bool> drawn = draw_screens(desk);
    if (!drawn) return drawn;
    drawn_ = true;
    BURIN_TRY_DO(show_screens(frame_ns));
    desk.times().reached(FrameStage::show);
    BURIN_TRY_DO(wait_for_device());
    desk.times().reached(FrameStage::draw);
    if (*drawn && screens_[wall_->main].picture->stats().whole)
        last_whole_ = WholePicture{detail_.pixel, clock_.now_ns() - began_ns};
    take_screenshots(desk);
    if (*drawn) losses_ = 0;
    return drawn;
}

Result<void> Presenter::fit_modes(Desk& desk) {
    for (std::size_t i = 0; i < screens_.size(); ++i) {
        ScreenStage& screen = screens_[i];
        if (is_empty(screen.place.size)) continue;  // minimised
        if (const auto fits = fit_mode(i, desk.output_on(i)); !fits) {
            if (device_->lost()) return fits;
            desk.refuse_mode(screen.shown.mode, fits.error());
        }
        screen.settings = desk.output_on(i);
    }
    return {};
}

Result<void> Presenter::fit_mode(std::size_t i, const wall::OutputSettings& wanted) {
    ScreenStage& screen = screens_[i];
    const wall::StereoMode before = screen.shown.mode;
    if (wanted.mode == before) return {};
    BURIN_TRY_DO(fit_outputs(i, wanted.mode));
    const auto fits = screen.picture->fit(screen.place.size, wanted);
    if (!fits && !device_->lost()) BURIN_TRY_DO(fit_outputs(i, before));
    return fits;
}

Result<void> Presenter::fit_outputs(std::size_t i, wall::StereoMode mode) {
    ScreenStage& screen = screens_[i];
    if (!screen.output) return {};
    const wall::ModeNeeds needs = wall::needs_of(mode);
    if (needs.two_windows && screen.window == nullptr) {
        return fail("screen " + wall_->screens[i].name, "it is driven directly, so that the right eye has no window",
                    "choose two_layers, or a screen in a window");
    }
    const std::uint32_t layers = needs.two_layers ? 2 : 1;
    const std::uint32_t layers_before = std::max(screen.output->layers(), 1u);
    if (layers_before != layers) {
        const auto images = screen.output->open_images(*device_, layers);
        if (!images) {
            BURIN_TRY_DO(screen.output->open_images(*device_, layers_before));
            return images;
        }
    }
    if (!needs.two_windows) screen.right_window.reset();
    if (!needs.two_windows || screen.right_window) return {};
    BURIN_TRY(right, SessionWindow::open("Burin, right eye", {}, screen.place.size));
    screen.right_window = std::move(right);
    const auto images = screen.right_window->open_images(*device_, 1);
    if (!images) screen.right_window.reset();
    return images;
}

// Records what is new of the surface, the panel and the scene on every screen, and submits it all at once; returns
// whether any output has to show something.
Result<bool> Presenter::draw_screens(Desk& desk) {
    BURIN_TRY(commands, gpu::Commands::begin(*device_));
    BURIN_TRY(uploaded, surface_.upload(commands));
    std::vector<std::optional<picture::Picture>> scenes(screens_.size());
    for (std::size_t i = 0; i < screens_.size(); ++i)
        if (!is_empty(screens_[i].place.size)) scenes[i] = desk.scene_on(i);
    choose_detail(desk, scenes);
    bool any = false;
    for (std::size_t i = 0; i < screens_.size(); ++i) {
        screens_[i].anew = false;
        if (is_empty(screens_[i].place.size)) continue;  // minimised
        BURIN_TRY_DO(draw_screen(commands, i, desk, std::move(scenes[i])));
        any = any || screens_[i].anew;
    }
    desk.times().reached(FrameStage::record);
    if (!any && uploaded == 0) return false;
    BURIN_TRY(submission, std::move(commands).submit());
    submitted_ = std::move(submission);
    return any;
}

// Decides with how many pixels all screens are drawn, and notes what moves.
void Presenter::choose_detail(Desk& desk, std::span<const std::optional<picture::Picture>> scenes) {
    PictureChange change;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        const PictureChange one = screens_[i].picture->change_to(scenes[i]);
        change = {change.room || one.room, change.tool || one.tool};
    }
    desk.times().moved({.view = change.room, .tool = change.tool});
    const bool less = draws_less_ && device_->info().is_software() && !desk.session().files().wants_pictures();
    detail_ = step_detail(detail_, {.now_ns = clock_.now_ns(),
                                    .in_full = !less,
                                    .moves = change.room,
                                    .last = std::exchange(last_whole_, std::nullopt)})
                  .state;
}

Result<void> Presenter::draw_screen(gpu::Commands& commands, std::size_t i, Desk& desk,
                                    std::optional<picture::Picture> scene) {
    ScreenStage& screen = screens_[i];
    SessionPicture& picture = *screen.picture;
    BURIN_TRY_DO(picture.paint(commands, desk.panel_on(i)));
    picture.draw_in_full(desk.session().files().wants_pictures());
    const auto drawn = picture.draw(commands, std::move(scene), screen.place.size, screen.settings, detail_.pixel);
    if (!drawn) return drawn;
    if (i == wall_->main) desk.note_drawn(picture.stats());
    screen.anew = note_changes(screen);
    return {};
}

// Records what changed; returns whether the outputs have to show something.
bool Presenter::note_changes(ScreenStage& screen) {
    bool whole = screen.settings != screen.shown || !same_place(screen.place, screen.shown_place, screen.settings);
    for (SessionOutput* output : outputs_of(screen))
        if (output != nullptr && output->needs_showing()) whole = true;
    screen.shown = screen.settings;
    screen.shown_place = screen.place;
    const std::vector<PixelRect> parts = screen.picture->changed(screen.place, screen.settings);
    for (PresentedParts* images_parts : {&screen.parts, &screen.right_parts}) {
        if (whole) images_parts->change_all();
        for (const PixelRect& part : parts) images_parts->change(part);
    }
    return whole || !parts.empty();
}

// ---- Showing

// Fills and presents the images of all outputs that have to show something. The device does so after the pictures.
Result<void> Presenter::show_screens(Nanoseconds frame_ns) {
    for (ScreenStage& screen : screens_) {
        if (!screen.output || is_empty(screen.place.size)) continue;
        const bool turns = screen.settings.mode == wall::StereoMode::frame_sequential;
        if (!screen.anew && !turns) continue;
        BURIN_TRY_DO(show(screen, frame_ns));
    }
    return {};
}

// Waits for all that this frame has submitted. When its times are taken, the frame is finished.
Result<void> Presenter::wait_for_device() {
    if (!submitted_) return {};
    const auto done = submitted_->wait();
    submitted_.reset();
    return done;
}

Result<void> Presenter::show(ScreenStage& screen, Nanoseconds frame_ns) {
    Outlet outlet{screen.output.get(), wall::Eye::left, &screen.parts};
    if (screen.settings.mode == wall::StereoMode::frame_sequential) {
        outlet.eye = eye_in_turn(screen, frame_ns);
        screen.parts.change_all();
    }
    const auto shown = show_in(screen, outlet);
    if (!shown || !screen.right_window) return shown;
    return show_in(screen, {screen.right_window.get(), wall::Eye::right, &screen.right_parts});
}

// Returns the eye of this refresh. Without a vblank counter of the display it goes by the clock: eyes may then be
// exchanged now and then.
wall::Eye Presenter::eye_in_turn(ScreenStage& screen, Nanoseconds frame_ns) {
    const auto counted = screen.output->vblank_count();
    const auto by_clock = static_cast<std::uint64_t>(std::max(0.0, seconds(frame_ns) * screen.output->refresh_Hz()));
    const wall::FieldChoice choice =
        wall::choose_field(screen.parity, counted.value_or(by_clock), screen.settings.first_eye);
    screen.parity = choice.state;
    return choice.eye;
}

// Presents without waiting: the display waits for the submission's semaphore.
Result<void> Presenter::show_in(ScreenStage& screen, const Outlet& outlet) {
    const gpu::SwapchainFrame frame = outlet.output->acquire();
    gpu::FrameAnswer answer = frame.answer;
    if (answer == gpu::FrameAnswer::presented) {
        BURIN_TRY(commands, gpu::Commands::begin(*device_));
        wall::OutputPlace place = screen.shown_place;
        place.size = {frame.width, frame.height};
        place.eye = outlet.eye;
        PresentedParts::Parts parts = outlet.parts->since(frame.age);
        if (place.size != screen.shown_place.size) parts = {};  // the output has just been resized
        Result<void> recorded = screen.picture->show(commands, {.view = frame.views[0], .place = place},
                                                     outlet.output->format(), screen.settings, parts);
        if (recorded && frame.views[1] != VK_NULL_HANDLE) {
            place.eye = wall::Eye::right;
            recorded = screen.picture->show(commands, {.view = frame.views[1], .place = place}, outlet.output->format(),
                                            screen.settings, parts);
        }
        if (!recorded) {
            outlet.output->abandon(frame);
            return recorded;
        }
        auto submission = std::move(commands).submit(frame.sync);
        answer = submission ? outlet.output->present(frame) : outlet.output->abandon(frame);
        if (submission) submitted_ = std::move(*submission);
        if (submission && answer == gpu::FrameAnswer::presented) outlet.parts->presented();
    }
    if (answer == gpu::FrameAnswer::device_lost) return fail("graphics device", "it was lost", "");
    if (answer == gpu::FrameAnswer::surface_lost)
        return outlet.output->reopen_images(*device_, outlet.output->layers());
    if (answer == gpu::FrameAnswer::resized) outlet.output->show_again();
    return {};
}

void Presenter::take_screenshots(Desk& desk) {
    if (!desk.session().files().wants_pictures()) return;
    const std::vector<Asked> wanted = desk.session().files().take_pictures();
    for (std::size_t i = 0; i < screens_.size(); ++i) photograph(i, desk, wanted);
}

// Saves screenshots. Where each eye has a display or a turn of its own, the picture has both side by side.
void Presenter::photograph(std::size_t i, Desk& desk, const std::vector<Asked>& wanted) {
    ScreenStage& screen = screens_[i];
    wall::OutputSettings settings = screen.shown;
    wall::OutputPlace place = screen.shown_place;
    const std::string& name = wall_->screens[i].name;
    const auto keep = [&](const Result<Image>& image) {
        for (const Asked& one : wanted)
            desk.session().files().keep_picture(
                {name.empty() || screens_.size() == 1 ? one.text : named_after(one.text, name), one.line}, image);
    };
    if (is_empty(place.size)) return keep(fail("screen " + name, "is minimised: no picture was taken", "show it"));
    if (wall::shows_one_eye_at_a_time(settings.mode) && needs_of(settings.mode).both_eyes) {
        settings.mode = wall::StereoMode::side_by_side;
        place.size = wall::output_size(settings.mode, screen.picture->eye());
    }
    keep(screen.picture->photograph(place, settings));
}

}  // namespace burin::session
