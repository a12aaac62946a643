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
#include "geometry/contact/local_surface.hpp"
#include "tests/support/uneven_poses.hpp"

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

// One ball that presses a larger one: Hertz 1881, with 1/r the sum of both curvatures.
double hertz_N(double depth_m, double radius_m, const SoftMaterial& material) {
    const double relative_m = radius_m * kPressedBall_m / (radius_m + kPressedBall_m);
    const double plane_Pa = material.young_Pa / (1.0 - material.poisson * material.poisson);
    return 4.0 / 3.0 * plane_Pa * std::sqrt(relative_m) * std::pow(depth_m, 1.5);
}

// The elements are 7.5 and 9 mm long, the dents from 0.5 mm on.
TEST(SoftPart, IsDentedByOnePointAsHertzSays) {
    struct Press {
        double spacing_m, point_m, young_Pa, depth_m;
        Vec3 from;
    };
    for (const Press& press :
         {Press{0.0094, 0.001, 100e3, 0.0005, {0.0, 1.0, 0.0}}, Press{0.0094, 0.001, 100e3, 0.001, {0.6, 0.0, 0.8}},
          Press{0.0094, 0.001, 100e3, 0.002, {0.48, -0.6, 0.64}},
          Press{0.0094, 0.001, 100e3, 0.004, {-0.64, 0.48, 0.6}}, Press{0.0075, 0.001, 400e3, 0.001, {0.0, 0.6, -0.8}},
          Press{0.0094, 0.003, 50e3, 0.002, {0.36, 0.48, 0.8}}}) {
        SoftPartSetup setup;
        setup.spacing_m = press.spacing_m;
        setup.point_radius_m = press.point_m;
        setup.material.young_Pa = press.young_Pa;
        setup.held_N_per_m = 1e7;
        Pressing body(setup);
        haptics::TickRecord tick;
        tick.contact.point_count = 1;
        tick.contact.points[0].hip_object_m = (kPressedBall_m + press.point_m - press.depth_m) * press.from;
        Nanoseconds now_ns = 0;
        for (int i = 0; i < 80; ++i) body.press(tick, now_ns += 4 * kTick_ns);
        const double ratio = body.felt_N(tick, now_ns) / hertz_N(press.depth_m, press.point_m, setup.material);
        EXPECT_NEAR(ratio, 1.0, 0.1) << 1e3 * press.depth_m << " mm of " << press.young_Pa << " Pa";
    }
}

