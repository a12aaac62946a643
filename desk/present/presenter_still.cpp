// SPDX-License-Identifier: MIT
// Draws pictures before there is a session, into the main screen's window alone.
#include "desk/present/presenter.hpp"

#include "base/try.hpp"

namespace burin::session {

Result<bool> Presenter::draw_still(const StillPicture& still) {
    ScreenStage& screen = screens_[wall_->main];
    if (!screen.output || is_empty(screen.place.size)) return false;
    const std::uint64_t before = presented();
    screen.settings = still.output;
    if (!fit_mode(wall_->main, still.output)) screen.settings.mode = screen.shown.mode;
    const Result<bool> anew = paint_still(screen, still);
    if (!anew) return anew;
    if (*anew) BURIN_TRY_DO(show(screen, clock_.now_ns()));
    BURIN_TRY_DO(wait_for_device());
    return presented() > before;
}

// Records and submits what is new; returns whether the window has to show something.
Result<bool> Presenter::paint_still(ScreenStage& screen, const StillPicture& still) {
    BURIN_TRY(commands, gpu::Commands::begin(*device_));
    BURIN_TRY_DO(surface_.upload(commands));
    BURIN_TRY_DO(screen.picture->paint(commands, still.panel));
    BURIN_TRY_DO(screen.picture->draw(commands, still.scene, screen.place.size, screen.settings));
    if (!note_changes(screen)) return false;
    BURIN_TRY(submission, std::move(commands).submit());
    submitted_ = std::move(submission);
    return true;
}

void Presenter::hide_windows() {
    for (ScreenStage& screen : screens_)
        if (screen.window != nullptr) screen.window->hide();
}

}  // namespace burin::session
