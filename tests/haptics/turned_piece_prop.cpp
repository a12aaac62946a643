// SPDX-License-Identifier: MIT
// A piece that another hand turns is a body that moves: a tool that rests on it feels what it feels on one that stands.
#include <gtest/gtest.h>

#include <string>

#include "bench/haptics/turned_scene.hpp"

namespace burin::haptics {
namespace {

struct TurnedCase {
    bench::CarvingTool tool;
    bool friction = true;

    [[nodiscard]] std::string name(double speed_deg_per_s) const {
        return tool.name + (friction ? ", friction, " : ", no friction, ") + std::to_string(speed_deg_per_s) + " deg/s";
    }
};

std::vector<TurnedCase> turned_cases() {
    std::vector<TurnedCase> cases;
    for (const bench::CarvingTool& tool : bench::carving_tools())
        for (const bool friction : {false, true})
            if (tool.name == "ball" || tool.name == "box") cases.push_back({tool, friction});
    return cases;
}

constexpr double kOfForce = 0.05, kSpeeds_deg_per_s[] = {10.0, 45.0, 90.0, 180.0};

}  // namespace

TEST(TurnedPiece, PressesAToolThatRestsOnItAsOneThatStands) {
    for (const TurnedCase& one : turned_cases()) {
        const double right_N = bench::turn_under(one.tool.shape, {.friction = one.friction}).mean_N;
        EXPECT_NEAR(right_N, 0.6, 0.06) << one.tool.name << ": 600 N/m, 1 mm less the tool's clearance";
        for (const double speed : kSpeeds_deg_per_s) {
            const bench::TurnedUnder turned =
                bench::turn_under(one.tool.shape, {.speed_deg_per_s = speed, .friction = one.friction});
            EXPECT_GT(turned.least_N, (1.0 - kOfForce) * right_N) << one.name(speed);
            EXPECT_LT(turned.most_N, (1.0 + kOfForce) * right_N) << one.name(speed);
            EXPECT_EQ(turned.set_anew, 0u) << one.name(speed);
            EXPECT_EQ(turned.let_go, 0u) << one.name(speed);
            // What holds still slides on a piece that goes on: friction takes it along with the piece by so much.
            const double beside = one.friction ? turned.dynamic_friction : 0.0;
            EXPECT_NEAR(turned.last_beside, beside, kOfForce) << one.name(speed);
            EXPECT_NEAR(turned.last_along, beside, kOfForce) << one.name(speed);
        }
    }
}

TEST(TurnedPiece, TakesAToolAlongThatGoesWithIt) {
    for (const TurnedCase& one : turned_cases()) {
        if (!one.friction) continue;
        const double right_N = bench::turn_under(one.tool.shape, {}).mean_N;
        for (const double speed : kSpeeds_deg_per_s) {
            const bench::TurnedUnder turned =
                bench::turn_under(one.tool.shape, {.speed_deg_per_s = speed, .along = true});
            EXPECT_GT(turned.least_N, (1.0 - kOfForce) * right_N) << one.name(speed);
            EXPECT_LT(turned.most_N, (1.0 + kOfForce) * right_N) << one.name(speed);
            EXPECT_LE(turned.most_beside, 1.25 * turned.dynamic_friction + kOfForce) << one.name(speed);
        }
    }
}

TEST(TurnedPiece, ThatStopsIsFeltWhereItStopsAndPressesOn) {
    for (const TurnedCase& one : turned_cases()) {
        const double right_N = bench::turn_under(one.tool.shape, {.friction = one.friction}).mean_N;
        const bench::TurnedUnder turned = bench::turn_under(
            one.tool.shape, {.speed_deg_per_s = 180.0, .friction = one.friction, .stops_after_s = 0.5});
        EXPECT_GT(turned.least_N, (1.0 - kOfForce) * right_N) << one.name(180.0);
        EXPECT_LT(turned.most_N, (1.0 + kOfForce) * right_N) << one.name(180.0);
        EXPECT_LE(turned.most_beyond_rad, 1e-9) << one.name(180.0);
        EXPECT_NEAR(turned.late_rad, 0.0, 1e-9) << one.name(180.0);
        EXPECT_LT(turned.moved_m, 1e-5) << one.name(180.0);
    }
}

// What it was: each picture's mapping began afresh, and a turned piece gave less than half of its force.
TEST(TurnedPiece, ThatIsSetAnewInEachPictureFadesInEachTime) {
    const compute::ToolShape ball = bench::carving_tools().front().shape;
    const double right_N = bench::turn_under(ball, {}).mean_N;
    const bench::TurnedUnder anew = bench::turn_under(ball, {.speed_deg_per_s = 90.0, .follows = false});
    EXPECT_GE(anew.set_anew, 59u);
    EXPECT_LT(anew.mean_N, 0.55 * right_N);
}

}  // namespace burin::haptics
