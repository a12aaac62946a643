// SPDX-License-Identifier: MIT
// A participant's visit in a live session, whose hand is a written log's mouse: from the start cap to the end cap.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/text.hpp"
#include "gpu/device.hpp"
#include "study/protocol/protocol.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

const std::string kLiveStudy = std::string(kBurinCommand) + " study ";

// The thesis' study with one trial and no training.
std::string one_trial_protocol() {
    std::string text{study::known_protocol("kinesthetic-path").value()};
    const std::size_t stages = text.find("stages = [\"introduction\"");
    text.replace(stages, text.find('\n', stages) - stages, "stages = [\"test\"]");
    return text;
}

// Writes the log of a desk whose mouse and wheel lead the middle of the simulated wand, in a window of 1280 by 720
// pixels, evenly through places of the world.
class DeskLog {
public:
    DeskLog() { text_ << "burin-input 1 a visit\n0.1 mouse 640 360\n0.15 command toggle-panel\n"; }

    void go(const Vec3& to_m, int steps) {
        const Vec3 from_m = at_m_;
        for (int i = 1; i <= steps; ++i) {
            const Vec3 next_m = from_m + (static_cast<double>(i) / steps) * (to_m - from_m);
            time_s_ += 0.05;
            // A pixel moves the hand as far as its picture, and so farther the deeper it is.
            const double m_per_px = 0.001053 - 0.00126 * at_m_.z;
            mouse_px_ += Vec2(next_m.x - at_m_.x, at_m_.y - next_m.y) / m_per_px;
            text_ << formatted("%.3f mouse %.2f %.2f\n", time_s_, mouse_px_.x, mouse_px_.y);
            if (next_m.z != at_m_.z)
                text_ << formatted("%.3f scroll 0 %.5f\n", time_s_, (at_m_.z - next_m.z) / kWheelStep_m);
            at_m_ = next_m;
        }
    }
    void wait(double seconds) { time_s_ += seconds; }
    void say(const std::string& act) { text_ << formatted("%.3f command do %s\n", time_s_, act.c_str()); }
    void command(const std::string& words) { text_ << formatted("%.3f command %s\n", time_s_, words.c_str()); }
    [[nodiscard]] double time_s() const { return time_s_; }
    [[nodiscard]] std::string closed() const { return text_.str() + formatted("%.3f close\n", time_s_ + 0.5); }

private:
    static constexpr double kWheelStep_m = 0.012;
    std::ostringstream text_;
    double time_s_ = 0.3;
    Vec2 mouse_px_{640.0, 360.0};
    Vec3 at_m_{0.0, 0.21, 0.2345};  // where the wand rests
};

const Vec3 kInStartCap{-0.175, 0.165, 0.11}, kInEndCap{0.18, 0.165, 0.11};

void go_through(DeskLog& log) {
    const study::Protocol protocol = study::parse_protocol(one_trial_protocol()).protocol;
    for (const Vec3& place : protocol.worlds.at(0).spine_m) log.go(place, 2);
    log.go(kInEndCap, 4);
}

void make_live_study(const Workplace& place) {
    place.write("p.toml", one_trial_protocol());
    ASSERT_EQ(place.run(kLiveStudy + "init p.toml s --participants 2 --seed 3").status, 0);
    ASSERT_EQ(place.run(kLiveStudy + "enrol s p01").status, 0);
}

Workplace::Outcome visit(const Workplace& place, const DeskLog& log) {
    place.write("visit.txt", log.closed());
    return place.run(kLiveStudy + "run s --participant p01 --input visit.txt --offscreen");
}

// The columns of the visit's recording, by name.
std::map<std::string, std::vector<double>> recorded_ticks(const Workplace& place) {
    EXPECT_EQ(place.run(std::string(kBurinCommand) + " convert s/data/p01/day1-01-run1.session t.csv --to csv").status,
              0);
    std::istringstream lines(place.read("t.csv"));
    std::vector<std::string> names;
    std::map<std::string, std::vector<double>> columns;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with('#')) continue;
        const bool is_header = names.empty();
        std::istringstream fields(line);
        std::size_t i = 0;
        for (std::string field; std::getline(fields, field, ',');) {
            if (is_header)
                names.push_back(field);
            else
                columns[names.at(i++)].push_back(std::strtod(field.c_str(), nullptr));
        }
    }
    return columns;
}

}  // namespace

