// SPDX-License-Identifier: MIT
#include "app/bench/profile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

constexpr Nanoseconds kMs = 1'000'000;

// A hundred frames in a shuffled order: their stages take i, 2 i, ... ms, their heads are as old as i ms, no tool is
// known.
ProfiledRun hundred_frames() {
    ProfiledRun run;
    run.record.device = "a device";
    run.record.wall_ns = 5 * kNanosecondsPerSecond;
    run.record.processor_ns = 8 * kNanosecondsPerSecond;
    run.record.skipped = 33;
    for (int n = 0; n < 100; ++n) {
        const Nanoseconds i = 1 + n * 37 % 100;
        session::TimedFrame frame;
        for (std::size_t stage = 0; stage < session::kFrameStages; ++stage)
            frame.stage_ns[stage] = static_cast<Nanoseconds>(stage + 1) * i * kMs;
        frame.processor_ns = 10 * i * kMs;
        frame.times.head_sampled_ns = 1000 * kMs - i * kMs;
        frame.times.seen_ns = 1000 * kMs;
        frame.ages = session::ages_of(frame.times, nullptr, {});
        run.record.frames.push_back(frame);
    }
    run.record.ticks = 5000;
    run.record.late_ticks = 7;
    run.record.missed_deadlines = 3;
    run.record.machine_pace = 1.75;
    run.record.lost_targets = 2;
    run.record.tick_duration = {5000, 1'000, 12'500, 20'000, 30'000, 40'000};
    run.record.tick_lateness = {5000, 0, 250, 500, 1'500, 900'000};
    run.record.warnings = {"too late"};
    return run;
}

std::size_t lines_with(const std::string& text, const std::string& part) {
    std::istringstream lines(text);
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);) count += line.find(part) != std::string::npos ? 1 : 0;
    return count;
}

}  // namespace

TEST(ProfileReport, GivesTheMedianThe99thPercentileAndTheWorst) {
    const auto run = describe_run(hundred_frames());
    for (std::size_t stage = 0; stage < session::kFrameStages; ++stage) {
        const auto& figure = run["stages_ms"][name_of(static_cast<session::FrameStage>(stage))];
        const auto unit = static_cast<double>(stage + 1);
        EXPECT_DOUBLE_EQ(figure["median"].get<double>(), 50.0 * unit);
        EXPECT_DOUBLE_EQ(figure["p99"].get<double>(), 99.0 * unit);
        EXPECT_DOUBLE_EQ(figure["worst"].get<double>(), 100.0 * unit);
    }
    EXPECT_DOUBLE_EQ(run["processor_ms"]["median"].get<double>(), 500.0);
    EXPECT_DOUBLE_EQ(run["ages_ms"]["head age"]["p99"].get<double>(), 99.0);
    EXPECT_TRUE(run["ages_ms"]["tool age"].is_null());
    EXPECT_TRUE(run["carve_update_ms"].is_null());
    EXPECT_DOUBLE_EQ(run["frames"]["drawn_per_s"].get<double>(), 20.0);
    EXPECT_EQ(run["frames"]["skipped"].get<int>(), 33);
    EXPECT_DOUBLE_EQ(run["cores_busy"].get<double>(), 1.6);
    EXPECT_DOUBLE_EQ(run["ticks"]["duration_us"]["median"].get<double>(), 12.5);
    EXPECT_DOUBLE_EQ(run["ticks"]["lateness_us"]["worst"].get<double>(), 900.0);
    EXPECT_EQ(run["ticks"]["missed_deadlines"].get<int>(), 3);
    EXPECT_DOUBLE_EQ(run["ticks"]["machine_pace"].get<double>(), 1.75);
    EXPECT_EQ(run["ticks"]["lost_targets"].get<int>(), 2);
    EXPECT_TRUE(run["driver_threads"].is_null());
}

TEST(ProfileReport, TheTableHasALineForEachFigure) {
    const std::string table = profile_table(describe_run(hundred_frames()));
    EXPECT_EQ(lines_with(table, "1.75 times as long as the reference core; 2 targets"), 1u);
    for (std::size_t stage = 0; stage < session::kFrameStages; ++stage)
        EXPECT_GE(lines_with(table, "  " + std::string(name_of(static_cast<session::FrameStage>(stage)))), 1u) << stage;
    for (std::size_t figure = 0; figure < session::kFrameFigures; ++figure)
        EXPECT_EQ(lines_with(table, "  " + std::string(name_of(static_cast<session::FrameFigure>(figure))) + " "), 1u);
    EXPECT_EQ(lines_with(table, "100 frames drawn (20.0 a second), 33 skipped, 1.60 cores busy"), 1u);
    EXPECT_EQ(lines_with(table, "5000 ticks, 7 late, 3 deadlines missed"), 1u);
    EXPECT_EQ(lines_with(table, "warning: too late"), 1u);
    EXPECT_EQ(lines_with(table, "median"), 4u);
    EXPECT_EQ(lines_with(table, "nan"), 0u);
    EXPECT_EQ(lines_with(table, "at rest"), 0u);
}

