// SPDX-License-Identifier: MIT
// Presents a session's pictures: for each screen in a window (two where each eye has its own), on a display driven
// directly, or only as screenshots. Draws with one lane of the session's graphics device, which may be lost and
// replaced.
//
// One frame is draw(): it takes the session's surface updates, draws all screens' pictures in one submission, and shows
// them in the outputs' images, into which only their damaged parts are drawn. It waits for the device once, when all
// screens' images are under way.
// Main thread alone, except for wake().
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.hpp"
#include "desk/draw/drawn_detail.hpp"
#include "desk/draw/session_picture.hpp"
#include "desk/draw/session_surface.hpp"
#include "desk/present/direct_output.hpp"
#include "desk/present/frame_output.hpp"
#include "desk/present/session_waker.hpp"
#include "desk/present/session_window.hpp"
#include "desk/view/session_screens.hpp"
#include "picture/picture.hpp"
#include "session/options/desk_options.hpp"
#include "wall/output_settings.hpp"
#include "wall/parity.hpp"

namespace burin::session {

struct Asked;  // session/state/session_orders.hpp
class Desk;    // desk/live/desk.hpp

// The main screen's picture where there is no session yet.
struct StillPicture {
    std::optional<picture::Picture> scene;  // none: it is dark
    wall::OutputSettings output;
    std::optional<PanelPicture> panel;
};

class Presenter final : public FrameOutput {
public:
    // The wall must outlive it. opened: a device to begin with, where the session has one and shows no window.
    [[nodiscard]] static Result<Presenter> open(const DeskOptions& options, const SessionWall& wall,
                                                DirectDriver driver = direct_driver(),
                                                std::optional<gpu::Device> opened = {});

    // Reads the outputs' positions and sizes, which hold until the next call; once a frame.
    void look() override;
    [[nodiscard]] std::vector<wall::OutputPlace> places() const override;  // of all screens' outputs
    // Position and size of the main screen's output.
    [[nodiscard]] const wall::OutputPlace& place() const { return screens_[wall_->main].place; }
    // Overrides a screen's position and size with those to draw for, whatever the output is like.
    void put(std::size_t screen, const wall::OutputPlace& place) override { screens_[screen].place = place; }
    [[nodiscard]] std::size_t screens() const override { return screens_.size(); }
    // Returns whether any screen has an output, or there are screenshots alone; and whether there are windows, which
    // give input.
    [[nodiscard]] bool shows() const override { return screens_.front().output != nullptr; }
    [[nodiscard]] bool has_windows() const { return !waker_ && shows(); }
    // Returns whether the windows' display is gone for good: they are dead, and a session has to end.
    [[nodiscard]] bool has_lost_display() const override { return has_windows() && window::display_is_lost(); }
    [[nodiscard]] double refresh_Hz() const;
    // Has the windows say what is worked on.
    void name_windows(const std::string& document);
    // Returns how much larger than on a common display letters have to be on the main screen's, as the desktop says.
    [[nodiscard]] double display_scale() const;
    // Return what the display reports: how long all outputs waited (the vblank is the main screen's, the left eye's of
    // two), and what the main screen's output has presented; nothing where nothing is shown.
    [[nodiscard]] SessionOutput::Blocked take_blocked();
    [[nodiscard]] std::uint64_t presented() const;
    [[nodiscard]] std::optional<bool> was_shown(std::uint64_t picture) const;
    [[nodiscard]] const std::string& device_name() const { return device_->info().name; }
    [[nodiscard]] gpu::Device& device() { return *device_; }  // a new one after recover()
    [[nodiscard]] const SessionSurface& surface() const { return surface_; }

    // Returns what happened in the windows, waiting for at most so long (0: not at all) or until wake(). The mouse
    // counts in the main screen alone; in the window of its right eye positions lie kRightWindow_px (seen_place.hpp)
    // further to the right, in the panel's window kPanelWindow_px (panel_pointer.hpp). Closing any window asks the
    // session to end, since none of a wall's windows can be reopened alone. Displays driven directly give no input.
    [[nodiscard]] std::vector<Input> inputs(double wait_s) override;
    void wake();  // any thread

    // Has frames from now on draw less while the view moves, where the device is a processor (drawn_detail.hpp). Only
    // for a session in real time: what is drawn depends on how long it takes.
    void draw_less_in_motion() { draws_less_ = true; }
    // Returns whether the full picture is still to come; a frame after its rest draws it.
    [[nodiscard]] bool owes_full_picture() const { return burin::session::owes_full_picture(detail_); }
    // Draws one frame, if anything is new; returns whether it was. frame_ns: when it is to be seen, in session time.
    [[nodiscard]] Result<bool> draw(Desk& desk, Nanoseconds frame_ns) override;
    // Draws a picture in the main screen's window, if it differs from the one before; returns whether it was shown. A
    // stereo mode that the window cannot have is left for the session to refuse.
    [[nodiscard]] Result<bool> draw_still(const StillPicture& still);
    void hide_windows();
    // Has the session refuse a stereo mode that the output cannot show or the device has no memory for, and go on with
    // the one shown. draw() does so too; a frame that is not drawn calls it, once has_drawn(), so that the next
    // picture has the shape of the mode that goes on.
    [[nodiscard]] Result<void> fit_modes(Desk& desk) override;
    [[nodiscard]] bool has_drawn() const override { return drawn_; }
    // Returns whether eyes are shown by turns, which needs a picture at each refresh.
    [[nodiscard]] bool takes_turns(const Desk& desk) const;
    // Has coarser levels of the surface computed in the background; call between frames. resting: nothing has happened
    // for a while.
    void refine_beside(bool resting) { surface_.refine_beside(resting); }