TEST(LiveStudy, CountsATrialFromTheStartCapToTheEndCapInJournalAndRecord) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace place;
    make_live_study(place);
    DeskLog log;
    log.go({-0.22, 0.165, 0.2345}, 20);  // beside the world, then in from behind the start cap
    log.go({-0.22, 0.165, 0.11}, 20);
    log.say("start");
    log.wait(0.1);
    log.go(kInStartCap, 10);
    log.wait(0.3);
    const double leaves_s = log.time_s();
    go_through(log);
    const double way_s = log.time_s() - leaves_s;
    const auto went = visit(place, log);
    ASSERT_EQ(went.status, 0) << went.output;
    EXPECT_TRUE(went.output.contains("1 stages ended; 0 of the day are left")) << went.output;
    EXPECT_TRUE(went.output.contains("trials.csv: 1 trials")) << went.output;
    EXPECT_TRUE(place.read("s/journal.jsonl").contains("\"stage\":\"test\",\"result\":\"valid exit\""));
    const Json record = Json::parse(place.read("s/data/p01/day1-01-run1.json"));
    EXPECT_NEAR(record.at("time_s").get<double>(), way_s, 1.0);
    EXPECT_LT(record.at("from_axis_mean_mm").get<double>(), 15.0);
    EXPECT_EQ(record.at("failed_attempts"), 0);
    EXPECT_EQ(record.at("deviations_differ"), 0);
    const auto replayed = place.run(kLiveStudy + "replay s");
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_EQ(place.run(kLiveStudy + "check s").status, 0);
}

// A trial's figures are the hand's: a wand that is read four times less often has the same, all from time stamps.
TEST(LiveStudy, FiguresOfATrialAreTheSameWhateverTheWandsRate) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const study::Protocol protocol = study::parse_protocol(one_trial_protocol()).protocol;
    const auto& spine_m = protocol.worlds.at(0).spine_m;
    DeskLog log;
    log.go({-0.22, 0.165, 0.2345}, 20);
    log.go({-0.22, 0.165, 0.11}, 20);
    log.say("start");
    log.wait(0.1);
    log.go(kInStartCap, 10);
    log.wait(0.3);
    // Too high in the middle, so that the upper point goes out of the tube's wall for a while.
    for (std::size_t i = 0; i < spine_m.size(); ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(spine_m.size() - 1);
        log.go(spine_m[i] + Vec3(0.0, 0.03 * std::sin(std::numbers::pi * share), 0.0), 2);
    }
    log.go(kInEndCap, 4);
    const auto figures_at = [&](int rate_Hz) {
        const Workplace place;
        make_live_study(place);
        place.write("w.toml", formatted("name = \"Wand at %d Hz\"\nrate = %d\n[[point]]\nname = \"top\"\noffset = "
                                        "[0, 0.03, 0]\n[[point]]\nname = \"bottom\"\noffset = [0, -0.03, 0]\n",
                                        rate_Hz, rate_Hz));
        place.write("visit.txt", log.closed());
        const auto went = place.run(
            kLiveStudy + "run s --participant p01 --input visit.txt --offscreen --device simulated-wand:w.toml");
        EXPECT_TRUE(went.output.contains("trials.csv: 1 trials")) << went.output;
        return Json::parse(place.read("s/data/p01/day1-01-run1.json"));
    };
    const Json usual = figures_at(1000);
    ASSERT_GT(usual.at("contact_s").get<double>(), 0.5);
    ASSERT_TRUE(usual.at("ldlj").is_number() && usual.at("sparc").is_number());
    for (const int rate_Hz : {250, 500, 2000}) {
        const Json figures = figures_at(rate_Hz);
        for (const auto& [name, value] : usual.items()) {
            const double wanted = value.get<double>();
            // A hundredth of a millimetre is nothing for an encoder of 0.05 mm.
            const double least = name.ends_with("_mm") ? 0.01 : 0.0;
            EXPECT_NEAR(figures.at(name).get<double>(), wanted, std::max(least, 0.01 * std::abs(wanted)))
                << name << " at " << rate_Hz;
        }
    }
}

