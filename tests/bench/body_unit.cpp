// SPDX-License-Identifier: MIT
// burin bench body: its trials at small counts, against what they must keep whatever the count, and its command.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/json.hpp"
#include "bench/body/body_bench.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::bench {

TEST(BodyBench, HoldsPuttyStillWhileThePapersModelCreeps) {
    const StillPutty still = hold_putty(3.0);
    EXPECT_GT(still.early_dent_m, 0.005);
    EXPECT_NEAR(still.late_dent_m / still.early_dent_m, 1.0, 0.001);
    EXPECT_GT(still.paper_late_m3, 1.5 * still.paper_early_m3);
}

TEST(BodyBench, KneadsPuttyWithinItsVolume) {
    const KneadedPutty kneaded = knead_putty(8);
    EXPECT_NEAR(kneaded.volume_share, 1.0, 0.01);
    EXPECT_NEAR(kneaded.enclosed_share, 1.0, 0.03);
    EXPECT_EQ(kneaded.inverted, 0u);
    EXPECT_GT(kneaded.least_share, 0.5);
    EXPECT_LT(knead_putty(0).worst_rest_quality, 0.6) << "the mesh's own";
}

TEST(BodyBench, GivesNoMoreThanTheDevicesLimitWhateverIsAsked) {
    const RandomGrasps grasps = grasp_at_random(15);
    EXPECT_EQ(grasps.not_finite, 0u);
    EXPECT_GT(grasps.most_asked_N, grasps.limit_N) << "else the limit is not tried";
    EXPECT_LE(grasps.most_given_N, grasps.limit_N * (1.0 + 1e-12));
    EXPECT_EQ(grasps.inverted_after, 0u);
}

TEST(BodyBench, SqueezesABallUntilFingersMeetAndLetsItComeBack) {
    const auto meeting = squeeze_until_they_meet();
    ASSERT_EQ(meeting.size(), 6u);
    EXPECT_EQ(meeting[4].share, 1.0);
    for (const MeetingFingers& at : meeting) EXPECT_TRUE(std::isfinite(at.force_N));
    EXPECT_GT(meeting[2].force_N, meeting[1].force_N);
    EXPECT_NEAR(meeting.back().volume_share, 1.0, 0.001);
    EXPECT_GT(meeting.back().least_share, 0.0) << "none stays inside out";
}

TEST(BodyBench, PrintsItsFiguresBesideTheirReferences) {
    const Workplace at;
    const auto done = at.run(std::string(kBurinCommand) +
                             " bench body --along-radius 3 --still 1.5 --kneads 2 --grasps 3 --json b.json --svg f.svg "
                             "--dents d.svg");
    ASSERT_EQ(done.status, 0) << done.output;
    const Json json = Json::parse(at.read("b.json"));
    for (const char* key : {"squeezes", "sweeps_and_steps", "still_putty", "kneaded_putty", "random_grasps",
                            "two_fingers_that_meet", "felt_between_steps"})
        EXPECT_TRUE(json.contains(key)) << key;
    EXPECT_GT(json.at("squeezes").at(3).at("tatara_N").get<double>(),
              json.at("squeezes").at(3).at("hertz_N").get<double>());
    EXPECT_EQ(json.at("felt_between_steps").size(), 4u);
    for (const char* name : {"f.svg", "d.svg"}) EXPECT_TRUE(at.read(name).contains("</svg>")) << name;
    EXPECT_TRUE(at.run(std::string(kBurinCommand) + " bench body --still 0").output.contains("ask for 1 to 3600"));
    EXPECT_TRUE(at.run("echo '[1]' > c.json && " + std::string(kBurinCommand) + " bench body --calculix c.json")
                    .output.contains("is no list of forces"));
}

}  // namespace burin::bench
