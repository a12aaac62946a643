// SPDX-License-Identifier: MIT
// The roles beside a live session: what it watches, logs and queues.
#include <gtest/gtest.h>

#include "compute/engine/chosen_engine.hpp"
#include "desk/live/desk.hpp"
#include "desk/panel/panel.hpp"
#include "desk/run/session.hpp"
#include "tests/desk/viewed.hpp"
#include "tests/session/carving_setup.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/test_units.hpp"

namespace burin::session {
namespace {

Viewed before(const std::string& wall) {
    DeskOptions options;
    options.wall = std::string(kWallsFolder) + "/" + wall;
    return block_before_wall(session_wall(options).value());
}

// Returns how far the scene moved with a wand that pressed its first button where it pointed at the main screen from x,
// y, and was then raised by 10 cm.
double carried_m(double x_world, double y_world) {
    SessionSetup options = carving_setup();
    options.carve.workpiece = {"ball:0.1", 32, false};
    options.carve.engine = compute::EngineChoice::cpu;
    options.desk.wall = std::string(kWallsFolder) + "/powerwall.toml";
    SimulatedClock clock;
    const SessionWall wall = session_wall(options.desk).value();
    const auto desk = Desk::create(options, wall, clock).value();
    const auto step = [&](Nanoseconds time_ns, const std::vector<InputEvent>& events) {
        desk->step({time_ns, time_ns, events}, {.size = {1440, 1080}}, haptics::ToolState{},
                   [](const scene::SceneThread::Order&) {});
    };
    const auto wand = [&](double y) { return WandInput{0, {{x_world, y, 1.0}, Quat{1, 0, 0, 0}}, true}; };
    step(10'000'000, {{10'000'000, wand(y_world)}});
    const Vec3 before_world = desk->session().state().world_from_object.position_m;
    step(20'000'000, {{20'000'000, WandClick{0, 0, true}}});
    step(30'000'000, {{30'000'000, wand(y_world + 0.1)}});
    return glm::length(desk->session().state().world_from_object.position_m - before_world);
}

// Returns how many files a session asks for when a log wants a mesh and a picture in each of two ways.
std::size_t files_asked_for(bool writes_nothing) {
    const Workplace place;
    SessionSetup options = carving_setup();
    options.carve.workpiece = {"ball:0.1", 32, false};
    options.carve.engine = compute::EngineChoice::cpu;
    options.record.input = "script.txt";
    options.work.outputs = (place / "out").string();
    options.work.writes_nothing = writes_nothing;
    SimulatedClock clock;
    const auto desk = Desk::create(options, session_wall(options.desk).value(), clock).value();
    std::size_t meshes = 0;
    const std::vector<InputEvent> events{{0, CommandInput{"export", {"a.stl"}}},
                                         {0, CommandInput{"export-mesh", {}}},
                                         {0, CommandInput{"screenshot", {"a.png"}}},
                                         {0, CommandInput{"take-screenshot", {}}}};
    desk->step({10'000'000, 10'000'000, events}, {.size = {640, 360}}, haptics::ToolState{}, [&](const auto& order) {
        order();
        desk->session().finish_scene();
        // The second export takes the place of the first, whose name it has.
        for (const auto& entry : std::filesystem::recursive_directory_iterator(place / "."))
            if (entry.path().extension() == ".stl") meshes += std::filesystem::remove(entry.path()) ? 1 : 0;
    });
    return meshes + desk->session().files().take_pictures().size();
}

}  // namespace

TEST(ComfortWatch, WarnsOnceEachTimeThatTheStrainBegins) {
    Viewed viewed = before("powerwall.toml");
    haptics::ToolState tool;
    tool.proxy_object_m = viewed.room.workpiece_object.center();
    ComfortWatch watch;
    EXPECT_FALSE(watch.look(viewed.seen(), tool));
    const Vec3 home_m = viewed.state.world_from_object.position_m;
    for (int time = 0; time < 2; ++time) {
        viewed.state.world_from_object.position_m = home_m + Vec3(0.0, 0.0, 1.5);
        const auto warning = watch.look(viewed.seen(), tool);
        ASSERT_TRUE(warning);
        EXPECT_FALSE(warning->empty());
        EXPECT_FALSE(watch.look(viewed.seen(), tool)) << "not in each frame";
        viewed.state.world_from_object.position_m = home_m;
        EXPECT_FALSE(watch.look(viewed.seen(), tool));
    }
    viewed.state.world_from_object.position_m = home_m + Vec3(0.0, 0.0, 1.5);
    viewed.viewer.output.mode = wall::StereoMode::mono;
    EXPECT_FALSE(watch.look(viewed.seen(), tool)) << "one picture for both eyes strains nobody";
}

TEST(WandWatch, TellsOnceOfAWandThatIsReportedInMillimetresAndLeavesTheSceneAlone) {
    Viewed viewed = before("cave.toml");
    const Similarity before = viewed.state.world_from_object;
    WandWatch watch;
    std::vector<std::string> told;
    const auto step_at = [&](int frame, double unit) {
        const Nanoseconds time_ns = 10'000'000 * (frame + 1);
        const Pose pose{Vec3(0.1 + 0.001 * frame, 1.2, 0.8) * unit, Quat{1, 0, 0, 0}};
        const std::vector<InputEvent> events{{time_ns, WandInput{0, pose, true}},
                                             {time_ns, WandClick{0, 0, frame < 30}}};
        static_cast<void>(
            viewed.step(events, {.dt_s = 0.01, .tool = {}}, {.display_ns = time_ns, .eye_size = {1280, 720}}));
        if (auto says = watch.look(viewed.viewer.wands)) told.push_back(*says);
    };
    for (int frame = 0; frame < 20; ++frame) step_at(frame, 1000.0);
    ASSERT_EQ(told.size(), 1u);
    EXPECT_NE(told[0].find("wand 0"), std::string::npos) << told[0];
    EXPECT_NE(told[0].find("millimetres"), std::string::npos) << told[0];
    EXPECT_EQ(viewed.state.world_from_object, before);
    for (int frame = 20; frame < 30; ++frame) step_at(frame, 1.0);
    EXPECT_EQ(told.size(), 2u);
    EXPECT_GT(glm::length(viewed.state.world_from_object.position_m - before.position_m), 0.005)
        << "it holds the scene now";
}

TEST(TrackerWatch, TellsOfALossAndOfItsEndOnce) {
    Viewed viewed = before("cave.toml");
    TrackerWatch watch;
    EXPECT_FALSE(watch.look(viewed.viewer, viewed.desk, 0)) << "there is no tracker";
    const auto step_at = [&](Nanoseconds time_ns, bool sees) {
        std::vector<InputEvent> events;
        if (sees) events.push_back({time_ns, HeadInput{{{0.0, 1.6, 1.5}, Quat{1, 0, 0, 0}}, true}});
        static_cast<void>(
            viewed.step(events, {.dt_s = 0.01, .tool = {}}, {.display_ns = time_ns, .eye_size = {1280, 720}}));
        return watch.look(viewed.viewer, viewed.desk, time_ns);
    };
    constexpr Nanoseconds kFrame_ns = 10'000'000;
    Nanoseconds now_ns = kFrame_ns;
    for (int i = 0; i < 10; ++i, now_ns += kFrame_ns)
        EXPECT_FALSE(step_at(now_ns, true)) << "all is well from the start";
    int told = 0;
    for (int i = 0; i < 300; ++i, now_ns += kFrame_ns) {
        const auto lost = step_at(now_ns, false);
        if (!lost) continue;
        ++told;
        EXPECT_EQ(lost->find("head tracker: "), 0u) << *lost;
        EXPECT_NE(watch.report().state, wall::TrackerState::ok);
    }
    EXPECT_EQ(told, 1);
    told = 0;
    for (int i = 0; i < 50; ++i, now_ns += kFrame_ns) {
        const auto found = step_at(now_ns, true);
        if (!found) continue;
        ++told;
        EXPECT_EQ(*found, "the tracker sees the head again");
    }
    EXPECT_EQ(told, 1);
    EXPECT_EQ(watch.report().state, wall::TrackerState::ok);
}

TEST(LampWatch, ATurningWorkpieceIsNotLitAnewUntilItHasRested) {
    SessionState state;
    LampWatch watch;
    Nanoseconds now_ns = 0;
    bool held = false;  // by the button that turns it
    const auto look = [&](Nanoseconds later_ns) { return watch.look(state, held, now_ns += later_ns * kMs); };
    const auto first = look(0);
    ASSERT_TRUE(first) << "the carving side does not know the lamp yet";
    EXPECT_FALSE(look(16));
    const auto turn = [&](double angle_rad) {
        state.world_from_object.orientation = glm::angleAxis(angle_rad, Vec3(1.0, 0.0, 0.0));
    };
    held = true;
    for (int i = 1; i < 100; ++i) {
        turn(0.02 * i);
        EXPECT_FALSE(look(16)) << "all of its surface would be lit for a moment";
    }
    EXPECT_FALSE(look(100));
    EXPECT_TRUE(look(60)) << "the hand holds it still";
    turn(1.0);
    EXPECT_FALSE(look(16));
    held = false;
    const auto last = look(16);
    ASSERT_TRUE(last) << "it rests where it is";
    EXPECT_GT(glm::length(last->direction_object - first->direction_object), 0.1);
    EXPECT_FALSE(look(16));
}

TEST(MessageLog, ShowsRecordedEventsInPlaceOfItsOwnInAReplay) {
    testing::internal::CaptureStderr();
    MessageLog log;
    log.notify("undone", MessageKind::info, {"script.txt:3: ", " (elsewhere)"});
    EXPECT_EQ(log.newest(), "undone") << "what the panel shows depends on no file's name";
    log.notify_of_event("a monitor has gone");
    EXPECT_EQ(log.newest(), "undone") << "a recording keeps it between two steps";
    EXPECT_EQ(log.take_events(), std::vector<std::string>{"a monitor has gone"}) << "no message of the input's";
    EXPECT_EQ(log.newest(), "a monitor has gone");
    EXPECT_TRUE(log.take_events().empty());
    const std::vector<std::string> recorded{"the tracker is there", "wrote it"};
    log.replay_events(recorded);
    EXPECT_EQ(log.newest(), "wrote it");
    log.notify_of_event("not as recorded");
    EXPECT_EQ(log.newest(), "wrote it");
    log.replay_events({});
    EXPECT_EQ(log.newest(), "wrote it");
    log.notify("undone again");
    EXPECT_EQ(log.newest(), "undone again");
    const std::string said = testing::internal::GetCapturedStderr();
    for (const char* line :
         {"burin: script.txt:3: undone (elsewhere)\n", "burin: a monitor has gone\n", "burin: not as recorded\n"})
        EXPECT_NE(said.find(line), std::string::npos) << said;
}

// A switch of the amplifiers and the fault that it brings may be told in one step.
TEST(MessageLog, HasTheOrderThatAReplayHas) {
    MessageLog live, again;
    live.notify_of_event("the amplifiers are off");
    live.notify("no force");
    const std::vector<std::string> recorded = live.take_events();
    again.replay_events({});
    again.notify("no force");
    again.replay_events(recorded);
    ASSERT_EQ(live.all().size(), 2u);
    ASSERT_EQ(again.all().size(), 2u);
    for (const std::size_t i : {0u, 1u}) EXPECT_EQ(live.all()[i].text, again.all()[i].text) << i;
}

TEST(Desk, ThatWritesNothingOrdersNeitherMeshesNorPictures) {
    EXPECT_EQ(files_asked_for(false), 4u);
    EXPECT_EQ(files_asked_for(true), 0u);
}

TEST(Desk, OffersToolSizesThatSuitItsWorkpiece) {
    SessionSetup options = carving_setup();
    options.carve.workpiece = {"ball:0.01", 32, false};
    options.carve.engine = compute::EngineChoice::cpu;
    SimulatedClock clock;
    const auto desk = Desk::create(options, session_wall(options.desk).value(), clock).value();
    // Where the slider is, by a panel of the same size; on a desk it is at the right of the window.
    const ImageSize window{1280, 900}, size{static_cast<std::uint32_t>(kPanelWidth_px), window.height};
    Panel alike = Panel::create({.size = size}).value();
    PanelModel model;
    model.tool = desk->session().state().led().tool.shape;
    static_cast<void>(alike.show(model, 0));
    const auto slider = alike.place_of("radius").value();
    const double y_px = slider.y + 0.5 * slider.height, left_px = window.width - size.width + slider.x;
    Nanoseconds now_ns = 0;
    const auto step = [&](const Input& input) {
        now_ns += 16'000'000;
        const std::vector<InputEvent> events{{now_ns, input}};
        desk->step({now_ns, now_ns, events}, {.size = window}, haptics::ToolState{},
                   [](const scene::SceneThread::Order&) {});
    };
    step(MouseMove{{left_px + 0.5 * slider.width, y_px}});
    step(MouseClick{MouseButton::left, true, {}});
    step(MouseMove{{left_px + slider.width + 2.0, y_px}});  // to the end
    EXPECT_DOUBLE_EQ(descriptor_of(Quantity::radius).value(desk->session().state()), 0.01)
        << "half of the longest side";
}

// The mouse in the panel's own window works the panel and not the scene, and the other way round; the picture has none.
TEST(LivePanel, IsWorkedInItsOwnWindowAlone) {
    SessionSetup options = carving_setup();
    options.carve.workpiece = {"ball:0.02", 16, false};
    options.hands.tool.shape = "ball:0.001";
    options.carve.engine = compute::EngineChoice::cpu;
    options.desk.panel_window = true;
    SimulatedClock clock;
    const auto desk = Desk::create(options, session_wall(options.desk).value(), clock).value();
    const ImageSize window{1280, 900}, size{static_cast<std::uint32_t>(kPanelWidth_px), 700}, own{400, 700};
    Panel alike = Panel::create({.size = size}).value();
    PanelModel model;
    model.tool = desk->session().state().led().tool.shape;
    static_cast<void>(alike.show(model, 0));
    const auto slider = alike.place_of("radius").value();
    Nanoseconds now_ns = 0;
    const auto step = [&](const Input& input) {
        now_ns += 16'000'000;
        const std::vector<InputEvent> events{{now_ns, input}};
        desk->step(
            {now_ns, now_ns, events}, {.size = window}, haptics::ToolState{}, [](const scene::SceneThread::Order&) {},
            own);
    };
    const auto drag = [&](double left_px) {
        const double y_px = slider.y + 0.5 * slider.height;
        step(MouseMove{{left_px + slider.x + 0.5 * slider.width, y_px}});
        step(MouseClick{MouseButton::left, true, {}});
        step(MouseMove{{left_px + slider.x + slider.width + 2.0, y_px}});  // to the end
        step(MouseClick{MouseButton::left, false, {}});
    };
    const auto radius_m = [&] { return descriptor_of(Quantity::radius).value(desk->session().state()); };
    drag(window.width - kPanelWidth_px);
    EXPECT_DOUBLE_EQ(radius_m(), 0.001) << "where it would be over the picture there is none";
    const Vec3 hand_device_m = desk->viewer().desk.target_device_m;
    drag(kPanelWindow_px + own.width - kPanelWidth_px);
    EXPECT_DOUBLE_EQ(radius_m(), 0.02) << "half of the longest side";
    EXPECT_EQ(desk->viewer().desk.target_device_m, hand_device_m) << "no motion of the hand";
    EXPECT_FALSE(desk->panel_on(0)) << "the picture shows the scene alone";
    ASSERT_TRUE(desk->panel_on(1));
    EXPECT_EQ(desk->panel_on(1)->size, size);
    EXPECT_FALSE(desk->scene_on(1)) << "and its window the panel alone";
    step(KeyInput{Key::tab, KeyMotion::press, {}});
    EXPECT_TRUE(desk->panel_on(1)) << "there it cannot be hidden";
}

TEST(LivePanel, KeepsAWandsPressesOnAStandingPanelFromTheScene) {
    EXPECT_NEAR(carried_m(-0.3, 1.25), 0.1, 1e-6) << "beside the panel the wand carries the scene";
    EXPECT_EQ(carried_m(1.05, 1.25), 0.0) << "on the panel it does not";
}

namespace {

// A script that refuses to begin needs no graphics device.
SessionSetup scripted(const Workplace& place, const std::string& script) {
    place.write("script.txt", "burin-input 1\n" + script);
    SessionSetup options = carving_setup();
    options.carve.workpiece = {"ball:0.1", 32, false};
    options.record.input = (place / "script.txt").string();
    options.desk.offscreen = true;
    return options;
}

}  // namespace

TEST(RunSession, RefusesWhatOnlyCarvingAlongAStrokeDoesAndSaysWhatToDoInstead) {
    const Workplace place;
    const SessionSetup plain = scripted(place, "0.1 command quit\n");
    const auto refused = [&](const std::string& option, const SessionSetup& options) {
        const auto outcome = run_session(options);
        ASSERT_FALSE(outcome) << option;
        EXPECT_EQ(outcome.error().where, option);
        EXPECT_FALSE(outcome.error().remedy.empty()) << option;
    };
    SessionSetup options = plain;
    options.carve.stroke.file = "stroke.csv";
    refused("--stroke", options);
    options = plain;
    options.carve.exports.files = {"part.stl"};
    refused("--export", options);
    options = plain;
    options.carve.stroke.pictures = "pictures";
    refused("--pictures", options);
    options = plain;
    options.carve.stroke.report = "report.json";
    refused("--report", options);
}

TEST(RunSession, NamesAFolderForScreenshotsThatCannotBeMade) {
    const Workplace place;
    SessionSetup options = scripted(place, "0.1 command quit\n");
    place.write("file", "");
    options.desk.screenshots = (place / "file").string() + "/shots";
    const auto outcome = run_session(options);
    ASSERT_FALSE(outcome);
    EXPECT_EQ(outcome.error().where, options.desk.screenshots);
    EXPECT_TRUE(outcome.error().line().contains("--screenshots")) << outcome.error().line();
}

}  // namespace burin::session
