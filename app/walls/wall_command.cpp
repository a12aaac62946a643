// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/output_files.hpp"
#include "app/walls/wall_commands.hpp"
#include "base/try.hpp"
#include "desk/view/session_tracker.hpp"
#include "wall/wall.hpp"
#include "wall/wall_figures.hpp"
#include "wall/wall_file.hpp"

namespace burin::app {

namespace {

// Options of show; check has the file alone.
struct ShownWall {
    std::string file, svg, json, tracker;
    bool print_config = false;
};

// Returns the setup with its tracker's description written out, its address as --tracker says.
Result<wall::WallSetup> with_tracker(wall::WallSetup setup, const std::string& file, const std::string& tracker) {
    session::SessionSetup options;
    options.desk.wall = file;
    options.desk.tracker = tracker;
    BURIN_TRY(heard, session::session_tracker(options, setup));
    setup.tracker_toml.clear();
    if (heard.described) {
        devices::TrackerDescription described = *heard.described;
        described.address = heard.where.substr(0, heard.where.find(','));
        setup.tracker_toml = devices::tracker_text(described, "tracker");
    } else if (!heard.where.empty()) {
        setup.tracker_toml = "# --tracker " + heard.where + ": its bodies have the names that its settings say\n";
    }
    return setup;
}

Result<void> show_wall(const ShownWall& shown) {
    BURIN_TRY_DO(check_places(std::array{shown.svg, shown.json}, std::array{shown.file}));
    BURIN_TRY(setup, wall::read_wall(shown.file));
    if (shown.print_config) {
        BURIN_TRY(whole, with_tracker(setup, shown.file, shown.tracker));
        std::fputs(wall::wall_text(whole).c_str(), stdout);
        return {};
    }
    const auto figures = wall::wall_figures(setup);
    if (shown.json != kStandardOutput && shown.svg != kStandardOutput)
        std::fputs(wall::wall_table(figures).c_str(), stdout);
    BURIN_TRY_DO(write_output(shown.svg, wall::wall_drawing(setup)));
    return write_output(shown.json, json_text(figures));
}

Result<void> check_wall(const std::string& file) {
    BURIN_TRY(setup, wall::read_wall(file));
    BURIN_TRY_DO(with_tracker(setup, file, {}));
    std::vector<wall::WallProblem> problems = wall::check(setup);
    for (wall::WallProblem& problem : wall::check_modes(setup)) problems.push_back(std::move(problem));
    for (const wall::WallProblem& p : problems) std::printf("%s\n", line_of(p).c_str());
    const auto errors = std::ranges::count(problems, true, &wall::WallProblem::error);
    if (errors > 0) {
        std::fflush(stdout);
        return fail(file, std::to_string(errors) + (errors == 1 ? " error" : " errors"), "correct it and check again");
    }
    if (problems.empty()) std::printf("%s: nothing wrong\n", file.c_str());
    return {};
}

CommandAction add_wall_show(Command command) {
    const auto options = std::make_shared<ShownWall>();
    command.option("FILE", options->file, "A wall file, see docs/formats.md").asset(AssetRoom::walls).required();
    command.option("--svg", options->svg, "A file for a drawing, plan and side view; - for standard output");
    command.flag("--print-config", options->print_config,
                 "Print the file with every setting, its tracker's description written out, and do no more");
    command
        .option("--tracker", options->tracker,
                "With --print-config: a tracker as sessions take it, in place of the file's")
        .asset(AssetRoom::trackers);
    command.option("--json", options->json, "A file for all figures; - for standard output");
    return action([options] { return show_wall(*options); });
}

CommandAction add_wall_check(Command command) {
    const auto file = std::make_shared<std::string>();
    command.option("FILE", *file, "A wall file").asset(AssetRoom::walls).required();
    return action([file] { return check_wall(*file); });
}

CommandAction add_wall_command(Command command) {
    command.require_subcommand();
    return add_commands(command,
                        {{"show", "Its screens in metres, degrees and pixels", add_wall_show},
                         {"check", "What is wrong with it; exit status 1 when there is an error", add_wall_check},
                         wall_calibrate_row()});
}

}  // namespace

CommandRow wall_row() { return {"wall", "Show, check or calibrate a stereo wall", add_wall_command}; }

}  // namespace burin::app
