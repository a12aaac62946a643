// SPDX-License-Identifier: MIT
// Simulated learners: an analysis finds the effect that was put in, and none where none was.
#include "study/people/learner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "study/people/recorded_trial.hpp"

namespace burin::study {
namespace {

Protocol thesis() {
    std::ifstream in("assets/studies/kinesthetic-path/protocol.toml");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    return parse_protocol(text).protocol;
}

// The mean distance of a trial from the tube's axis, of people of one group.
std::vector<double> wanders(const Protocol& protocol, bool first, double effect, std::size_t people) {
    LearnerPopulation population;
    population.effect = effect;
    const StudyWorld& world = protocol.worlds.at(0);
    std::vector<double> values;
    for (std::size_t i = 0; i < people; ++i) {
        Random random(17, 2 * i + (first ? 1 : 0));
        const Learner learner = draw_learner(population, first, random);
        const SimulatedStage stage = simulate_stage(protocol, *protocol.stage("test"), learner, population, random);
        double sum_m = 0.0;
        for (std::size_t k = 0; k < stage.top_m.size(); k += 10)
            sum_m += nearest_on(world.spine_m, 0.5 * (stage.top_m[k] + stage.bottom_m[k])).distance_m;
        if (!stage.top_m.empty()) values.push_back(sum_m / static_cast<double>(stage.top_m.size()));
    }
    return values;
}

// P(first < second) - P(first > second).
double superiority(const std::vector<double>& first, const std::vector<double>& second) {
    double sum = 0.0;
    for (const double a : first) {
        for (const double b : second) sum += a < b ? 1.0 : a > b ? -1.0 : 0.0;
    }
    return sum / static_cast<double>(first.size() * second.size());
}

TEST(StudyLearners, DifferByTheEffectThatWasPutIn) {
    const Protocol protocol = thesis();
    constexpr std::size_t kPeople = 150;
    const auto others = wanders(protocol, false, 0.0, kPeople);
    ASSERT_GT(others.size(), kPeople * 9 / 10);
    // 150 + 150: the standard error of the superiority is 0.067 without effect.
    EXPECT_NEAR(superiority(wanders(protocol, true, 0.0, kPeople), others), 0.0, 0.2);
    // Of normal values d apart it is 2 Phi(d / sqrt 2) - 1 = erf(d / 2): 0.84 for 2. The wander of single trials and
    // the few waves of each blur it, so that it lies below and well above 0.
    const double found = superiority(wanders(protocol, true, 2.0, kPeople), others);
    EXPECT_GT(found, 0.4);
    EXPECT_LT(found, std::erf(1.0) + 0.1);
}

TEST(StudyLearners, WanderLessAfterTraining) {
    const Protocol protocol = thesis();
    Learner learner;
    learner = after_stage(learner, *protocol.stage("interactive"));
    learner = after_stage(learner, *protocol.stage("model"));
    EXPECT_DOUBLE_EQ(learner.trained_min, 5.0);
}

TEST(StudyLearners, EndEveryStageOfTheProtocol) {
    const Protocol protocol = thesis();
    Random random(3);
    const Learner learner = draw_learner({}, true, random);
    for (const Stage& stage : protocol.stages) {
        const SimulatedStage went = simulate_stage(protocol, stage, learner, {}, random);
        EXPECT_EQ(went.end.phase, StagePhase::done) << stage.name;
        EXPECT_NE(went.end.result, StageResult::stopped) << stage.name;
        if (stage.ends_after_s) {
            EXPECT_NEAR(static_cast<double>(went.ticks), *stage.ends_after_s * kSimulatedRate_Hz, 2.0);
        }
    }
}

TEST(StudyLearners, DeviationIsTheDistanceToTheWall) {
    const StudyWorld world{"w", {{0, 0, 0}, {1, 0, 0}}, 0.045, 0.06, 0.02, 0.0};
    EXPECT_EQ(within_tube(world, {0.5, 0.03, 0.0}), Vec3(0.5, 0.03, 0.0));
    const Vec3 wall = within_tube(world, {0.5, 0.06, 0.08});
    EXPECT_NEAR(glm::distance(wall, Vec3(0.5, 0.06, 0.08)), 0.1 - 0.045, 1e-12);
    // A trial 25 mm above the axis: the top point is 10 mm out, the bottom one within.
    SimulatedStage stage;
    stage.end.result = StageResult::valid_exit;
    stage.end.clock_stopped_s = 2.0;
    for (int i = 0; i <= 2000; ++i) {
        const Vec3 middle{i / 2000.0, 0.025, 0.0};
        stage.top_m.push_back(middle + Vec3(0, 0.03, 0));
        stage.bottom_m.push_back(middle - Vec3(0, 0.03, 0));
    }
    const Json record = trial_record(world, stage);
    EXPECT_NEAR(record.at("deviation_top_mm").get<double>(), 10.0, 1e-9);
    EXPECT_NEAR(record.at("deviation_bottom_mm").get<double>(), 0.0, 1e-12);
    EXPECT_NEAR(record.at("deviation_mm").get<double>(), 10.0, 1e-9);
    EXPECT_NEAR(record.at("from_axis_mean_mm").get<double>(), 25.0, 1e-9);
    EXPECT_EQ(record.at("time_s").get<double>(), 2.0);
}

}  // namespace
}  // namespace burin::study
