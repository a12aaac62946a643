// SPDX-License-Identifier: MIT
// Each turn tells an exercise the time since the turn before and how a held body lies in the palm, whatever exercise it
// is; and a body that has fallen down is brought back each time.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <vector>

#include "activities/rehab/exercise_kinds.hpp"
#include "activities/rehab/rehab.hpp"
#include "bodies/soft_part.hpp"
#include "tests/activities/acted_hand.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::activities {
namespace {

// Notes its turns, and takes the place of the world's ball.
class NotedExercise final : public Exercise {
public:
    explicit NotedExercise(std::vector<ExerciseTurn>& turns) : turns_(turns) {}
    [[nodiscard]] const char* name() const override { return "noted"; }
    [[nodiscard]] const SettingValues& settings() const override { return settings_; }
    [[nodiscard]] bodies::SoftPartSetup body() const override {
        bodies::SoftPartSetup setup;
        setup.object = kBall;
        setup.half_axes_m = Vec3(0.03);
        setup.spacing_m = 0.03 / 3.2;
        setup.scene_from_body = uneven_pose(0);
        return setup;
    }
    [[nodiscard]] std::array<double, 3> srgb() const override { return {}; }
    [[nodiscard]] bool is_carried() const override { return true; }
    void turn(const ExerciseTurn& turn, session::ActivityOrders&) override { turns_.push_back(turn); }
    [[nodiscard]] ExerciseEnd end() const override { return ExerciseEnd::not_yet; }
    [[nodiscard]] ExerciseCourse course() const override { return {}; }
    [[nodiscard]] std::string task() const override { return {}; }

private:
    std::vector<ExerciseTurn>& turns_;
    SettingValues settings_{exercise_named("ball")->settings};
};

class NotedRehab {
public:
    // Goes on by so many turns; what is drawn comes with the first of them.
    session::ActivityOrders go_on(int turns, const std::shared_ptr<bodies::SoftShape>& drawn = nullptr) {
        const std::vector<scene::DrawnShare> all(drawn ? 1 : 0, drawn);
        session::ActivityOrders orders = hand.go_on(rehab, turns, ball_on_a_table(), all);
        for (const auto& order : orders.on_scene) order();
        return orders;
    }
    // The body as it is drawn, somewhere below its place, or in a palm.
    [[nodiscard]] std::shared_ptr<bodies::SoftShape> shape(double below_m, std::optional<Pose> palm_from_body = {}) {
        auto shape = std::make_shared<bodies::SoftShape>();
        shape->scene_from_body = uneven_pose(0);
        shape->scene_from_body.position_m.y -= below_m;
        shape->palm_from_body = palm_from_body;
        std::uint32_t corners = 0;
        for (const auto& triangle : body().triangles())
            for (const std::uint32_t corner : triangle) corners = std::max(corners, corner + 1);
        shape->places_m.assign(corners, Vec3(0.01));
        return shape;
    }
    [[nodiscard]] bodies::SoftPart& body() { return dynamic_cast<bodies::SoftPart&>(*rehab.scene_part()); }
    std::vector<ExerciseTurn> turns;
    ActedHand hand;
    Rehab rehab{std::make_unique<NotedExercise>(turns)};
};

}  // namespace

TEST(RehabTurns, TakeAsLongAsTheTicksOfThemAreApart) {
    NotedRehab noted;
    noted.go_on(1);
    ASSERT_EQ(noted.turns.size(), 1u);
    EXPECT_EQ(noted.turns[0].fingers.dt_s, 0.0) << "nothing was before";
    for (const std::uint64_t every : {1u, 3u, 1u, 40u, 2u}) {
        noted.hand.tell_every(every);
        noted.turns.clear();
        noted.go_on(10);
        ASSERT_EQ(noted.turns.size(), 10u);
        for (const ExerciseTurn& turn : noted.turns)
            EXPECT_NEAR(turn.fingers.dt_s, 0.001 * static_cast<double>(every), 1e-12) << every;
    }
}

