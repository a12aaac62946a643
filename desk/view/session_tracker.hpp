// SPDX-License-Identifier: MIT
// Which tracker a session hears: what --tracker names, an address or a description, or what the wall's file says.
#pragma once

#include <optional>
#include <string>

#include "devices/trackers/tracker_file.hpp"
#include "session/options/session_setup.hpp"
#include "wall/wall.hpp"

namespace burin::session {

// The value of --tracker that leaves the wall's tracker alone.
inline constexpr const char* kNoTracker = "none";

struct SessionTracker {
    std::string where;                                     // as devices::open_tracker() takes it; empty: none
    std::optional<devices::TrackerDescription> described;  // none: bodies have their usual names
};

// Resolves the options: --tracker none, an address, or FILE.toml with a description; else the table [tracker] of the
// wall's file. An address of the kind that the wall's description has replaces that description's address alone; one of
// another kind replaces the tracker. Where nothing is heard from outside (an --input in simulated time) there is none,
// and no file of a description is read. Errors: those of a description; eyes that both the wall and the tracker's head
// move from the sensor.
[[nodiscard]] Result<SessionTracker> session_tracker(const SessionSetup& options, const wall::WallSetup& setup);

// Opens it.
[[nodiscard]] Result<std::unique_ptr<devices::Tracker>> open_tracker(const SessionTracker& tracker,
                                                                     const wall::WallSetup& setup,
                                                                     devices::TrackerHost host);

}  // namespace burin::session
