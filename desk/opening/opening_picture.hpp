// SPDX-License-Identifier: MIT
// The picture of a desktop window while its workpiece is made: the mesh of the file where the workpiece will stand, as
// soon as it is read, and a card with name, step, share and seconds. Thread: the frame's.
#pragma once

#include <optional>
#include <string>

#include "base/work_watch.hpp"
#include "desk/opening/opening_work.hpp"
#include "desk/panel/panel.hpp"
#include "desk/present/presenter.hpp"
#include "desk/viewer/viewer.hpp"
#include "session/state/session_room.hpp"

namespace burin::session {

class OpeningPicture {
public:
    // Fails as the session would: where a device or the stereo mode is unknown.
    [[nodiscard]] static Result<OpeningPicture> create(const SessionSetup& options, const SessionWall& wall);

    // Has the mesh stand before the viewer from now on.
    void take(FirstLook look);
    // Lays the card out; returns the picture for a window of this size, which is valid until the next call.
    [[nodiscard]] Result<StillPicture> lay_out(const WorkWatch::Seen& seen, Nanoseconds time_ns, ImageSize window);

private:
    OpeningPicture(const SessionSetup& options, const SessionWall& wall, Room room, wall::OutputSettings output);
    [[nodiscard]] picture::Picture scene() const;

    SessionSetup options_;
    Room room_;
    DeskRoom desk_;
    wall::OutputSettings output_;
    std::string name_;
    std::optional<FirstLook> look_;
    std::optional<Panel> panel_;
};

}  // namespace burin::session
