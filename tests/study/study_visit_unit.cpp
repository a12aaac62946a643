// SPDX-License-Identifier: MIT
// How one participant is taken through: which options go with a script, with a live session and with learners.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "study/people/recorded_trial.hpp"
#include "study/protocol/protocol.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::study {
namespace {

const std::string kVisitStudy = std::string(kBurinCommand) + " study ";
const std::string kStandingHand = "burin-study-input 1\n0 hand -0.175 0.165 0.11\n0.1 start\n0.2 stop\n";

void make_visited(const Workplace& place) {
    ASSERT_EQ(place.run(kVisitStudy + "init kinesthetic-path s --participants 2 --seed 3").status, 0);
    ASSERT_EQ(place.run(kVisitStudy + "enrol s p01").status, 0);
    place.write("hand.txt", kStandingHand);
}

}  // namespace

TEST(StudyVisits, RefuseEachOptionThatAScriptWouldNotHeed) {
    const Workplace place;
    make_visited(place);
    const std::string journal = place.read("s/journal.jsonl");
    for (const auto& [name, value] :
         {std::pair{"--live", ""}, std::pair{"--record", " r.session"}, std::pair{"--offscreen", ""},
          std::pair{"--stereo", " side-by-side"}, std::pair{"--swap-eyes", ""}, std::pair{"--wall", " w.toml"},
          std::pair{"--tracker", " udp:5000"}, std::pair{"--device", " simulated-wand"}, std::pair{"--windowed", ""},
          std::pair{"--full-screen", " 0"}, std::pair{"--width", " 1280"}, std::pair{"--height", " 720"},
          std::pair{"--samples", " 1"}, std::pair{"--screenshots", " shots"}, std::pair{"--outputs", " out"},
          std::pair{"--panel-window", ""}, std::pair{"--effect", " 0"}, std::pair{"--threads", " 1"}}) {
        const auto refused =
            place.run(kVisitStudy + "run s --participant p01 --input hand.txt " + name + std::string(value));
        EXPECT_EQ(refused.status, 1) << name;
        EXPECT_TRUE(refused.output.contains(std::string(name) + ": no effect")) << refused.output;
        EXPECT_TRUE(refused.output.contains("; leave it out, or ")) << refused.output;
    }
    const auto two = place.run(kVisitStudy + "run s --participant p01 --input hand.txt --offscreen --device x");
    EXPECT_TRUE(two.output.contains("--offscreen, --device: ")) << two.output;
    EXPECT_EQ(place.read("s/journal.jsonl"), journal);
    EXPECT_EQ(place.run(kVisitStudy + "run s --participant p01 --input hand.txt").status, 0);
}

TEST(StudyVisits, NameEachWordOfAScriptThatHadNoEffectAndFailAtTheEnd) {
    const Workplace place;
    make_visited(place);
    place.write("words.txt", "burin-study-input 1\n0 hand -0.175 0.165 0.11\n0.1 stop\n0.2 start\n0.3 next\n" +
                                 std::string("0.4 go on\n0.5 pause\n0.6 pause\n0.7 go on\n0.8 repeat\n0.911 stop\n"));
    const auto went = place.run(kVisitStudy + "run s --participant p01 --input words.txt");
    EXPECT_EQ(went.status, 1);
    for (const char* part :
         {"words.txt:3: stop had no effect: no stage", "words.txt:5: next had no effect: this stage ends by itself",
          "words.txt:6: go on had no effect: the stage is not paused", "words.txt:8: pause had no effect",
          "words.txt:10: repeat had no effect", "introduction ended by stop", "5 of its words had no effect"})
        EXPECT_TRUE(went.output.contains(part)) << part << "\n" << went.output;
    // The last line comes between two frames and is said all the same; what comes after the visit's end is not.
    EXPECT_TRUE(place.read("s/journal.jsonl").contains("\"result\":\"stopped\""));
    place.write("late.txt", kStandingHand + "0.3 note too late\n");
    const auto late = place.run(kVisitStudy + "run s --participant p01 --input late.txt");
    EXPECT_EQ(late.status, 1);
    EXPECT_TRUE(late.output.contains("late.txt:5: note too late had no effect: the visit has ended")) << late.output;
}

