// SPDX-License-Identifier: MIT
// A hand among rigid things by the command line: scripted, in a glove at the far end of a line, and when that is
// pulled.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "gpu/device.hpp"
#include "tests/app/real_time.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

class HandSessions : public testing::Test {
protected:
    void SetUp() override {
        if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    }
    // burin hand in the world that comes with it, with a script that does too; that means a window of its size.
    [[nodiscard]] std::string hand(const std::string& script) const {
        const std::string sessions = kSessionsFolder;
        return std::string(kBurinCommand) + " hand " + sessions + "/../worlds/hand.toml --input " + sessions +
               "/hand-" + script + ".txt --outputs out";
    }
    // The same as a user has it, who names neither: both come from the folder of the repository.
    [[nodiscard]] std::string grasp(const std::string& how) const {
        return "cd " + std::string(kSessionsFolder) + "/../.. && " + kBurinCommand + " hand --grasp " + how +
               " --offscreen --outputs " + (at / "out").string();
    }
    // The emulated glove ends by itself, whatever becomes of the session.
    [[nodiscard]] std::string with_glove(const std::string& options, const std::string& command) const {
        return "(" + std::string(kBurinCommand) + " glove emulate --seconds 40 " + options +
               " > port.txt &) ; while ! test -s port.txt; do sleep 0.05; done; " + command +
               " --offscreen --device glove:$(cat port.txt)";
    }
    // What the recording h.session holds of the longest time without sets.
    struct PulledLine {
        std::size_t ticks = 0, with_force = 0, unlike = 0;
        bool is_back = false;
        double before_N = 0.0, after_N = 0.0;  // the largest commanded force, in the grasp before and ever after
    };
    [[nodiscard]] PulledLine pulled_line() const;
    const Workplace at;
};

// The columns of a table, by their names.
std::map<std::string, std::vector<double>> table_of(const std::string& text) {
    std::istringstream lines(text);
    std::string line, word;
    std::getline(lines, line);
    std::vector<std::string> names;
    for (std::istringstream words(line); std::getline(words, word, ',');) names.push_back(word);
    std::map<std::string, std::vector<double>> table;
    while (std::getline(lines, line)) {
        std::istringstream words(line);
        for (std::size_t i = 0; std::getline(words, word, ',') && i < names.size(); ++i)
            table[names[i]].push_back(std::strtod(word.c_str(), nullptr));
    }
    return table;
}

HandSessions::PulledLine HandSessions::pulled_line() const {
    constexpr std::array<const char*, 4> kNames{"thumb", "index", "middle", "ring"};
    std::array<std::map<std::string, std::vector<double>>, 4> parts;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::string file = std::string(kNames[i]) + ".csv";
        std::filesystem::remove(at / file);
        const auto done =
            at.run(std::string(kBurinCommand) + " convert h.session " + file + " --to csv --part " + kNames[i]);
        if (done.status != 0) return {};
        parts[i] = table_of(at.read(file));
        if (parts[i]["fault"].size() != parts[0]["fault"].size()) return {};
    }
    // The longest of all: a machine that is busy may let the line wait at other times as well.
    const std::vector<double>& fault = parts[0]["fault"];
    std::size_t pulled = 0, back = 0;
    for (std::size_t tick = 0; tick < fault.size();) {
        std::size_t end = tick;
        while (end < fault.size() && (fault[end] != 0.0) == (fault[tick] != 0.0)) ++end;
        if (fault[tick] != 0.0 && end - tick > back - pulled) pulled = tick, back = end;
        tick = end;
    }
    // The fingers close three seconds before it is pulled. Where the line was late at the end of that the force is
    // still on its way back from zero.
    constexpr std::size_t kGrasps = 2500;
    PulledLine line{.ticks = back - pulled, .is_back = back < fault.size()};
    for (std::size_t tick = 0; tick < fault.size(); ++tick)
        for (auto& part : parts) {
            double force_N = 0.0;
            for (const char* axis : {"x", "y", "z"})
                force_N += std::abs(part[std::string("commanded_force_device_") + axis + "_N"][tick]);
            line.unlike += (part["fault"][tick] != 0.0) != (fault[tick] != 0.0) ? 1 : 0;
            line.with_force += fault[tick] != 0.0 && force_N != 0.0 ? 1 : 0;
            if (tick < pulled && tick + kGrasps >= pulled) line.before_N = std::max(line.before_N, force_N);
            if (tick > back) line.after_N = std::max(line.after_N, force_N);
        }
    return line;
}

}  // namespace

TEST_F(HandSessions, G10GraspsAndCarriesABall) {
    const auto whole = at.run(grasp("whole"));
    EXPECT_EQ(whole.status, 0) << whole.output;
    EXPECT_TRUE(whole.output.contains("\ngrasped ball, carried ")) << whole.output;
    EXPECT_FALSE(whole.output.contains("carried 0 mm")) << whole.output;
    EXPECT_TRUE(whole.output.contains(", held for ")) << whole.output;
    EXPECT_FALSE(whole.output.contains("grasped table")) << whole.output;
}

