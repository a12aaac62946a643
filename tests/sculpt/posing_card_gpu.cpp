// SPDX-License-Identifier: MIT
// Carving on what poses as a card (tests/tools/vulkan_layer): whatever it lacks and whenever it is lost, the part is
// the processor's to the byte, and the user is told once.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/json.hpp"
#include "gpu/device.hpp"
#include "tests/compute/effort.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posing_device.hpp"
#include "tests/support/run_command.hpp"

namespace burin::sculpt {
namespace {

// A scratch across a ball of 5 cm, with the button up at both ends.
std::string scratch_across_a_ball() {
    std::string text = kStrokeHeader;
    for (int i = 0; i <= 60; ++i) {
        const double x = -0.03 + 0.001 * i, z = std::sqrt(0.0513 * 0.0513 - x * x);
        text += std::to_string(0.02 * i) + "," + std::to_string(x) + ",0.003," + std::to_string(z) + ",0,0,0,1," +
                (i == 0 || i == 60 ? "0" : "1") + "\n";
    }
    return text;
}

class PosingCard : public testing::Test {
protected:
    void SetUp() override {
        const auto devices = gpu::list_devices();
        if (!devices) GTEST_SKIP() << "no Vulkan driver";
        at_.write("s.csv", scratch_across_a_ball());
    }
    // Carves the scratch into `name`.stl and `name`.json, at 64 cells unless `how` says another number.
    Workplace::Outcome sculpt(const std::string& posing, const std::string& name, const std::string& how) const {
        return at_.run(posing + "BURIN_VULKAN_VALIDATION=1 " + kBurinCommand +
                       " sculpt --workpiece ball:0.05 --tool ball:0.004 --stroke s.csv --export " + name +
                       ".stl --report " + name + ".json " + how +
                       (how.contains("--resolution") ? "" : " --resolution 64"));
    }

    // How many devices the layer has seen, which adds a line to this file for each.
    std::size_t devices_in(const std::string& counts) const {
        const std::string lines = at_.read(counts);
        return static_cast<std::size_t>(std::ranges::count(lines, '\n'));
    }
    // Expects the files of two folders to be alike to the byte.
    void expect_same_files(const std::string& one, const std::string& other) const {
        std::size_t files = 0;
        for (const auto& file : std::filesystem::directory_iterator(at_ / one)) {
            const std::string name = file.path().filename().string();
            EXPECT_TRUE(at_.read(one + "/" + name) == at_.read(other + "/" + name)) << name;
            ++files;
        }
        EXPECT_GT(files, 3u);
    }

