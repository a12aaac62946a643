// SPDX-License-Identifier: MIT
// A stage's recording as a data set of BIDS, before the specification's own validator.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "base/json.hpp"
#include "tests/study/lost_study.hpp"

namespace burin::study {
namespace {

// BIDS_VALIDATOR names the program where it is not on the path.
std::string validator(const Workplace& place) {
    const char* named = std::getenv("BIDS_VALIDATOR");
    const std::string program = named != nullptr ? named : "bids-validator";
    return place.run("'" + program + "' --version").status == 0 ? "'" + program + "'" : "";
}

void convert_visit(const Workplace& place) {
    make_lost_study(place, {"\"test\""});
    LostVisit visit;
    ASSERT_EQ(
        visit_by(place, "p02", visit.say("start").come("arc").say("note takes a breath").goes_back(1).through()).status,
        0);
    ASSERT_EQ(place
                  .run(std::string(kBurinCommand) +
                       " convert s/data/p02/day1-01-run1.session set --to bids --subject 02 --task test")
                  .status,
              0);
}

}  // namespace

TEST(StudyBids, TellsTheGroupTheProgramAndWhatWasHeld) {
    const Workplace place;
    convert_visit(place);
    EXPECT_EQ(place.read("set/participants.tsv"), "participant_id\tgroup\nsub-02\ttouch\n");
    EXPECT_TRUE(Json::parse(place.read("set/participants.json")).contains("group"));
    const std::string begin = "set/sub-02/motion/sub-02_task-test_tracksys-hand_";
    const Json motion = Json::parse(place.read(begin + "motion.json"));
    const std::string version = place.run(std::string(kBurinCommand) + " --version").output;
    EXPECT_TRUE(version.contains(motion.at("SoftwareVersions").get<std::string>().substr(6))) << motion.dump();
    EXPECT_EQ(motion.at("ManufacturersModelName"), "simulated wand, scripted hand");
    const std::string events = place.read(begin + "events.tsv");
    EXPECT_TRUE(events.starts_with("onset\tduration\ttrial_type\tvalue\tstate\n")) << events;
    EXPECT_TRUE(events.contains("\t0\tnote\ttakes a breath\tn/a\n")) << events;
    EXPECT_TRUE(events.contains("\t0\tattempt failed\twent back\tn/a\n")) << events;
    EXPECT_TRUE(events.contains("\ttest\tn/a\tdone\n")) << events;
}

TEST(StudyBids, PassesTheValidatorWithoutAnError) {
    const Workplace place;
    const std::string program = validator(place);
    if (program.empty()) GTEST_SKIP() << "bids-validator is not installed: npm install bids-validator@1.15";
    convert_visit(place);
    // Its own warnings come before the report.
    const std::string said = place.run(program + " --json set").output;
    const std::size_t begin = std::min(said.find("{\""), said.size()), end = said.rfind('}');
    const Json found = Json::parse(said.substr(begin, end == std::string::npos ? 0 : end + 1 - begin), nullptr, false);
    ASSERT_TRUE(found.is_object()) << said;
    EXPECT_TRUE(found.at("issues").at("errors").empty()) << found.at("issues").at("errors").dump(2);
}

}  // namespace burin::study
