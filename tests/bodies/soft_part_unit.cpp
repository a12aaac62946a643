// SPDX-License-Identifier: MIT
// A soft body as a part of a scene: a finger that presses it, what its ticks feel between two steps against the same
// body stepped each tick, and what becomes of it when updates come late or not at all.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "bodies/soft_part.hpp"

namespace burin::bodies {
namespace {

constexpr double kPressedBall_m = 0.03;
constexpr Nanoseconds kTick_ns = 1'000'000;

SoftPartSetup coarse_setup() {
    SoftPartSetup setup;
    setup.object = 7;
    setup.spacing_m = kPressedBall_m / 3.2;
    return setup;
}

// A tick of a fingertip: five points, the middle one so deep in the ball at rest, pressed along a direction.
haptics::TickRecord fingertip(double depth_m, const Vec3& from = {0.0, 1.0, 0.0}) {
    haptics::TickRecord tick;
    tick.contact.point_count = 5;
    const Vec3 side = glm::normalize(glm::cross(from, Vec3(0.3, 0.1, 1.0))), across = glm::cross(from, side);
    const Vec3 middle = (kPressedBall_m - depth_m) * from;
    constexpr double kExtent_m = 0.004;
    const std::array places{middle, middle + kExtent_m * side, middle - kExtent_m * side, middle + kExtent_m * across,
                            middle - kExtent_m * across};
    for (std::size_t i = 0; i < places.size(); ++i) tick.contact.points[i].hip_object_m = places[i];
    return tick;
}

// A body whose ticks and updates are made here.
class Pressing {
public:
    explicit Pressing(const SoftPartSetup& setup) : part_(SoftPart::create(setup).value()) {}
    void press(const haptics::TickRecord& tick, Nanoseconds now_ns, std::size_t hand = 0) {
        part_->take_ticks(hand, {&tick, 1});
        EXPECT_TRUE(part_->update(now_ns, nullptr));
    }
    // The sum of what the hand's ticks would feel with their points there.
    [[nodiscard]] double felt_N(const haptics::TickRecord& tick, Nanoseconds now_ns, std::size_t hand = 0,
                                bool by_surface = false) const {
        double sum = 0.0;
        for (geometry::LocalModel model : part_->models(hand)) {
            if (by_surface) model.stiffness_N_per_m = model.surface_N_per_m;
            sum += model.force_at(tick.contact.points[model.point].hip_object_m, now_ns);
        }
        return sum;
    }
    [[nodiscard]] SoftPart& part() { return *part_; }

private:
    std::unique_ptr<SoftPart> part_;
};

}  // namespace

// The truth is the same body stepped each tick with many sweeps. A tick that touched the surface as it stood at the
// last step would be off by several times as much.
TEST(SoftPart, IsFeltBetweenItsStepsAsItWouldGive) {
    SoftPartSetup setup = coarse_setup(), fine_setup = setup;
    fine_setup.step_ns = kTick_ns;
    fine_setup.sweeps = 12;
    Pressing body(setup), fine(fine_setup);
    double off = 0.0, held_off = 0.0, step_N = 0.0, true_step_N = 0.0, last_N = 0.0, last_true_N = 0.0, most_N = 0.0;
    for (int i = 1; i <= 500; ++i) {
        const Nanoseconds now_ns = i * kTick_ns;
        const auto tick = fingertip(0.002 - 0.002 * std::cos(2.0 * std::numbers::pi * 8.0 * seconds(now_ns)));
        const double felt_N = body.felt_N(tick, now_ns), held_N = body.felt_N(tick, now_ns, 0, true);
        fine.press(tick, now_ns);
        const double true_N = fine.felt_N(tick, now_ns);
        if (i % 4 == 0) body.press(tick, now_ns);
        if (i < 50) continue;  // the first steps
        off += (felt_N - true_N) * (felt_N - true_N);
        held_off += (held_N - true_N) * (held_N - true_N);
        if (i > 50) step_N = std::max(step_N, std::abs(felt_N - last_N));
        if (i > 50) true_step_N = std::max(true_step_N, std::abs(true_N - last_true_N));
        last_N = felt_N;
        last_true_N = true_N;
        most_N = std::max(most_N, true_N);
    }
    EXPECT_GT(most_N, 3.0);
    EXPECT_LT(std::sqrt(off / 450.0), 0.06 * most_N);
    EXPECT_LT(std::sqrt(off), 0.4 * std::sqrt(held_off));
    EXPECT_LT(step_N, 2.0 * true_step_N) << "continuous over the steps";
}

// A push from one side moves the whole body against its springs; the surface gives besides.
TEST(SoftPart, ComesToTheForceOfItsSpringsAndGoesBackToRest) {
    Pressing body(coarse_setup());
    const auto tick = fingertip(0.004);
    Nanoseconds now_ns = 0;
    for (int i = 0; i < 250; ++i) body.press(tick, now_ns += 4 * kTick_ns);
    const double felt_N = body.felt_N(tick, now_ns);
    Vec3 drawn_N(0.0);
    double core_kg = 0.0;
    const SoftBody& soft = body.part().body();
    for (const bool counts : {false, true})
        for (std::uint32_t i = 0; i < soft.corners(); ++i) {
            const Vec3& rest = soft.rest().places_m[i];
            if (glm::length(rest) >= 0.5 * kPressedBall_m) continue;
            if (!counts) core_kg += soft.mass_kg(i);
            if (counts)
                drawn_N += body.part().setup().held_N_per_m * soft.mass_kg(i) / core_kg *
                           (rest - body.part().state().places_m[i]);
        }
    EXPECT_NEAR(drawn_N.y / felt_N, 1.0, 0.01) << "action and reaction";
    EXPECT_LT(std::abs(drawn_N.x), 0.05 * felt_N);
    const auto away = fingertip(-0.1);
    for (int i = 0; i < 500; ++i) body.press(away, now_ns += 4 * kTick_ns);
    EXPECT_EQ(body.felt_N(away, now_ns), 0.0);
    double off_m = 0.0;
    for (std::uint32_t i = 0; i < soft.corners(); ++i)
        off_m = std::max(off_m, glm::length(body.part().state().places_m[i] - soft.rest().places_m[i]));
    EXPECT_LT(off_m, 1e-5);
    const std::uint64_t steps = body.part().steps();
    body.press(away, now_ns += 4 * kTick_ns);
    EXPECT_EQ(body.part().steps(), steps) << "a body at rest that nobody is near costs nothing";
}

TEST(SoftPart, IsStifferTheStifferItsMaterial) {
    double last_N = 0.0;
    for (const double young_Pa : {30e3, 100e3, 300e3}) {
        SoftPartSetup setup = coarse_setup();
        setup.material.young_Pa = young_Pa;
        setup.held_N_per_m = 1e6;
        Pressing body(setup);
        const auto tick = fingertip(0.003);
        Nanoseconds now_ns = 0;
        for (int i = 0; i < 150; ++i) body.press(tick, now_ns += 4 * kTick_ns);
        const double felt_N = body.felt_N(tick, now_ns);
        if (last_N > 0.0) {
            EXPECT_NEAR(felt_N / last_N / (young_Pa == 100e3 ? 100.0 / 30.0 : 3.0), 1.0, 0.03);
        }
        last_N = felt_N;
    }
}

TEST(SoftPart, StepsNoMoreThanAFewTimesWhenAnUpdateIsLate) {
    Pressing body(coarse_setup());
    const auto tick = fingertip(0.002);
    body.press(tick, 0);
    body.press(tick, 4 * kTick_ns);
    EXPECT_EQ(body.part().steps(), 1u);
    body.press(tick, 2'000 * kTick_ns);
    EXPECT_EQ(body.part().steps(), 1u + SoftPart::kMostSteps);
    body.press(tick, 2'003 * kTick_ns);
    EXPECT_EQ(body.part().steps(), 1u + SoftPart::kMostSteps) << "the next step is not due";
    body.press(tick, 2'004 * kTick_ns);
    EXPECT_EQ(body.part().steps(), 2u + SoftPart::kMostSteps);
}

TEST(SoftPart, DoesTheSameAgainToTheBit) {
    const auto forces = [] {
        Pressing body(coarse_setup());
        std::vector<double> all;
        for (int i = 1; i < 60; ++i) {
            const auto tick = fingertip(1e-4 * i);
            body.press(tick, i * 4 * kTick_ns);
            all.push_back(body.felt_N(tick, i * 4 * kTick_ns));
        }
        return all;
    };
    EXPECT_EQ(forces(), forces());
}

TEST(SoftPart, GivesEachHandItsOwnPointsAndNoneToOneFarAway) {
    Pressing body(coarse_setup());
    body.press(fingertip(0.002), 4 * kTick_ns, 0);
    body.press(fingertip(0.002, {-1.0, 0.0, 0.0}), 8 * kTick_ns, 2);
    EXPECT_EQ(body.part().models(0).size(), 5u);
    EXPECT_EQ(body.part().models(1).size(), 0u);
    ASSERT_EQ(body.part().models(2).size(), 5u);
    EXPECT_LT(body.part().models(2).front().normal_object.x, -0.99);
    EXPECT_EQ(body.part().models(2).front().object, 7u);
    EXPECT_EQ(body.part().models(99).size(), 0u);
    geometry::LocalSurface draft;
    ASSERT_TRUE(body.part().add_near({.hand = 2}, draft));
    EXPECT_EQ(draft.models.count, 5u);
    body.press(fingertip(-0.05, {-1.0, 0.0, 0.0}), 12 * kTick_ns, 2);
    EXPECT_EQ(body.part().models(2).size(), 0u);
}

TEST(SoftPart, TakesNoHarmOfPlacesThatAreNone) {
    Pressing body(coarse_setup());
    auto tick = fingertip(0.002);
    tick.contact.points[1].hip_object_m.x = std::nan("");
    tick.contact.points[2].hip_object_m = Vec3(1e300);
    tick.contact.points[3].hip_object_m = Vec3(0.0);  // the middle of the ball
    for (int i = 1; i < 100; ++i) body.press(tick, i * 4 * kTick_ns);
    for (const Vec3& place : body.part().state().places_m) ASSERT_TRUE(finite(place));
    for (const geometry::LocalModel& model : body.part().models(0)) EXPECT_TRUE(model.is_sensible());
}

TEST(SoftPart, RefusesABodyThatCannotBe) {
    SoftPartSetup setup;
    setup.material.young_Pa = 0.0;
    EXPECT_FALSE(SoftPart::create(setup));
    setup = {};
    setup.half_axes_m = {0.03, -0.03, 0.03};
    EXPECT_FALSE(SoftPart::create(setup));
}

// A hand without force goes through a body as through air: what reaches in must not knead putty before its exercise.
TEST(SoftPart, IsLeftAloneByAHandWhoseForceIsOff) {
    SoftPartSetup setup = coarse_setup();
    setup.material.yield_Pa = 3e3;
    Pressing through(setup), pressed(setup);
    for (int i = 0; i < 60; ++i) {
        haptics::TickRecord tick = fingertip(0.01);
        pressed.press(tick, i * 4 * kTick_ns);
        tick.flags |= haptics::kTickProxyReset;
        through.press(tick, i * 4 * kTick_ns);
    }
    EXPECT_EQ(through.part().state().places_m, through.part().body().rest().places_m);
    EXPECT_TRUE(through.part().models(0).empty());
    EXPECT_NE(pressed.part().state().places_m, pressed.part().body().rest().places_m);
}

}  // namespace burin::bodies
