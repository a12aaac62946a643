// SPDX-License-Identifier: MIT
#include "app/cli/live_options.hpp"

#include "base/numbers.hpp"
#include "base/try.hpp"
#include "compute/engine/chosen_engine.hpp"
#include "devices/registry/device_registry.hpp"
#include "devices/trackers/tracker.hpp"
#include "sculpt/load_workpiece.hpp"
#include "session/options/option_bounds.hpp"

namespace burin::app {

void add_mouse_option(Command command, session::SessionSetup& options) {
    command.option(
        "--mouse",
        [&options](const std::vector<std::string>& given) -> Result<void> {
            if (given.empty()) return {};
            BURIN_TRY(mode, session::parse_mouse_mode(given.back(), "--mouse " + given.back()));
            options.hands.mouse = mode;
            return {};
        },
        "surface: the tool is where the cursor points, as usual for a person who carves; free: the mouse moves it "
        "along the screen and the wheel in depth, as usual for an --input");
}

void add_edge_option(Command command, session::SessionSetup& options) {
    command.option(
        "--edge-comfort",
        [&options](const std::vector<std::string>& given) -> Result<void> {
            if (given.empty()) return {};
            BURIN_TRY(comfort, session::parse_edge_comfort(given.back(), "--edge-comfort " + given.back()));
            options.desk.edge_comfort = comfort;
            return {};
        },
        "on: what stands before a lone screen is shown flatter towards its edges, which spares the eyes and is not its "
        "true depth; off: nowhere; auto: until a tracker has told where the head is");
}

void add_detail_option(Command command, session::SessionSetup& options) {
    using session::DetailChoice;
    command.choice(
        "--detail", options.desk.detail,
        "auto: on a device that is a processor the picture has fewer pixels while the view moves, and all of "
        "them when it rests; full: always all",
        std::vector<std::pair<std::string, DetailChoice>>{{"auto", DetailChoice::automatic},
                                                          {"full", DetailChoice::full}});
}

void add_engine_option(Command command, compute::EngineChoice& engine) {
    command.choice("--engine", engine,
                   "auto, cpu or vulkan; where a device cannot carve, or is lost, the processor goes on",
                   {{"auto", compute::EngineChoice::automatic},
                    {"cpu", compute::EngineChoice::cpu},
                    {"vulkan", compute::EngineChoice::vulkan}});
}

void add_shadows_option(Command command, session::SessionSetup& options) {
    command.choice("--shadows", options.desk.shadows, "Whether the objects of a world cast shadows",
                   std::vector<std::pair<std::string, bool>>{{"on", true}, {"off", false}});
}

std::vector<std::string> add_live_options(Command command, session::SessionSetup& options, const char* input_help,
                                          const char* device_help) {
    const std::size_t before = command.options().size();
    command.flag("--live", options.desk.live,
                 "Open a window; also without this when neither a stroke nor an output is given");
    command.option("--input", options.record.input, input_help).asset(AssetRoom::sessions);
    command.option("--record", options.record.path,
                   "A new file for all that the session depends on; with --input that log is played in real time. "
                   "FILE.session keeps every tick as well (burin session info FILE), any other name is a log as text. "
                   "With a --stroke that a simulated hand feels: a session file, whatever its name");
    command.flag("--lsl", options.record.lsl,
                 "Stream ticks, events and trials by Lab Streaming Layer, in real time; liblsl has to be installed");
    command.option(
        "--lsl-markers",
        [&options](const std::vector<std::string>& given) -> Result<void> {
            if (!given.empty()) options.record.lsl_markers = given.back();
            return {};
        },
        "With --record FILE.session: hear streams of type Markers by this name, or predicate as XPath has them, and "
        "keep what they say among the recording's events; \"\" for all");
    command.option("--journal", options.work.journal,
                   "A folder in which strokes are kept until they are saved, none for no such folder; else the usual "
                   "one, and none with --input");
    command.flag("--offscreen", options.desk.offscreen, "With --input: no window, only screenshots");
    command.option("--stereo", options.desk.stereo, "side-by-side, anaglyph-red-cyan, row-interlaced, ...; else mono");
    command.flag("--swap-eyes", options.desk.swap_eyes, "For exchanged cables or glasses");
    add_edge_option(command, options);
    command
        .option("--wall", options.desk.wall,
                "A wall file: its screens, each on its monitor or display, its eyes and its tracker")
        .asset(AssetRoom::walls);
    command
        .option("--tracker", options.desk.tracker,
                "Where head and wands are heard, else as the wall file says (none: nowhere): FILE.toml, a tracker's "
                "description; " +
                    devices::tracker_usage())
        .asset(AssetRoom::trackers);
    command
        .option(
            "--device",
            [&options](const std::vector<std::string>& given) { return session::set_devices(options.hands, given); },
            "The force-feedback device, else the mouse for carving in a window, and otherwise " +
                std::string(devices::kDefaultHapticDevice) +
                "; several hands have one each: --device right=simulated --device left=simulated-wand. There are " +
                devices::haptic_usage() + device_help)
        .asset(AssetRoom::devices);
    add_mouse_option(command, options);
    command.flag("--windowed", options.desk.windowed,
                 "With --wall: its screens in windows, fitted into --width by --height");
    command.flag("--panel-window", options.desk.panel_window,
                 "The panel in a window of its own, for an operator; the pictures show no more of it than the page for "
                 "the person who stands before them");
    command.option(
        "--panel-scale",
        [&options](const std::vector<std::string>& given) -> Result<void> {
            if (given.empty()) return {};
            const auto scale = parse_numbers(given.back(), 1, "--panel-scale");
            const auto& bounds = session::kPanelScaleBounds;
            if (!scale || (*scale)[0] < bounds.least || (*scale)[0] > bounds.most)
                return fail("--panel-scale " + given.back(), "is no size of letters",
                            "write a number from 0.5 to 4; 1 is for a display of 96 dpi");
            options.desk.panel_scale = (*scale)[0];
            return {};
        },
        "Size of the panel's letters, from 0.5 to 4; else as the desktop asks (2 at 192 dpi)");
    command.option("--full-screen", options.desk.full_screen, "Fill this monitor: its name or index");
    command.option("--width", options.desk.width, "Of the window, in pixels")
        .within(session::kPictureBounds)
        .show_default();
    command.option("--height", options.desk.height, "Of the window, in pixels")
        .within(session::kPictureBounds)
        .show_default();
    command.option("--samples", options.desk.samples, "A pixel: 1 or 4; 0: 4, but 1 on a software device")
        .one_of(session::kSampleCounts)
        .show_default();
    add_detail_option(command, options);
    add_shadows_option(command, options);
    command.option("--screenshots", options.desk.screenshots, "The folder for the session's screenshots");
    command.option("--outputs", options.work.outputs,
                   "With --input: the folder below which all its files go; else one in the working folder, named after "
                   "the log: LOG-outputs");
    std::vector<std::string> names = command.options();
    names.erase(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(before));
    return names;
}

void add_mirror_option(Command command, session::SessionSetup& options) {
    command.option(
        "--mirror",
        [&options](const std::vector<std::string>& given) -> Result<void> {
            if (given.empty()) return {};
            BURIN_TRY(mirror, toolbox::parse_mirror(given.back(), "--mirror " + given.back()));
            options.carve.mirror = mirror;
            return {};
        },
        "Carve the other side as well, across planes through the workpiece's middle: x, y, z, or several such as xz");
}

}  // namespace burin::app
