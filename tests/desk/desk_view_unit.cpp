// SPDX-License-Identifier: MIT
// How a part stands in a desk's picture: as large as the panel leaves room, straight on where a view says so, and above
// its plinth.
#include <array>

#include "desk/viewer/view_cube.hpp"
#include "tests/desk/mouse_desk.hpp"

namespace burin::session {
namespace {

// Where the corners of a part are seen, in pixels of the window.
struct SeenPart {
    Vec2 lo{1e9}, hi{-1e9};
};
SeenPart seen_part(const MouseDesk& desk) {
    SeenPart seen;
    const Box& box = desk.session().room().workpiece_object;
    for (int i = 0; i < 8; ++i) {
        const Vec3 corner((i & 1) != 0 ? box.hi.x : box.lo.x, (i & 2) != 0 ? box.hi.y : box.lo.y,
                          (i & 4) != 0 ? box.hi.z : box.lo.z);
        const Vec2 px = desk.px_of(1e3 * corner);
        seen.lo = glm::min(seen.lo, px);
        seen.hi = glm::max(seen.hi, px);
    }
    return seen;
}

void expect_fills(const MouseDesk& desk, double free_px, const std::string& where) {
    const SeenPart seen = seen_part(desk);
    const Vec2 middle = 0.5 * (seen.lo + seen.hi), size = seen.hi - seen.lo;
    EXPECT_NEAR(middle.x, 0.5 * free_px, 2.0) << where;
    EXPECT_NEAR(middle.y, 360.0, 2.0) << where;
    EXPECT_NEAR(std::max(size.x / free_px, size.y / 720.0), kFilled, 0.01) << where;
}

void press_key(MouseDesk& desk, Key key, const Modifiers& with = {}) {
    desk.run({{KeyInput{key, KeyMotion::press, with}, 8'000'000}, {KeyInput{key, KeyMotion::release, with}, 1}},
             100'000'000);
}

// What of the part faces the eye.
Vec3 towards_eye_object(const MouseDesk& desk) {
    const SessionState& state = desk.session().state();
    const Vec3 middle = desk.session().room().workpiece_object.center();
    return glm::normalize(inverse(state.world_from_object) * desk.desk->viewer().seen_from.eye_world - middle);
}

std::optional<picture::PicturePedestal> plinth_of(const MouseDesk& desk) {
    const auto scene = desk.desk->scene_on(0);
    return scene && scene->pedestal.visible ? std::optional(scene->pedestal) : std::nullopt;
}

double lowest_m(const MouseDesk& desk) {
    double lowest = 1e9;
    for (const Vec3& p : desk.vertices_mm())
        lowest = std::min(lowest, (desk.session().state().world_from_object * (1e-3 * p)).y);
    return lowest;
}

}  // namespace

TEST(DeskView, APartFillsWhatThePanelLeavesFree) {
    MouseDesk desk(plate(12.0));
    expect_fills(desk, 1280.0 - 340.0, "at first, with the panel");
    press_key(desk, Key::right);
    desk.run({{Scroll{{0.0, 8.0}, {}}, 8'000'000}}, 100'000'000);
    press_key(desk, Key::f);
    expect_fills(desk, 1280.0, "F, while the panel is hidden");
    press_key(desk, Key::tab);
    for (const Key key : {Key::digit_1, Key::digit_2, Key::digit_3}) {
        press_key(desk, key, {.ctrl = true});
        expect_fills(desk, 1280.0 - 340.0, "a view beside the panel");
    }
}

TEST(DeskView, TopIsSeenStraightFromAbove) {
    MouseDesk desk(plate(12.0));
    press_key(desk, Key::digit_3, {.ctrl = true});
    EXPECT_LT(glm::length(towards_eye_object(desk) - Vec3(0.0, 1.0, 0.0)), 1e-3);
    press_key(desk, Key::digit_2, {.ctrl = true});
    EXPECT_LT(glm::length(towards_eye_object(desk) - Vec3(1.0, 0.0, 0.0)), 1e-3);
    press_key(desk, Key::digit_1, {.ctrl = true});
    EXPECT_LT(glm::length(towards_eye_object(desk) - Vec3(0.0, 0.0, 1.0)), 1e-3);
}

// A face of the cube in the corner shows the part from there; it turns nothing else, and is no stroke that missed.
TEST(DeskView, APressOnAFaceOfTheCubeShowsThePartFromThere) {
    MouseDesk desk(plate(12.0));
    const auto cube = [&] { return view_cube(desk.desk->seen()); };
    ASSERT_TRUE(cube());
    const std::array<std::pair<Vec3, std::array<Key, 2>>, 5> faces{{{{0, 0, 1}, {Key::right, Key::down}},
                                                                    {{1, 0, 0}, {Key::left, Key::down}},
                                                                    {{-1, 0, 0}, {Key::right, Key::down}},
                                                                    {{0, 1, 0}, {Key::right, Key::down}},
                                                                    {{0, -1, 0}, {Key::right, Key::up}}}};
    for (const auto& [face, keys] : faces) {
        press_key(desk, Key::digit_1, {.ctrl = true});
        for (const Key key : keys) press_key(desk, key);
        desk.move_to(desk.px_of_world(*cube() * (0.5 * face)));
        const std::string told =
            desk.told_while({{MouseClick{}, 100'000'000}, {MouseClick{MouseButton::left, false, {}}, 80'000'000}});
        EXPECT_EQ(told, "");
        EXPECT_LT(glm::length(towards_eye_object(desk) - face), 1e-3) << face.x << face.y << face.z;
    }
    press_key(desk, Key::digit_1, {.shift = true, .ctrl = true});
    EXPECT_LT(glm::length(towards_eye_object(desk) - Vec3(0.0, 0.0, -1.0)), 1e-3);
}

TEST(DeskView, TheCubeStandsAsThePartDoesAndBesideThePanel) {
    MouseDesk desk(plate(12.0));
    press_key(desk, Key::tab);
    press_key(desk, Key::digit_3, {.ctrl = true});
    const Similarity cube = view_cube(desk.desk->seen()).value();
    const Vec3 eye = desk.desk->viewer().seen_from.eye_world;
    EXPECT_LT(glm::length(glm::normalize(glm::conjugate(cube.orientation) * (eye - cube.position_m)) - Vec3(0, 1, 0)),
              1e-3)
        << "its upper face is seen straight on";
    for (const double x : {-0.5, 0.5})
        for (const double y : {-0.5, 0.5})
            for (const double z : {-0.5, 0.5}) {
                const Vec2 at = desk.px_of_world(cube * Vec3(x, y, z));
                EXPECT_TRUE(at.x > 700.0 && at.x < 940.0 && at.y > 0.0 && at.y < 200.0) << at.x << ", " << at.y;
            }
    const auto scene = desk.desk->scene_on(0);
    ASSERT_TRUE(scene);
    EXPECT_GE(scene->objects.size(), 2u);
}

// The pillar stood where the part had stood at first, and as thick: a part that was turned or enlarged sank into it.
TEST(DeskView, ThePlinthKeepsBelowThePartHoweverItIsTurnedAndEnlarged) {
    MouseDesk desk(plate(12.0));
    ASSERT_TRUE(plinth_of(desk));
    const double radius_m = plinth_of(desk)->radius_m, scale = desk.session().state().world_from_object.scale;
    int seen = 0;
    desk.move_to({500, 300});
    desk.run({{Scroll{{0.0, -6.0}, {}}, 8'000'000}}, 50'000'000);  // it stays above the floor
    for (int turn = 0; turn < 24; ++turn) {
        press_key(desk, turn % 3 == 0 ? Key::up : Key::right);
        desk.move_to({500, 300});
        desk.run({{Scroll{{0.0, turn % 2 == 0 ? 2.0 : -2.0}, {}}, 8'000'000}}, 50'000'000);
        const auto plinth = plinth_of(desk);
        if (!plinth) continue;
        ++seen;
        EXPECT_LE(plinth->top_center_world.y, lowest_m(desk) + 1e-6) << turn;
        EXPECT_NEAR(plinth->radius_m / radius_m, desk.session().state().world_from_object.scale / scale, 1e-6);
    }
    EXPECT_GT(seen, 5);
}

// The plinth's height came from the corners of the part's box: a ball that was turned floated above it.
TEST(DeskView, ABallTouchesItsPlinthHoweverItIsTurned) {
    MouseDesk desk("");  // of 40 mm
    for (int turn = 0; turn < 6; ++turn) {
        press_key(desk, turn % 2 == 0 ? Key::up : Key::right);
        press_key(desk, Key::right);
        const auto plinth = plinth_of(desk);
        ASSERT_TRUE(plinth) << turn;
        const Similarity& pose = desk.session().state().world_from_object;
        const double lowest_m = (pose * Vec3(0.0)).y - 0.04 * pose.scale;
        EXPECT_NEAR(plinth->top_center_world.y, lowest_m, 0.002 * pose.scale * 0.08) << turn;
    }
}

TEST(DeskView, ThePlinthIsLeftOutWhereItWouldHideThePart) {
    const Box ball{Vec3(-0.04), Vec3(0.04)};
    const Similarity high{Vec3(0.0, 1.8, -0.3), Quat(1.0, 0.0, 0.0, 0.0), 5.0};
    EXPECT_TRUE(plinth_under(ball, high, {0.0, 2.0, 2.0}).visible);
    EXPECT_FALSE(plinth_under(ball, high, {0.0, 1.3, 2.0}).visible) << "seen from below";
    const Similarity huge{Vec3(0.0, 3.0, -0.3), Quat(1.0, 0.0, 0.0, 0.0), 60.0};
    EXPECT_FALSE(plinth_under(ball, huge, {0.0, 1.6, 2.0}).visible) << "lower than the floor, and up to the viewer";
}

}  // namespace burin::session