// Ten frames of each kind: turning 50 ms apart, carving 40, looking 20; a cut that is seen 100 ms after its click.
TEST(ProfileReport, TellsWhatAPersonsFramesWereGivenBesideWhatIsAimedAt) {
    ProfiledRun run;
    Nanoseconds seen_ns = 1000 * kMs;
    const auto add = [&](const session::FrameMotion& motion, Nanoseconds after_ns) {
        session::FrameTimes before;
        before.seen_ns = seen_ns;
        session::TimedFrame frame;
        frame.motion = motion;
        frame.processor_ns = 7 * kMs;
        frame.times.seen_ns = seen_ns += after_ns;
        frame.ages = session::ages_of(frame.times, &before, {});
        run.record.frames.push_back(frame);
    };
    for (int i = 0; i < 10; ++i) {
        add({.view = true, .tool = true}, 50 * kMs);
        add({.tool = true, .works = true}, 40 * kMs);
        add({.tool = true}, 20 * kMs);
        add({}, 900 * kMs);
    }
    run.record.frames[1].click_ns = 100 * kMs;
    const Json described = describe_run(run);
    EXPECT_DOUBLE_EQ(described["doing"]["turning"]["drawn_per_s"].get<double>(), 20.0);
    EXPECT_DOUBLE_EQ(described["doing"]["carving"]["drawn_per_s"].get<double>(), 25.0);
    EXPECT_DOUBLE_EQ(described["doing"]["looking"]["drawn_per_s"].get<double>(), 50.0);
    EXPECT_DOUBLE_EQ(described["doing"]["looking"]["aim_per_s"].get<double>(), 30.0);
    EXPECT_DOUBLE_EQ(described["click_to_cut_ms"]["median"].get<double>(), 100.0);
    EXPECT_DOUBLE_EQ(described["click_to_cut_ms"]["frames"].get<double>(), 2.5);
    const std::string table = profile_table(described);
    EXPECT_EQ(lines_with(table, "  turning                       20.0          30       50.00                7.00"),
              1u);
    EXPECT_EQ(lines_with(table, "until its cut is seen: 100.00 ms in the median, 100.00 at worst; 2.5 frames, aim 2"),
              1u);
}

TEST(ProfileReport, RestIsToldByItself) {
    ProfiledRun run = hundred_frames();
    run.record.rested_ns = 2'000'000'000;
    run.record.rested_processor_ns = 18'000'000;
    EXPECT_EQ(lines_with(profile_table(describe_run(run)), "at rest for 2.0 s of these, with 0.90 % of a core"), 1u);
}

TEST(ProfileReport, TellsWhatCarvingAndDrawingAskedOfTheDevice) {
    ProfiledRun run = hundred_frames();
    EXPECT_EQ(lines_with(profile_table(describe_run(run)), "asked of the device"), 0u);
    run.record.engine = "vulkan";
    run.record.engine_traffic = {300, 200, 5'000, 70'000, 9'000'000};
    run.record.picture_traffic = {40, 41, 1'000'000, 0, 2'000'000};
    run.record.updates = 100;
    run.record.rays_changed = 12'345;
    const Json described = describe_run(run);
    EXPECT_EQ(described["engine"]["traffic"]["submissions"], 300);
    EXPECT_EQ(described["engine"]["updates"], 100);
    EXPECT_EQ(described["engine"]["rays_changed"], 12'345);
    EXPECT_EQ(described["picture"]["bytes_to_device"], 1'000'000);
    const std::string table = profile_table(described);
    EXPECT_EQ(lines_with(table, "  submissions                    300             3.0          40"), 1u) << table;
    EXPECT_EQ(lines_with(table, "  bytes to the host            70000           700.0           0"), 1u) << table;
    EXPECT_EQ(lines_with(table, "  rays changed                 12345           123.5   in 100 updates"), 1u) << table;
    EXPECT_EQ(lines_with(table, "by the engine vulkan"), 1u) << table;
    run.record.engine_traffic.reset();  // the processor carves
    const std::string by_processor = profile_table(describe_run(run));
    EXPECT_EQ(lines_with(by_processor, "  submissions                      -               -          40"), 1u)
        << by_processor;
    run.record.updates = run.record.rays_changed = 0;
    EXPECT_EQ(lines_with(profile_table(describe_run(run)), "  rays changed                     0               -"), 1u);
}

TEST(ProfileReport, ASessionWithoutFramesHasATableToo) {
    const auto run = describe_run({});
    EXPECT_TRUE(run["stages_ms"]["draw"].is_null());
    EXPECT_EQ(run["frames"]["drawn_per_s"].get<double>(), 0.0);
    EXPECT_EQ(lines_with(profile_table(run), "0 frames drawn"), 1u);
}

TEST(ProfileReport, ComparesTheDriversThreads) {
    ProfiledRun one = hundred_frames(), two = hundred_frames();
    one.driver_threads = 1;
    two.driver_threads = 2;
    two.record.missed_deadlines = 444;
    EXPECT_TRUE(comparison_table({describe_run(one)}).empty());
    const std::string table = comparison_table({describe_run(one), describe_run(two)});
    EXPECT_EQ(std::ranges::count(table, '\n'), 3);
    EXPECT_EQ(lines_with(table, "444"), 1u);
    std::istringstream lines(table);
    std::string title, row;
    std::getline(lines, title);
    while (std::getline(lines, row)) EXPECT_EQ(row.size(), title.size());
}

TEST(ProfileCommand, NamesTheInputThatIsNotThere) {
    const Workplace place;
    const auto outcome = place.run("BURIN_ASSETS=/nowhere " + std::string(kBurinCommand) + " profile");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.output.find("first-carve.txt"), std::string::npos) << outcome.output;
    const auto wrong = place.run(std::string(kBurinCommand) + " profile --width 3");
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.output.find("burin profile --help"), std::string::npos) << wrong.output;
    for (const std::string threads : {"-1", "0,,1", "1,", "33", "two"}) {
        const auto refused = place.run(std::string(kBurinCommand) + " profile --driver-threads=" + threads);
        EXPECT_EQ(refused.status, 1) << threads;
        EXPECT_NE(refused.output.find("0,1,2"), std::string::npos) << refused.output;
    }
}

}  // namespace burin::app
