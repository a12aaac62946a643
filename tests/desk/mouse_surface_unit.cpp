// SPDX-License-Identifier: MIT
// The mouse as a hand on the surface of an own part: where the tool goes, how deep a stroke is, what a stroke does
// where the ray leaves what it was on.
#include <map>
#include <set>

#include "tests/desk/mouse_desk.hpp"

namespace burin::session {
namespace {

constexpr double kThick_mm = 12.0, kRadius_mm = 4.0, kDepth_mm = 0.3 * kRadius_mm;  // as a session begins
// How much less deep a stroke is than set: what the material bears up, by the arm's stiffness.
constexpr double kBears_mm = 0.06;

double to_segment_mm(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double t = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::length(p - a - t * along);
}

// The groove of a drag along x, in slices across: its depth, and where its middle is.
struct Groove {
    std::vector<double> depths_mm, middles_mm;
    [[nodiscard]] double drift_mm() const { return std::ranges::max(middles_mm) - std::ranges::min(middles_mm); }
};
Groove groove_along_x(const MouseDesk& desk, double from_mm, double to_mm, double near_y_mm, double width_mm) {
    const double slice_mm = 2.0 * desk.cell_mm();
    const std::vector<Vec3> carved = desk.vertices_mm();
    Groove groove;
    for (double x = from_mm; x < to_mm; x += slice_mm) {
        double lowest = kThick_mm, least_y = 1e9, most_y = -1e9;
        for (const Vec3& p : carved) {
            if (std::abs(p.x - x) > slice_mm || std::abs(p.y - near_y_mm) > width_mm || p.z < 0.5) continue;
            lowest = std::min(lowest, p.z);
            if (p.z > kThick_mm - 0.25 * kDepth_mm) continue;
            least_y = std::min(least_y, p.y);
            most_y = std::max(most_y, p.y);
        }
        groove.depths_mm.push_back(kThick_mm - lowest);
        groove.middles_mm.push_back(0.5 * (least_y + most_y));
    }
    return groove;
}

}  // namespace

TEST(MouseOnSurface, ALetterDraggedIntoAnOwnPartIsAsDeepAsSetAlongItsWholeWay) {
    MouseDesk desk(plate(kThick_mm));
    const std::vector<Vec3> letter{{12, 48, 12}, {66, 48, 12}, {14, 12, 12}, {66, 12, 12}};
    desk.stroke(letter);
    EXPECT_EQ(desk.strokes(), 1u);
    // Along each bar, a millimetre apart, the deepest of the mesh near it is as deep as set.
    const std::vector<Vec3> carved = desk.vertices_mm();
    for (std::size_t bar = 1; bar < letter.size(); ++bar) {
        const int steps = static_cast<int>(glm::length(letter[bar] - letter[bar - 1]));
        for (int i = 1; i < steps; ++i) {
            const Vec3 on_bar = glm::mix(letter[bar - 1], letter[bar], 1.0 * i / steps);
            double depth = 0.0;
            for (const Vec3& p : carved)
                if (p.z > 6.0 && glm::length(Vec2(p) - Vec2(on_bar)) < 1.5 * desk.cell_mm())
                    depth = std::max(depth, kThick_mm - p.z);
            EXPECT_NEAR(depth, kDepth_mm, kBears_mm) << "bar " << bar << " at " << on_bar.x << ", " << on_bar.y;
        }
    }
    // And beside the letter nothing is gone. The ball's groove is 2 sqrt(2 r d - d^2) wide.
    const double half_width = std::sqrt(2.0 * kRadius_mm * kDepth_mm - kDepth_mm * kDepth_mm) + desk.cell_mm();
    for (const Vec3& p : carved) {
        double near = 1e9;
        for (std::size_t bar = 1; bar < letter.size(); ++bar)
            near = std::min(near, to_segment_mm({p.x, p.y, kThick_mm}, letter[bar - 1], letter[bar]));
        const bool inside = p.x > 1.0 && p.x < 79.0 && p.y > 1.0 && p.y < 59.0 && p.z > 1.0;
        if (!inside || near <= half_width) continue;
        EXPECT_NEAR(p.z, kThick_mm, 1e-3) << p.x << ", " << p.y;
    }
}

TEST(MouseOnSurface, TheGrooveIsTheSameAt5And10And60FramesASecond) {
    std::map<int, Groove> grooves;
    double cell_mm = 0.0;
    for (const int rate : {5, 10, 60}) {
        MouseDesk desk(plate(kThick_mm), "ball:0.004", rate);
        desk.stroke({{15, 30, 12}, {65, 30, 12}});
        grooves[rate] = groove_along_x(desk, 18.0, 62.0, 30.0, 5.0);
        cell_mm = desk.cell_mm();
    }
    for (const int rate : {5, 10})
        for (std::size_t i = 0; i < grooves[60].depths_mm.size(); ++i) {
            EXPECT_NEAR(grooves[rate].depths_mm[i], grooves[60].depths_mm[i], 0.1 * cell_mm) << rate << " slice " << i;
            EXPECT_NEAR(grooves[rate].middles_mm[i], grooves[60].middles_mm[i], 0.1 * cell_mm) << rate;
        }
}

TEST(MouseOnSurface, EveryToolCutsAStraightGroove) {
    for (const std::string tool : {"ball:0.004", "cylinder:0.003,0.012", "cone:0.001,0.004,0.012",
                                   "bullnose:0.003,0.001,0.012", "box:0.003,0.006,0.003"}) {
        MouseDesk desk(plate(kThick_mm), tool);
        desk.stroke({{15, 30, 12}, {65, 30, 12}});
        const Groove groove = groove_along_x(desk, 20.0, 60.0, 30.0, 8.0);
        EXPECT_LT(groove.drift_mm(), 0.1 * desk.cell_mm()) << tool;
        EXPECT_NEAR(groove.middles_mm.front(), 30.0, 0.1) << tool << ": it is under the cursor";
        EXPECT_GT(std::ranges::min(groove.depths_mm), 0.2) << tool;
        EXPECT_LT(std::ranges::max(groove.depths_mm) - std::ranges::min(groove.depths_mm), 0.1 * desk.cell_mm())
            << tool;
        std::printf("%-28s drift %.4f mm, depth %.3f to %.3f mm\n", tool.c_str(), groove.drift_mm(),
                    std::ranges::min(groove.depths_mm), std::ranges::max(groove.depths_mm));
    }
}

// The hand went on feeling the tool that it had put down: a mill taken up on the panel stayed a ball's radius above
// what it should cut, and a box cut nothing.
TEST(MouseOnSurface, AToolTakenUpOnThePanelIsFeltAtOnce) {
    for (const std::string tool : {"cylinder", "box"}) {
        MouseDesk desk(plate(kThick_mm));
        desk.run({{CommandInput{"toggle-panel", {}}, 0}}, 100'000'000);
        const auto at = desk.desk->place_on_panel("tool " + tool);
        ASSERT_TRUE(at);
        desk.move_to({at->x + 0.5 * at->width, at->y + 0.5 * at->height});
        desk.run({{MouseClick{}, 50'000'000}, {MouseClick{MouseButton::left, false, {}}, 50'000'000}}, 100'000'000);
        desk.stroke({{15, 30, 12}, {45, 30, 12}});
        const Groove groove = groove_along_x(desk, 20.0, 40.0, 30.0, 8.0);
        EXPECT_NEAR(std::ranges::min(groove.depths_mm), kDepth_mm, kBears_mm) << tool;
        EXPECT_NEAR(std::ranges::max(groove.depths_mm), kDepth_mm, kBears_mm) << tool;
    }
}

// The hand needs a while to where the cursor has jumped; the stroke begins there all the same, and not on the way.
TEST(MouseOnSurface, AStrokeBeginsWhereTheButtonWentDownHoweverSoonAfterAJump) {
    for (const Nanoseconds after_ns : {0LL, 8'000'000LL, 20'000'000LL, 60'000'000LL}) {
        MouseDesk desk(plate(kThick_mm));
        desk.point_at({65, 15, 12});
        desk.run({{MouseMove{desk.px_of({20, 40, 12})}, 8'000'000}, {MouseClick{}, after_ns}}, 400'000'000);
        desk.release();
        double deepest = kThick_mm;
        for (const Vec3& p : desk.vertices_mm()) {
            if (p.x < 1.0 || p.x > 79.0 || p.y < 1.0 || p.y > 59.0 || p.z < 1.0) continue;
            deepest = std::min(deepest, p.z);
            if (glm::length(Vec2(p) - Vec2(20.0, 40.0)) <= 4.0 + desk.cell_mm()) continue;
            ASSERT_NEAR(p.z, kThick_mm, 1e-3) << after_ns << " ns: " << p.x << ", " << p.y;
        }
        EXPECT_NEAR(kThick_mm - deepest, kDepth_mm, 0.1) << after_ns << " ns";
    }
}

TEST(MouseOnSurface, APressThatRestsDoesNotDrill) {
    MouseDesk desk(plate(kThick_mm));
    desk.point_at({40, 30, 12});
    desk.press();
    const auto deepest = [&] {
        double z = kThick_mm;
        for (const Vec3& p : desk.vertices_mm())
            if (glm::length(Vec2(p) - Vec2(40.0, 30.0)) < 3.0 && p.z > 1.0) z = std::min(z, p.z);
        return kThick_mm - z;
    };
    const double soon = deepest();
    desk.rest(3.0);
    EXPECT_NEAR(soon, kDepth_mm, kBears_mm);
    EXPECT_NEAR(deepest(), kDepth_mm, kBears_mm) << "the surface under the cursor is gone, and the tool stays";
    desk.release();
    desk.press();
    EXPECT_NEAR(deepest(), 2.0 * kDepth_mm, 2.0 * kBears_mm) << "another stroke begins on what the first has left";
}

TEST(MouseOnSurface, AStrokeThatLeavesTheSilhouetteAndComesBackCutsNoDeeperAtTheEdge) {
    MouseDesk desk("");  // a ball of 40 mm
    desk.point_at({0, 0, 40});
    desk.press();
    const Vec2 from = desk.px_of({0, 0, 40}), edge = desk.px_of({40, 0, 0});
    const Vec2 beyond = from + 1.4 * (edge - from);
    desk.drag(from, beyond);
    desk.rest(0.5);
    EXPECT_EQ(desk.tool().buttons & 1u, 1u) << "the stroke goes on";
    EXPECT_GT(glm::length(desk.tool_mm()), 40.0 + kRadius_mm) << "and hovers";
    desk.drag(beyond, from);
    desk.release();
    EXPECT_EQ(desk.strokes(), 1u);
    double least = 1e9, at_the_rim = 1e9;
    for (const Vec3& p : desk.vertices_mm()) {
        least = std::min(least, glm::length(p));
        if (p.z < 8.0) at_the_rim = std::min(at_the_rim, glm::length(p));
    }
    EXPECT_NEAR(least, 40.0 - kDepth_mm, 2.0 * kBears_mm);
    EXPECT_GT(at_the_rim, 40.0 - kDepth_mm - 0.1);
}

TEST(MouseOnSurface, BothEyesSeeTheToolWhereTheCursorIsFromBetweenThem) {
    MouseDesk desk(plate(kThick_mm));
    desk.run({{CommandInput{"stereo-mode", {"anaglyph_red_cyan"}}, 8'000'000}}, 100'000'000);
    desk.point_at({60, 45, 12});
    EXPECT_LT(glm::length(Vec2(desk.tool_mm()) - Vec2(60.0, 45.0)), 0.05);
}

TEST(MouseOnSurface, TheToolComesThroughThePartToItsOtherSideAndIsNotCaught) {
    MouseDesk desk("");  // a ball of 40 mm
    desk.point_at({0, 0, 40});
    for (int turn = 0; turn < 12; ++turn) desk.run({{CommandInput{"turn-right", {}}, 8'000'000}}, 50'000'000);
    desk.point_at({0, 0, -40});
    desk.rest(0.5);
    EXPECT_LT(glm::length(desk.tool_mm() - Vec3(0.0, 0.0, -40.0 - 1.1 * kRadius_mm)), 0.1);
    desk.press();
    desk.release();
    double least = 1e9;
    for (const Vec3& p : desk.vertices_mm()) least = std::min(least, glm::length(p));
    EXPECT_NEAR(least, 40.0 - kDepth_mm, kBears_mm) << "and works there";
}

TEST(MouseOnSurface, KeysShowAllOfItFromTheFrontTheSideAndAbove) {
    MouseDesk desk(plate(kThick_mm));
    const auto out_object = [&] {  // what of the part faces the viewer
        const SessionState& state = desk.session().state();
        return glm::normalize(inverse(state.world_from_object) * desk.viewer().seen_from.eye_world -
                              state.middle_object);
    };
    const auto press = [&](Key key, const Modifiers& with = {}) {
        desk.run({{KeyInput{key, KeyMotion::press, with}, 8'000'000}, {KeyInput{key, KeyMotion::release, with}, 1}},
                 100'000'000);
    };
    const Vec3 head_before = desk.viewer().desk.head_world.position_m;
    press(Key::digit_3, {.ctrl = true});
    EXPECT_LT(glm::length(out_object() - Vec3(0.0, 1.0, 0.0)), 1e-3) << "its top";
    press(Key::digit_2, {.ctrl = true});
    EXPECT_LT(glm::length(out_object() - Vec3(1.0, 0.0, 0.0)), 1e-3) << "its right side";
    press(Key::right);
    press(Key::up);
    EXPECT_GT(glm::length(out_object() - Vec3(1.0, 0.0, 0.0)), 0.3);
    desk.move_to({300, 300});
    desk.run({{Scroll{{0.0, 8.0}, {}}, 8'000'000}}, 100'000'000);
    press(Key::f);
    press(Key::digit_1, {.ctrl = true});
    EXPECT_LT(glm::length(out_object() - Vec3(0.0, 0.0, 1.0)), 1e-3);
    EXPECT_EQ(desk.viewer().desk.head_world.position_m, head_before) << "arrow keys shear nothing";
}

TEST(MouseOnSurface, AStrokeIsMirroredShownOnBothSidesAndUndoneAsOne) {
    MouseDesk desk(plate(10.0));
    desk.run({{CommandInput{"mirror", {"x"}}, 0}});
    const auto glass = [&] {
        const auto scene = desk.desk->scene_on(0);
        return scene ? std::ranges::count_if(scene->objects, [](const auto& o) { return o.opacity < 1.0; }) : -1;
    };
    desk.stroke({{20.0, 20.0, 10.0}, {20.0, 40.0, 10.0}});
    EXPECT_EQ(glass(), 2) << "the plane, and the tool's image";
    EXPECT_EQ(desk.strokes(), 1u) << "for one undo";
    // How deep the plate is cut beside a place of its top, mm.
    const auto depth_at = [&](double x_mm) {
        double deepest = 0.0;
        for (const Vec3& p : desk.vertices_mm())
            if (std::abs(p.x - x_mm) < 1.0 && std::abs(p.y - 30.0) < 5.0 && p.z > 5.0)
                deepest = std::max(deepest, 10.0 - p.z);
        return deepest;
    };
    EXPECT_GT(depth_at(20.0), 0.5);
    EXPECT_NEAR(depth_at(60.0), depth_at(20.0), 0.1 * desk.cell_mm());
    EXPECT_LT(depth_at(40.0), 0.01);
    desk.run({{CommandInput{"undo", {}}, 0}}, 200'000'000);
    EXPECT_LT(depth_at(20.0), 0.01);
    EXPECT_LT(depth_at(60.0), 0.01);
    desk.run({{CommandInput{"mirror", {"none"}}, 0}}, 100'000'000);
    EXPECT_EQ(glass(), 0);
}

TEST(MouseOnSurface, AThinWallIsNeverEnteredFromBehind) {
    MouseDesk desk(plate(2.0));
    const double front = 2.0;
    desk.stroke({{15, 30, front}, {65, 30, front}});
    desk.stroke({{15, 45, front}, {65, 45, front}});
    double back = 0.0;
    std::size_t carved = 0;
    for (const Vec3& p : desk.vertices_mm()) {
        if (p.x < 1.0 || p.x > 79.0 || p.y < 1.0 || p.y > 59.0) continue;
        if (p.z < 0.5) back = std::max(back, std::abs(p.z));
        if (p.z > 0.5 && p.z < front - 0.1) ++carved;
    }
    EXPECT_GT(carved, 100u);
    EXPECT_NEAR(back, 0.0, 1e-3);
}

TEST(MouseOnSurface, AClickBesideTheWorkpieceSaysThatNothingWasTouchedAndADragTurnsTheScene) {
    MouseDesk desk(plate(kThick_mm));
    desk.move_to({30, 60});
    const Quat before = desk.session().state().world_from_object.orientation;
    const std::string told =
        desk.told_while({{MouseClick{}, 8'000'000}, {MouseClick{MouseButton::left, false, {}}, 50'000'000}});
    EXPECT_NE(told.find("nothing was touched"), std::string::npos) << told;
    EXPECT_EQ(desk.session().state().world_from_object.orientation, before);
    const std::string dragged = desk.told_while({{MouseClick{}, 8'000'000},
                                                 {MouseMove{{130, 60}}, 50'000'000},
                                                 {MouseClick{MouseButton::left, false, {}}, 50'000'000}});
    EXPECT_EQ(dragged, "");
    EXPECT_NE(desk.session().state().world_from_object.orientation, before);
    EXPECT_EQ(desk.strokes(), 0u);
}

TEST(MouseOnSurface, TheSceneDoesNotTurnWhileTheToolWorks) {
    MouseDesk desk(plate(kThick_mm));
    desk.point_at({40, 30, 12});
    desk.press();
    const Similarity before = desk.session().state().world_from_object;
    desk.run({{MouseClick{MouseButton::right, true, {}}, 8'000'000},
              {MouseMove{{700, 300}}, 8'000'000},
              {MouseClick{MouseButton::right, false, {}}, 8'000'000}},
             50'000'000);
    EXPECT_EQ(desk.session().state().world_from_object, before);
    desk.release();
    desk.run({{MouseClick{MouseButton::right, true, {}}, 8'000'000}, {MouseMove{{600, 300}}, 8'000'000}}, 50'000'000);
    EXPECT_NE(desk.session().state().world_from_object, before);
}

TEST(MouseOnSurface, TheWheelKeepsWhatIsUnderTheCursorThere) {
    MouseDesk desk(plate(kThick_mm));
    const Vec3 place_mm{60, 45, 12};
    const Vec2 px = desk.px_of(place_mm);
    desk.point_at(place_mm);
    desk.run({{Scroll{{0.0, 5.0}, {}}, 8'000'000}}, 100'000'000);
    EXPECT_GT(desk.session().state().world_from_object.scale,
              1.5 * desk.session().state().home_world_from_object.scale);
    EXPECT_LT(glm::length(desk.px_of(place_mm) - px), 0.5);
}

TEST(MouseOnSurface, TheWheelMakesAStrokeDeeperWhileTheButtonIsDown) {
    MouseDesk desk(plate(kThick_mm));
    desk.point_at({40, 30, 12});
    desk.press();
    const Similarity before = desk.session().state().world_from_object;
    desk.run({{Scroll{{0.0, 5.0}, {}}, 8'000'000}}, 500'000'000);
    EXPECT_EQ(desk.session().state().world_from_object, before);
    EXPECT_NEAR(desk.viewer().desk.strength, 0.3 * std::pow(1.1, 5.0), 1e-9);
    double lowest = kThick_mm;
    for (const Vec3& p : desk.vertices_mm())
        if (p.z > 1.0 && glm::length(Vec2(p) - Vec2(40.0, 30.0)) < 3.0) lowest = std::min(lowest, p.z);
    EXPECT_NEAR(kThick_mm - lowest, kDepth_mm * std::pow(1.1, 5.0), 1.5 * kBears_mm);
}

TEST(MouseOnSurface, TheToolStandsUprightOnTheSurfaceUnderTheCursor) {
    MouseDesk desk(plate(kThick_mm), "cylinder:0.003,0.012");
    for (const Vec3& place_mm : {Vec3(20, 15, 12), Vec3(60, 45, 12), Vec3(40, 30, 12)}) {
        desk.point_at(place_mm);
        EXPECT_LT(glm::length(Vec2(desk.tool_mm()) - Vec2(place_mm)), 0.05);
        EXPECT_NEAR(desk.tool_mm().z, 12.0 + 0.1 * 3.0, 0.05) << "its tip hovers by a tenth of its half width";
        const Vec3 axis = desk.tool().tool_orientation_object * Vec3(0.0, 1.0, 0.0);
        EXPECT_GT(axis.z, 0.9999);
    }
}

TEST(MouseOnSurface, MaterialIsAddedAboveTheTopAndTheBorderOfTheRoomIsShownNearIt) {
    MouseDesk desk(plate(kThick_mm), "ball:0.004", 60, 128, 0.4);
    desk.run({{CommandInput{"operation", {"fill"}}, 0}}, 100'000'000);
    const double border_mm = 1e3 * desk.session().room().lattice_object.hi.z;
    EXPECT_NEAR(border_mm, kThick_mm + 0.4 * 80.0, 2.0);
    const auto highest = [&] {
        double z = 0.0;
        for (const Vec3& p : desk.vertices_mm()) z = std::max(z, p.z);
        return z;
    };
    desk.stroke({{40, 30, kThick_mm}});
    EXPECT_NEAR(highest(), kThick_mm + 2.0 * 4.0 - kDepth_mm, 0.1)
        << "as high as the ball, less the depth, however long it is pressed";
    EXPECT_FALSE(desk.desk->scene_on(0)->proposed_box.visible);
    for (int again = 0; again < 5; ++again) desk.stroke({{40, 30, highest()}});
    EXPECT_LE(highest(), border_mm);
    EXPECT_GT(highest(), border_mm - 2.0) << "up to the border";
    EXPECT_TRUE(desk.desk->scene_on(0)->proposed_box.visible);
}

TEST(MouseOnSurface, RoomIsForWhoAddsAndLogsOfBeforeHaveNone) {
    SessionSetup person, log, cut, added, given, untouched;
    log.record.input = "log.txt";
    cut.carve.stroke.file = added.carve.stroke.file = "stroke.csv";
    added.hands.tool.operation = compute::Operation::fill;
    given.carve.workpiece.room = 0.4;
    for (SessionSetup* options : {&person, &log, &given}) settle_room(*options, true);
    for (SessionSetup* options : {&cut, &added, &untouched}) settle_room(*options, false);
    EXPECT_EQ(person.carve.workpiece.room, workpiece::kUsualRoom);
    EXPECT_EQ(log.carve.workpiece.room, 0.0);
    EXPECT_EQ(cut.carve.workpiece.room, 0.0);
    EXPECT_EQ(untouched.carve.workpiece.room, 0.0);
    EXPECT_EQ(added.carve.workpiece.room, workpiece::kUsualRoom);
    EXPECT_EQ(given.carve.workpiece.room, 0.4);
}

// Off screen it once kept every tile as often as it had changed: some megabytes a stroke.
TEST(MouseOnSurface, StrokesThatNobodyDrawsKeepEachTileOnce) {
    MouseDesk desk(plate(kThick_mm));
    static_cast<void>(desk.desk->take_surface_updates());
    desk.draws = false;
    for (int i = 0; i < 3; ++i) desk.stroke({{20.0, 20.0 + 3.0 * i, kThick_mm}, {60.0, 20.0 + 3.0 * i, kThick_mm}});
    const auto updates = desk.desk->take_surface_updates();
    ASSERT_EQ(updates.size(), 1u);
    std::set<std::uint32_t> tiles;
    for (const scene::TileUpdate& tile : updates[0].tiles) {
        EXPECT_TRUE(tiles.insert(tile.tile).second) << tile.tile;
        EXPECT_EQ(tile.surface, desk.session().scene_side().surface()->shared_tile(tile.tile)) << "the newest";
    }
    EXPECT_GT(tiles.size(), 3u);
    EXPECT_EQ(updates[0].undoable, 3u);
}

TEST(MouseOnSurface, IsForWhoHasAMouseAndLogsOfBeforeFlyFreely) {
    SessionSetup options;
    ASSERT_TRUE(settle_mouse(options));
    EXPECT_EQ(options.hands.mouse, MouseMode::surface);
    EXPECT_EQ(options.hands.device, "mouse");
    SessionSetup log;
    log.record.input = "log.txt";
    ASSERT_TRUE(settle_mouse(log));
    EXPECT_EQ(log.hands.mouse, std::nullopt);
    EXPECT_EQ(log.hands.device, "simulated");
    SessionSetup given;
    ASSERT_TRUE(set_devices(given.hands, {"simulated"}));
    ASSERT_TRUE(settle_mouse(given));
    EXPECT_EQ(given.hands.device, "simulated") << "who gives a device has it";
    SessionSetup felt;
    ASSERT_TRUE(set_devices(felt.hands, {"omni:emulated"}));
    ASSERT_TRUE(settle_mouse(felt));
    EXPECT_EQ(felt.hands.mouse, std::nullopt) << "a hand leads it";
    felt.hands.mouse = MouseMode::surface;
    const auto refused = settle_mouse(felt);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().line().find("omni:emulated"), std::string::npos);
    // A hand that a SpaceMouse or a recording leads is none for the mouse, and what it touches does not wait for a
    // button.
    for (const char* device : {"spacemouse", "spacemouse:emulated"}) {
        SessionSetup led;
        led.hands.device = device;
        led.hands.device_given = true;
        ASSERT_TRUE(settle_mouse(led));
        EXPECT_EQ(led.hands.mouse.value_or(MouseMode::free), MouseMode::free) << device;
        led.hands.mouse = MouseMode::surface;
        const auto no = settle_mouse(led);
        ASSERT_FALSE(no);
        EXPECT_TRUE(no.error().what.contains("leads itself")) << no.error().line();
    }
}

}  // namespace burin::session
