// SPDX-License-Identifier: MIT
// The mapping of a piece that moves, followed from tick to tick between the pictures in which it is published.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "haptics/workspace/technique.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::haptics {
namespace {

constexpr double kPieceTick_s = 1e-3;
constexpr int kTicksAPicture = 16;

// A piece that is turned about a place of its own, which is nowhere special in any frame, and carried along the axis.
struct LedPiece {
    Vec3 axis_device = uneven_direction(2), middle_device_m{0.03, -0.02, 0.05};
    double turns_rad_per_s = 0.0, slides_m_per_s = 0.0, grows_per_s = 0.0;

    // Where the device has what it had at `place` when it was led by nothing.
    [[nodiscard]] Vec3 moved(const Vec3& place_device_m, double time_s) const {
        const Quat turn = glm::angleAxis(turns_rad_per_s * time_s, axis_device);
        return middle_device_m + (1.0 + grows_per_s * time_s) * (turn * (place_device_m - middle_device_m)) +
               slides_m_per_s * time_s * axis_device;
    }
    [[nodiscard]] Similarity mapping(double time_s) const {
        const Similarity at_rest{uneven_offset(1), uneven_turn(1), 1.7};
        const Quat turn = glm::angleAxis(turns_rad_per_s * time_s, axis_device);
        const Similarity led{moved(Vec3(0.0), time_s), turn, 1.0 + grows_per_s * time_s};
        return at_rest * inverse(led);
    }
};

struct PieceTicks {
    WorkspaceSettings settings;
    WorkspaceState state;
    WorkspaceStep step;
    Vec3 hand_device_m{0.02, 0.01, -0.01};

    PieceTicks() { settings.placed = 1; }
    const WorkspaceStep& tick(const Similarity& published) {
        settings.object_from_device = published;
        step = step_workspace(state, settings, {hand_device_m, Vec3(0.0), 0, true, kPieceTick_s});
        state = step.next;
        return step;
    }
    // Publishes every kTicksAPicture; returns the tick's time.
    double follow(const LedPiece& piece, int tick_number, double stops_s = HUGE_VAL) {
        const double picture_s = kPieceTick_s * (tick_number / kTicksAPicture) * kTicksAPicture;
        tick(piece.mapping(std::min(picture_s, stops_s)));
        return kPieceTick_s * tick_number;
    }
};

}  // namespace

TEST(PieceMotion, ASteadyTurnIsFollowedAtItsOwnVelocity) {
    for (const double turns_rad_per_s : {0.1, -0.8, 3.14}) {
        const LedPiece piece{.turns_rad_per_s = turns_rad_per_s, .slides_m_per_s = 0.05};
        PieceTicks ticks;
        for (int i = 0; i < 300; ++i) {
            const Similarity before = ticks.state.object_from_device;
            ticks.follow(piece, i);
            EXPECT_EQ(ticks.step.jumped, i == 0);
            if (i < 10 * kTicksAPicture) continue;
            const Vec3 place(0.01, 0.04, -0.02);
            const Vec3 expected = turns_rad_per_s * glm::cross(piece.axis_device, place - piece.middle_device_m) +
                                  piece.slides_m_per_s * piece.axis_device;
            // Within a tick a place goes on its circle by half of w^2 r t.
            EXPECT_LT(glm::length(ticks.step.piece.at(place) - expected), 4e-4 * glm::length(expected) + 1e-9);
            const Similarity moved = inverse(ticks.step.object_from_device) * before;
            EXPECT_LT(glm::length(moved * place - place - kPieceTick_s * ticks.step.piece.at(place)),
                      2e-3 * kPieceTick_s * glm::length(expected) + 1e-12);
        }
    }
}

TEST(PieceMotion, ATurnedPieceKeepsItsMiddleOnTheWayBetweenPictures) {
    const LedPiece piece{.turns_rad_per_s = 3.14};
    const Vec3 middle_object_m = piece.mapping(0.0) * piece.middle_device_m;
    PieceTicks ticks;
    for (int i = 0; i < 400; ++i) {
        ticks.follow(piece, i);
        const Vec3 now = ticks.step.object_from_device * piece.middle_device_m;
        EXPECT_LT(glm::length(now - middle_object_m), 1e-12);
    }
}