    Workplace at_;
};

std::size_t times_told(const std::string& output, const std::string& what = "the processor carves instead") {
    std::size_t times = 0;
    for (std::size_t at = 0; (at = output.find(what, at)) != std::string::npos; ++at) ++times;
    return times;
}

}  // namespace

TEST_F(PosingCard, ThatFailsInAnyOfTwelveWaysGivesTheProcessorsPartAndOneMessage) {
    const std::vector<std::string> failures{
        "BURIN_POSE_HIDE=float64",         "BURIN_POSE_HIDE=int64",
        "BURIN_POSE_HIDE=address",         "BURIN_POSE_DEVICE_BYTES=3000000",
        "BURIN_POSE_DEVICE_BYTES=8000000", "BURIN_POSE_DEVICE_BYTES=20000000",
        "BURIN_POSE_HOST_BYTES=1000000",   "BURIN_POSE_LOSE_SUBMIT=1",
        "BURIN_POSE_LOSE_SUBMIT=7",        "BURIN_POSE_LOSE_WAIT=3",
        "BURIN_POSE_LOSE_WAIT=8",          "VK_DRIVER_FILES=/nowhere VK_ICD_FILENAMES=/nowhere"};
    std::size_t tried = 0;  // a command takes ten times as long under a sanitizer, which tries a fifth
    for (const std::string hand : {"rigid", "simulated"}) {
        ASSERT_EQ(sculpt("", "cpu", "--engine cpu --hand " + hand).status, 0);
        for (const std::string& failure : failures)
            for (const std::string engine : {"auto", "vulkan"}) {
                const std::string what = failure + ", " + engine + ", " + hand;
                if (compute::test::kSanitized && tried++ % 5 != 0) continue;
                const auto done = sculpt(posing_as(failure), "card", "--engine " + engine + " --hand " + hand);
                ASSERT_EQ(done.status, 0) << what << "\n" << done.output;
                EXPECT_TRUE(at_.read("card.stl") == at_.read("cpu.stl")) << what;
                const Json report = Json::parse(at_.read("card.json")), &reported = report["engine"];
                // Carving needs little memory of the device; making cells as well is told of where it has too little.
                const bool fits = failure.contains("DEVICE_BYTES"), makes_cells = !failure.ends_with("=3000000");
                const bool is_silent = (fits && makes_cells) || (failure.contains("nowhere") && engine == "auto");
                EXPECT_EQ(reported["name"], fits ? "vulkan" : "cpu") << what;
                EXPECT_EQ(times_told(done.output), fits || is_silent ? 0u : 1u) << what << "\n" << done.output;
                EXPECT_EQ(times_told(done.output, "the processor makes the surface"), fits && !makes_cells ? 1u : 0u)
                    << what << "\n"
                    << done.output;
                EXPECT_EQ(report.contains("notices"), !is_silent) << what;
                EXPECT_FALSE(done.output.contains("Vulkan validation")) << what << "\n" << done.output;
            }
    }
}

TEST_F(PosingCard, FeelsAndRecordsWhatTheProcessorFeelsAndEitherReplaysTheOther) {
    for (const std::string resolution : {"64", "128"}) {
        if (compute::test::kSanitized && resolution == "128") continue;
        for (const std::string engine : {"cpu", "vulkan"}) {
            const auto felt = sculpt(posing_as("BURIN_POSE_COUNTS=counts"), engine,
                                     "--engine " + engine + " --hand simulated --resolution " + resolution +
                                         " --record " + engine + resolution + ".session");
            ASSERT_EQ(felt.status, 0) << felt.output;
            const Json reported = Json::parse(at_.read(engine + ".json"))["engine"];
            EXPECT_EQ(reported["name"], engine);
            ASSERT_EQ(reported.contains("traffic"), engine == "vulkan");
            if (engine == "cpu") continue;
            // The layer counts by itself what goes through it.
            const Json counted = Json::parse(at_.read("counts")), &told = reported["traffic"];
            for (const char* count : {"submissions", "bytes_to_device"})
                EXPECT_EQ(told[count], counted[count]) << count;
            const auto home = told["bytes_to_host"].get<std::uint64_t>(),
                       written = told["bytes_written_to_host"].get<std::uint64_t>();
            EXPECT_EQ(home - written, counted["bytes_to_host"]) << "what shaders write is no copy";
            EXPECT_GT(written, 0u);
            EXPECT_EQ(told["most_memory_bytes"], counted["most_device_bytes"]);
            EXPECT_LE(counted["blocking_waits"], told["blocking_waits"])
                << "a device may be done before it is waited for";
            const std::string session = engine + resolution + ".session";
            const std::string kept = at_.run(std::string(kBurinCommand) + " session info " + session).output;
            EXPECT_TRUE(kept.contains("vulkan: " + told["submissions"].dump() + " submissions, ")) << kept;
            EXPECT_TRUE(kept.contains("at most " + told["most_memory_bytes"].dump() + " bytes of its memory")) << kept;
            const Json made = Json::parse(at_.read(engine + ".json"))["carving"];
            const auto updates = made["updates"].get<std::uint64_t>();
            EXPECT_GT(updates, 50u);
            EXPECT_LE(told["submissions"].get<std::uint64_t>(), updates + 5) << "one an update";
            EXPECT_LE(home, 65'536 * updates);
            std::filesystem::remove(at_ / "counts");
        }
        EXPECT_TRUE(at_.read("cpu.stl") == at_.read("vulkan.stl")) << resolution;
        for (const std::string recorded : {"cpu", "vulkan"})
            for (const std::string again : {"cpu", "vulkan"}) {
                const auto replayed = at_.run(posing_as() + kBurinCommand + " replay " + recorded + resolution +
                                              ".session --set engine=" + again);
                EXPECT_EQ(replayed.status, 0) << replayed.output;
                EXPECT_TRUE(replayed.output.contains("equal to the bit")) << replayed.output;
            }
    }
}

TEST_F(PosingCard, OfALiveSessionWithPicturesIsOneDeviceThatCarvesAndDraws) {
    const std::string live = std::string(kBurinCommand) + " sculpt --input " + kSessionsFolder +
                             "/first-carve.txt --offscreen --workpiece ball:0.05 --resolution 64 ";
    for (const std::string engine : {"cpu", "vulkan"})
        for (const std::string queues : {"1", "2"}) {
            const std::string as = engine + queues;
            const auto done =
                at_.run(posing_as("BURIN_POSE_QUEUES=" + queues + " BURIN_POSE_COUNTS=" + as + ".counts") +
                        "BURIN_VULKAN_VALIDATION=1 " + live + "--engine " + engine + " --outputs " + as);
            ASSERT_EQ(done.status, 0) << done.output;
            EXPECT_FALSE(done.output.contains("Vulkan validation")) << done.output;
            EXPECT_EQ(devices_in(as + ".counts"), 1u) << as;
            const Json counted = Json::parse(at_.read(as + ".counts"));
            EXPECT_EQ(std::to_string(counted["queues"].get<int>()), queues);
            if (engine == "vulkan") {
                EXPECT_GT(counted["dispatches"], 100) << "the device has carved";
            }
        }
    for (const std::string as : {"cpu2", "vulkan1", "vulkan2"}) expect_same_files("cpu1", as);
}

TEST_F(PosingCard, ThatCarvesAStrokeAndTakesItsPicturesIsOneDevice) {
    for (const std::string engine : {"cpu", "vulkan", "auto"}) {
        const auto done = sculpt(posing_as("BURIN_POSE_COUNTS=" + engine + ".counts"), engine,
                                 "--pictures " + engine + " --engine " + engine);
        ASSERT_EQ(done.status, 0) << done.output;
        EXPECT_FALSE(done.output.contains("Vulkan validation")) << done.output;
        EXPECT_EQ(devices_in(engine + ".counts"), 1u) << engine;
        EXPECT_EQ(Json::parse(at_.read(engine + ".json"))["engine"]["name"], engine == "cpu" ? "cpu" : "vulkan");
    }
    ASSERT_EQ(sculpt(posing_as("BURIN_POSE_COUNTS=none.counts"), "none", "--engine cpu").status, 0);
    EXPECT_EQ(devices_in("none.counts"), 0u) << "nobody needs one";
    expect_same_files("cpu", "vulkan");
    expect_same_files("cpu", "auto");
}

// What was lost carves on another device, whichever of the two that use it meets the loss first.
TEST_F(PosingCard, LostInTheMidstOfALiveSessionLosesNothingOfItAndComesBack) {
    const std::string live = std::string(kBurinCommand) + " sculpt --input " + kSessionsFolder +
                             "/first-carve.txt --offscreen --workpiece ball:0.05 --resolution 64 ";
    ASSERT_EQ(at_.run(posing_as() + live + "--engine cpu --outputs cpu").status, 0);
    const std::vector<std::string> failures{"BURIN_POSE_LOSE_SUBMIT=40 BURIN_POSE_LOSE_DEVICES=1",
                                            "BURIN_POSE_LOSE_WAIT=60 BURIN_POSE_LOSE_DEVICES=1",
                                            "BURIN_POSE_LOSE_SUBMIT=20"};  // the last loses every device that is opened
    for (const std::string& failure : failures) {
        const bool loses_one = failure.contains("DEVICES");
        const auto done = at_.run(posing_as(failure + " BURIN_POSE_COUNTS=counts") + "BURIN_VULKAN_VALIDATION=1 " +
                                  live + "--engine vulkan --outputs card");
        ASSERT_EQ(done.status, 0) << done.output;
        EXPECT_FALSE(done.output.contains("Vulkan validation")) << done.output;
        EXPECT_TRUE(at_.read("card/first-carve.stl") == at_.read("cpu/first-carve.stl")) << failure;
        const std::size_t losses = times_told(done.output), returns = times_told(done.output, "carves again");
        EXPECT_TRUE(loses_one ? losses == 1 && returns == 1 : losses > 1 && losses <= 3) << done.output;
        EXPECT_TRUE(loses_one ? devices_in("counts") == 2 : devices_in("counts") > 2) << done.output;
        std::filesystem::remove_all(at_ / "card");
        std::filesystem::remove(at_ / "counts");
    }
}

}  // namespace burin::sculpt