TEST(StudyVisits, TellWhereTheStartCapIsAlsoOfAWorldThatWasMoved) {
    const Workplace place;
    std::string text{known_protocol("kinesthetic-path").value()};
    const auto replace = [&](const std::string& from, const std::string& behind, const std::string& by) {
        const std::size_t at = text.find(from);
        text.replace(at, text.find(behind, at) + behind.size() - at, by);
    };
    replace("stages = [", "]", "stages = [\"test\"]");
    place.write("p.toml", text);
    const auto stays = place.run(kVisitStudy + "check p.toml");
    EXPECT_TRUE(stays.output.contains("world tube: in the wand's workspace as it stands; the middle of its start cap"))
        << stays.output;
    std::string spine = "spine_m = [";
    const Protocol protocol = parse_protocol(text).protocol;
    for (const Vec3& p : protocol.worlds.at(0).spine_m) spine += formatted("[%.6f, %.6f, %.6f], ", p.x, p.y, p.z + 0.3);
    replace("spine_m = [", "\n]", spine + "]");
    place.write("p.toml", text);
    const auto moved = place.run(kVisitStudy + "check p.toml");
    ASSERT_TRUE(moved.output.contains("world tube: centred in the wand's workspace, as it reaches beyond; moved by "))
        << moved.output;
    ASSERT_EQ(place.run(kVisitStudy + "init p.toml s --participants 2").status, 0);
    ASSERT_EQ(place.run(kVisitStudy + "enrol s p01").status, 0);
    // The hand is elsewhere for long, and then where `check` says.
    const std::size_t at = moved.output.find("start cap is at ") + 16;
    std::string cap = moved.output.substr(at, moved.output.find(" m in the maker's", at) - at);
    std::erase(cap, ',');
    place.write("visit.txt", "burin-study-input 1\n0 hand 0 0.2 0.1\n0.1 start\n11 hand 0 0.2 0.1\n11.5 hand " + cap +
                                 "\n13 hand " + cap + "\n");
    const auto went = place.run(kVisitStudy + "run s --participant p01 --input visit.txt");
    const std::size_t hint = went.output.find("both points must be in the start cap"),
                      touch = went.output.find("start touched");
    ASSERT_NE(hint, std::string::npos) << went.output;
    ASSERT_NE(touch, std::string::npos) << went.output;
    EXPECT_LT(hint, touch);
}

TEST(StudyTrials, SayOfEachParticipantWhetherThereWasAPerson) {
    std::vector<TrialRow> rows;
    for (const auto& [id, hand] : {std::pair{"p1", Hand::learner}, std::pair{"p2", Hand::script},
                                   std::pair{"p3", Hand::device}, std::pair{"p3", Hand::simulated_device}})
        rows.push_back({id, "haptic", "all", "test", 1, 1, Json::object(), hand});
    EXPECT_EQ(
        simulated_fact(rows),
        "2 of 3 participants of these trials are simulated, no person (learners: 1, by a script: 1). 1 of 3 held a "
        "simulated device (mouse, keys or a log).");
    const std::string table = trials_csv(rows);
    for (const char* part : {"# 2 of 3 participants", "stratum,hand\n", ",all,learner\n", ",all,script\n",
                             ",all,device\n", ",all,simulated device\n"})
        EXPECT_TRUE(table.contains(part)) << table;
    rows.erase(rows.begin(), rows.begin() + 2);
    rows.pop_back();
    EXPECT_EQ(simulated_fact(rows), "");
    EXPECT_FALSE(trials_csv(rows).contains("simulated"));
}

TEST(StudyVisits, RefuseALiveSessionsOptionsForLearners) {
    const Workplace place;
    make_visited(place);
    const auto refused = place.run(kVisitStudy + "run s --simulated --offscreen");
    EXPECT_EQ(refused.status, 1);
    EXPECT_TRUE(refused.output.contains("--offscreen: no effect on simulated learners")) << refused.output;
}

TEST(StudyVisits, RefuseTheRecordingOfAnotherVisit) {
    const Workplace place;
    make_visited(place);
    const std::string journal = place.read("s/journal.jsonl");
    place.write("r.log", "burin-input 2 burin sculpt --world s/worlds/tube/world.toml\n0 clock 1 1000000 0.00005 1\n");
    const auto refused = place.run(kVisitStudy + "run s --participant p01 --input r.log --offscreen");
    EXPECT_EQ(refused.status, 1);
    EXPECT_TRUE(refused.output.contains("r.log: is a recording")) << refused.output;
    EXPECT_TRUE(refused.output.contains("burin-input 1")) << refused.output;
    EXPECT_EQ(place.read("s/journal.jsonl"), journal);
}

TEST(StudyVisits, SayInTheHelpWhatAnInputIs) {
    const Workplace place;
    const std::string help = place.run(kVisitStudy + "run --help").output;
    const std::string input = help.substr(std::min(help.find("--input"), help.size()), 400);
    EXPECT_TRUE(input.contains("script of a visit")) << input;
    EXPECT_FALSE(input.contains("A recording, done again")) << input;
    const std::size_t at = std::min(help.find("--device"), help.size());
    const std::string device = help.substr(at, help.find("\n  --", at) - at);
    EXPECT_TRUE(device.contains("not the Omni")) << device;
}

}  // namespace burin::study
