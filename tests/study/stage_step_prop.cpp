// SPDX-License-Identifier: MIT
// The step's crossing times against slow searches that share none of its algebra.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "study/statistics/random.hpp"
#include "study/trial/stage_step.hpp"

namespace burin::study {
namespace {

bool contains(const CapBox& cap, const Vec3& p) {
    const Vec3 d = p - cap.centre_m;
    const double x = glm::dot(d, cap.x), y = glm::dot(d, cap.y), z = glm::dot(d, cap.z);
    return std::abs(x) <= cap.half_width_m && std::abs(y) <= cap.half_width_m && z >= 0.0 && z <= cap.depth_m;
}

StudyWorld random_world(Random& random) {
    StudyWorld w{"w", {}, 0.045, 0.06, 0.02, 0.0};
    Vec3 at{0.0};
    for (int i = 0; i < 6; ++i) {
        w.spine_m.push_back(at);
        const double bend = random.normal(), rise = random.normal();
        at += Vec3{0.08, 0.03 * rise, 0.03 * bend};
    }
    return w;
}

Vec3 random_near(const Vec3& centre_m, Random& random) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    return centre_m + 0.05 * Vec3{x, y, z};
}

RC_GTEST_PROP(StageCaps, AgreeWithASearchAlongTheSegment, (std::uint64_t seed)) {
    Random random(seed);
    const CapBox cap = end_cap(random_world(random));
    const Vec3 from = random_near(cap.centre_m, random), to = random_near(cap.centre_m, random);
    const auto found = inside(cap, from, to);
    constexpr int kSteps = 20'000;
    int first = -1, last = -1;
    for (int i = 0; i <= kSteps; ++i) {
        if (!contains(cap, from + (static_cast<double>(i) / kSteps) * (to - from))) continue;
        if (first < 0) first = i;
        last = i;
    }
    // The search cannot see what is shorter than a step.
    if (first < 0) {
        RC_ASSERT(!found || found->leaves - found->enters < 2.0 / kSteps);
        return;
    }
    RC_ASSERT(found.has_value());
    RC_ASSERT(std::abs(found->enters - static_cast<double>(first) / kSteps) <= 1.0 / kSteps + 1e-9);
    RC_ASSERT(std::abs(found->leaves - static_cast<double>(last) / kSteps) <= 1.0 / kSteps + 1e-9);
}

RC_GTEST_PROP(StageCaps, NearestPlaceIsNoFartherThanAnyOther, (std::uint64_t seed)) {
    Random random(seed);
    const StudyWorld w = random_world(random);
    const Vec3 p = random_near(w.spine_m[2], random);
    const NearestOnLine nearest = nearest_on(w.spine_m, p);
    RC_ASSERT(std::abs(glm::distance(nearest.place_m, p) - nearest.distance_m) < 1e-12);
    for (std::size_t i = 1; i < w.spine_m.size(); ++i) {
        for (int k = 0; k <= 100; ++k) {
            const Vec3 other = w.spine_m[i - 1] + (k / 100.0) * (w.spine_m[i] - w.spine_m[i - 1]);
            RC_ASSERT(glm::distance(other, p) >= nearest.distance_m - 1e-12);
        }
    }
}

// A wand that moves evenly along a straight tube, with ticks at random times: the trial's time is length by speed.
RC_GTEST_PROP(StageStep, TimeDoesNotDependOnWhenTheTicksAre, (std::uint64_t seed)) {
    Random random(seed);
    const StudyWorld w{"w", {{0.0, 0.0, 0.0}, {0.3, 0.0, 0.0}}, 0.045, 0.06, 0.02, 0.0};
    StageSetup setup;
    setup.kind = StageKind::trial;
    setup.ends_at_exit = true;
    setup.start = start_cap(w);
    setup.end = end_cap(w);
    setup.spine_m = w.spine_m;
    const double speed = 0.05 + 0.5 * random.uniform();
    StageState state;
    for (double t = 0.0; state.phase != StagePhase::done && t < 20.0;) {
        const Vec3 m{-0.015 + speed * t, 0.0, 0.0};
        state = step(setup, state, {t, {m + Vec3{0, 0.03, 0}, m - Vec3{0, 0.03, 0}}, OperatorAct::none, false}).state;
        t += 0.0005 + 0.045 * random.uniform();
    }
    RC_ASSERT(state.result == StageResult::valid_exit);
    RC_ASSERT(std::abs(trial_time_s(state) - 0.3 / speed) < 1e-9);
}

}  // namespace
}  // namespace burin::study
