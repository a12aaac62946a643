// SPDX-License-Identifier: MIT
// Plastic flow: one mapped element against its closed form, what stays below yield, what would go bad; and putty under
// fingers that stay still or knead it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <tuple>
#include <vector>

#include "bodies/soft_part.hpp"
#include "bodies/solver/plastic_flow.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::bodies {
namespace {

constexpr double kPutty_m = 0.03;
constexpr Nanoseconds kPuttyStep_ns = 4'000'000;

SoftMaterial putty(double yield_Pa = 4e3) {
    SoftMaterial material;
    material.yield_Pa = yield_Pa;
    return material;
}

const SoftBody& putty_ball() {
    static const SoftBody body = SoftBody::create(ellipsoid(Vec3(kPutty_m), 0.0095).value(), putty()).value();
    return body;
}

void map_by(const SoftBody& body, SoftState& state, const glm::dmat3& map) {
    for (std::size_t i = 0; i < state.places_m.size(); ++i) state.places_m[i] = map * body.rest().places_m[i];
}

// Stretched along x, at the same volume.
glm::dmat3 stretched(double by) {
    glm::dmat3 map(1.0 / std::sqrt(by));
    map[0][0] = by;
    return map;
}

// Two fingertips of five points each that face each other along an axis, each so far from the middle.
haptics::TickRecord pinch(const Vec3& axis, double from_middle_m) {
    haptics::TickRecord tick;
    const Vec3 side = glm::normalize(glm::cross(axis, Vec3(0.3, 0.1, 1.0))), across = glm::cross(axis, side);
    std::uint32_t n = 0;
    for (const double sign : {1.0, -1.0})
        for (const Vec3& off : {Vec3(0.0), side, -side, across, -across})
            tick.contact.points[n++].hip_object_m = sign * from_middle_m * axis + 0.004 * off;
    tick.contact.point_count = n;
    return tick;
}

class Putty {
public:
    explicit Putty(const SoftMaterial& material, const Vec3& half_axes_m = Vec3(kPutty_m)) {
        SoftPartSetup setup;
        setup.half_axes_m = half_axes_m;
        setup.spacing_m = std::min({half_axes_m.x, half_axes_m.y, half_axes_m.z}) / 3.2;
        setup.material = material;
        part_ = SoftPart::create(setup).value();
    }
    void turn(const haptics::TickRecord& tick) {
        part_->take_ticks(0, {&tick, 1});
        ASSERT_TRUE(part_->update(now_ns_ += kPuttyStep_ns, nullptr));
    }
    void hold(const haptics::TickRecord& tick, double for_s) {
        for (double t = 0.0; t < for_s; t += seconds(kPuttyStep_ns)) turn(tick);
    }
    // Closes two fingers to a distance from the middle, and leaves them there.
    void close(const Vec3& axis, double from_m, double to_m, double for_s) {
        for (double t = 0.0; t < for_s; t += seconds(kPuttyStep_ns))
            turn(pinch(axis, from_m + (to_m - from_m) * t / for_s));
    }
    [[nodiscard]] double felt_N(const haptics::TickRecord& tick) const {
        double sum = 0.0;
        for (const geometry::LocalModel& model : part_->models(0))
            sum += model.force_at(tick.contact.points[model.point].hip_object_m, now_ns_);
        return sum;
    }
    // The state when nobody has touched it for a while.
    [[nodiscard]] SoftState let_go() const {
        SoftState state = part_->state();
        SoftSolver solver;
        for (int i = 0; i < 250; ++i) solver.step(part_->body(), state, {});
        return state;
    }
    [[nodiscard]] const SoftPart& part() const { return *part_; }

private:
    std::unique_ptr<SoftPart> part_;
    Nanoseconds now_ns_ = 0;
};

// By how much a body is narrower along y than it was.
double dent_m(const SoftPart& part, const SoftState& state) {
    const EmbeddedSurface surface = ellipsoid_surface(part.body().rest(), part.setup().half_axes_m, 3);
    double top = 0.0, bottom = 0.0;
    const std::vector<Vec3> before = places_of(surface, part.body().rest().places_m),
                            now = places_of(surface, state.places_m);
    const double half_m = part.setup().half_axes_m.y;
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (before[i].y > 0.999 * half_m) top = now[i].y;
        if (before[i].y < -0.999 * half_m) bottom = now[i].y;
    }
    return 2.0 * half_m - (top - bottom);
}

double volume_share(const SoftBody& body, const SoftState& state) {
    return volume_of(body, state.places_m).volume_m3 / volume_m3(body.rest());
}

}  // namespace