// A finger that leans on the table, one that presses the ball, one that does both, and one that nothing touches.
TEST(RehabTurns, TellForcesOfTheBodyApartFromThoseOfAllElse) {
    NotedRehab noted;
    noted.go_on(1);
    const Vec3 up{0.0, 1.0, 0.0};
    noted.hand.touch(0, kTable, up);
    noted.hand.push(0, 5.0);
    noted.hand.touch(1, kBall, up);
    noted.hand.push(1, 2.0);
    noted.hand.touch(2, kBall, up);
    noted.hand.push(2, 1.0);
    noted.hand.lean(2, kTable, 3.0);
    for (std::size_t finger = 0; finger < kFelt; ++finger) noted.hand.measure(finger, 2.0);
    noted.go_on(3);
    const FingersTurn& fingers = noted.turns.back().fingers;
    EXPECT_EQ(fingers.forces_N, (FingerForces{0.0, 2.0, 1.0, 0.0}));
    EXPECT_EQ(fingers.elsewhere_N, (FingerForces{5.0, 0.0, 3.0, 0.0}));
    const std::array<double, kFelt> measured_N{0.0, 2.0, 0.5, 0.0};
    for (std::size_t finger = 0; finger < kFelt; ++finger) EXPECT_EQ(fingers.measured_N[finger], measured_N[finger]);
    // A force takes some ticks to go after the finger has left: it stays what it was.
    noted.hand.touch_nothing();
    noted.hand.lean(2, 0, 0.0);
    noted.go_on(1);
    EXPECT_EQ(noted.turns.back().fingers.forces_N, (FingerForces{0.0, 2.0, 0.25, 0.0}));
    EXPECT_EQ(noted.turns.back().fingers.elsewhere_N, (FingerForces{5.0, 0.0, 0.75, 0.0}));
    const Json report = noted.rehab.report();
    EXPECT_EQ(report["fingers"][0]["peak_force_N"], 0.0);
    EXPECT_EQ(report["fingers"][0]["peak_elsewhere_N"], 5.0);
    EXPECT_EQ(report["fingers"][1]["peak_force_N"], 2.0);
    EXPECT_EQ(report["fingers"][1]["peak_elsewhere_N"], 0.0);
}

TEST(RehabTurns, TellHowABodyLiesInThePalmWhileAHandHoldsIt) {
    NotedRehab noted;
    noted.go_on(2);
    EXPECT_FALSE(noted.turns.back().lies_in_palm_m);
    for (std::size_t hold = 0; hold < 3; ++hold) {
        noted.go_on(2, noted.shape(0.0, uneven_pose(hold + 1)));
        EXPECT_EQ(noted.turns.back().lies_in_palm_m, uneven_pose(hold + 1).position_m) << hold;
        noted.go_on(2, noted.shape(0.0));
        EXPECT_FALSE(noted.turns.back().lies_in_palm_m) << "it is held no more, after hold " << hold;
    }
}

TEST(RehabTurns, BringABodyBackEachTimeThatItHasFallenDown) {
    NotedRehab noted;
    noted.go_on(1);
    const Vec3 place_m = uneven_pose(0).position_m;
    for (int fall = 0; fall < 3; ++fall) {
        noted.body().frame().put(place_m - Vec3(0.3, 2.0, 0.1));
        EXPECT_TRUE(noted.go_on(1, noted.shape(0.3)).messages.empty()) << "not so deep";
        const auto fallen = noted.go_on(1, noted.shape(0.5));
        ASSERT_EQ(fallen.messages.size(), 1u) << fall;
        EXPECT_EQ(fallen.messages[0], "the ball has fallen down, and is back at its place");
        EXPECT_EQ(noted.body().frame().pose().position_m, place_m) << fall;
        EXPECT_TRUE(noted.go_on(3, noted.shape(0.6)).messages.empty()) << "once, until it is drawn at its place";
        EXPECT_TRUE(noted.go_on(1, noted.shape(0.0)).messages.empty());
    }
}

}  // namespace burin::activities