// Nobody can feel a path without force: such an attempt counted, since a live tick did not say that there was none.
TEST(LiveStudy, CountsNoAttemptInWhichTheAmplifiersWereOff) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace place;
    make_live_study(place);
    DeskLog log;
    log.go({-0.22, 0.165, 0.2345}, 20);
    log.go({-0.22, 0.165, 0.11}, 20);
    log.say("start");
    log.wait(0.1);
    log.go(kInStartCap, 10);
    log.wait(0.3);
    const study::Protocol protocol = study::parse_protocol(one_trial_protocol()).protocol;
    const auto& spine_m = protocol.worlds.at(0).spine_m;
    for (std::size_t i = 0; i < spine_m.size(); ++i) {
        log.go(spine_m[i], 2);
        if (i == spine_m.size() / 2) log.command("amplifiers off");
    }
    log.go(kInEndCap, 4);
    const auto went = visit(place, log);
    EXPECT_FALSE(went.output.contains("valid exit")) << went.output;
    const std::string told =
        place.run(std::string(kBurinCommand) + " convert s/data/p01/day1-01-run1.session - --to log").output;
    EXPECT_TRUE(told.contains("amplifiers off")) << told.substr(told.size() - std::min<std::size_t>(told.size(), 2000));
    EXPECT_EQ(place.run(kLiveStudy + "replay s").status, 0);
}

// What is seen and felt in a stage is the protocol's: a script's command changed it, and the journal said nothing.
TEST(LiveStudy, KeepsItsWorldWhateverIsSaid) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace place;
    make_live_study(place);
    const auto shown = [&](const std::string& name, const std::vector<std::string>& commands) {
        DeskLog log;
        log.say("start");
        log.wait(0.5);
        for (const std::string& command : commands) log.command(command);
        log.wait(0.5);
        log.command("screenshot " + name + ".png");
        place.write(name + ".txt", log.closed());
        return place.run(kLiveStudy + "run s --participant p01 --resume --input " + name +
                         ".txt --offscreen --outputs .");
    };
    ASSERT_EQ(shown("as-it-is", {}).status, 0);
    for (const std::string command :
         {"object \"seen tube\" seen on", "object tube felt off", "tool ball:0.01", "radius 1"}) {
        const auto outcome = shown("changed", {command});
        EXPECT_EQ(outcome.status, 1) << command << "\n" << outcome.output;
        EXPECT_TRUE(outcome.output.contains("stay as they are")) << command << "\n" << outcome.output;
        EXPECT_TRUE(place.read("as-it-is.png") == place.read("changed.png")) << command;
    }
}

// Everything that the participant's hand, the operator and the threads did is in the file, and the protocol is.
TEST(LiveStudy, ItsRecordingIsDoneAgainToTheBitAndHoldsTheTrial) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace place;
    make_live_study(place);
    DeskLog log;
    log.go({-0.22, 0.165, 0.2345}, 20);
    log.go({-0.22, 0.165, 0.11}, 20);
    log.say("start");
    log.wait(0.1);
    log.go(kInStartCap, 10);
    log.wait(0.3);
    go_through(log);
    place.write("visit.txt", log.closed());
    const auto went =
        place.run(kLiveStudy + "run s --participant p01 --input visit.txt --offscreen --record r.session");
    ASSERT_EQ(went.status, 0) << went.output;
    const auto replayed = place.run(std::string(kBurinCommand) + " replay r.session");
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_TRUE(replayed.output.contains("equal to the bit")) << replayed.output;
    const std::string told = place.run(std::string(kBurinCommand) + " session info r.session --json -").output;
    const Json info = Json::parse(told, nullptr, false);
    ASSERT_TRUE(info.is_object()) << told;
    ASSERT_EQ(info.at("trials").size(), 1u) << told;
    EXPECT_EQ(info.at("trials").at(0).at("name"), "test");
    EXPECT_EQ(info.at("trials").at(0).at("state"), "done");
    // The stage's own recording has the same forces for the same ticks.
    ASSERT_EQ(place
                  .run(std::string(kBurinCommand) +
                       " convert r.session trial.csv --to csv --trials test --columns tick,commanded_force_device_x_N")
                  .status,
              0);
    std::istringstream trial(place.read("trial.csv"));
    std::map<std::string, std::string> session_force;
    for (std::string line; std::getline(trial, line);)
        if (const std::size_t comma = line.find(','); comma != std::string::npos)
            session_force[line.substr(0, comma)] = line.substr(comma + 1);
    EXPECT_GT(session_force.size(), 1000u);
    const auto stage = recorded_ticks(place);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < stage.at("tick").size(); ++i) {
        const auto same = session_force.find(formatted("%.0f", stage.at("tick")[i]));
        if (same == session_force.end()) continue;
        ++compared;
        ASSERT_EQ(std::strtod(same->second.c_str(), nullptr), stage.at("commanded_force_device_x_N")[i]);
    }
    EXPECT_GT(compared, 1000u);
}

