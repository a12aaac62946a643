// SPDX-License-Identifier: MIT
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "app/bench/bench_command.hpp"
#include "app/cli/output_files.hpp"
#include "base/try.hpp"
#include "bench/frame/frame.hpp"
#include "bench/frame/frame_peers.hpp"
#include "gpu/driver_threads.hpp"
#include "picture/png.hpp"

namespace burin::app {
namespace {

struct FrameBench {
    bench::FrameOptions frame;
    std::string scene = "all", peer, ways = "all", json, csv, ratios, pictures;
};

bench::FrameOptions frame_options(const FrameBench& options) {
    bench::FrameOptions wanted = options.frame;
    const bool all = options.scene == "all";
    std::erase_if(wanted.motions,
                  [&](bench::FrameMotion motion) { return !all && options.scene != bench::name_of(motion); });
    wanted.idle = all || options.scene == "idle";
    wanted.first = all || options.scene == "first";
    wanted.other_ways = options.ways == "all";
    wanted.osg = options.peer == "osg" || options.peer == "all";
    wanted.vtk = options.peer == "vtk" || options.peer == "all";
    return wanted;
}

Result<void> check(const FrameBench& options) {
    BURIN_TRY_DO(check_places(std::array{options.json, options.csv, options.ratios}));
    std::error_code ignored;
    if (!options.pictures.empty() && !std::filesystem::is_directory(options.pictures, ignored)) {
        return fail(options.pictures, "is not a folder", "make it first");
    }
    if (!options.peer.empty() && !bench::has_frame_peers()) {
        return fail("--peer " + options.peer, "is not built into this program",
                    "install it with scripts/setup --peers and configure with -DBURIN_WITH_PEERS=ON");
    }
    if (options.frame.samples != 1 && options.frame.samples != 4) {
        return fail("--samples " + std::to_string(options.frame.samples), "is not possible", "choose 1 or 4");
    }
    return {};
}

// Adds the ratios to a file, so that it holds those of many runs; a new file begins with the names of its columns.
Result<void> add_ratios(const bench::FrameReport& report, const std::string& path) {
    if (path.empty()) return {};
    std::error_code none;
    std::ostringstream before;
    if (const std::ifstream file(path); file && std::filesystem::is_regular_file(path, none)) before << file.rdbuf();
    const std::string rows = bench::ratio_rows(report, gpu::driver_threads(), before.str().empty());
    return write_output(path, before.str() + rows);
}

// Writes each subject's last picture, both eyes side by side, to a file named after subject, scene and way:
// burin-moving-burin-s-light-at-vertices.png.
Result<void> write_pictures(const bench::FrameReport& report, const std::filesystem::path& folder) {
    for (const bench::FrameTimes& times : report.times) {
        std::string name = times.subject + "-" + bench::name_of(times.motion) + "-" + bench::name_of(times.way);
        for (char& c : name) c = std::isalnum(c) == 0 ? '-' : static_cast<char>(std::tolower(c));
        BURIN_TRY_DO(picture::write_png(folder / (name + ".png"), side_by_side(times.pictures)));
    }
    return {};
}

Result<void> run_frame_bench(const FrameBench& options) {
    BURIN_TRY_DO(check(options));
    gpu::leave_a_core_to_touch();  // as a session does, so that the figures are those of a session
    BURIN_TRY(report, bench::run_frames(frame_options(options), [](const std::string& part) {
                  std::fprintf(stderr, "measuring: %s\n", part.c_str());
              }));
    if (options.json != kStandardOutput && options.csv != kStandardOutput) {
        std::fputs(bench::frame_table(report).c_str(), stdout);
        std::printf("a software driver draws with %s thread(s), as in a session; LP_NUM_THREADS says otherwise\n",
                    gpu::driver_threads());
    }
    if (!options.pictures.empty()) {
        BURIN_TRY_DO(write_pictures(report, options.pictures));
    }
    BURIN_TRY_DO(write_output(options.csv, bench::frame_csv(report)));
    BURIN_TRY_DO(add_ratios(report, options.ratios));
    Json json = bench::frame_json(report);
    json["driver_threads"] = gpu::driver_threads();
    return write_output(options.json, json_text(json));
}

CommandAction add_frame_bench(Command command) {
    const auto options = std::make_shared<FrameBench>();
    command.option("--triangles", options->frame.triangles, "How many the surface has, about")
        .within(std::size_t{1'000}, std::size_t{10'000'000})
        .show_default();
    command
        .option("--scene", options->scene,
                "moving: the head goes about; still; carving: a few patches change; idle; first: the first picture")
        .one_of({"moving", "still", "carving", "idle", "first", "all"})
        .show_default();
    command.option("--samples", options->frame.samples, "Samples a pixel, 1 or 4").show_default();
    command.option("--frames", options->frame.frames, "Frames that are measured, of each scene")
        .within(std::uint64_t{1}, std::uint64_t{1'000'000})
        .show_default();
    command.option("--peer", options->peer, "Let this library draw the same: osg, vtk or all")
        .one_of({"osg", "vtk", "all"});
    command
        .option(
            "--ways", options->ways,
            "all: a moving head also with light at pixels and at vertices, with the same light and with all triangles; "
            "as-set-up: only as users set each up")
        .one_of({"all", "as-set-up"})
        .show_default();
    command.option("--device", options->frame.device, "Which Vulkan device, by its number in burin --version");
    command.option("--pictures", options->pictures, "A folder for each last picture, both eyes side by side");
    command.option("--csv", options->csv, "A file for the table; - for standard output");
    command.option("--ratios", options->ratios,
                   "A file that the ratios to the peers are added to, for medians of many runs");
    command.option("--json", options->json, "A file for every figure; - for standard output");
    return action([options] { return run_frame_bench(*options); });
}

}  // namespace

CommandRow bench_frame_row() {
    return {"frame", "Stereo frames off screen: their cost, beside OpenSceneGraph's and VTK's", add_frame_bench};
}

}  // namespace burin::app
