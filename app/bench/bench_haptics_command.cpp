// SPDX-License-Identifier: MIT
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/bench/bench_command.hpp"
#include "app/cli/output_files.hpp"
#include "base/file_io.hpp"
#include "base/try.hpp"
#include "bench/haptics/groove_figure.hpp"
#include "bench/haptics/haptics.hpp"

namespace burin::app {
namespace {

struct HapticsBench {
    bool quick = false;
    std::uint64_t contact_ticks = 0, paced_ticks = 0;  // 0: the default number
    std::string models, csv, svg, json, groove, before;
};

bench::HapticsOptions haptics_options(const HapticsBench& options) {
    bench::HapticsOptions wanted = options.quick ? bench::quick_haptics() : bench::HapticsOptions{};
    if (options.contact_ticks > 0) wanted.contact_ticks = options.contact_ticks;
    if (options.paced_ticks > 0) wanted.paced_ticks = options.paced_ticks;
    wanted.scenes.models = options.models;
    return wanted;
}

void notify_measured(const std::string& part) { std::fprintf(stderr, "measuring: %s\n", part.c_str()); }

// Draws what a tool feels in the groove that it cuts.
Result<void> draw_groove(const HapticsBench& options) {
    const std::filesystem::path folder = options.groove;
    const std::string sinking = (folder / "sinking.svg").string(), lifted = (folder / "lifted.svg").string(),
                      csv = (folder / "groove.csv").string();
    const std::vector<std::string> read =
        options.before.empty() ? std::vector<std::string>{} : std::vector{options.before};
    BURIN_TRY_DO(check_places(std::array{sinking, lifted, csv}, read));
    std::vector<bench::GroovePoint> before;
    if (!options.before.empty()) {
        BURIN_TRY(text, read_text_file(options.before));
        BURIN_TRY(points, bench::groove_points(text, options.before, "before"));
        before = std::move(points);
        std::erase_if(before, [](const bench::GroovePoint& point) { return point.kind != "lifted"; });
    }
    bench::GrooveOptions wanted;
    if (options.quick) {
        wanted.tools.resize(1);
        wanted.resolutions = {64};
        wanted.presses = {0.9, 1.5};
        wanted.pressed_from_m = 0.0005;
        wanted.lifted_resolution = 64;
    }
    const std::vector<bench::GroovePoint> points = bench::measure_groove(wanted, notify_measured);
    BURIN_TRY_DO(write_output(csv, bench::groove_csv(points)));
    BURIN_TRY_DO(write_output(sinking, bench::sinking_svg(points)));
    before.insert(before.end(), points.begin(), points.end());
    return write_output(lifted, bench::lifted_svg(before));
}

Result<void> run_haptics_bench(const HapticsBench& options) {
    if (!options.groove.empty()) return draw_groove(options);
    if (!options.before.empty())
        return fail("--before " + options.before, "is drawn beside nothing", "give --groove FOLDER as well");
    BURIN_TRY_DO(check_places(std::array{options.csv, options.svg, options.json}));
    BURIN_TRY(all, bench::run_haptics(haptics_options(options), notify_measured));
    if (options.json != kStandardOutput && options.csv != kStandardOutput && options.svg != kStandardOutput) {
        std::fputs(bench::haptics_table(all).c_str(), stdout);
    }
    BURIN_TRY_DO(write_output(options.csv, bench::haptics_csv(all)));
    BURIN_TRY_DO(write_output(options.svg, bench::haptics_svg(all)));
    return write_output(options.json, json_text(bench::haptics_json(all)));
}

CommandAction add_haptics_bench(Command command) {
    const auto options = std::make_shared<HapticsBench>();
    command.flag("--quick", options->quick, "Small meshes and few ticks: whether it works, in seconds");
    command.option("--ticks", options->contact_ticks, "How many ticks are looked at for lost contact (1000000)")
        .within(std::uint64_t{1}, std::uint64_t{1'000'000'000});
    command
        .option("--paced-ticks", options->paced_ticks,
                "How many ticks of each scene and probe, 1 ms each, cold, and as many rehearsed (2000)")
        .within(std::uint64_t{1}, std::uint64_t{10'000'000});
    command.option("--models", options->models,
                   "A folder of meshes (STL, OBJ, PLY, OFF) to be touched besides, each scaled to 100 mm");
    command.option("--csv", options->csv, "A file for the table of ticks; - for standard output");
    command.option("--svg", options->svg, "A file for the figure");
    command.option("--groove", options->groove,
                   "A folder for sinking.svg, lifted.svg and groove.csv of a tool in its groove, and nothing else");
    command.option("--before", options->before, "With --groove: another version's groove.csv, to be drawn beside");
    command.option("--json", options->json, "A file for every figure; - for standard output");
    return action([options] { return run_haptics_bench(*options); });
}

}  // namespace

CommandRow bench_haptics_row() {
    return {"haptics",
            "Ticks of the haptic loop: their cost, parts, the proxy's error, lost contact, edits, the force's jumps",
            add_haptics_bench};
}

}  // namespace burin::app
