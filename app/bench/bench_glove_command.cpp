// SPDX-License-Identifier: MIT
#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "activities/grasp/grasp_options.hpp"
#include "app/bench/bench_command.hpp"
#include "app/cli/output_files.hpp"
#include "base/assets.hpp"
#include "base/try.hpp"
#include "bench/glove/glove_output.hpp"
#include "devices/emulators/emulated_glove.hpp"
#include "devices/gloves/glove_link.hpp"

namespace burin::app {
namespace {

constexpr int kFinerSkins = 2;  // so that the skin's own facets are not felt
constexpr double kListen_s = 3.0;

struct GloveBench {
    std::string hand = asset_path("hands/right.glb");
    std::string svg, json;
    bool without_line = false;
};

// Counts the sets that come over the emulated glove's line in some seconds.
Result<double> sets_per_s() {
    BURIN_TRY(port, devices::GlovePort::create());
    std::atomic<bool> ends = false;
    std::thread glove([&] { port.run({}, [&] { return ends.load(); }); });
    MonotonicClock clock;
    double rate = 0.0;
    Result<void> opened;
    if (auto link = devices::GloveLink::open(port.name(), clock)) {
        const auto number = [&] { return (*link)->newest().set.number; };
        const Nanoseconds from_ns = clock.now_ns();
        std::uint8_t last = number();
        std::uint64_t sets = 0;
        while (clock.now_ns() - from_ns < nanoseconds(kListen_s)) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            const std::uint8_t now = number();
            sets += static_cast<std::uint8_t>(now - last);
            last = now;
        }
        rate = static_cast<double>(sets) / seconds(clock.now_ns() - from_ns);
    } else {
        opened = std::unexpected(link.error());
    }
    ends = true;
    glove.join();
    if (!opened) return std::unexpected(opened.error());
    return rate;
}

Result<void> run_glove_bench(const GloveBench& options) {
    BURIN_TRY_DO(check_places(std::array{options.svg, options.json}, std::array{options.hand}));
    BURIN_TRY(hand, geometry::read_hand_model(options.hand));
    for (int i = 0; i < kFinerSkins; ++i) hand = geometry::with_finer_skin(hand);
    bench::GloveFigures figures;
    BURIN_TRY(press, bench::press_fingertip(hand, geometry::Finger::index, figures.task));
    figures.press = std::move(press);
    const activities::GraspOptions usual;
    figures.default_points = usual.points;
    figures.default_extent_m = 1e-3 * usual.extent_mm;
    figures.lines = bench::compare_lines({9'600, 19'200, 38'400, 57'600, 115'200});
    if (!options.without_line) {
        BURIN_TRY(rate, sets_per_s());
        figures.measured_sets_per_s = rate;
        for (const bench::MadeAt at : {bench::MadeAt::controller, bench::MadeAt::host}) {
            BURIN_TRY(trial, bench::try_line(at));
            figures.trials.push_back(trial);
        }
    }
    if (options.json != kStandardOutput && options.svg != kStandardOutput)
        std::fputs(bench::glove_table(figures).c_str(), stdout);
    BURIN_TRY_DO(write_output(options.svg, bench::glove_svg(figures)));
    return write_output(options.json, json_text(bench::glove_json(figures)));
}

CommandAction add_glove_bench(Command command) {
    const auto options = std::make_shared<GloveBench>();
    command.option("--hand", options->hand, "A skinned hand, as assets/hands/README.md describes").show_default();
    command.flag("--without-line", options->without_line,
                 "Leave out what runs on the emulated glove's line in real time, about a minute");
    command.option("--svg", options->svg, "A file for the figure; - for standard output");
    command.option("--json", options->json, "A file for all figures; - for standard output");
    return action([options] { return run_glove_bench(*options); });
}

}  // namespace

CommandRow bench_glove_row() {
    return {"glove", "What a few points feel of a fingertip, and what a serial line does to a glove's force",
            add_glove_bench};
}

}  // namespace burin::app