    void exchange_full_screen() { screens_[wall_->main].output->exchange_full_screen(); }
    [[nodiscard]] std::vector<std::string> take_messages();  // for the user

    // Replaces a lost device: drops what was made on it and starts anew on one that is present, waiting some seconds at
    // most. What is carved belongs to the session and stays. Returns any other error, and so a device that is lost over
    // and over.
    [[nodiscard]] Result<void> recover(Desk& desk, const Error& error) override;

private:
    // Output for one eye's picture or both eyes'.
    struct Outlet {
        SessionOutput* output = nullptr;
        wall::Eye eye = wall::Eye::left;
        PresentedParts* parts = nullptr;
    };
    struct ScreenStage {
        std::unique_ptr<SessionOutput> output;
        SessionWindow* window = nullptr;  // same object, where the output is a window
        std::string title;                // of the window, without what is worked on
        std::unique_ptr<SessionWindow> right_window;
        PresentedParts parts, right_parts;
        std::optional<SessionPicture> picture;
        wall::OutputPlace place;
        wall::FieldParity parity;
        wall::OutputSettings settings;  // of this frame's picture
        bool anew = false;              // this frame's picture differs from the one in the outputs' images
        wall::OutputSettings shown;     // settings of the pictures in the outputs' images
        wall::OutputPlace shown_place;
    };

    Presenter(const DeskOptions& options, const SessionWall& wall, DirectDriver driver)
        : options_(options), wall_(&wall), driver_(std::move(driver)) {}
    [[nodiscard]] Result<void> open_outputs();
    [[nodiscard]] Result<void> open_device(std::optional<gpu::Device> opened = {});
    [[nodiscard]] Result<gpu::Device> lane() override { return device_->lane(); }
    [[nodiscard]] Result<gpu::Device> create_device() const;
    // Returns the outputs of a screen and of its right eye; null where there is none.
    [[nodiscard]] static std::array<SessionOutput*, 2> outputs_of(const ScreenStage& screen) {
        return {screen.output.get(), screen.right_window.get()};
    }
    [[nodiscard]] static std::vector<Input> right_eyes_inputs(const ScreenStage& screen);
    [[nodiscard]] static std::vector<Input> panels_inputs(const ScreenStage& screen, double wait_s);
    [[nodiscard]] Result<bool> paint_still(ScreenStage& screen, const StillPicture& still);
    // ---- presenter_drawing.cpp
    // Opens and closes what the mode needs: a second window, images of two layers. An Error leaves the screen in a
    // state it can show.
    [[nodiscard]] Result<void> fit_mode(std::size_t screen, const wall::OutputSettings& wanted);
    [[nodiscard]] Result<void> fit_outputs(std::size_t screen, wall::StereoMode mode);
    [[nodiscard]] Result<bool> draw_screens(Desk& desk);
    [[nodiscard]] Result<void> draw_screen(gpu::Commands& commands, std::size_t screen, Desk& desk,
                                           std::optional<picture::Picture> scene);
    void choose_detail(Desk& desk, std::span<const std::optional<picture::Picture>> scenes);
    static bool note_changes(ScreenStage& screen);
    [[nodiscard]] Result<void> show_screens(Nanoseconds frame_ns);
    [[nodiscard]] Result<void> show(ScreenStage& screen, Nanoseconds frame_ns);
    [[nodiscard]] Result<void> show_in(ScreenStage& screen, const Outlet& outlet);
    [[nodiscard]] wall::Eye eye_in_turn(ScreenStage& screen, Nanoseconds frame_ns);
    [[nodiscard]] Result<void> wait_for_device();
    void take_screenshots(Desk& desk);
    void photograph(std::size_t screen, Desk& desk, const std::vector<Asked>& wanted);

    DeskOptions options_;
    const SessionWall* wall_;
    DirectDriver driver_;
    std::optional<gpu::Device> device_;
    SessionSurface surface_;  // as all screens draw it
    std::vector<ScreenStage> screens_;
    std::unique_ptr<SessionWaker> waker_;  // present where no window waits for events
    std::vector<std::string> messages_;
    std::optional<gpu::Submission> submitted_;  // the last of this frame's submissions; done when all are
    MonotonicClock clock_;
    bool draws_less_ = false;
    DetailState detail_;
    std::optional<WholePicture> last_whole_;  // of the frame before, if it drew one
    bool drawn_ = false;                      // a picture, since it was opened
    int losses_ = 0;                          // device losses since the last picture
};

}  // namespace burin::session