// b = diag(s^2, 1/s, 1/s) has von Mises' stress mu (s^2 - 1/s); so a stretch that has flowed has its s by yield alone.
TEST(PlasticFlow, LeavesAStretchTheStressOfYieldAndTheRestToTheRestShape) {
    const SoftBody& body = putty_ball();
    for (const double by : {0.5, 0.8, 1.3, 2.0}) {
        SoftState state = body.at_rest();
        map_by(body, state, stretched(by));
        for (int i = 0; i < 500; ++i) flow(body, state, 0.004);
        const double sign = by > 1.0 ? 1.0 : -1.0;
        double low = 1.0, high = by;
        for (int i = 0; i < 100; ++i) {
            const double s = 0.5 * (low + high);
            (sign * body.material().mu_Pa() * (s * s - 1.0 / s) < body.material().yield_Pa ? low : high) = s;
        }
        const double s = 0.5 * (low + high);
        for (const glm::dmat3& metric : state.flow.metrics) {
            EXPECT_NEAR(metric[0][0] / (s * s / (by * by)), 1.0, 1e-9);
            EXPECT_NEAR(metric[1][1] / (by / s), 1.0, 1e-9);
            EXPECT_NEAR(metric[2][2] / (by / s), 1.0, 1e-9);
            EXPECT_NEAR(glm::determinant(metric), 1.0, 1e-12);
        }
        EXPECT_EQ(state.flow.stopped_count, 0u);
        for (const double stress_Pa : stresses_of(body, state))
            EXPECT_NEAR(stress_Pa / body.material().yield_Pa, 1.0, 1e-9);
    }
}

// Also of what is turned, pressed together or drawn apart: what flows is the shape, and the rest shape's volume stays.
TEST(PlasticFlow, LetsWhatIsBeyondYieldFallWithItsTime) {
    const SoftBody& body = putty_ball();
    const double yield_Pa = body.material().yield_Pa;
    const glm::dmat3 turned = glm::mat3_cast(uneven_turn(0)) * stretched(1.4) * glm::mat3_cast(uneven_turn(1));
    for (const glm::dmat3& map : {stretched(1.4), turned, 0.9 * turned, 1.1 * turned}) {
        SoftState state = body.at_rest();
        map_by(body, state, map);
        const double before_Pa = stresses_of(body, state).front();
        for (int i = 0; i < 3; ++i) flow(body, state, body.material().relaxes_s / 3.0);
        EXPECT_NEAR((stresses_of(body, state).front() - yield_Pa) / (before_Pa - yield_Pa), std::exp(-1.0), 1e-9);
        EXPECT_NEAR(glm::determinant(state.flow.metrics.front()), 1.0, 1e-12);
        EXPECT_EQ(state.flow.flowing_count, body.rest().cells.size());
    }
}

// A body that was only carried and turned is held where it was, however unevenly it is held.
TEST(PlasticFlow, LeavesTheShapeOfACarriedBodyInItsPlace) {
    const SoftBody& body = putty_ball();
    const std::vector<Vec3>& rest = body.rest().places_m;
    for (std::size_t pose = 0; pose < kUnevenPoses; ++pose) {
        SoftState state = body.at_rest();
        map_by(body, state, glm::mat3_cast(uneven_turn(pose)));
        std::vector<double> holds_N_per_m;
        for (std::size_t i = 0; i < rest.size(); ++i) {
            state.places_m[i] += uneven_offset(pose);
            holds_N_per_m.push_back(100.0 + 7.0 * static_cast<double>(i % 13));
        }
        std::vector<Vec3> held_at_m(rest.size());
        follow_shape(body, state, holds_N_per_m, held_at_m);
        for (std::size_t i = 0; i < rest.size(); ++i) EXPECT_LT(glm::length(held_at_m[i] - rest[i]), 1e-9);
    }
}

TEST(PlasticFlow, LeavesABodyBelowYieldAsAnElasticOneToTheBit) {
    SoftMaterial hard = putty(1e9), elastic = putty(0.0);
    const SoftBody one = SoftBody::create(ellipsoid(Vec3(kPutty_m), 0.0095).value(), hard).value();
    const SoftBody other = SoftBody::create(ellipsoid(Vec3(kPutty_m), 0.0095).value(), elastic).value();
    SoftState first = one.at_rest(), second = other.at_rest();
    map_by(one, first, stretched(1.5));
    map_by(other, second, stretched(1.5));
    SoftSolver solver;
    for (int i = 0; i < 50; ++i) {
        solver.step(one, first, {});
        solver.step(other, second, {});
    }
    EXPECT_EQ(first.places_m, second.places_m);
    EXPECT_EQ(first.flow.flowing_count, 0u);
    EXPECT_TRUE(second.flow.metrics.empty());
}