TEST_F(HandSessions, G10PinchesACardAndPointsAtABall) {
    const auto pinch = at.run(grasp("pinch"));
    EXPECT_EQ(pinch.status, 0) << pinch.output;
    EXPECT_TRUE(pinch.output.contains("\npinched card, carried ")) << pinch.output;
    const auto point = at.run(grasp("point"));
    EXPECT_EQ(point.status, 0) << point.output;
    EXPECT_TRUE(point.output.contains("the hand points at ball")) << point.output;
    EXPECT_TRUE(point.output.contains("nothing was grasped")) << point.output;
}

TEST_F(HandSessions, GraspsInAGloveAndIsDoneAgainToTheBitWithoutIt) {
    Workplace::Outcome recorded;
    // On a machine that is late the line falls silent at times, and the ball is then grasped anew where it lies.
    const std::regex carried("\ngrasped ball, carried [1-9]");
    const auto late = kept_from_real_time(at, "h.session", [&] {
        recorded = at.run(with_glove("", hand("glove") + " --record h.session"));
        return std::regex_search(recorded.output, carried) && !pace_of(at, "h.session").is_cut_off;
    });
    if (late) GTEST_SKIP() << *late;
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    EXPECT_TRUE(std::regex_search(recorded.output, carried)) << recorded.output;
    const auto replayed = at.run(std::string(kBurinCommand) + " replay h.session");
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_TRUE(replayed.output.contains("equal to the bit")) << replayed.output;
    EXPECT_TRUE(replayed.output.contains("the hand grasps ball")) << replayed.output;
}

TEST_F(HandSessions, ALineThatIsPulledInMidGraspEndsTheForceInAllPartsAtOnceAndTheSessionGoesOn) {
    // The fingers close from two seconds after the session began until seven; the line is pulled between.
    Workplace::Outcome recorded;
    PulledLine line;
    const auto late = kept_from_real_time(at, "h.session", [&] {
        recorded = at.run(with_glove("--silent-from 5 --silent-for 1", hand("glove") + " --record h.session"));
        line = pulled_line();
        return line.before_N > 0.0 && line.after_N > 0.0 && line.is_back;
    });
    if (late) GTEST_SKIP() << *late;
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    EXPECT_TRUE(recorded.output.contains("the hand grasps ball")) << recorded.output;
    EXPECT_TRUE(recorded.output.contains("the glove is lost")) << recorded.output;
    EXPECT_TRUE(recorded.output.contains("the hand lets go of ball")) << recorded.output;
    EXPECT_TRUE(recorded.output.contains("the glove is back")) << recorded.output;
    EXPECT_GT(line.ticks, 500u) << "the line was pulled for a second";
    EXPECT_TRUE(line.is_back) << "the session goes on, and the line comes back";
    EXPECT_EQ(line.with_force, 0u) << "ticks of a lost line in which a part was given force";
    EXPECT_EQ(line.unlike, 0u) << "ticks in which the line was lost for some parts alone";
    EXPECT_GT(line.before_N, 0.0) << "it was pulled in mid-grasp";
    EXPECT_GT(line.after_N, 0.0) << "force comes back with the line";
}

TEST_F(HandSessions, SaysWhatItTakes) {
    const std::string burin = kBurinCommand;
    const auto stylus = at.run(burin + " hand --device simulated");
    EXPECT_EQ(stylus.status, 1);
    EXPECT_TRUE(stylus.output.contains("is no glove")) << stylus.output;
    const auto both = at.run(burin + " hand --grasp whole --device glove:/dev/ttyUSB0");
    EXPECT_EQ(both.status, 1);
    EXPECT_TRUE(both.output.contains("--device names glove:/dev/ttyUSB0")) << both.output;
    EXPECT_EQ(at.run(burin + " hand --points 6").status, 2);
    const auto twice = at.run(burin + " hand --grasp whole --input hand.txt");
    EXPECT_EQ(twice.status, 1);
    EXPECT_TRUE(twice.output.contains("--input names another")) << twice.output;
    const auto local = at.run(burin + " hand --rendering local");
    EXPECT_EQ(local.status, 1);
    EXPECT_TRUE(local.output.contains("needs a glove's controller")) << local.output;
    const auto motion = at.run(burin + " glove emulate --motion foo");
    EXPECT_EQ(motion.status, 2);
    EXPECT_TRUE(motion.output.contains("'foo' is none of: closing, still")) << motion.output;
    const auto silent = at.run(burin + " glove emulate --silent-for 1");
    EXPECT_EQ(silent.status, 1);
    EXPECT_TRUE(silent.output.contains("give --silent-from too")) << silent.output;
    const auto shape = at.run(hand("whole") + " --offscreen --device simulated-glove:claw");
    EXPECT_EQ(shape.status, 1);
    EXPECT_TRUE(shape.output.contains("whole, pinch, point")) << shape.output;
}

}  // namespace burin::app
