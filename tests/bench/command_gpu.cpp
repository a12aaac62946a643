// SPDX-License-Identifier: MIT
// The commands that a person with a graphics card runs, on the software device that poses as one
// (tests/tools/vulkan_layer): what they count is counted there as on a card.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "base/json.hpp"
#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posing_device.hpp"
#include "tests/support/run_command.hpp"

namespace burin::bench {
namespace {

class CardCommand : public testing::Test {
protected:
    void SetUp() override {
        const auto devices = gpu::list_devices();
        if (!devices) GTEST_SKIP() << "no Vulkan driver";
    }
    [[nodiscard]] Workplace::Outcome on_card(const std::string& command) const {
        const auto outcome = at_.run(posing_as() + "BURIN_VULKAN_VALIDATION=1 " + command);
        EXPECT_FALSE(outcome.output.contains("Vulkan validation")) << outcome.output;
        return outcome;
    }
    [[nodiscard]] Json written(const std::string& file) const { return Json::parse(at_.read(file)); }

    Workplace at_;
};

}  // namespace

TEST_F(CardCommand, EnginesAreTheSameToTheBitAndTheDeviceCarvesEachConvexTool) {
    const auto outcome = on_card(std::string(kBurinCommand) +
                                 " bench engines --operations 80 --resolution 24 --threads 1 --json engines.json");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(outcome.output.contains("no end differs")) << outcome.output;
    const Json check = written("engines.json");
    EXPECT_EQ(check["all"]["ends_that_differ"], 0);
    EXPECT_TRUE(check["first_difference"].is_null());
    EXPECT_GT(check["bytes_to_host"], 0) << "a card copies";
    EXPECT_TRUE(check["device"].is_string() && check["driver"].is_string() && check["machine"].is_string());
    for (const Json& work : check["by_work"])
        for (const char* tool : {"ball", "cylinder", "cone", "bullnose", "box"})
            if (work["work"] == tool) {
                EXPECT_GT(work["submissions"], 0) << tool;
            }
}

TEST_F(CardCommand, EnginesOfADeviceThatCannotCarveAreRefusedWithARemedy) {
    const auto outcome = at_.run(posing_as("BURIN_POSE_HIDE=float64") + kBurinCommand +
                                 " bench engines --operations 10 --resolution 24 --json engines.json");
    EXPECT_EQ(outcome.status, 1) << outcome.output;
    EXPECT_TRUE(outcome.output.contains("no doubles in shaders; choose another device with --device"))
        << outcome.output;
    EXPECT_EQ(at_.files(), 0u);
}

TEST_F(CardCommand, StrokesOfEachToolCountWhatAnUpdateAsksOfTheDevice) {
    for (const std::string tool : {"ball", "cylinder", "cone", "bullnose", "box --swept"}) {
        const auto outcome = on_card(std::string(kBurinCommand) +
                                     " bench stroke --engine vulkan --resolution 24 --updates 4 --plain --threads 1" +
                                     " --json stroke.json --tool " + tool);
        ASSERT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_TRUE(outcome.output.contains("asked of an update")) << outcome.output;
        const Json report = written("stroke.json"), &counts = report["counts_per_update"];
        EXPECT_GE(counts["submissions"]["median"], 1) << tool;
        EXPECT_EQ(counts["submissions"]["all"].get<double>() / 4, report["submissions_per_update"].get<double>());
        EXPECT_GT(counts["bytes_to_host"]["median"], 0) << tool;
        EXPECT_EQ(counts["rays_changed"]["all"].get<double>(), report["rays_changed"].get<double>()) << tool;
        EXPECT_EQ(report["swept"], tool.contains("swept"));
        EXPECT_EQ(report["bad_edges"], 0) << tool;
    }
}

// The script that fills bench/results, from its first command to the one file that it writes.
TEST_F(CardCommand, RecordOfAGpuRunsToItsEndWithTheProgramAlone) {
    const auto outcome =
        on_card("BURIN_PROGRAM=" + std::string(kBurinCommand) + " '" + kBenchRecord + "' gpu --small --into .");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    ASSERT_EQ(at_.files(), 1u) << outcome.output;
    const std::string name = std::filesystem::directory_iterator(at_ / ".")->path().filename().string();
    EXPECT_TRUE(name.starts_with("gpu-") && name.ends_with(".json")) << name;
    const Json record = written(name);
    for (const char* key : {"device", "driver", "machine", "program"}) EXPECT_TRUE(record[key].is_string()) << key;
    EXPECT_EQ(record["small"], true);
    EXPECT_EQ(record["engines"]["all"]["ends_that_differ"], 0);
    EXPECT_EQ(record["strokes"].size(), 30u) << "five tools, stamped, swept and smoothing, by two engines";
    for (const Json& stroke : record["strokes"])
        EXPECT_EQ(stroke["counts_per_update"].is_null(), stroke["engine"] == "cpu");
    EXPECT_EQ(record["commands"].size(), 34u);
    EXPECT_FALSE(record["frame"].is_null());
    ASSERT_EQ(record["profile"].size(), 2u);
    const Json &carved = record["profile"][0]["runs"][0], &by_processor = record["profile"][1]["runs"][0];
    EXPECT_EQ(carved["engine"]["name"], "vulkan");
    EXPECT_GT(carved["engine"]["traffic"]["submissions"], 0);
    EXPECT_GT(carved["engine"]["rays_changed"], 0);
    EXPECT_GT(carved["picture"]["bytes_to_device"], 0);
    EXPECT_EQ(by_processor["engine"]["name"], "cpu");
    EXPECT_FALSE(by_processor["engine"].contains("traffic"));
    EXPECT_TRUE(outcome.output.contains("asked of the device")) << outcome.output;
    EXPECT_TRUE(outcome.output.contains("the worst first")) << outcome.output;
    EXPECT_TRUE(record["failed"].empty());
}

}  // namespace burin::bench