TEST(LiveStudy, FreesAWandThatCameIntoTheStartCapThroughTheFunnelsWall) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace place;
    make_live_study(place);
    DeskLog log;
    log.go({kInStartCap.x, kInStartCap.y, 0.2345}, 20);
    log.say("start");
    log.wait(0.1);
    log.go({kInStartCap.x, kInStartCap.y, 0.15}, 20);  // against the funnel from its side, and on
    log.go(kInStartCap, 10);
    log.wait(1.0);
    const auto went = visit(place, log);
    ASSERT_EQ(went.status, 0) << went.output;
    const auto ticks = recorded_ticks(place);
    const std::vector<double>& z_m = ticks.at("position_device_z_m");
    const auto force_N = [&](std::size_t i) {
        return glm::length(Vec3(ticks.at("commanded_force_device_x_N")[i], ticks.at("commanded_force_device_y_N")[i],
                                ticks.at("commanded_force_device_z_N")[i]));
    };
    // Both points are in the cap from 0.178 m on; the funnel's wall is 1 to 2 cm before that, and the cap's touch a few
    // frames old at 0.157 m. A wand whose proxies stay outside is pushed with the 2 N of the limit there.
    constexpr double kDeeper_m = 0.157 - 0.01;  // the device's middle is at 0.01 m
    double largest_N = 0.0;
    std::size_t i = 0;
    for (; i < z_m.size() && z_m[i] > kDeeper_m; ++i) largest_N = std::max(largest_N, force_N(i));
    ASSERT_LT(i, z_m.size());
    EXPECT_GT(largest_N, 0.5) << "the funnel was felt from its side";
    EXPECT_EQ(force_N(i), 0.0) << "both proxies are on the axis, on the hand's side of the funnel";
}

TEST(LiveStudy, StandsStillWhereTheWandReadsFartherOffInItsJigThanAllowed) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace place;
    make_live_study(place);
    DeskLog log;
    log.go({-0.22, 0.165, 0.2345}, 10);
    log.say("start");
    log.wait(0.2);
    log.say("jig");  // the hand does not reach the jig, which is below the workspace
    log.wait(0.2);
    log.say("go-on");
    log.go({-0.22, 0.165, 0.11}, 20);
    log.go(kInStartCap, 10);
    go_through(log);
    const auto went = visit(place, log);
    for (const char* part : {"STAGE STOPPED: in its jig the wand reads", "2.0 mm and 2.00 degrees are allowed",
                             "put it into the jig", "do go-on: the wand read", "0 stages ended; 1 of the day are left"})
        EXPECT_TRUE(went.output.contains(part)) << part << "\n" << went.output;
    const std::string journal = place.read("s/journal.jsonl");
    EXPECT_TRUE(journal.contains("in the jig the wand reads")) << journal;
    EXPECT_FALSE(journal.contains("stage ended")) << journal;
}

// The journal said "simulated wand" of every wand, and took a mouse for a person's device.
TEST(LiveStudy, TellsTheDeviceThatWasHeldInJournalTableAndRecording) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    DeskLog log;
    log.say("start");
    log.wait(0.5);
    log.say("stop");
    for (const std::string device : {"simulated-wand", "mouse"}) {
        const Workplace place;
        make_live_study(place);
        ASSERT_EQ(place.run(kLiveStudy + "enrol s p02").status, 0);
        place.write("visit.txt", log.closed());
        // One of the two is in the group that sees, which may have a device without force.
        const auto by = [&](const std::string& id) {
            return place.run(kLiveStudy + "run s --participant " + id + " --input visit.txt --offscreen --device " +
                             device);
        };
        const std::string id = by("p01").status == 0 ? "p01" : "p02";
        if (id == "p02") {
            ASSERT_EQ(by(id).status, 0);
        }
        EXPECT_TRUE(
            place.read("s/journal.jsonl")
                .contains("\"device\":\"" + device + "\",\"hand\":\"simulated device\",\"felt_by_person\":false"));
        EXPECT_TRUE(place.read("s/trials.csv").contains(",simulated device\n")) << place.read("s/trials.csv");
        const std::string facts =
            place.run(std::string(kBurinCommand) + " convert s/data/" + id + "/day1-01-run1.session - --to log").output;
        for (const std::string& fact : {"# device: " + device, std::string("# hand: simulated device"),
                                        std::string("# felt by a person: no"), std::string("# version: ")})
            EXPECT_TRUE(facts.contains(fact)) << facts.substr(0, 2000);
    }
}

}  // namespace burin::app
