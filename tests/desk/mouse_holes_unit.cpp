// SPDX-License-Identifier: MIT
// The mouse as a hand on the surface, over holes: what a stroke does where the ray meets a hole's wall.
#include <numbers>

#include "tests/desk/mouse_desk.hpp"

namespace burin::session {
namespace {

constexpr double kPierced_mm = 12.0, kHoleTool_mm = 4.0, kHoleStroke_mm = 0.3 * kHoleTool_mm;  // as a session begins
// How much less deep a stroke is than set: what the material bears up, by the arm's stiffness.
constexpr double kHoleBears_mm = 0.06;

// A plate of 80 x 60 x 12 mm with a square hole through it, from 30 to 50 and from 20 to 40 mm.
std::string pierced_plate() {
    Corners all;
    const auto outer = [](int k, double z) { return Vec3(k == 1 || k == 2 ? 80.0 : 0.0, k >= 2 ? 60.0 : 0.0, z); };
    const auto inner = [](int k, double z) { return Vec3(k == 1 || k == 2 ? 50.0 : 30.0, k >= 2 ? 40.0 : 20.0, z); };
    for (int k = 0; k < 4; ++k) {
        const int n = (k + 1) % 4;
        add_quad(all, outer(k, kPierced_mm), outer(n, kPierced_mm), inner(n, kPierced_mm), inner(k, kPierced_mm));
        add_quad(all, outer(n, 0), outer(k, 0), inner(k, 0), inner(n, 0));
        add_quad(all, outer(k, 0), outer(n, 0), outer(n, kPierced_mm), outer(k, kPierced_mm));
        add_quad(all, inner(n, 0), inner(k, 0), inner(k, kPierced_mm), inner(n, kPierced_mm));
    }
    return stl_of(all);
}

}  // namespace

TEST(MouseOverHoles, AStrokeGoesOverAHoleAndOnBehindItAndCutsNothingWithin) {
    MouseDesk desk(pierced_plate());
    desk.point_at({12, 30, 12});
    desk.press();
    const Vec2 from = desk.px_of({12, 30, 12}), over = desk.px_of({40, 30, 12}), to = desk.px_of({68, 30, 12});
    desk.drag(from, over);
    desk.rest(0.5);
    EXPECT_GT(desk.tool_mm().z, kPierced_mm + kHoleTool_mm) << "it hovers, and is not in the hole";
    desk.drag(over, to);
    desk.release();
    EXPECT_EQ(desk.strokes(), 1u) << "for one undo";
    double left = kPierced_mm, right = kPierced_mm, within = 0.0;
    for (const Vec3& p : desk.vertices_mm()) {
        if (std::abs(p.y - 30.0) > 2.0 || p.z < 1.0) continue;
        if (p.x > 14.0 && p.x < 26.0) left = std::min(left, p.z);
        if (p.x > 54.0 && p.x < 66.0) right = std::min(right, p.z);
        const bool is_wall = p.x > 29.0 && p.x < 51.0 && p.z < kPierced_mm - kHoleStroke_mm - 0.1;
        if (is_wall) within = std::max(within, std::min(std::abs(p.x - 30.0), std::abs(p.x - 50.0)));
    }
    EXPECT_NEAR(left, kPierced_mm - kHoleStroke_mm, kHoleBears_mm);
    EXPECT_NEAR(right, kPierced_mm - kHoleStroke_mm, kHoleBears_mm);
    EXPECT_LT(within, 0.02) << "the hole's walls";
}

namespace {

// A plate of 80 x 60 x 8 mm with a round hole of 8 mm through its middle.
std::string drilled_plate() {
    constexpr int kSides = 48;
    Corners all;
    const auto inner = [](int k, double z) {
        const double turn = 2.0 * std::numbers::pi * k / kSides;
        return Vec3(40.0 + 4.0 * std::cos(turn), 30.0 + 4.0 * std::sin(turn), z);
    };
    // The point of the outline in the same direction.
    const auto outer = [&](int k, double z) {
        const Vec3 out = inner(k, z) - Vec3(40.0, 30.0, z);
        return Vec3(40.0, 30.0, z) +
               out * std::min(40.0 / std::max(std::abs(out.x), 1e-9), 30.0 / std::max(std::abs(out.y), 1e-9));
    };
    const auto quad = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { add_quad(all, a, b, c, d); };
    for (int k = 0; k < kSides; ++k) {
        const int n = k + 1;
        // The plate's corners lie between two of them.
        const Vec3 a = outer(k, 8), b = outer(n, 8), low(0, 0, -8);
        const bool turns = std::abs(a.x - b.x) > 1e-6 && std::abs(a.y - b.y) > 1e-6;
        const Vec3 corner(a.x + b.x > 80.0 ? 80.0 : 0.0, a.y + b.y > 60.0 ? 60.0 : 0.0, 8.0);
        const Vec3 middle = turns ? corner : 0.5 * (a + b);
        quad(a, middle, b, inner(n, 8));
        for (const Vec3& p : {a, inner(n, 8.0), inner(k, 8.0)}) all.push_back(p);
        quad(b + low, middle + low, a + low, inner(k, 0));
        for (const Vec3& p : {b + low, inner(k, 0.0), inner(n, 0.0)}) all.push_back(p);
        quad(a + low, middle + low, middle, a);
        quad(middle + low, b + low, b, middle);
        quad(inner(n, 0), inner(k, 0), inner(k, 8), inner(n, 8));
    }
    return stl_of(all);
}

}  // namespace

// Seen aslant the ray meets the far wall of a hole that is narrower than the tool: the ball dived in and gnawed it.
TEST(MouseOverHoles, AStrokeOverAHoleNarrowerThanItsToolGoesStraightOnAndLeavesItsWalls) {
    for (const double y_mm : {30.0, 33.5, 26.5}) {
        MouseDesk desk(drilled_plate(), "ball:0.006");
        desk.run({{MouseClick{MouseButton::right, true, {}}, 8'000'000}});
        const Vec2 middle(640.0, 360.0);
        desk.drag(middle, middle + Vec2(60.0, -90.0));
        desk.run({{MouseClick{MouseButton::right, false, {}}, 8'000'000}}, 300'000'000);
        desk.stroke({{15, y_mm, 8}, {65, y_mm, 8}});
        double deepest = 8.0, far_off = 0.0;
        for (const Vec3& p : desk.vertices_mm()) {
            if (p.x < 12.0 || p.x > 68.0 || p.y < 15.0 || p.y > 45.0) continue;
            const double from_axis = glm::length(Vec2(p) - Vec2(40.0, 30.0));
            // What lies below the groove, above the plate's back, is the hole's wall, where it was.
            if (p.z < 8.0 - 0.3 * 6.0 - 0.1 && p.z > 0.2) far_off = std::max(far_off, std::abs(from_axis - 4.0));
            if (from_axis > 5.0 && std::abs(p.y - y_mm) < 1.0 && p.z > 1.0) deepest = std::min(deepest, p.z);
        }
        EXPECT_NEAR(deepest, 8.0 - 0.3 * 6.0, 2.0 * kHoleBears_mm) << y_mm;
        EXPECT_LT(far_off, 0.1) << y_mm << ": the hole's wall";
    }
}

}  // namespace burin::session