TEST(PieceMotion, APieceThatStopsIsNeverFeltBeyondThatAndArrivesExactly) {
    const LedPiece piece{.turns_rad_per_s = 3.14, .slides_m_per_s = 0.02, .grows_per_s = 0.3};
    const double stops_s = 0.2;
    const Vec3 place(0.06, 0.02, 0.05);
    PieceTicks ticks;
    double last_m = 0.0;
    const Vec3 start = piece.mapping(0.0) * place;
    for (int i = 0; i < 260; ++i) {
        ticks.follow(piece, i, stops_s);
        const double way_m = glm::length(ticks.step.object_from_device * place - start);
        EXPECT_GE(way_m, last_m - 1e-12) << i;
        last_m = way_m;
    }
    EXPECT_EQ(ticks.step.object_from_device, piece.mapping(stops_s));
    EXPECT_EQ(ticks.step.piece.at(place), Vec3(0.0));
}

TEST(PieceMotion, FollowsWhatATechniqueHasMovedTheWorkspaceBy) {
    const LedPiece piece{.turns_rad_per_s = 1.0};
    PieceTicks ticks;
    ticks.settings.technique = WorkspaceTechnique::scaling;
    ticks.settings.scaling_gain = 2.0;
    for (int i = 0; i < 400; ++i) ticks.follow(piece, i, 0.3);
    Similarity expected = piece.mapping(0.3);
    expected.scale *= 2.0;
    EXPECT_NEAR(ticks.step.object_from_device.scale, expected.scale, 1e-12);
    const Vec3 place(0.02, -0.03, 0.01);
    EXPECT_LT(glm::length(ticks.step.object_from_device * place - expected * place), 1e-12);
}

TEST(PieceMotion, IsSetAtOnceWhereACommandHasPlacedItAndWhereItWouldGoTooFar) {
    const LedPiece still;
    const auto jumps = [&](const LedPiece& piece, double time_s, std::uint64_t placed) {
        PieceTicks ticks;
        ticks.settings.placed = 5;
        for (int i = 0; i < 50; ++i) ticks.tick(still.mapping(0.0));
        ticks.settings.placed = placed;
        const bool jumped = ticks.tick(piece.mapping(time_s)).jumped;
        EXPECT_EQ(jumped, ticks.step.object_from_device == piece.mapping(time_s));
        EXPECT_EQ(jumped, ticks.step.piece.at(Vec3(0.1)) == Vec3(0.0));
        return jumped;
    };
    const LedPiece slides{.slides_m_per_s = 1.0};
    EXPECT_FALSE(jumps(slides, 0.0199, 5));
    EXPECT_TRUE(jumps(slides, 0.0201, 5));
    EXPECT_TRUE(jumps(slides, 0.001, 6)) << "placed by a command";
    EXPECT_TRUE(jumps(slides, 0.001, 0)) << "placed by whoever never counts";
    PieceTicks near;  // a turn about the hand moves it nowhere
    LedPiece about_hand{.middle_device_m = near.hand_device_m, .turns_rad_per_s = 1.0};
    EXPECT_FALSE(jumps(about_hand, 0.34, 5));
    EXPECT_TRUE(jumps(about_hand, 0.36, 5));
    about_hand.turns_rad_per_s = 0.0;
    about_hand.grows_per_s = 1.0;
    EXPECT_FALSE(jumps(about_hand, 0.09, 5));
    EXPECT_TRUE(jumps(about_hand, 0.11, 5));
    EXPECT_TRUE(jumps(about_hand, -0.1, 5));
}

TEST(PieceMotion, NeverGoesFasterAtTheHandThanAHandDoes) {
    const LedPiece slides{.slides_m_per_s = 1.0};
    PieceTicks ticks;
    double led_m = 0.0;
    for (int i = 0; i < 200; ++i) {
        // Each other tick somebody publishes, nineteen millimetres to and fro.
        led_m = i % 4 < 2 ? 0.0 : 0.019;
        ticks.tick(slides.mapping(led_m));
        EXPECT_LE(glm::length(ticks.step.piece.at(ticks.hand_device_m)), 1.0 + 1e-9);
    }
}

}  // namespace burin::haptics
