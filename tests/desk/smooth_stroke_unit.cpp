// SPDX-License-Identifier: MIT
// Shift when a stroke of the mouse begins: the tool smooths, and afterwards does what it did before.
#include "session/state/smooth_stroke.hpp"

#include "tests/desk/mouse_desk.hpp"

namespace burin::session {
namespace {

constexpr double kPlate_mm = 12.0;

// Presses with or without Shift at the first place, drags to the second and lets go.
void stroke_with(MouseDesk& desk, bool shift, const Vec3& from_mm, const Vec3& to_mm) {
    desk.point_at(from_mm);
    desk.run({{MouseClick{MouseButton::left, true, {.shift = shift}}, 8'000'000}}, 300'000'000);
    desk.drag(desk.px_of(from_mm), desk.px_of(to_mm));
    desk.release();
}

// How deep the plate's upper face lies near x in the row y, at most and on average over the row.
double deepest_mm(const MouseDesk& desk, double y_mm) {
    double deepest = 0.0;
    for (const Vec3& p : desk.vertices_mm())
        if (p.z > 4.0 && std::abs(p.x - 40.0) < 8.0 && std::abs(p.y - y_mm) < 3.0)
            deepest = std::max(deepest, kPlate_mm - p.z);
    return deepest;
}

}  // namespace

TEST(SmoothStroke, ShiftFillsTheGrooveThatTheSameToolHasCutAndThenItCutsAgain) {
    MouseDesk desk(plate(kPlate_mm), "ball:0.004");
    stroke_with(desk, false, {15, 30, 12}, {65, 30, 12});
    const double cut_mm = deepest_mm(desk, 30.0);
    EXPECT_GT(cut_mm, 1.0);
    double last_mm = cut_mm;
    for (int i = 0; i < 4; ++i) {
        stroke_with(desk, true, {15, 30, 12}, {65, 30, 12});
        EXPECT_LT(deepest_mm(desk, 30.0), last_mm - 0.02) << i;
        last_mm = deepest_mm(desk, 30.0);
        EXPECT_EQ(desk.session().state().led().tool.operation, compute::Operation::cut);
        EXPECT_FALSE(desk.session().state().smooth_stroke);
    }
    std::printf("a groove of %.2f mm is %.2f mm deep after four strokes with Shift\n", cut_mm, last_mm);
    EXPECT_LT(last_mm, 0.85 * cut_mm);
    stroke_with(desk, false, {15, 45, 12}, {65, 45, 12});
    EXPECT_NEAR(deepest_mm(desk, 45.0), cut_mm, 0.05);
    EXPECT_EQ(desk.strokes(), 6u);
}

// The hand comes after the mouse: had the tool been given back at the mouse's release, it would go on cutting.
TEST(SmoothStroke, NothingIsCutWhereTheHandStillHasToGoWhenTheButtonComesUp) {
    for (const double px_per_s : {250.0, 1500.0}) {
        MouseDesk desk(plate(kPlate_mm), "ball:0.004");
        desk.point_at({15, 30, 12});
        desk.run({{MouseClick{MouseButton::left, true, {.shift = true}}, 8'000'000}});
        desk.drag(desk.px_of({15, 30, 12}), desk.px_of({65, 30, 12}), px_per_s);
        desk.run({{MouseClick{MouseButton::left, false, {}}, 8'000'000}}, 16'000'000);
        EXPECT_EQ(desk.session().state().led().tool.operation, compute::Operation::smooth);
        desk.rest(1.5);
        EXPECT_EQ(desk.session().state().led().tool.operation, compute::Operation::cut);
        for (const Vec3& p : desk.vertices_mm()) {
            const bool inside = p.x > 2.0 && p.x < 78.0 && p.y > 2.0 && p.y < 58.0 && p.z > 4.0;
            if (inside) {
                ASSERT_NEAR(p.z, kPlate_mm, 1e-3) << p.x << ", " << p.y;
            }
        }
    }
}

TEST(SmoothStroke, GivesBackWhatTheToolDidWhateverThatWas) {
    for (const char* key : {"tool-2", "tool-3", "tool-4", "tool-5"}) {
        MouseDesk desk(plate(kPlate_mm), "ball:0.004");
        desk.run({{CommandInput{key, {}}, 8'000'000}}, 100'000'000);
        const compute::Operation before = desk.session().state().led().tool.operation;
        const bool only_touch = desk.session().state().led().only_touch;
        desk.point_at({20, 30, 12});
        desk.run({{MouseClick{MouseButton::left, true, {.shift = true}}, 8'000'000}}, 200'000'000);
        EXPECT_EQ(desk.session().state().led().tool.operation, compute::Operation::smooth);
        EXPECT_FALSE(desk.session().state().led().only_touch);
        desk.release();
        desk.rest(0.5);
        EXPECT_EQ(desk.session().state().led().tool.operation, before) << key;
        EXPECT_EQ(desk.session().state().led().only_touch, only_touch) << key;
    }
}

TEST(SmoothStroke, ACommandDuringItIsWhatTheToolDoesFromThenOn) {
    MouseDesk desk(plate(kPlate_mm), "ball:0.004");
    desk.point_at({20, 30, 12});
    desk.run({{MouseClick{MouseButton::left, true, {.shift = true}}, 8'000'000}}, 200'000'000);
    desk.run({{CommandInput{"operation", {"paint"}}, 8'000'000}}, 50'000'000);
    desk.release();
    desk.rest(0.5);
    EXPECT_EQ(desk.session().state().led().tool.operation, compute::Operation::paint);
}

TEST(SmoothStroke, EndsAfterTheHandHasCarvedItOrHasNeverPressed) {
    SmoothStroke stroke = followed({}, {0.1, true, false});
    stroke = followed(stroke, {0.1, true, true});
    stroke = followed(stroke, {0.1, false, true});
    EXPECT_FALSE(stroke.is_over());  // the hand is still at it
    stroke = followed(stroke, {0.1, false, false});
    EXPECT_FALSE(stroke.is_over());  // its last ticks may not have been read
    EXPECT_TRUE(followed(stroke, {0.1, false, false}).is_over());
    SmoothStroke missed = followed({}, {0.1, true, false});
    missed = followed(missed, {0.4, false, false});
    EXPECT_FALSE(missed.is_over());
    EXPECT_TRUE(followed(missed, {0.4, false, false}).is_over());
}

}  // namespace burin::session
