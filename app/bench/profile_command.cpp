// SPDX-License-Identifier: MIT
#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "app/bench/profile.hpp"
#include "app/cli/live_options.hpp"
#include "app/cli/output_files.hpp"
#include "base/assets.hpp"
#include "base/try.hpp"
#include "compute/rays/lattice.hpp"
#include "desk/run/session.hpp"
#include "sculpt/carved_workpiece.hpp"
#include "session/options/option_bounds.hpp"
#include "session/record/input_files.hpp"

namespace burin::app {

namespace {

struct ProfileOptions {
    session::SessionSetup sculpt;
    bool window = false, simulated_hand = false;
    std::string driver_threads;  // "0,1,2"; empty: one run with as many as a live session has
    std::string json;
};

constexpr unsigned kMostDriverThreads = 32;

// Returns the options for which the log that comes with the program was written.
session::SessionSetup first_carve() {
    session::SessionSetup options;
    options.carve.workpiece.source = "ball:0.1";
    options.hands.tool.shape = "ball:0.01";
    options.record.input = asset_path("sessions/first-carve.txt");
    return options;
}

Result<ProfiledRun> run_once(const session::SessionSetup& options, bool for_a_device,
                             std::optional<unsigned> driver_threads) {
    // The software driver reads the variable when the session opens its device.
    if (driver_threads)
        setenv("LP_NUM_THREADS", std::to_string(*driver_threads).c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
    BURIN_TRY(record, session::time_session(options, for_a_device));
    return ProfiledRun{driver_threads, std::move(record)};
}

// Parses "0,1,2" to a choice for each run; an empty text to one run that leaves the choice to the session.
Result<std::vector<std::optional<unsigned>>> parse_driver_threads(const std::string& text) {
    if (text.empty()) return std::vector<std::optional<unsigned>>{std::nullopt};
    std::vector<std::optional<unsigned>> all;
    const char *at = text.data(), *const end = at + text.size();
    while (true) {
        unsigned threads = 0;
        const auto read = std::from_chars(at, end, threads);
        const bool ends = read.ptr == end;
        if (read.ec != std::errc() || threads > kMostDriverThreads || (!ends && *read.ptr != ',')) {
            return fail("--driver-threads " + text, "is no list of numbers from 0 to 32", "give one, or some: 0,1,2");
        }
        all.emplace_back(threads);
        if (ends) return all;
        at = read.ptr + 1;
    }
}

Result<void> profile(const ProfileOptions& o) {
    BURIN_TRY_DO(check_places(std::array{o.json}, session::inputs_of(o.sculpt).list()));
    session::SessionSetup options = o.sculpt;
    options.carve.make_workpiece = sculpt::make_carved_workpiece;
    options.desk.offscreen = !o.window;
    options.scene.no_workpiece = !options.scene.world.empty();
    BURIN_TRY(choices, parse_driver_threads(o.driver_threads));
    std::vector<Json> runs;
    for (const std::optional<unsigned> threads : choices) {
        BURIN_TRY(run, run_once(options, !o.simulated_hand, threads));
        runs.push_back(describe_run(run));
        if (o.json != kStandardOutput) std::printf("%s\n", profile_table(runs.back()).c_str());
    }
    if (o.json != kStandardOutput) std::fputs(comparison_table(runs).c_str(), stdout);
    Json all = {{"input", options.record.input}, {"workpiece", options.carve.workpiece.source}, {"runs", runs}};
    if (options.scene.no_workpiece) all["workpiece"] = options.scene.world;
    return write_output(o.json, json_text(all));
}

CommandAction add_profile(Command command) {
    const auto options = std::make_shared<ProfileOptions>();
    ProfileOptions& o = *options;
    o.sculpt = first_carve();
    session::SessionSetup& s = o.sculpt;
    command.option("--input", s.record.input, "A recorded or written log of a session's input; it leaves no files")
        .asset(AssetRoom::sessions)
        .show_default();
    command.flag("--window", o.window, "Show it in a window, instead of drawing what nobody sees");
    command.flag("--simulated-hand", o.simulated_hand,
                 "Ticks as a session without a device has them, which may rest; else as a device's user needs them");
    command.option("--workpiece", s.carve.workpiece.source, "As burin sculpt has it")
        .asset(AssetRoom::workpieces)
        .show_default();
    command.option("--world", s.scene.world, "A world, as burin world has it, in the workpiece's place")
        .asset(AssetRoom::worlds);
    command.option("--tool", s.hands.tool.shape, "As burin sculpt has it").asset(AssetRoom::tools).show_default();
    command.flag("--close-holes", s.carve.workpiece.close_holes, "As burin sculpt has it");
    command.option("--weld", s.carve.workpiece.weld_m, "As burin sculpt has it").within(session::kWeldBounds);
    command.unit("--units", s.carve.workpiece.units, "As burin sculpt has it");
    command.option("--resolution", s.carve.workpiece.resolution, "Lattice cells along the longest side")
        .within(compute::kMinResolution, compute::kMaxResolution)
        .show_default();
    command.option("--stereo", s.desk.stereo, "side-by-side, anaglyph-red-cyan, ...; else mono");
    command.option("--wall", s.desk.wall, "A wall file: all its screens").asset(AssetRoom::walls);
    command.flag("--windowed", s.desk.windowed, "With --wall and --window: its screens in windows on the desktop");
    command.option("--width", s.desk.width, "Of the picture, in pixels").within(session::kPictureBounds).show_default();
    command.option("--height", s.desk.height, "Of the picture, in pixels")
        .within(session::kPictureBounds)
        .show_default();
    command.option("--samples", s.desk.samples, "A pixel: 1 or 4; 0: 4, but 1 on a software device")
        .one_of(session::kSampleCounts)
        .show_default();
    add_mouse_option(command, s);
    add_detail_option(command, s);
    add_shadows_option(command, s);
    add_engine_option(command, s.carve.engine);
    command.option("--threads", s.threads, "How many threads carve; 0: one per core").within(0, 1024);
    command.option("--driver-threads", o.driver_threads,
                   "With a software device: how many threads draw, 0 to 32; several, with commas: a session for each");
    command.option("--json", o.json, "A file for all figures; - for standard output");
    return action([options] { return profile(*options); });
}

}  // namespace

CommandRow profile_row() { return {"profile", "Time the frames and ticks of a session that a log leads", add_profile}; }

}  // namespace burin::app
