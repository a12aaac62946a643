// SPDX-License-Identifier: MIT
#include "app/world/seek_command.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "activities/seek/seek.hpp"
#include "app/cli/live_options.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/recorded_files.hpp"
#include "app/recordings/live_replay.hpp"
#include "base/try.hpp"
#include "session/record/input_files.hpp"

namespace burin::app {

namespace {

// Its report is a JSON file; empty: none.
struct SeekSession {
    session::SessionSetup session;
    unsigned targets = 0;
    std::uint64_t seed = 1;
    std::string report;
};

// Leaves to a recording that is done again what the user has not given; what was given must be as it was recorded.
Result<activities::SeekOptions> sought(const SeekSession& options, const std::string& repeated,
                                       const std::vector<std::string>& given) {
    activities::SeekOptions sought{.targets = options.targets, .seed = options.seed};
    if (!repeated.starts_with("seek ")) return sought;
    BURIN_TRY(recorded, activities::seek_options_of(repeated));
    if (std::ranges::find(given, "--targets") == given.end()) sought.targets = recorded.targets;
    if (std::ranges::find(given, "--seed") == given.end()) sought.seed = recorded.seed;
    return sought;
}

Result<void> seek_objects(const SeekSession& options, const std::vector<std::string>& given) {
    session::SessionSetup session = options.session;
    const std::string repeated = repeated_activity(session);
    session.scene.no_workpiece = true;
    if (!session.hands.named.empty())
        return fail("--device", "gives several hands, and a search is one hand's", "name one device");
    BURIN_TRY_DO(check_places(std::array{options.report}, session::inputs_of(session).list()));
    BURIN_TRY(targets, sought(options, repeated, given));
    const auto activity = std::make_shared<activities::Seek>(targets);
    session.activity = activity;
    const Result<void> done = run_recorded_session(session, "seek");
    // What the person has done is kept, even where the session missed something else; one that never began leaves an
    // older report alone.
    if (!done && activity->found().empty()) return done;
    const Result<void> written = write_output(options.report, json_text(activity->report()));
    return done ? written : done;
}

CommandAction add_seek(Command command) {
    const auto options = std::make_shared<SeekSession>();
    SeekSession& seek = *options;
    command
        .option("FILE", seek.session.scene.world,
                "A world: .toml, .wrl for VRML 2.0, or a mesh (STL, OBJ, PLY, OFF); a recording has its own")
        .asset(AssetRoom::worlds);
    command.option("--targets", seek.targets, "How many objects are sought; 0: each that is seen and felt, once")
        .show_default();
    command.option("--seed", seek.seed, "Of the order in which they are named").show_default();
    command.option("--report", seek.report, "A JSON file for the times and paths; - for standard output");
    add_live_options(command, seek.session);
    return [options, command]() -> Result<int> {
        if (options->session.scene.world.empty() && repeated_activity(options->session).empty())
            return wrong_usage("seek", "FILE is required");
        return action([&] { return seek_objects(*options, command.given()); })();
    };
}

}  // namespace

CommandRow seek_row() {
    return {"seek", "Touch the objects of a world as they are named, against the clock", add_seek};
}

}  // namespace burin::app