TEST(PlasticFlow, StopsElementsThatWouldGoBadAndLetsThemFlowBack) {
    const SoftBody& body = putty_ball();
    SoftState state = body.at_rest();
    for (double by = 1.0; by < 12.0; by *= 1.05) {
        map_by(body, state, stretched(by));
        for (int i = 0; i < 20; ++i) flow(body, state, 0.02);
    }
    EXPECT_GT(state.flow.stopped_count, body.rest().cells.size() / 2);
    EXPECT_EQ(std::ranges::count(state.flow.stopped, 1), static_cast<std::ptrdiff_t>(state.flow.stopped_count));
    EXPECT_GE(worst_rest_quality(body, state), kLeastPlasticQuality);
    map_by(body, state, stretched(1.0));
    for (int i = 0; i < 50; ++i) flow(body, state, 0.02);
    EXPECT_EQ(state.flow.stopped_count, 0u);
    EXPECT_GT(worst_rest_quality(body, state), 0.3);
}

TEST(PlasticFlow, GivesNoInvertedElementARestShapeOfItsOwn) {
    const SoftBody& body = putty_ball();
    SoftState state = body.at_rest();
    const auto& cell = body.rest().cells[body.rest().cells.size() / 2];
    state.places_m[cell[0]] -= 3.0 * (state.places_m[cell[0]] - state.places_m[cell[1]]);
    ASSERT_LT(volume_of(body, state.places_m).least_share, 0.0);
    SoftSolver solver;
    for (int i = 0; i < 100; ++i) solver.step(body, state, {});
    EXPECT_GT(volume_of(body, state.places_m).least_share, 0.9);
    EXPECT_GE(worst_rest_quality(body, state), kLeastPlasticQuality);
    EXPECT_NEAR(volume_share(body, state), 1.0, 1e-3);
}

TEST(PlasticFlow, RefusesAMaterialThatCannotBe) {
    const Tetrahedra rest = ellipsoid(Vec3(kPutty_m), 0.0095).value();
    for (const auto& [yield_Pa, relaxes_s, told] :
         {std::tuple(-1.0, 0.03, "yield stress: is -1 Pa"), std::tuple(std::nan(""), 0.03, "yield stress"),
          std::tuple(4e3, 0.0, "relaxation: is 0 s"), std::tuple(4e3, 11.0, "relaxation: is 11 s")}) {
        SoftMaterial material = putty(yield_Pa);
        material.relaxes_s = relaxes_s;
        const auto body = SoftBody::create(rest, material);
        ASSERT_FALSE(body);
        EXPECT_TRUE(body.error().line().contains(told)) << body.error().line();
    }
}

// The dent is what stays when the fingers go away. From a second after they have stopped on, it may change in two
// seconds by as much as makes 0.1 % in a minute: what creeps does so evenly, or faster at first.
TEST(Putty, KeepsItsDentWhileFingersAreStill) {
    constexpr double kWatched_s = 2.0, kMost = 0.001 * kWatched_s / 60.0;
    Putty putty_ball(putty());
    const Vec3 up(0.0, 1.0, 0.0);
    putty_ball.close(up, kPutty_m, 0.75 * kPutty_m, 0.5);
    const haptics::TickRecord still = pinch(up, 0.75 * kPutty_m);
    putty_ball.hold(still, 1.0);
    const double early_m = dent_m(putty_ball.part(), putty_ball.let_go()), early_N = putty_ball.felt_N(still);
    putty_ball.hold(still, kWatched_s);
    const double late_m = dent_m(putty_ball.part(), putty_ball.let_go());
    EXPECT_GT(early_m, 0.3 * kPutty_m) << "of 0.5 that the fingers went in";
    EXPECT_NEAR(late_m / early_m, 1.0, kMost);
    EXPECT_NEAR(putty_ball.felt_N(still) / early_N, 1.0, kMost);
}