// Five points of a fingertip, 0.05 and 0.1 of the radius deep: elements of 9 mm give as those of 5 mm do.
TEST(SoftPart, IsPressedByAFingertipAsAFinerOneIs) {
    for (const double depth_m : {0.0015, 0.003}) {
        std::array<double, 2> felt_N{};
        for (const bool fine : {false, true}) {
            SoftPartSetup setup = coarse_setup();
            if (fine) setup.spacing_m = 0.005;
            setup.held_N_per_m = 1e7;
            Pressing body(setup);
            const auto tick = fingertip(depth_m - setup.point_radius_m, glm::normalize(Vec3(0.3, 0.8, -0.5)));
            Nanoseconds now_ns = 0;
            for (int i = 0; i < 80; ++i) body.press(tick, now_ns += 4 * kTick_ns);
            felt_N[fine ? 1 : 0] = body.felt_N(tick, now_ns);
        }
        EXPECT_GT(felt_N[1], 0.5);
        EXPECT_NEAR(felt_N[0] / felt_N[1], 1.0, 0.1) << 1e3 * depth_m << " mm";
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

// ---- A body that lies turned

namespace {

// Five points of a fingertip, so deep in a body that lies at a pose, from a direction of the body's own frame.
haptics::TickRecord touch_of(const Pose& scene_from_body, const Vec3& half_axes_m, const Vec3& from_body,
                             double depth_m) {
    haptics::TickRecord tick = fingertip(0.0, from_body);
    const double surface_m = 1.0 / glm::length(from_body / half_axes_m);
    const Vec3 middle = tick.contact.points[0].hip_object_m;
    for (std::uint32_t i = 0; i < tick.contact.point_count; ++i) {
        Vec3& place = tick.contact.points[i].hip_object_m;
        place = scene_from_body * (place - middle + (surface_m - depth_m) * from_body);
    }
    return tick;
}

SoftPartSetup turned_setup(std::size_t pose) {
    SoftPartSetup setup = coarse_setup();
    setup.scene_from_body = uneven_pose(pose);
    FlightRoom room;
    room.gravity_m_per_s2 = Vec3(0.0);
    setup.room = room;
    return setup;
}

}  // namespace

TEST(SoftPart, IsPushedTheWayThatItIsTouchedHoweverItLies) {
    for (std::size_t pose = 0; pose < kUnevenPoses; ++pose)
        for (const std::size_t way : {pose, (pose + 2) % kUnevenPoses}) {
            const SoftPartSetup setup = turned_setup(pose);
            Pressing body(setup);
            const Vec3 from_body = uneven_direction(way), from_scene = setup.scene_from_body.orientation * from_body;
            const auto tick = touch_of(setup.scene_from_body, setup.half_axes_m, from_body, 0.002);
            body.part().frame().fly({setup.scene_from_body.position_m, Vec3(0.0), {}}, 0);
            body.press(tick, 4 * kTick_ns);
            body.press(tick, 8 * kTick_ns);
            body.press(tick, 12 * kTick_ns);
            const Vec3 velocity = body.part().frame().velocity_at(body.part().frame().pose().position_m);
            ASSERT_GT(glm::length(velocity), 0.01);
            EXPECT_GT(glm::dot(glm::normalize(velocity), -from_scene), 0.99) << pose << " from " << way;
            const Vec3 gone_m = body.part().frame().pose().position_m - setup.scene_from_body.position_m;
            EXPECT_GT(glm::dot(glm::normalize(gone_m), -from_scene), 0.99) << pose << " from " << way;
        }
}

TEST(SoftPart, TellsItsModelsInTheSceneHoweverItLies) {
    for (const std::size_t pose : {0u, 3u}) {
        SoftPartSetup setup = turned_setup(pose);
        setup.half_axes_m = {0.03, 0.042, 0.036};
        Pressing body(setup);
        for (int axis = 0; axis < 3; ++axis)
            for (const double sign : {-1.0, 1.0}) {
                Vec3 from_body(0.0);
                from_body[axis] = sign;
                const auto tick = touch_of(setup.scene_from_body, setup.half_axes_m, from_body, 0.0005);
                body.press(tick, (1 + axis) * 100 * kTick_ns + (sign > 0.0 ? 50 * kTick_ns : 0));
                ASSERT_EQ(body.part().models(0).size(), 5u) << pose << ", axis " << axis;
                for (const geometry::LocalModel& model : body.part().models(0)) {
                    EXPECT_GT(glm::dot(model.normal_object, setup.scene_from_body.orientation * from_body), 0.95);
                    EXPECT_LT(glm::distance(model.place_object_m, tick.contact.points[model.point].hip_object_m),
                              1e-12);
                    EXPECT_GT(model.force_N, 0.0);
                }
            }
    }
}

// What stands is as the update has it; what a hand holds is where that hand was when it told of itself last.
TEST(SoftPart, HasItsModelsAsOfTheHandThatTouchesItWhileItIsHeld) {
    const SoftPartSetup setup = turned_setup(1);
    Pressing body(setup);
    SoftPart& part = body.part();
    const std::array<std::size_t, 3> hands{0, 1, 5};
    const std::array<Nanoseconds, 3> ago_ns{1'300'000, 2'700'000, 600'000};
    Nanoseconds now_ns = 100 * kTick_ns;
    const auto update = [&] {
        now_ns += 4 * kTick_ns;
        for (std::size_t i = 0; i < hands.size(); ++i) {
            haptics::TickRecord tick = touch_of(part.frame().pose(), setup.half_axes_m, uneven_direction(i), 0.0005);
            tick.time_ns = now_ns - ago_ns[i];
            part.take_ticks(hands[i], {&tick, 1});
        }
        ASSERT_TRUE(part.update(now_ns, nullptr));
    };
    const auto expect_times = [&](bool is_held, const std::string& of) {
        for (std::size_t i = 0; i < hands.size(); ++i) {
            ASSERT_FALSE(part.models(hands[i]).empty()) << of;
            for (const geometry::LocalModel& model : part.models(hands[i]))
                EXPECT_EQ(model.time_ns, is_held ? now_ns - ago_ns[i] : now_ns) << of << ", hand " << hands[i];
        }
    };
    for (const std::size_t holds : {5u, 5u, 1u}) {
        part.frame().put(part.frame().pose().position_m);
        update();
        expect_times(false, "it stands");
        part.frame().take_hold(std::array<std::size_t, 1>{holds});
        update();
        expect_times(true, "held by " + std::to_string(holds));
        update();
        expect_times(true, "still");
        part.frame().let_go();
        update();
        expect_times(false, "it flies");
    }
}

// The surface of a held body moves as the hand does, which turns: each point of it with its own velocity in the scene.
TEST(SoftPart, HasModelsThatMoveAsItsSurfaceInAHandThatTurns) {
    constexpr std::size_t kCarries = 6;  // no finger: a part that carries the body itself
    for (std::size_t pose = 0; pose < kUnevenPoses; ++pose) {
        const SoftPartSetup setup = turned_setup(pose);
        Pressing body(setup);
        SoftPart& part = body.part();
        const Vec3 turns_rad_per_s = 3.0 * uneven_direction(pose + 1), goes_m_per_s = 2.0 * uneven_offset(pose + 2);
        Pose palm{uneven_offset(pose + 3), uneven_turn(pose + 4)};
        Nanoseconds now_ns = 100 * kTick_ns;
        for (int update = 0; update < 12; ++update) {
            constexpr double kUpdate_s = 0.004;
            now_ns += nanoseconds(kUpdate_s);
            palm.position_m += kUpdate_s * goes_m_per_s;
            palm.orientation = glm::angleAxis(3.0 * kUpdate_s, uneven_direction(pose + 1)) * palm.orientation;
            haptics::TickRecord carries;
            carries.time_ns = now_ns;
            carries.sample.position_device_m = palm.position_m;
            carries.sample.orientation_device = palm.orientation;
            part.take_ticks(kCarries, {&carries, 1});
            haptics::TickRecord touches =
                touch_of(part.frame().pose(), setup.half_axes_m, uneven_direction(pose), 0.002);
            touches.time_ns = now_ns;
            part.take_ticks(0, {&touches, 1});
            if (update == 0) part.frame().take_hold(std::array{kCarries});
            ASSERT_TRUE(part.update(now_ns, nullptr));
            if (update < 2) continue;
            ASSERT_FALSE(part.models(0).empty()) << pose;
            for (const geometry::LocalModel& model : part.models(0)) {
                const Vec3 moves_m_per_s =
                    goes_m_per_s + glm::cross(turns_rad_per_s, model.place_object_m - palm.position_m);
                EXPECT_LT(glm::distance(model.velocity_object_m_per_s, moves_m_per_s), 0.005) << pose << " " << update;
            }
        }
    }
}

}  // namespace burin::bodies
