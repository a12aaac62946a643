// SPDX-License-Identifier: MIT
// Opens a session's workpiece before its user's eyes: a thread of its own makes it (opening_work.hpp), while the
// frame's thread shows the file's mesh and how far the work is (opening_picture.hpp). Then the session begins with what
// was made. Closing the window or Esc ends it.
//
//   open_before_eyes()   -> OpeningWork: read -> first look -> check, close holes -> solid -> surface    its thread
//        |  each 0.1 s, or woken: window's events, first look, step and share -> picture                 the frame's
//        v
//   MadeWorkpiece -> Desk::create
#pragma once

#include <optional>

#include "desk/opening/opening_work.hpp"
#include "desk/present/presenter.hpp"

namespace burin::session {

// Returns the workpiece; nothing where the user has ended it. Errors are those of the work. Where no picture can be
// made the work goes on without. The presenter has a window, and the options a workpiece.
[[nodiscard]] Result<std::unique_ptr<workpiece::Workpiece>> open_before_eyes(Presenter& presenter,
                                                                             const SessionSetup& options,
                                                                             const SessionWall& wall,
                                                                             OpeningWork::Make make);

// Returns whether an event of the window ends what goes on before the session: its closing, Esc, or Ctrl+Q.
[[nodiscard]] bool ends_opening(const Input& input);

}  // namespace burin::session
