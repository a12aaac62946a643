// SPDX-License-Identifier: MIT
// What a session's pictures appear on: for each screen a window (two where each eye has its own), a display driven directly, or nothing but
// screenshots. All on one graphics device, which may be lost and replaced.
//
// One frame: draw() has the session record each screen's picture, submits what has changed, and shows it in the outputs' images, into
// which only what they lack is drawn.
// Main thread alone, but for wake().
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/session/direct_output.hpp"
#include "app/session/live_session.hpp"
#include "app/session/session_picture.hpp"
#include "app/session/session_waker.hpp"
#include "app/session/session_window.hpp"
#include "renderer/output/parity.hpp"

namespace burin {

class SessionStage {
public:
    // The wall must outlive it.
    [[nodiscard]] static Result<SessionStage> open(const LiveOptions& options, const SessionWall& wall,
                                                   DirectDriver driver = direct_driver());

    // Where the outputs are now: so they stay for whoever asks until the next look, once a frame.
    void look();
    [[nodiscard]] std::vector<OutputPlace> places() const;                                  // of all screens' outputs
    [[nodiscard]] const OutputPlace& place() const { return screens_[wall_->main].place; }  // of the main screen's
    // Instead: as it is to be drawn, whatever the output is like.
    void put(std::size_t screen, const OutputPlace& place) { screens_[screen].place = place; }
    [[nodiscard]] std::size_t screens() const { return screens_.size(); }
    // Whether anything appears at all, or there are screenshots alone; and whether there are windows, which give input.
    [[nodiscard]] bool shows() const { return screens_.front().output != nullptr; }
    [[nodiscard]] bool has_windows() const { return !waker_ && shows(); }
    [[nodiscard]] double refresh_Hz() const;
    // What the main screen's output (the left eye's of two) knows of its display; nothing of it where nothing is shown.
    [[nodiscard]] SessionOutput::Blocked take_blocked();
    [[nodiscard]] std::uint64_t presented() const;
    [[nodiscard]] std::optional<bool> was_shown(std::uint64_t picture) const;
    [[nodiscard]] const std::string& device_name() const { return device_->info().name; }
    [[nodiscard]] gpu::Device& device() { return *device_; }  // another one after recover()

    // What happened in the windows, waiting for at most so long (0: not at all) or until wake(). The mouse counts in the main screen's alone;
    // in the window of its right eye it is told kRightWindow_px (seen_place.hpp) further to the right. Whichever is closed, the session is
    // asked to end: none of a wall's windows can be had back alone. Displays driven directly say nothing.
    [[nodiscard]] std::vector<Input> inputs(double wait_s);
    void wake();  // any thread

    // One frame, if there is anything new; whether there was. frame_ns: when it is to be seen, by the session's time.
    [[nodiscard]] Result<bool> draw(LiveSession& session, Nanoseconds frame_ns);
    // Eyes shown by turns need a picture at each refresh.
    [[nodiscard]] bool takes_turns(const LiveSession& session) const;
    // Has coarser levels of the surface worked out beside the frames; between these. resting: nothing has happened for a while.
    void refine_beside(bool resting);

    void exchange_full_screen() { screens_[wall_->main].output->exchange_full_screen(); }
    [[nodiscard]] std::vector<std::string> take_messages();  // for people

    // Drops what was made on a device that is gone and starts anew on one that is there, for which it waits some seconds at most. What is
    // carved is the session's and stays. Any other error is given back, and so is a device that is lost over and over.
    [[nodiscard]] Result<void> recover(LiveSession& session, const Error& error);

private:
    // Where one eye's, or both eyes' picture goes.
    struct Outlet {
        SessionOutput* output = nullptr;
        Eye eye = Eye::left;
        PresentedParts* parts = nullptr;
    };
    struct ScreenStage {
        std::unique_ptr<SessionOutput> output;
        SessionWindow* window = nullptr;  // the same, where it is one
        std::unique_ptr<SessionWindow> right_window;
        PresentedParts parts, right_parts;
        std::optional<SessionPicture> picture;
        OutputPlace place;
        FieldParity parity;
        OutputSettings shown;  // with which the outputs' images were drawn
        OutputPlace shown_place;
    };

    SessionStage(const LiveOptions& options, const SessionWall& wall, DirectDriver driver)
        : options_(options), wall_(&wall), driver_(std::move(driver)) {}
    [[nodiscard]] Result<void> open_outputs();
    [[nodiscard]] Result<void> open_device();
    [[nodiscard]] Result<gpu::Device> create_device() const;
    // The output of a screen, and of its right eye; null where there is none.
    [[nodiscard]] static std::array<SessionOutput*, 2> outputs_of(const ScreenStage& screen) {
        return {screen.output.get(), screen.right_window.get()};
    }
    [[nodiscard]] static std::vector<Input> right_eyes_inputs(const ScreenStage& screen);
    // ---- session_drawing.cpp
    // Opens and closes what the mode needs: a second window, images of two layers. An Error leaves the screen as it can be.
    [[nodiscard]] Result<void> fit_mode(std::size_t screen, StereoMode mode);
    [[nodiscard]] Result<bool> draw_screen(std::size_t screen, LiveSession& session, Nanoseconds frame_ns);
    bool note_changes(ScreenStage& screen, const OutputSettings& settings, const OutputPlace& place);
    [[nodiscard]] Result<void> show(ScreenStage& screen, const OutputSettings& settings, Nanoseconds frame_ns);
    [[nodiscard]] Result<void> show_in(ScreenStage& screen, const Outlet& outlet, const OutputSettings& settings);
    [[nodiscard]] Eye eye_in_turn(ScreenStage& screen, const OutputSettings& settings, Nanoseconds frame_ns);
    void photograph(std::size_t screen, LiveSession& session, const std::vector<std::filesystem::path>& paths);

    LiveOptions options_;
    const SessionWall* wall_;
    DirectDriver driver_;
    std::optional<gpu::Device> device_;
    std::vector<ScreenStage> screens_;
    std::unique_ptr<SessionWaker> waker_;  // where no window waits
    std::vector<std::string> messages_;
    int losses_ = 0;  // of the device, since the last picture
};

}  // namespace burin
