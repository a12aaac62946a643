// SPDX-License-Identifier: MIT
// A world before a person in a desktop's window: in what the panel leaves free, with the tool under the cursor, and not
// closed over edits without a word.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "desk/live/desk.hpp"
#include "session/drive/driver.hpp"
#include "session/objects/object_turn.hpp"
#include "session/state/session_settings.hpp"
#include "tests/session/carving_setup.hpp"
#include "tests/support/run_command.hpp"
#include "wall/projection.hpp"

namespace burin::session {
namespace {

constexpr ImageSize kFramedWindow{1280, 720};

// A plate, and a stone at its right end.
class FramedWorld {
public:
    explicit FramedWorld(bool framed = true) {
        place_.write("t.off", "OFF\n4 4 0\n0 0 0\n0.1 0 0\n0 0.1 0\n0 0 0.1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
        place_.write(
            "w.toml",
            "[[object]]\nname = \"left\"\nmesh = \"t.off\"\nmesh_units = \"m\"\n"
            "[[object]]\nname = \"right\"\nmesh = \"t.off\"\nmesh_units = \"m\"\nposition = [0.3, 0.0, 0.0]\n");
        options.scene.world = (place_ / "w.toml").string();
        options.scene.no_workpiece = true;
        options.desk.frames_world = framed;
        options.desk.width = static_cast<int>(kFramedWindow.width);
        options.desk.height = static_cast<int>(kFramedWindow.height);
        auto made = Desk::create(options, session_wall(options.desk).value(), clock);
        if (!made) throw std::runtime_error(made.error().line());
        desk = std::move(*made);
        desk->take_loaded();
    }
    void frame(const std::vector<Input>& inputs = {}) {
        clock.sleep_until(clock.now_ns() + 10'000'000);
        std::vector<InputEvent> events;
        for (const CommandInput& told : desk->session().take_told()) events.push_back({clock.now_ns(), told});
        for (const Input& input : inputs) events.push_back({clock.now_ns(), input});
        desk->step({clock.now_ns(), clock.now_ns(), events}, {.size = kFramedWindow}, desk->session().newest_tool(),
                   [](const scene::SceneThread::Order& order) { order(); });
        ASSERT_TRUE(desk->session().scene().update(clock.now_ns()));
        static_cast<void>(desk->session().collect({}));
        desk->take_news(Executor::kAllCollected);
    }
    void command(const std::string& name, std::vector<std::string> arguments = {}) {
        frame({CommandInput{name, std::move(arguments)}});
    }
    // Pixels of the window.
    [[nodiscard]] Vec2 seen_px(const Vec3& place_world) const {
        const SeenFrom& from = desk->viewer().seen_from;
        const Vec2 at = wall::point_on_screen(from.screen, from.eye_world, place_world);
        const double width_m = glm::length(from.screen.lower_right_world - from.screen.lower_left_world),
                     height_m = glm::length(from.screen.upper_left_world - from.screen.lower_left_world);
        return {at.x / width_m * kFramedWindow.width, (1.0 - at.y / height_m) * kFramedWindow.height};
    }
    struct Extent {
        Vec2 lo{1e9}, hi{-1e9};
    };
    [[nodiscard]] Extent extent_px(const std::vector<scene::ObjectId>& ids) const {
        Extent all;
        for (const scene::ObjectId id : ids) {
            const scene::SceneObject& object = *state().world->find(id);
            for (const Vec3& place : object.mesh->positions_m) {
                const Vec2 px = seen_px(state().world_from_object * (object.pose * (object.scale * place)));
                all.lo = glm::min(all.lo, px);
                all.hi = glm::max(all.hi, px);
            }
        }
        return all;
    }
    [[nodiscard]] double free_px() const { return desk->viewer().seen_from.free_width * kFramedWindow.width; }
    [[nodiscard]] const SessionState& state() const { return desk->session().state(); }

    SessionSetup options = carving_setup();
    SimulatedClock clock;
    std::unique_ptr<Desk> desk;

private:
    Workplace place_;
};

void expect_free(const FramedWorld& world, const std::vector<scene::ObjectId>& ids) {
    const auto [lo, hi] = world.extent_px(ids);
    EXPECT_GE(lo.x, 0.0);
    EXPECT_GE(lo.y, 0.0);
    EXPECT_LE(hi.x, world.free_px()) << "the panel covers it";
    EXPECT_LE(hi.y, kFramedWindow.height);
}

const std::vector<scene::ObjectId> kBothObjects{1, 2};

}  // namespace

TEST(FramedWorldSession, NothingOfItLiesUnderThePanelWhenItOpens) {
    FramedWorld world;
    world.frame();
    ASSERT_LT(world.desk->viewer().seen_from.free_width, 0.8);
    expect_free(world, kBothObjects);
    const auto [lo, hi] = world.extent_px(kBothObjects);
    EXPECT_NEAR(0.5 * (lo.x + hi.x), 0.5 * world.free_px(), 0.06 * kFramedWindow.width) << "in the middle of it";
}

TEST(FramedWorldSession, HomeShowsAllAndFTheChosenObject) {
    FramedWorld world;
    world.frame();
    const double all_px = world.extent_px({2}).hi.y - world.extent_px({2}).lo.y;
    world.command("select", {"right"});
    world.frame({KeyInput{Key::f, KeyMotion::press, {}}});
    const double alone_px = world.extent_px({2}).hi.y - world.extent_px({2}).lo.y;
    EXPECT_GT(alone_px, 1.3 * all_px);
    expect_free(world, {2});
    world.frame({KeyInput{Key::home, KeyMotion::press, {}}});
    EXPECT_NEAR(world.extent_px({2}).hi.y - world.extent_px({2}).lo.y, all_px, 1.0);
    expect_free(world, kBothObjects);
}

TEST(FramedWorldSession, AnObjectThatIsChosenComesFromUnderThePanel) {
    FramedWorld world;
    world.frame();
    world.command("select", {"right"});
    world.frame({KeyInput{Key::f, KeyMotion::press, {}}});  // the other one is beside the picture
    world.command("select", {"left"});
    expect_free(world, {1});
    world.command("object", {"left", "position", "0.5,0,0"});
    expect_free(world, {1});
}

TEST(FramedWorldSession, TheToolIsUnderTheCursor) {
    FramedWorld world;
    world.frame();
    for (const Vec2& px : {Vec2(420.0, 330.0), Vec2(300.0, 400.0), Vec2(520.0, 380.0)}) {
        world.frame({MouseMove{px}});
        const Vec3 target_world = world.state().led().world_from_device * world.desk->viewer().desk.target_device_m;
        EXPECT_LT(glm::length(world.seen_px(target_world) - px), 1.0) << px.x;
        world.frame({Scroll{{0.0, 2.0}, {}}});
        const Vec3 deeper_world = world.state().led().world_from_device * world.desk->viewer().desk.target_device_m;
        EXPECT_LT(glm::length(world.seen_px(deeper_world) - px), 1.0) << "deeper";
        EXPECT_LT(deeper_world.z, target_world.z);
    }
}

TEST(FramedWorldSession, ClosingOverEditsAsksAndNotAfterTheyWereUndone) {
    FramedWorld world;
    world.frame();
    world.command("object", {"left", "colour", "1,0,0"});
    world.frame();
    world.frame({WindowClose{}});
    EXPECT_EQ(world.state().asked.closing, Closing::asked);
    EXPECT_FALSE(world.state().quit) << "the edits are lost without a word";
    world.command("quit", {"stay"});
    world.command("undo");
    world.frame();
    world.frame({WindowClose{}});
    EXPECT_TRUE(world.state().quit) << "nothing is changed any more";
}

TEST(FramedWorldSession, ARecordingIsShownAsItWasRecorded) {
    FramedWorld before(false);
    before.frame();
    EXPECT_NE(settings_line(FramedWorld().options).find("--frames-world"), std::string::npos);
    EXPECT_EQ(settings_line(before.options).find("--frames-world"), std::string::npos);
    const auto [lo, hi] = before.extent_px(kBothObjects);
    EXPECT_NEAR(0.5 * (lo.x + hi.x), 0.5 * kFramedWindow.width, 0.05 * kFramedWindow.width);
}

TEST(FramedWorldSession, SwitchesTakeYesAndNo) {
    FramedWorld world;
    world.command("object", {"left", "felt", "no"});
    EXPECT_FALSE(world.state().world->find(1)->felt);
    world.command("object", {"left", "felt", "yes"});
    EXPECT_TRUE(world.state().world->find(1)->felt);
    testing::internal::CaptureStderr();
    world.command("object", {"left", "felt", "noo"});
    EXPECT_NE(testing::internal::GetCapturedStderr().find("did you mean no?"), std::string::npos);
}

TEST(ObjectTurn, EveryOrientationHasAnglesThatGiveItBack) {
    std::mt19937 random{5};
    std::normal_distribution<double> some;
    for (int i = 0; i < 200; ++i) {
        const Quat q = glm::normalize(Quat(some(random), some(random), some(random), some(random)));
        const Quat again = orientation_of(turn_of(q));
        EXPECT_GT(std::abs(glm::dot(q, again)), 1.0 - 1e-9);
    }
    for (const double nod : {-90.0, 90.0}) {
        const Quat q = orientation_of({30.0, nod, 20.0});
        EXPECT_GT(std::abs(glm::dot(q, orientation_of(turn_of(q)))), 1.0 - 1e-9) << "straight up and down";
    }
    EXPECT_NEAR(turn_of(orientation_of({90.0, 0.0, 0.0}))[0], 90.0, 1e-9);
    const scene::PropertyValue none = orientation_value({0.0, 0.0, 0.0});
    EXPECT_NE(Vec3(none[0], none[1], none[2]), Vec3(0.0)) << "a command refuses an axis without length";
}

}  // namespace burin::session
