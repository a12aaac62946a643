// SPDX-License-Identifier: MIT
// Simulated learners: an analysis finds the effect that was put in, and none where none was.
#include "study/people/learner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "study/trial/stage_step.hpp"

namespace burin::study {
namespace {

Protocol thesis() {
    std::ifstream in("assets/studies/kinesthetic-path/protocol.toml");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    return parse_protocol(text).protocol;
}

// The mean distance from the tube's axis at which people of one group mean to be in a trial; no device, no force.
std::vector<double> wanders(const Protocol& protocol, bool first, double effect, std::size_t people) {
    LearnerPopulation population;
    population.effect = effect;
    const StudyWorld& world = protocol.worlds.at(0);
    const Stage& stage = *protocol.stage("test");
    const StageSetup setup = setup_of(protocol, stage);
    std::vector<double> values;
    for (std::size_t i = 0; i < people; ++i) {
        Random random(17, 2 * i + (first ? 1 : 0));
        const Learner learner = draw_learner(population, first, random);
        LearnerHand hand(protocol, stage, world, learner, population, false, random);
        StageState state;
        double sum_m = 0.0, count = 0.0;
        for (double t = 0.0; state.phase != StagePhase::done && t < 600.0; t += 0.005) {
            const Vec3 middle = hand.next(state, t).middle_m, up(0.0, protocol.point_offset_m, 0.0);
            state = step(setup, state, {t, {middle + up, middle - up}, OperatorAct::none, false}).state;
            if (state.phase != StagePhase::running) {
                if (state.phase != StagePhase::done) sum_m = count = 0.0;
                continue;
            }
            sum_m += nearest_on(world.spine_m, middle).distance_m;
            count += 1.0;
        }
        if (state.result == StageResult::valid_exit) values.push_back(sum_m / count);
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

TEST(StudyLearners, DeviationIsTheDistanceToTheWall) {
    const StudyWorld world{"w", {{0, 0, 0}, {1, 0, 0}}, 0.045, 0.06, 0.02, 0.0};
    EXPECT_EQ(within_tube(world, {0.5, 0.03, 0.0}), Vec3(0.5, 0.03, 0.0));
    const Vec3 wall = within_tube(world, {0.5, 0.06, 0.08});
    EXPECT_NEAR(glm::distance(wall, Vec3(0.5, 0.06, 0.08)), 0.1 - 0.045, 1e-12);
}

}  // namespace
}  // namespace burin::study
