// SPDX-License-Identifier: MIT
// Exercises with a glove that has a fault, by the drills of the emulated one: what is scored, measured and told.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "base/json.hpp"
#include "gpu/device.hpp"
#include "tests/app/real_time.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

class RehabDrills : public testing::Test {
protected:
    void SetUp() override {
        if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    }
    // A ball with a glove that has a fault, by the exercise's own script; the report it leaves.
    [[nodiscard]] Json report_with(const std::string& drill) {
        const std::string burin = kBurinCommand;
        const auto path = [&](const char* name) { return (at / name).string(); };
        outcome = at.run("rm -f port.txt g.json; (" + burin + " glove emulate --seconds 60 " + drill +
                         " > port.txt &) ; while ! test -s port.txt; do sleep 0.05; done; cd " +
                         std::string(kSessionsFolder) + "/../.. && " + burin + " rehab ball --device glove:$(cat " +
                         path("port.txt") + ") --offscreen --share 0 --record " + path("g.session") + " --report " +
                         path("g.json") + " --outputs " + path("out"));
        const Json json = Json::parse(at.read("g.json"), nullptr, false);
        return json.is_object() ? json : Json::object();
    }
    const Workplace at;
    Workplace::Outcome outcome;
};

}  // namespace

TEST_F(RehabDrills, AGloveWhoseMotorsAreOffScoresNothingAndIsToldSo) {
    const Json report = report_with("--motors-off");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(outcome.output.contains("the glove's motors are off")) << outcome.output;
    ASSERT_TRUE(report.contains("counts")) << outcome.output;
    EXPECT_EQ(report["counts"]["repetitions"], 0);
    EXPECT_EQ(report["score"], 0.0);
    for (const Json& finger : report["fingers"]) {
        EXPECT_EQ(finger["peak_force_N"], 0.0);
        EXPECT_NE(finger["pressed_at_start"], true);
    }
}

// Whatever the others do: the index has given nothing at the start, and is told by name.
TEST_F(RehabDrills, ADeadPistonHasGivenNothingAtTheStart) {
    Json report;
    const auto late = kept_from_real_time(at, "g.session", [&] {
        report = report_with("--dead index");
        return report.contains("fingers") && std::ranges::any_of(report["fingers"], [](const Json& finger) {
                   return finger["pressed_at_start"] == true;
               });
    });
    if (late) GTEST_SKIP() << *late;
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(outcome.output.contains("press with each finger once: thumb, index, middle, ring")) << outcome.output;
    EXPECT_TRUE(outcome.output.contains("the index finger's piston gives another force than it is told") ||
                outcome.output.contains("gave nothing when they were to press: index"))
        << outcome.output;
    EXPECT_EQ(report["fingers"][1]["pressed_at_start"], false) << outcome.output;
    EXPECT_LT(report["fingers"][1]["peak_measured_N"].is_number()
                  ? report["fingers"][1]["peak_measured_N"].get<double>()
                  : 0.0,
              0.05);
}

}  // namespace burin::app
