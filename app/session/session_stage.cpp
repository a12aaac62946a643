// SPDX-License-Identifier: MIT
#include "app/session/session_stage.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "renderer/png.hpp"

namespace burin {
namespace {

constexpr int kMostLosses = 3, kMostTries = 10;
constexpr std::chrono::milliseconds kBetweenTries{300};

std::uint32_t samples_for(const gpu::Device& device, std::uint32_t asked) {
    if (asked != 0) return asked;
    return device.info().is_software() ? 1 : device.capabilities().msaa_samples;
}

// On a software device drawing takes the same cores as touch: it leaves one of them free.
void leave_a_core_to_touch() {
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    setenv("LP_NUM_THREADS", std::to_string(std::max(1u, cores - 1)).c_str(), 0);  // NOLINT(concurrency-mt-unsafe)
}

Error with_ways_out(Error e, const SessionScreen& screen) {
    if (!screen.monitor.empty() && !screen.name.empty()) {
        e.where = "screen " + screen.name + ", " + e.where;
        e.remedy += "; or try the wall with --windowed";
    }
    e.remedy += "; without a display carve a --stroke, or give --offscreen and an --input";
    return e;
}

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

// Places for windows on the desktop, side by side, in rows as wide as the main monitor.
class Rows {
public:
    Rows() {
        const auto monitors = window::monitors();
        if (monitors && !monitors->empty()) width_ = monitors->front().width;
    }
    window::Window::Position next(ImageSize size) {
        const int width = static_cast<int>(size.width), height = static_cast<int>(size.height);
        if (x_ > 0 && x_ + width > width_) {
            x_ = 0;
            y_ += tallest_ + kTitle;
            tallest_ = 0;
        }
        const window::Window::Position place{x_, y_};
        x_ += width + kGap;
        tallest_ = std::max(tallest_, height);
        return place;
    }

private:
    static constexpr int kGap = 4, kTitle = 40;  // pixels
    int width_ = 1280, x_ = 0, y_ = 0, tallest_ = 0;
};

}  // namespace

// ---- Opening

Result<SessionStage> SessionStage::open(const LiveOptions& options, const SessionWall& wall) {
    leave_a_core_to_touch();
    SessionStage stage(options, wall);
    for (const SessionScreen& screen : wall.screens) stage.screens_.emplace_back().offscreen = screen.size;
    if (!options.offscreen) {
        if (const auto opened = stage.open_windows(); !opened) return std::unexpected(opened.error());
    }
    if (const auto opened = stage.open_device(); !opened) return std::unexpected(opened.error());
    return stage;
}

Result<void> SessionStage::open_windows() {
    Rows beside;
    for (std::size_t i = 0; i < screens_.size(); ++i) {
        const SessionScreen& screen = wall_->screens[i];
        const std::string title = screen.name.empty() ? "Burin" : "Burin, screen " + screen.name;
        std::optional<window::Window::Position> place;
        if (screens_.size() > 1 && screen.monitor.empty()) place = beside.next(screen.size);
        auto window = SessionWindow::open(title, screen.monitor, screen.size, place);
        if (!window) return std::unexpected(with_ways_out(window.error(), screen));
        screens_[i].window = std::make_unique<SessionWindow>(std::move(*window));
    }
    return {};
}

Result<void> SessionStage::open_device() {
    auto device = has_windows() ? SessionWindow::open_device() : gpu::Device::create();
    if (!device) return std::unexpected(device.error());
    device_ = std::move(*device);
    for (ScreenStage& screen : screens_) {
        for (SessionWindow* window : {screen.window.get(), screen.right_window.get()}) {
            if (window == nullptr) continue;
            if (const auto images = window->open_images(*device_, 1); !images) return images;
        }
        auto picture = SessionPicture::create(*device_, samples_for(*device_, options_.samples));
        if (!picture) return std::unexpected(picture.error());
        screen.picture = std::move(*picture);
        screen.shown.mode = StereoMode::mono;  // as the windows' images are now
        screen.parts.change_all();
        screen.right_parts.change_all();
    }
    return {};
}

Result<void> SessionStage::recover(LiveSession& session, const Error& error) {
    if (!device_->lost()) return std::unexpected(error);
    if (++losses_ > kMostLosses) {
        return fail("graphics device", "it was lost " + std::to_string(losses_) + " times without a picture in between",
                    "update the graphics driver, or try a smaller window");
    }
    session.say("the graphics device was lost; starting on a new one");
    std::vector<SessionPicture::Kept> kept;
    for (ScreenStage& screen : screens_) {
        kept.push_back(screen.picture->take_kept());
        screen.picture.reset();
        for (SessionWindow* window : {screen.window.get(), screen.right_window.get()})
            if (window != nullptr) window->close_images();
    }
    device_.reset();
    Result<void> opened = open_device();
    for (int i = 0; !opened && i < kMostTries; ++i) {  // a driver that starts anew takes a while
        device_.reset();
        std::this_thread::sleep_for(kBetweenTries);
        opened = open_device();
    }
    if (!opened) return opened;
    for (std::size_t i = 0; i < screens_.size(); ++i) screens_[i].picture->give_kept(std::move(kept[i]));
    session.say("the graphics device is " + device_name());
    return {};
}

// ---- What the windows say

ImageSize SessionStage::size_of(const ScreenStage& screen) {
    return screen.window ? screen.window->size() : screen.offscreen;
}

OutputPlace SessionStage::place_of(const ScreenStage& screen) {
    OutputPlace place{.size = size_of(screen)};
    if (screen.window) {
        place.monitor_x = screen.window->on_monitor().x;
        place.monitor_y = screen.window->on_monitor().y;
    }
    return place;
}

double SessionStage::refresh_Hz() const { return has_windows() ? screens_[wall_->main].window->refresh_Hz() : 60.0; }

SessionWindow::Blocked SessionStage::take_blocked() {
    SessionWindow::Blocked blocked;
    for (ScreenStage& screen : screens_) {
        for (SessionWindow* window : {screen.window.get(), screen.right_window.get()}) {
            if (window == nullptr) continue;
            const SessionWindow::Blocked one = window->take_blocked();
            blocked.for_ns += one.for_ns;
            if (window == screens_[wall_->main].window.get()) blocked.until_ns = one.until_ns;
        }
    }
    return blocked;
}

std::uint64_t SessionStage::presented() const { return has_windows() ? screens_[wall_->main].window->presented() : 0; }

std::optional<bool> SessionStage::was_shown(std::uint64_t picture) const {
    return has_windows() ? screens_[wall_->main].window->was_shown(picture) : std::nullopt;
}

std::vector<Input> SessionStage::inputs(double wait_s) {
    const ScreenStage& main = screens_[wall_->main];
    std::vector<Input> inputs = main.window->inputs(wait_s);
    const auto add_all_but_mouse = [&](SessionWindow* window) {
        if (window == nullptr) return;
        for (Input& input : window->inputs(0.0)) {
            const bool of_main = std::holds_alternative<MouseMove>(input) ||
                                 std::holds_alternative<MouseClick>(input) || std::holds_alternative<Scroll>(input) ||
                                 std::holds_alternative<WindowResize>(input) ||
                                 std::holds_alternative<WindowFocus>(input);
            if (!of_main) inputs.push_back(std::move(input));
        }
    };
    for (std::size_t i = 0; i < screens_.size(); ++i) {
        if (i != wall_->main) add_all_but_mouse(screens_[i].window.get());
        if (i != wall_->main) add_all_but_mouse(screens_[i].right_window.get());
    }
    for (Input& input : right_eyes_inputs(main)) inputs.push_back(std::move(input));
    return inputs;
}

// The mouse as if the windows were of one size.
std::vector<Input> SessionStage::right_eyes_inputs(const ScreenStage& screen) {
    if (!screen.right_window) return {};
    std::vector<Input> inputs = screen.right_window->inputs(0.0);
    const ImageSize left = size_of(screen), right = screen.right_window->size();
    for (Input& input : inputs) {
        auto* move = std::get_if<MouseMove>(&input);
        if (move == nullptr || is_empty(right)) continue;
        move->position_px *= Vec2(left.width, left.height) / Vec2(right.width, right.height);
        move->position_px.x += kRightWindow_px;
    }
    std::erase_if(inputs, [](const Input& input) {
        return std::holds_alternative<WindowResize>(input) || std::holds_alternative<WindowFocus>(input);
    });
    return inputs;
}

std::vector<std::string> SessionStage::take_messages() {
    std::vector<std::string> messages = std::exchange(messages_, {});
    for (ScreenStage& screen : screens_) {
        if (!screen.window) continue;
        for (std::string& message : screen.window->take_messages()) messages.push_back(std::move(message));
    }
    return messages;
}

void SessionStage::refine_beside(bool resting) {
    for (ScreenStage& screen : screens_) screen.picture->refine_beside(resting);
}

// ---- One frame

bool SessionStage::takes_turns(const LiveSession& session) const {
    if (!has_windows()) return false;
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
    if (!screen.window || mode == screen.shown.mode) return {};
    const ModeNeeds needs = needs_of(mode);
    const std::uint32_t layers = needs.two_layers ? 2 : 1;
    if (screen.window->layers() != layers) {
        const auto images = screen.window->open_images(*device_, layers);
        if (!images) {
            if (const auto back = screen.window->open_images(*device_, 1); !back) return back;
            return images;
        }
    }
    if (!needs.two_windows) screen.right_window.reset();
    if (!needs.two_windows || screen.right_window) return {};
    auto right = SessionWindow::open("Burin, right eye", {}, size_of(screen));
    if (!right) return std::unexpected(right.error());
    screen.right_window = std::make_unique<SessionWindow>(std::move(*right));
    const auto images = screen.right_window->open_images(*device_, 1);
    if (!images) screen.right_window.reset();
    return images;
}

Result<bool> SessionStage::draw_screen(std::size_t i, LiveSession& session, Nanoseconds frame_ns) {
    ScreenStage& screen = screens_[i];
    if (is_empty(size_of(screen))) return false;  // minimised
    if (const auto fits = fit_mode(i, session.output_on(i).mode); !fits) {
        if (device_->lost()) return std::unexpected(fits.error());
        session.refuse_mode(screen.shown.mode, fits.error());
    }
    const OutputSettings settings = session.output_on(i);
    const OutputPlace place = place_of(screen);
    auto commands = gpu::Commands::begin(*device_);
    if (!commands) return std::unexpected(commands.error());
    if (const auto drawn = session.draw(*commands, i, *screen.picture, place.size); !drawn)
        return std::unexpected(drawn.error());
    session.times().reached(FrameStage::record);
    const bool anew = note_changes(screen, settings, place);
    const bool turns = screen.window && settings.mode == StereoMode::frame_sequential;
    if (anew || screen.picture->stats().uploaded_bytes > 0) {
        auto submission = std::move(*commands).submit();
        if (!submission) return std::unexpected(submission.error());
        if (const auto done = submission->wait(); !done) return std::unexpected(done.error());
    }
    session.times().reached(FrameStage::draw);
    if (screen.window && (anew || turns)) {
        if (const auto shown = show(screen, settings, frame_ns); !shown) return std::unexpected(shown.error());
    }
    session.times().reached(FrameStage::show);
    return anew;
}

// Whether the windows have to be shown something.
bool SessionStage::note_changes(ScreenStage& screen, const OutputSettings& settings, const OutputPlace& place) {
    bool whole = settings != screen.shown || !same_place(place, screen.shown_place, settings);
    for (SessionWindow* window : {screen.window.get(), screen.right_window.get()})
        if (window != nullptr && window->needs_showing()) whole = true;
    screen.shown = settings;
    screen.shown_place = place;
    const std::vector<PixelRect> parts = screen.picture->changed(place, settings);
    for (PresentedParts* windows_parts : {&screen.parts, &screen.right_parts}) {
        if (whole) windows_parts->change_all();
        for (const PixelRect& part : parts) windows_parts->change(part);
    }
    return whole || !parts.empty();
}

// ---- Showing

Result<void> SessionStage::show(ScreenStage& screen, const OutputSettings& settings, Nanoseconds frame_ns) {
    Outlet outlet{screen.window.get(), Eye::left, &screen.parts};
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
    const auto counted = screen.window->vblank_count();
    const auto by_clock = static_cast<std::uint64_t>(std::max(0.0, seconds(frame_ns) * screen.window->refresh_Hz()));
    const FieldChoice choice = choose_field(screen.parity, counted.value_or(by_clock), settings.first_eye);
    screen.parity = choice.state;
    return choice.eye;
}

Result<void> SessionStage::show_in(ScreenStage& screen, const Outlet& outlet, const OutputSettings& settings) {
    const gpu::SwapchainFrame frame = outlet.window->acquire();
    gpu::FrameAnswer answer = frame.answer;
    if (answer == gpu::FrameAnswer::presented) {
        auto commands = gpu::Commands::begin(*device_);
        if (!commands) return std::unexpected(commands.error());
        OutputPlace place = screen.shown_place;
        place.size = {frame.width, frame.height};
        place.eye = outlet.eye;
        PresentedParts::Parts parts = outlet.parts->since(frame.age);
        if (place.size != screen.shown_place.size) parts = {};  // the window has just grown
        Result<void> recorded = screen.picture->show(*commands, {.view = frame.views[0], .place = place},
                                                     outlet.window->format(), settings, parts);
        if (recorded && frame.views[1] != VK_NULL_HANDLE) {
            place.eye = Eye::right;
            recorded = screen.picture->show(*commands, {.view = frame.views[1], .place = place},
                                            outlet.window->format(), settings, parts);
        }
        if (!recorded) {
            outlet.window->abandon(frame);
            return recorded;
        }
        auto submission = std::move(*commands).submit(frame.sync);
        if (submission) {
            if (const auto done = submission->wait(); !done) return done;
        }
        answer = submission ? outlet.window->present(frame) : outlet.window->abandon(frame);
        if (submission && answer == gpu::FrameAnswer::presented) outlet.parts->presented();
    }
    if (answer == gpu::FrameAnswer::device_lost) return fail("graphics device", "it was lost", "");
    if (answer == gpu::FrameAnswer::surface_lost) return outlet.window->open_images(*device_, outlet.window->layers());
    if (answer == gpu::FrameAnswer::resized) outlet.window->show_again();
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
        session.say(written ? "wrote " + path.string() : written.error().line());
    }
}

}  // namespace burin
