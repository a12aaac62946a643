// SPDX-License-Identifier: MIT
// Draws pictures before there is a session, into the main screen's window alone.
#include "desk/present/presenter.hpp"

namespace burin::session {

Result<bool> Presenter::draw_still(const StillPicture& still) {
    ScreenStage& screen = screens_[wall_->main];
    if (!screen.output || is_empty(screen.place.size)) return false;
    const std::uint64_t before = presented();
    screen.settings = still.output;
    if (!fit_mode(wall_->main, still.output)) screen.settings.mode = screen.shown.mode;
    const Result<bool> anew = paint_still(screen, still);
    if (!anew) return anew;
    if (*anew)
        if (const auto shown = show(screen, clock_.now_ns()); !shown) return std::unexpected(shown.error());
    if (const auto done = wait_for_device(); !done) return std::unexpected(done.error());
    return presented() > before;
}

// Records and submits what is new; returns whether the window has to show something.
Result<bool> Presenter::paint_still(ScreenStage& screen, const StillPicture& still) {
    auto commands = gpu::Commands::begin(*device_);
    if (!commands) return std::unexpected(commands.error());
    if (const auto uploaded = surface_.upload(*commands); !uploaded) return std::unexpected(uploaded.error());
    if (const auto painted = screen.picture->paint(*commands, still.panel); !painted)
        return std::unexpected(painted.error());
    const auto drawn = screen.picture->draw(*commands, still.scene, screen.place.size, screen.settings);
    if (!drawn) return std::unexpected(drawn.error());
    if (!note_changes(screen)) return false;
    auto submission = std::move(*commands).submit();
    if (!submission) return std::unexpected(submission.error());
    submitted_ = std::move(*submission);
    return true;
}

void Presenter::hide_windows() {
    for (ScreenStage& screen : screens_)
        if (screen.window != nullptr) screen.window->hide();
}

}  // namespace burin::session
