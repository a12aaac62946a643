// SPDX-License-Identifier: MIT
// burin seek WORLD: the objects of a world are touched as they are named, in a live session (activities/seek).
#include "activities/seek/seek.hpp"
#include "app/commands.hpp"
#include "app/live_options.hpp"
#include "app/output_files.hpp"
#include "session/drive/session.hpp"

namespace burin::app {

void add_seek_options(Command command, SeekSession& seek) {
    command.option("FILE", seek.session.world, "A world: .toml, .wrl for VRML 2.0, or a mesh (STL, OBJ, PLY, OFF)")
        .required();
    command.option("--targets", seek.targets, "How many objects are sought; 0: each that is seen and felt, once")
        .show_default();
    command.option("--seed", seek.seed, "Of the order in which they are named").show_default();
    command.option("--report", seek.report, "A JSON file for the times and paths; - for standard output");
    add_live_options(command, seek.session.live);
}

Result<void> seek(const SeekSession& options) {
    if (const auto ok =
            check_outputs({}, options.report == kStandardOutput ? "" : options.report, {options.session.world});
        !ok)
        return ok;
    const auto activity =
        std::make_shared<activities::Seek>(activities::SeekOptions{.targets = options.targets, .seed = options.seed});
    session::SculptOptions session = options.session;
    session.no_workpiece = true;
    session.activity = activity;
    if (const auto done = session::run_session(session); !done) return done;
    return write_output(options.report, json_text(activity->report()));
}

}  // namespace burin::app
