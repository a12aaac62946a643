// SPDX-License-Identifier: MIT
#include "desk/present/presenter.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <thread>
#include <utility>
#include <variant>

#include "base/try.hpp"
#include "desk/live/desk.hpp"
#include "desk/panel/panel_pointer.hpp"
#include "desk/present/window_rows.hpp"
#include "desk/view/session_screens.hpp"
#include "gpu/driver_threads.hpp"
#include "session/options/option_bounds.hpp"

namespace burin::session {
namespace {

constexpr int kMostLosses = 3, kMostTries = 10;
constexpr std::chrono::milliseconds kBetweenTries{300};

std::uint32_t samples_for(const gpu::Device& device, std::uint32_t asked) {
    if (asked != 0) return asked;
    return device.info().is_software() ? 1 : device.capabilities().msaa_samples;
}

Error with_ways_out(Error e, const SessionScreen& screen) {
    const auto add = [&](const std::string& way) { e.remedy += (e.remedy.empty() ? "" : "; ") + way; };
    if ((!screen.monitor.empty() || screen.direct) && !screen.name.empty()) {
        e.where = "screen " + screen.name + ", " + e.where;
        add("or try the wall with --windowed");
    }
    add("without a display carve a --stroke, or give --offscreen and an --input");
    return e;
}

// Returns the mode that an output is opened for. A display driven directly is opened for its own mode: a change right
// afterwards would take seconds, and what the display cannot do must be reported at once. A window begins with mono and
// changes mode when the session asks for it.
wall::StereoMode begins_with(const SessionScreen& screen) {
    return screen.direct ? screen.shown.mode : wall::StereoMode::mono;
}

Error with_reason(Error e, const SessionScreen& screen) {
    return screen.direct ? with_ways_out(std::move(e), screen) : e;
}

bool is_of_main_alone(const Input& input) {
    return std::holds_alternative<MouseMove>(input) || std::holds_alternative<MouseClick>(input) ||
           std::holds_alternative<Scroll>(input) || std::holds_alternative<WindowResize>(input) ||
           std::holds_alternative<WindowFocus>(input);
}

// Returns the places of the screens that are windows on the desktop, on the main monitor; those of others are empty.
std::vector<PlacedWindow> places_of(std::span<const SessionScreen> screens) {
    std::vector<PlacedWindow> places(screens.size());
    const auto on_desktop = [](const SessionScreen& screen) { return !screen.direct && screen.monitor.empty(); };
    std::vector<ImageSize> sizes;
    for (const SessionScreen& screen : screens)
        if (on_desktop(screen)) sizes.push_back(screen.size);
    const auto monitors = window::monitors();
    if (!monitors || monitors->empty() || sizes.empty() || screens.size() < 2) return places;
    const window::Monitor& main = monitors->front();
    const auto placed =
        side_by_side(sizes, {static_cast<std::uint32_t>(main.width), static_cast<std::uint32_t>(main.height)});
    if (placed.front().size.width < sizes.front().width)
        std::fprintf(stderr, "burin: the windows are smaller than asked for, so that all %zu are on the monitor\n",
                     sizes.size());
    for (std::size_t i = 0, next = 0; i < screens.size(); ++i) {
        if (!on_desktop(screens[i])) continue;
        places[i] = placed[next++];
        places[i].x += main.x;
        places[i].y += main.y;
    }
    return places;
}

}  // namespace

// ---- Opening

Result<Presenter> Presenter::open(const DeskOptions& options, const SessionWall& wall, DirectDriver driver,
                                  std::optional<gpu::Device> opened) {
    gpu::leave_a_core_to_touch();
    Presenter stage(options, wall, std::move(driver));
    for (const SessionScreen& screen : wall.screens) stage.screens_.emplace_back().place.size = screen.size;
    if (!options.offscreen) {
        BURIN_TRY_DO(stage.open_outputs());
    }
    BURIN_TRY_DO(stage.open_device(std::move(opened)));
    return stage;
}

Result<void> Presenter::open_outputs() {
    const std::vector<PlacedWindow> places = places_of(wall_->screens);
    for (std::size_t i = 0; i < screens_.size(); ++i) {
        const SessionScreen& screen = wall_->screens[i];
        if (screen.direct) {
            screens_[i].output = std::make_unique<DirectOutput>(*screen.direct, driver_);
            continue;
        }
        const std::string title = screen.name.empty()  ? "Burin"
                                  : wall_->is_panel(i) ? "Burin, panel"
                                                       : "Burin, screen " + screen.name;
        std::optional<window::Window::Position> place;
        ImageSize size = screen.size;
        if (places[i].size.width > 0) {
            place = {places[i].x, places[i].y};
            size = places[i].size;
        }
        auto window = SessionWindow::open(title, screen.monitor, size, place);
        if (!window) return std::unexpected(with_ways_out(window.error(), screen));
        screens_[i].title = title;
        screens_[i].window = window->get();
        screens_[i].output = std::move(*window);
    }
    const auto is_window = [](const ScreenStage& screen) { return screen.window != nullptr; };
    if (std::ranges::none_of(screens_, is_window)) waker_ = std::make_unique<SessionWaker>();
    return {};
}

// Creates a device that can present to all outputs.
Result<gpu::Device> Presenter::create_device() const {
    gpu::DeviceOptions options;
    if (has_windows()) {
        BURIN_TRY(extensions, window::required_extensions());
        options.instance_extensions = std::move(extensions);
    }
    const auto is_direct = [](const SessionScreen& screen) { return screen.direct.has_value(); };
    if (std::ranges::any_of(wall_->screens, is_direct)) options.optional_instance_extensions = driver_.extensions;
    return gpu::Device::create(options);
}

Result<void> Presenter::open_device(std::optional<gpu::Device> opened) {
    BURIN_TRY(device, opened ? Result<gpu::Device>(*std::move(opened)) : create_device());
    device_ = std::move(device);
    surface_.open(*device_);
    for (std::size_t i = 0; i < screens_.size(); ++i) {
        ScreenStage& screen = screens_[i];
        const wall::StereoMode mode = begins_with(wall_->screens[i]);
        for (SessionOutput* output : outputs_of(screen)) {
            if (output == nullptr) continue;
            const std::uint32_t layers = wall::needs_of(mode).two_layers ? 2 : 1;
            const auto images =
                losses_ > 0 ? output->reopen_images(*device_, layers) : output->open_images(*device_, layers);
            if (!images) return std::unexpected(with_reason(images.error(), wall_->screens[i]));
        }
        BURIN_TRY(picture, SessionPicture::create(*device_, samples_for(*device_, options_.samples), surface_.store()));
        screen.picture = std::move(picture);
        screen.shown.mode = mode;  // as the outputs' images are now
        screen.parts.change_all();
        screen.right_parts.change_all();
    }
    return {};
}

Result<void> Presenter::recover(Desk& desk, const Error& error) {
    if (!device_->lost()) return std::unexpected(error);
    if (++losses_ > kMostLosses) {
        return fail("graphics device", "it was lost " + std::to_string(losses_) + " times without a picture in between",
                    "update the graphics driver, or try a smaller window");
    }
    desk.session().notify_of_event("the graphics device was lost; starting on a new one");
    submitted_.reset();
    for (ScreenStage& screen : screens_) {
        screen.picture.reset();
        for (SessionOutput* output : outputs_of(screen))
            if (output != nullptr) output->close_images();
    }
    surface_.close();  // its tiles are kept
    device_.reset();
    Result<void> opened = open_device();
    for (int i = 0; !opened && i < kMostTries; ++i) {  // a restarting driver takes a while
        device_.reset();
        std::this_thread::sleep_for(kBetweenTries);
        opened = open_device();
    }
    if (!opened) return opened;
    desk.session().notify_of_event("the graphics device is " + device_name());
    return {};
}

// ---- State of the outputs

void Presenter::look() {
    for (ScreenStage& screen : screens_) {
        if (!screen.output) continue;
        screen.output->look_after(*device_);
        const SessionOutput::Position at = screen.output->on_monitor();
        screen.place = {.size = screen.output->size(), .monitor_x = at.x, .monitor_y = at.y};
    }
}

std::vector<wall::OutputPlace> Presenter::places() const {
    std::vector<wall::OutputPlace> places;
    for (const ScreenStage& screen : screens_) places.push_back(screen.place);
    return places;
}

void Presenter::name_windows(const std::string& document) {
    if (document.empty()) return;
    for (ScreenStage& screen : screens_) {
        if (screen.window != nullptr) screen.window->name(document + " \u2014 " + screen.title);
    }
}

// Steps of a quarter, so that letters stand sharp; only a desktop's window follows it.
double Presenter::display_scale() const {
    const ScreenStage& main = screens_[wall_->main];
    if (main.window == nullptr || !wall_->desk) return 1.0;
    return std::clamp(std::round(4.0 * main.window->scale()) / 4.0, kPanelScaleBounds.least, kPanelScaleBounds.most);
}

double Presenter::refresh_Hz() const { return shows() ? screens_[wall_->main].output->refresh_Hz() : 60.0; }

SessionOutput::Blocked Presenter::take_blocked() {
    SessionOutput::Blocked blocked;
    for (ScreenStage& screen : screens_) {
        for (SessionOutput* output : outputs_of(screen)) {
            if (output == nullptr) continue;
            const SessionOutput::Blocked one = output->take_blocked();
            blocked.for_ns += one.for_ns;
            if (output == screens_[wall_->main].output.get()) blocked.until_ns = one.until_ns;
        }
    }
    return blocked;
}

std::uint64_t Presenter::presented() const { return shows() ? screens_[wall_->main].output->presented() : 0; }

std::optional<bool> Presenter::was_shown(std::uint64_t picture) const {
    return shows() ? screens_[wall_->main].output->was_shown(picture) : std::nullopt;
}

std::vector<Input> Presenter::inputs(double wait_s) {
    if (waker_) {
        waker_->wait(wait_s);
        return {};
    }
    std::vector<Input> inputs;
    // The first window that is asked waits for all.
    const auto add = [&](SessionWindow* window, bool of_main) {
        if (window == nullptr) return;
        for (Input& input : window->inputs(std::exchange(wait_s, 0.0)))
            if (of_main || !is_of_main_alone(input)) inputs.push_back(std::move(input));
    };
    const ScreenStage& main = screens_[wall_->main];
    add(main.window, true);
    for (std::size_t i = 0; i < screens_.size(); ++i) {
        const ScreenStage& screen = screens_[i];
        if (i == wall_->main) continue;
        if (wall_->is_panel(i)) {
            for (Input& input : panels_inputs(screen, std::exchange(wait_s, 0.0))) inputs.push_back(std::move(input));
            continue;
        }
        add(screen.window, false);
        add(screen.right_window.get(), false);
    }
    for (Input& input : right_eyes_inputs(main)) inputs.push_back(std::move(input));
    return inputs;
}

void Presenter::wake() {
    if (waker_) {
        waker_->wake();
    } else if (shows()) {
        window::wake();
    }
}

// Positions in the panel's window lie to the right of all others.
std::vector<Input> Presenter::panels_inputs(const ScreenStage& screen, double wait_s) {
    if (screen.window == nullptr) return {};
    std::vector<Input> inputs = screen.window->inputs(wait_s);
    for (Input& input : inputs)
        if (auto* move = std::get_if<MouseMove>(&input)) move->position_px.x += kPanelWindow_px;
    std::erase_if(inputs, [](const Input& input) {
        return std::holds_alternative<WindowResize>(input) || std::holds_alternative<WindowFocus>(input);
    });
    return inputs;
}

// Scales the mouse's positions as if both windows had the same size.
std::vector<Input> Presenter::right_eyes_inputs(const ScreenStage& screen) {
    if (!screen.right_window) return {};
    std::vector<Input> inputs = screen.right_window->inputs(0.0);
    const ImageSize left = screen.place.size, right = screen.right_window->size();
    for (Input& input : inputs) {
        auto* move = std::get_if<MouseMove>(&input);
        if (move == nullptr || is_empty(right)) continue;
        move->position_px *= Vec2(left.width, left.height) / Vec2(right.width, right.height);
        move->position_px.x += wall::kRightWindow_px;
    }
    std::erase_if(inputs, [](const Input& input) {
        return std::holds_alternative<WindowResize>(input) || std::holds_alternative<WindowFocus>(input);
    });
    return inputs;
}

std::vector<std::string> Presenter::take_messages() {
    std::vector<std::string> messages = std::exchange(messages_, {});
    for (ScreenStage& screen : screens_) {
        if (!screen.output) continue;
        for (std::string& message : screen.output->take_messages()) messages.push_back(std::move(message));
    }
    return messages;
}

}  // namespace burin::session
