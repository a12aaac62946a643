// SPDX-License-Identifier: MIT
// burin rehab assess by the command line: a simulated hand from its course to its baseline, and what the exercises make
// of that.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "activities/rehab/assess/scripted_fingers.hpp"
#include "base/json.hpp"
#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

class RehabAssessments : public testing::Test {
protected:
    void SetUp() override {
        if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    }
    [[nodiscard]] std::string rehab(const std::string& options) const {
        return "cd " + std::string(kSessionsFolder) + "/../.. && " + kBurinCommand + " rehab " + options +
               " --offscreen --outputs " + (at / "out").string();
    }
    [[nodiscard]] std::string kept_for(unsigned participant) const {
        return " --results " + (at / "results").string() + " --participant " + std::to_string(participant);
    }
    [[nodiscard]] Json report_of(const std::string& options) const {
        const auto done = at.run(rehab(options + " --report " + (at / "r.json").string()));
        EXPECT_EQ(done.status, 0) << done.output;
        output = done.output;
        return Json::parse(at.read("r.json"), nullptr, false);
    }
    const Workplace at;
    mutable std::string output;
};

double flexion_rad(std::size_t finger, double closed) {
    double sum_rad = 0.0;
    const auto bent = devices::bent_in(devices::GripShape::whole, finger, closed),
               open = devices::bent_in(devices::GripShape::whole, finger, 0.0);
    for (std::size_t joint = 1; joint < bent.size(); ++joint) sum_rad += bent[joint] - open[joint];
    return sum_rad;
}

}  // namespace

// Of a patient whose range is half of the usual, whose index presses nothing, and whose fingers follow each other: all
// of it through glove, gate, session and rules.
TEST_F(RehabAssessments, MeasureAWeakHandAsItsCourseForetellsAndFitTheExercisesToIt) {
    const activities::AssessedHand hand = activities::assessed_hand(activities::SimulatedPerson::weak);
    ASSERT_EQ(hand.closes, 0.5);
    ASSERT_EQ(hand.holds_N[1], 0.0);
    const Json report = report_of("assess --hand weak" + kept_for(7));
    ASSERT_TRUE(report.is_object());
    EXPECT_EQ(report.at("ended"), "done") << output;
    EXPECT_EQ(report.at("score"), 100.0);
    EXPECT_TRUE(report.at("young_Pa").is_null());
    double together_N = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        const Json& finger = report.at("assess").at("fingers").at(i);
        double bending_rad = 0.0, slopes = 0.0;
        for (std::size_t joint = 1; joint < 4; ++joint)
            bending_rad += finger.at("range_of_motion_rad").at(joint).get<double>();
        EXPECT_NEAR(bending_rad, flexion_rad(i, 0.5), 1e-6) << finger;
        EXPECT_NEAR(bending_rad, 0.5 * flexion_rad(i, 1.0), 1e-6);
        EXPECT_NEAR(finger.at("strength_N").get<double>(), hand.holds_N[i], 0.03) << finger;
        EXPECT_NEAR(finger.at("peak_speed_rad_per_s").get<double>(), flexion_rad(i, 0.5) / hand.stroke_s, 1e-3);
        for (std::size_t k = 0; k < 4; ++k)
            if (k != i) slopes += hand.others_follow * flexion_rad(k, 1.0) / flexion_rad(i, 1.0);
        EXPECT_NEAR(finger.at("fractionation").get<double>(), 1.0 - slopes / 3.0, 1e-3) << finger;
        together_N += hand.holds_N[i];
    }
    EXPECT_NEAR(report.at("assess").at("strength_together_N").get<double>(), together_N, 0.06);

    const Json& range = report.at("person_range");
    EXPECT_TRUE(at.read("results/report.html").contains("participant-007/progress.html"));
    const std::string page = at.read("results/participant-007/progress.html");
    EXPECT_TRUE(page.contains("<h2>Assessment</h2>"));
    EXPECT_TRUE(page.contains("go by the assessment of")) << page.substr(0, 3000);
    EXPECT_EQ(report.at("side"), "right");
    EXPECT_TRUE(report.at("held_N_per_m").is_null());

    const std::string ball = "ball --hand scripted --repetitions 1 --hold 0.1 --time-limit 6 --level 1 --share 0";
    const Json fitted = report_of(ball + kept_for(7));
    EXPECT_TRUE(output.contains("fitted by the assessment of")) << output;
    EXPECT_EQ(fitted.at("settings").at("open"), range.at("open"));
    EXPECT_EQ(fitted.at("settings").at("closed"), range.at("closed"));
    EXPECT_EQ(fitted.at("settings").at("most_N"), range.at("most_N"));
    EXPECT_EQ(fitted.at("fitted_by").at("settings"), Json::array({"open", "closed", "most_N"}));
    // By hand still wins, also where it is what is usual; and nobody else is fitted.
    const Json by_hand = report_of(ball + " --most-force 0 --open 0.1" + kept_for(7));
    EXPECT_EQ(by_hand.at("settings").at("most_N"), 0.0);
    EXPECT_EQ(by_hand.at("settings").at("closed"), 1.0);
    EXPECT_FALSE(by_hand.contains("fitted_by"));
    EXPECT_FALSE(report_of(ball + kept_for(8)).contains("fitted_by"));
}

TEST_F(RehabAssessments, SayWhatTheyTake) {
    const auto wrong = at.run(rehab("assess --bound 11"));
    EXPECT_EQ(wrong.status, 1);
    EXPECT_TRUE(wrong.output.contains("--bound")) << wrong.output;
    EXPECT_EQ(at.run(rehab("assess --hand strong")).status, 2);
    EXPECT_EQ(at.run(rehab("ball --hand weak")).status, 2);
    at.write("bad.fingers", "burin-fingers 1\n0 0 0 0 3\n");
    const auto course = at.run(rehab("assess --device simulated-glove:" + (at / "bad.fingers").string() + " --input " +
                                     kSessionsFolder + "/rehab-assess.txt"));
    EXPECT_EQ(course.status, 1);
    EXPECT_TRUE(course.output.contains("bad.fingers, line 2")) << course.output;
}

}  // namespace burin::app
