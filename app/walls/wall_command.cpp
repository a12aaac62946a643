// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/output_files.hpp"
#include "app/walls/wall_commands.hpp"
#include "session/state/session_tracker.hpp"
#include "wall/wall.hpp"
#include "wall/wall_figures.hpp"
#include "wall/wall_file.hpp"

namespace burin::app {

struct WallCommand::Options {
    std::string file, svg, json, tracker;
    bool print_config = false;
    WallCalibrationOptions calibration;

    [[nodiscard]] Result<void> show() const;
    [[nodiscard]] Result<void> check_file() const;
};

namespace {

// Returns the setup with its tracker's description written out, its address as --tracker says.
Result<wall::WallSetup> with_tracker(wall::WallSetup setup, const std::string& file, const std::string& tracker) {
    session::LiveOptions options;
    options.wall = file;
    options.tracker = tracker;
    const auto heard = session::session_tracker(options, setup);
    if (!heard) return std::unexpected(heard.error());
    setup.tracker_toml.clear();
    if (heard->described) {
        devices::TrackerDescription described = *heard->described;
        described.address = heard->where.substr(0, heard->where.find(','));
        setup.tracker_toml = devices::tracker_text(described, "tracker");
    } else if (!heard->where.empty()) {
        setup.tracker_toml = "# --tracker " + heard->where + ": its bodies have the names that its settings say\n";
    }
    return setup;
}

}  // namespace

Result<void> WallCommand::Options::show() const {
    if (const auto ok = check_places(std::array{svg, json}, std::array{file}); !ok) return ok;
    const auto setup = wall::read_wall(file);
    if (!setup) return std::unexpected(setup.error());
    if (print_config) {
        const auto whole = with_tracker(*setup, file, tracker);
        if (!whole) return std::unexpected(whole.error());
        std::fputs(wall::wall_text(*whole).c_str(), stdout);
        return {};
    }
    const auto figures = wall::wall_figures(*setup);
    if (json != kStandardOutput && svg != kStandardOutput) std::fputs(wall::wall_table(figures).c_str(), stdout);
    if (const auto ok = write_output(svg, wall::wall_drawing(*setup)); !ok) return ok;
    return write_output(json, json_text(figures));
}

Result<void> WallCommand::Options::check_file() const {
    const auto setup = wall::read_wall(file);
    if (!setup) return std::unexpected(setup.error());
    if (const auto whole = with_tracker(*setup, file, {}); !whole) return std::unexpected(whole.error());
    std::vector<wall::WallProblem> problems = wall::check(*setup);
    for (wall::WallProblem& problem : wall::check_modes(*setup)) problems.push_back(std::move(problem));
    for (const wall::WallProblem& p : problems) std::printf("%s\n", line_of(p).c_str());
    const auto errors = std::ranges::count(problems, true, &wall::WallProblem::error);
    if (errors > 0) {
        std::fflush(stdout);
        return fail(file, std::to_string(errors) + (errors == 1 ? " error" : " errors"), "correct it and check again");
    }
    if (problems.empty()) std::printf("%s: nothing wrong\n", file.c_str());
    return {};
}

WallCommand::WallCommand(Command app)
    : options_(std::make_unique<Options>()),
      command_(app.subcommand("wall", "Show, check or calibrate a stereo wall")) {
    command_.require_subcommand();
    Options& o = *options_;
    show_ = command_.subcommand("show", "Its screens in metres, degrees and pixels");
    show_.option("FILE", o.file, "A wall file, see docs/formats.md").asset(AssetRoom::walls).required();
    show_.option("--svg", o.svg, "A file for a drawing, plan and side view; - for standard output");
    show_.flag("--print-config", o.print_config,
               "Print the file with every setting, its tracker's description written out, and do no more");
    show_.option("--tracker", o.tracker, "With --print-config: a tracker as sessions take it, in place of the file's")
        .asset(AssetRoom::trackers);
    show_.option("--json", o.json, "A file for all figures; - for standard output");

    check_ = command_.subcommand("check", "What is wrong with it; exit status 1 when there is an error");
    check_.option("FILE", o.file, "A wall file").asset(AssetRoom::walls).required();

    Command calibrate = command_.subcommand("calibrate", "A screen's corners from touches with a tracked wand");
    WallCalibrationOptions& c = o.calibration;
    calibrate.option("--wall", c.wall, "The wall file as it is").asset(AssetRoom::walls).required();
    calibrate
        .option("--samples", c.samples,
                "CSV with place,x,y,z in the wall's unit and the tracker's frame; - for standard input, with a "
                "prompt for each touch")
        .required();
    calibrate.option("--screen", c.screen, "Which screen was touched").required();
    calibrate.option("--out", c.out, "Where to write the new wall file; may be the old one").required();
    calibrate.option("--json", c.json, "A file for the residuals; - for standard output");
    calibrate.flag("--keep-size", c.keep_size, "Move and turn the screen, but leave its width and height");
}

WallCommand::~WallCommand() = default;

bool WallCommand::parsed() const { return command_.parsed(); }

Result<void> WallCommand::run() const {
    if (show_.parsed()) return options_->show();
    if (check_.parsed()) return options_->check_file();
    return calibrate_wall(options_->calibration);
}

}  // namespace burin::app
