// SPDX-License-Identifier: MIT
#include <memory>

#include "app/carve/sculpt.hpp"
#include "app/cli/live_options.hpp"
#include "app/cli/sculpt_options.hpp"
#include "app/recordings/live_replay.hpp"
#include "desk/run/session.hpp"

namespace burin::app {
namespace {

Result<void> carve_or_open(session::SessionSetup& options) {
    if (!records_a_felt_stroke(options) && session::wants_session(options))
        return run_recorded_session(options, "sculpt");
    session::settle_room(options, false);
    return app::sculpt(options);
}

CommandAction add_sculpt(Command command) {
    const auto options = std::make_shared<session::SessionSetup>();
    add_sculpt_options(command, *options);
    add_live_options(command, *options);
    return action([options] { return carve_or_open(*options); });
}

}  // namespace

CommandRow sculpt_row() { return {"sculpt", "Carve a workpiece, in a window or along a stroke", add_sculpt}; }

}  // namespace burin::app