TEST(Putty, StaysClosedWholeAndAsLargeWhateverItsKneading) {
    constexpr int kKneads = 12;
    for (const Vec3& half_axes_m : {Vec3(kPutty_m), Vec3(0.05, 0.032, 0.032)}) {
        Putty kneaded(putty(2e3), half_axes_m);
        const SoftBody& body = kneaded.part().body();
        std::mt19937 random(7);
        const auto draw = [&] { return 2.0 * static_cast<double>(random()) / 4294967295.0 - 1.0; };
        for (int knead = 0; knead < kKneads; ++knead) {
            const Vec3 axis = glm::normalize(Vec3(draw(), draw(), draw()));
            const double at_m = 1.0 / glm::length(axis / half_axes_m);
            kneaded.close(axis, 1.3 * at_m, 0.45 * at_m, 0.12);
            EXPECT_GT(volume_of(body, kneaded.part().state().places_m).least_share, 0.0);
            kneaded.close(axis, 0.45 * at_m, 1.3 * at_m, 0.12);
        }
        const SoftState state = kneaded.let_go();
        double farthest_m = 0.0;  // in some direction: where it was dented last, it may bulge elsewhere
        for (std::size_t i = 0; i < state.places_m.size(); ++i)
            farthest_m = std::max(farthest_m, glm::length(state.places_m[i] - body.rest().places_m[i]));
        EXPECT_GT(farthest_m, 0.005);
        EXPECT_NEAR(volume_share(body, state), 1.0, 0.01);
        EXPECT_GT(volume_of(body, state.places_m).least_share, 0.5);
        EXPECT_GE(worst_rest_quality(body, state), kLeastPlasticQuality);
        // The surface encloses what the elements fill.
        const EmbeddedSurface surface = ellipsoid_surface(body.rest(), half_axes_m, 4);
        const std::vector<Vec3> places = places_of(surface, state.places_m);
        double enclosed_m3 = 0.0;
        for (const auto& [a, b, c] : surface.triangles)
            enclosed_m3 += volume_m3(Vec3(0.0), places[a], places[b], places[c]);
        EXPECT_NEAR(enclosed_m3 / volume_m3(body.rest()), 1.0, 0.03);
    }
}

TEST(Putty, IsHarderTheHigherItsYieldAndStiffness) {
    double last_N = 0.0;
    for (const double hardness : {0.5, 1.0, 2.0}) {
        SoftMaterial material = putty(hardness * 4e3);
        material.young_Pa *= hardness;
        Putty pressed(material);
        pressed.close({0.0, 1.0, 0.0}, kPutty_m, 0.8 * kPutty_m, 0.3);
        const double felt_N = pressed.felt_N(pinch({0.0, 1.0, 0.0}, 0.8 * kPutty_m));
        EXPECT_GT(felt_N, 1.5 * last_N);
        last_N = felt_N;
    }
}

// A push off the middle turns it; let go, it turns back.
TEST(Putty, KeepsHowItIsTurnedHoweverItIsPushed) {
    Putty pushed(putty(), {0.032, 0.032, 0.048});
    for (int i = 0; i < 3; ++i) {
        for (double t = 0.0; t < 1.0; t += 0.004) {
            haptics::TickRecord tick = pinch({0.0, 1.0, 0.0}, 0.032 - 0.012 * std::min(2.0 * t, 1.0));
            for (std::uint32_t point = 0; point < 10; ++point)
                tick.contact.points[point].hip_object_m.z += point < 5 ? 0.02 : -0.02;
            pushed.turn(tick);
        }
        pushed.hold(pinch({0.0, 1.0, 0.0}, 0.08), 0.5);
    }
    // How far the long axis has turned, and been sheared: of the latter some stays, 0.26 when this was written.
    const SoftBody& body = pushed.part().body();
    Vec3 axis(0.0);
    for (std::uint32_t i = 0; i < body.corners(); ++i)
        axis += body.mass_kg(i) * body.rest().places_m[i].z * pushed.part().state().places_m[i];
    EXPECT_LT(std::acos(std::abs(glm::normalize(axis).z)), 0.3);
}

// Springs hold where it is, not the shape that it had.
TEST(Putty, GoesBackToItsPlaceAndKeepsItsShape) {
    Putty pressed(putty());
    pressed.close({0.0, 1.0, 0.0}, kPutty_m, 0.7 * kPutty_m, 0.5);
    pressed.close({0.0, 1.0, 0.0}, 0.7 * kPutty_m, 2.0 * kPutty_m, 0.3);
    pressed.hold(pinch({0.0, 1.0, 0.0}, 2.0 * kPutty_m), 0.5);
    const double dent = dent_m(pressed.part(), pressed.part().state());
    pressed.hold(pinch({0.0, 1.0, 0.0}, 2.0 * kPutty_m), 5.0);
    EXPECT_GT(dent, 0.3 * kPutty_m);
    EXPECT_NEAR(dent_m(pressed.part(), pressed.part().state()) / dent, 1.0, 0.001);
    Vec3 middle(0.0);
    for (std::uint32_t i = 0; i < pressed.part().body().corners(); ++i)
        middle += pressed.part().body().mass_kg(i) * pressed.part().state().places_m[i];
    EXPECT_LT(glm::length(middle) / volume_m3(pressed.part().body().rest()) / 1000.0, 0.0005);
    const std::uint64_t steps = pressed.part().steps();
    pressed.turn(pinch({0.0, 1.0, 0.0}, 2.0 * kPutty_m));
    EXPECT_EQ(pressed.part().steps(), steps) << "putty at rest that nobody is near costs nothing";
}

}  // namespace burin::bodies
