// SPDX-License-Identifier: MIT
// A session's activity: it sees every tick, is told what commands say, and changes objects, ticks and pictures.
#include "session/activity/activity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <tuple>

#include "desk/live/desk.hpp"
#include "desk/run/session_frames.hpp"
#include "haptics/channels.hpp"
#include "session/drive/executors.hpp"
#include "session/state/governed.hpp"
#include "session/state/session_settings.hpp"
#include "tests/desk/viewed.hpp"
#include "tests/session/carving_setup.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

// Keeps the numbers of the ticks that it has seen; hides the object that it is told; gives no force while it is told
// to be calm.
class Watching final : public Activity {
public:
    [[nodiscard]] std::string settings() const override { return "watching --seed 5"; }
    [[nodiscard]] std::span<const Act> acts() const override {
        static constexpr std::array kWatchingActs{Act{"hide", "NAME", ""}, Act{"calm", "", ""}, Act{"leave", "", ""}};
        return kWatchingActs;
    }
    [[nodiscard]] Result<void> act(std::span<const std::string> words, ActivityOrders& orders) override {
        if (words[0] == "hide") orders.edits.push_back({words[1], scene::ObjectProperty::seen, {0.0}});
        if (words[0] == "calm") calm = orders.parameters = true;
        if (words[0] == "leave") orders.quit = true;
        return {};
    }
    void step(const ActivityView& view, ActivityOrders&) override {
        for (const haptics::TickRecord& tick : view.first_part().ticks) ticks.push_back(tick.tick);
        objects = view.world != nullptr ? view.world->objects.size() : 0;
    }
    void adjust(PartOfHand, haptics::TickParameters& parameters) const override { parameters.enabled = !calm; }
    void stage(picture::Picture& scene, std::size_t) const override { scene.tool.colour = Vec3(0.0, 0.0, 1.0); }
    [[nodiscard]] ActivityPanel panel() const override {
        return {.title = "Watching",
                .aside = "",
                .page = page,
                .widgets = {ActivityPanel::Row{"Ticks", "many"},
                            ActivityPanel::Button{"Calm", {"calm"}, !calm, {}, Key::f6}},
                .governs = governs_from_now && asked_++ % 2 == 1};
    }
    [[nodiscard]] Result<void> finish() override {
        finished = true;
        return cannot_write.empty() ? Result<void>{} : fail(cannot_write, "cannot be written", "free some space");
    }

    std::string page;
    std::vector<std::uint64_t> ticks;
    std::size_t objects = 0;
    bool calm = false, finished = false;
    std::string cannot_write;       // at the end
    bool governs_from_now = false;  // in each step, once the panel is laid out

private:
    mutable std::size_t asked_ = 0;
};

const std::string kPyramid = "OFF\n4 4 0\n0 0 0\n0.1 0 0\n0 0.1 0\n0 0 0.1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

struct WatchedSession {
    explicit WatchedSession(std::shared_ptr<Watching> watching, bool panel_window = false)
        : activity(std::move(watching)) {
        options.desk.panel_window = panel_window;
        place.write("t.off", kPyramid);
        options.scene.world = (place / "t.off").string();
        options.scene.no_workpiece = true;
        options.activity = activity;
        auto made = Desk::create(options, session_wall(options.desk).value(), clock);
        if (!made) throw std::runtime_error(made.error().line());
        desk = std::move(*made);
        executor.emplace(clock, desk->session().loop(), desk->session().channels_of_parts(), desk->session().scene(),
                         [this](const auto& ended) { static_cast<void>(desk->session().collect(ended)); });
    }
    // A frame of 10 ms with these commands. Returns what the session told meanwhile.
    std::string frame(const std::vector<CommandInput>& commands) {
        return send({commands.begin(), commands.end()}, {640, 360});
    }
    std::string send(const std::vector<Input>& inputs, ImageSize output = {1280, 720}) {
        testing::internal::CaptureStderr();
        const Nanoseconds until_ns = clock.now_ns() + 10'000'000;
        EXPECT_TRUE(executor->advance_to(until_ns));
        std::vector<InputEvent> events;
        for (const Input& input : inputs) events.push_back({until_ns, input});
        desk->step(
            {until_ns, until_ns, events}, {.size = output}, desk->session().newest_tool(),
            [&](Executor::Order order) { executor->order(std::move(order)); },
            options.desk.panel_window ? ImageSize{340, 700} : ImageSize{});
        const Result<Executor::Taken> taken = executor->take_updates();
        EXPECT_TRUE(taken);
        if (taken) desk->take_news(taken->collected);
        return testing::internal::GetCapturedStderr();
    }

    Workplace place;
    std::shared_ptr<Watching> activity;
    SessionSetup options = carving_setup();
    SimulatedClock clock;
    std::unique_ptr<Desk> desk;
    std::optional<SteppedExecutor> executor;
};

}  // namespace

// By the key as by the button: alone, once for each press, and not where the button can do nothing.
TEST(SessionActivity, IsToldByTheKeysOfItsButtons) {
    const auto calm_after = [](const KeyInput& key) {
        const auto watching = std::make_shared<Watching>();
        WatchedSession watched(watching);
        watched.frame({});
        const std::string said = watched.send({Input{key}});
        EXPECT_EQ(said, "");
        return watching->calm;
    };
    EXPECT_TRUE(calm_after({Key::f6, KeyMotion::press, {}}));
    EXPECT_FALSE(calm_after({Key::f7, KeyMotion::press, {}}));
    EXPECT_FALSE(calm_after({Key::f6, KeyMotion::release, {}}));
    EXPECT_FALSE(calm_after({Key::f6, KeyMotion::press, {.ctrl = true}}));
}

TEST(SessionActivity, SeesEveryTickOnceInOrder) {
    WatchedSession watched(std::make_shared<Watching>());
    for (int i = 0; i < 30; ++i) watched.frame({});
    watched.desk->session().finish_scene();
    const std::vector<std::uint64_t>& ticks = watched.activity->ticks;
    ASSERT_GE(ticks.size(), 280u) << "all but those since the last update of the scene";
    for (std::size_t i = 0; i < ticks.size(); ++i) ASSERT_EQ(ticks[i], i + 1);
    EXPECT_EQ(watched.activity->objects, 1u);
    EXPECT_TRUE(watched.activity->finished);
}

// Whoever did a visit must know that nothing of it is on the disk, and so must a script, by the status.
TEST(SessionActivity, WhatItCouldNotWriteAtItsEndIsToldAndFailsTheSession) {
    for (const char* const lost : {"", "trials.csv"}) {
        const auto watching = std::make_shared<Watching>();
        watching->cannot_write = lost;
        WatchedSession watched(watching);
        watched.frame({});
        testing::internal::CaptureStderr();
        watched.desk->session().finish_scene();
        const std::string said = testing::internal::GetCapturedStderr();
        const auto outcome = watched.desk->session().files().outcome();
        const auto is_told = [](const Message& message) {
            return message.text.contains("trials.csv: cannot be written") && message.kind == MessageKind::error;
        };
        const bool is_lost = *lost != '\0';
        EXPECT_TRUE(watching->finished);
        EXPECT_EQ(static_cast<bool>(outcome), !is_lost) << said;
        EXPECT_EQ(std::ranges::count_if(watched.desk->session().log().all(), is_told), is_lost ? 1 : 0) << said;
        EXPECT_EQ(said.contains("trials.csv: cannot be written"), is_lost) << said;
    }
}

TEST(SessionActivity, ItsActsChangeObjectsTicksAndPictures) {
    WatchedSession watched(std::make_shared<Watching>());
    watched.frame({});
    ASSERT_TRUE(watched.desk->scene_on(0));
    EXPECT_EQ(watched.desk->scene_on(0)->objects.size(), 1u);
    EXPECT_EQ(watched.desk->scene_on(0)->tool.colour, Vec3(0.0, 0.0, 1.0));
    EXPECT_TRUE(watched.desk->session().channels().parameters.newest().enabled);
    EXPECT_EQ(watched.frame({{"do", {"hide", "t"}}, {"do", {"calm"}}}), "");
    watched.frame({});
    EXPECT_EQ(watched.desk->scene_on(0)->objects.size(), 0u);
    EXPECT_FALSE(watched.desk->session().channels().parameters.newest().enabled);
    EXPECT_FALSE(watched.desk->session().state().quit);
    watched.frame({{"do", {"leave"}}});
    EXPECT_TRUE(watched.desk->session().state().quit);
}

// Where the panel has a window of its own, the person before the picture sees the activity's page and no more of it.
TEST(SessionActivity, ItsPageIsOnThePictureWhereThePanelIsNot) {
    const auto watching = std::make_shared<Watching>();
    WatchedSession watched(watching, true);
    watched.frame({});
    EXPECT_FALSE(watched.desk->panel_on(0)) << "no page";
    watching->page = "Touch the red pyramid.";
    watched.frame({});
    ASSERT_TRUE(watched.desk->panel_on(0));
    const ImageSize low = watched.desk->panel_on(0)->size;
    EXPECT_EQ(low.width, 340u);
    EXPECT_LT(low.height, 80u) << "as high as its one line";
    for (int i = 0; i < 5; ++i) watching->page += " Then go round it once and come back to where you began.";
    watched.frame({});
    ASSERT_TRUE(watched.desk->panel_on(0));
    EXPECT_GT(watched.desk->panel_on(0)->size.height, 2 * low.height) << "as high as its lines";
    EXPECT_LT(watched.desk->panel_on(0)->size.height, 340u);
    EXPECT_EQ(watched.desk->panel_on(1)->size.height, 700u) << "the operator's";
}

TEST(SessionActivity, ThatGovernsLeavesThePanelNothingOfWhatIsFeltOrSeen) {
    PanelModel model;
    model.object = PanelObject{};
    model.object_names = {"stone"};
    model.activity = ActivityPanel{.title = "Study"};
    Panel panel = Panel::create({.size = {340, 2000}}).value();
    const auto offers = [&](const std::string& label) {
        static_cast<void>(panel.show(model, 0));
        const std::vector<std::string> labels = panel.labels();
        return std::ranges::find(labels, label) != labels.end();
    };
    for (const char* section : {"Tool", "Material", "Objects", "Workspace", "Touch", "View", "Study"})
        EXPECT_TRUE(offers(section)) << section;
    model.activity->governs = true;
    for (const char* section : {"Tool", "Material", "Objects", "Workspace", "Touch", "View"})
        EXPECT_FALSE(offers(section)) << section;
    for (const char* switched : {"force", "velocity-filter", "force-filter", "stereo-mode", "swap-eyes", "show-force"})
        EXPECT_FALSE(offers(switched)) << switched;
    EXPECT_TRUE(offers("Study"));
}

// The operator of a study: a page, warnings and rows come and go while the hand is on its way to a button.
TEST(SessionActivity, ThatGovernsHasItsButtonsWhereNothingMovesThem) {
    PanelModel model;
    ActivityPanel activity{
        .title = "Study",
        .aside = "p07, touch",
        .page = "",
    };
    activity.governs = true;
    activity.add<ActivityPanel::Button>({{"Start", {"start"}},
                                         {"Next", {"next"}},
                                         {"Pause", {"pause"}},
                                         {"Go on", {"go-on"}},
                                         {"Repeat", {"repeat"}},
                                         {"In the jig", {"jig"}},
                                         {"Stop", {"stop"}, true, "End the visit?"}});
    activity.widgets.push_back(ActivityPanel::Field{"Note", {"note"}});
    for (const ImageSize size : {ImageSize{340, 700}, ImageSize{340, 1000}}) {
        Panel panel = Panel::create({.size = size}).value();
        std::map<std::string, PixelRect> first;
        for (int state = 0; state < 5; ++state) {
            model.activity = activity;
            if (state > 0)
                model.activity->add<ActivityPanel::Row>(
                    {{"in the jig", "2.5 mm off"}, {"stage", "test"}, {"now", "runs"}});
            if (state > 1) model.activity->page = "A page of the participant's, which takes some lines of the panel.";
            if (state > 2) model.warnings = {"Picture 61 ms behind the hand; 15 is noticed", "The tracker is lost"};
            if (state > 3) {
                model.touch.cause = haptics::GateCause::device_fault;
                std::get<ActivityPanel::Button>(model.activity->widgets[1]).enabled = false;
            }
            static_cast<void>(panel.show(model, state));
            for (const char* label : {"do start", "do next", "do pause", "do go-on", "do repeat", "do jig", "do stop",
                                      "field do note", "do note"}) {
                const auto at = panel.place_of(label);
                ASSERT_TRUE(at) << label << " is not shown, state " << state;
                const auto [before, fresh] = first.emplace(label, *at);
                EXPECT_EQ(std::tie(at->x, at->y, at->width, at->height),
                          std::tie(before->second.x, before->second.y, before->second.width, before->second.height))
                    << label << ", state " << state;
            }
        }
        model.touch = {};
        model.warnings = {};
    }
}

TEST(SessionActivity, AsksBeforeItDoesWhatCannotBeTakenBack) {
    PanelModel model;
    model.activity = ActivityPanel{.title = "Study"};
    model.activity->add<ActivityPanel::Button>(
        {{"Next", {"next"}}, {"Stop", {"stop"}, true, "End the visit for good?"}});
    model.activity->governs = true;
    Panel panel = Panel::create({.size = {340, 700}}).value();
    Nanoseconds now_ns = 0;
    const auto clicked = [&](const std::string& label) {
        static_cast<void>(panel.show(model, now_ns += 16'000'000));
        const auto at = panel.place_of(label);
        EXPECT_TRUE(at) << label;
        const Vec2 middle = at ? Vec2(at->x + 0.5 * at->width, at->y + 0.5 * at->height) : Vec2(-1.0);
        const std::vector<InputEvent> events{{now_ns, MouseMove{middle}},
                                             {now_ns, MouseClick{MouseButton::left, true, {}}},
                                             {now_ns, MouseClick{MouseButton::left, false, {}}}};
        panel.feed(events);
        return panel.show(model, now_ns += 16'000'000).actions;
    };
    const std::vector<CommandInput> stop{{"do", {"stop"}}};
    EXPECT_TRUE(clicked("do stop").empty());
    EXPECT_TRUE(clicked("do stop").empty()) << "twice in one place does nothing";
    EXPECT_TRUE(clicked("no").empty());
    EXPECT_FALSE(panel.place_of("yes, do stop"));
    EXPECT_TRUE(clicked("do stop").empty());
    EXPECT_EQ(clicked("do next"), (std::vector<CommandInput>{{"do", {"next"}}}));
    EXPECT_FALSE(panel.place_of("yes, do stop")) << "something else was wanted";
    EXPECT_TRUE(clicked("do stop").empty());
    EXPECT_EQ(clicked("yes, do stop"), stop);
    EXPECT_FALSE(panel.place_of("yes, do stop"));
    EXPECT_TRUE(clicked("do stop").empty());
    std::get<ActivityPanel::Button>(model.activity->widgets[1]).enabled = false;
    static_cast<void>(panel.show(model, now_ns += 16'000'000));
    EXPECT_FALSE(panel.place_of("yes, do stop")) << "the stage has ended meanwhile";

    const std::vector<CommandInput> quit{{"quit", {}}};
    EXPECT_TRUE(clicked("quit").empty()) << "it would break the stage off";
    EXPECT_TRUE(clicked("quit").empty());
    EXPECT_EQ(clicked("yes, quit"), quit);
    model.activity->governs = false;
    EXPECT_EQ(clicked("quit"), quit) << "nothing is lost";
}

TEST(SessionActivity, TakesANoteFromTheOperatorsField) {
    PanelModel model;
    model.activity = ActivityPanel{.title = "Study"};
    model.activity->widgets = {ActivityPanel::Button{"Next", {"next"}}, ActivityPanel::Field{"Note", {"note"}}};
    model.activity->governs = true;
    Panel panel = Panel::create({.size = {340, 700}}).value();
    static_cast<void>(panel.show(model, 0));
    const auto middle = [&](const std::string& label) {
        const auto at = panel.place_of(label);
        EXPECT_TRUE(at) << label;
        return at ? Vec2(at->x + 0.5 * at->width, at->y + 0.5 * at->height) : Vec2(-1.0);
    };
    const auto click = [&](const std::string& label) {
        const std::vector<InputEvent> events{{0, MouseMove{middle(label)}},
                                             {0, MouseClick{MouseButton::left, true, {}}},
                                             {0, MouseClick{MouseButton::left, false, {}}}};
        panel.feed(events);
        return panel.show(model, 0).actions;
    };
    EXPECT_TRUE(click("do note").empty()) << "nothing is written";
    EXPECT_TRUE(click("field do note").empty());
    panel.feed(std::vector<InputEvent>{{0, TextInput{"holds her breath"}}});
    EXPECT_TRUE(panel.show(model, 0).actions.empty());
    EXPECT_EQ(click("do note"), (std::vector<CommandInput>{{"do", {"note", "holds her breath"}}}));
    EXPECT_TRUE(click("do note").empty()) << "it was written once";
}

TEST(SessionActivity, ManyButtonsStandInRowsSoThatTheirTitlesHaveRoom) {
    Panel panel = Panel::create({.size = {340, 2000}}).value();
    for (const std::size_t count : {6u, 7u}) {
        PanelModel model;
        model.activity = ActivityPanel{.title = "Study"};
        for (std::size_t i = 0; i < count; ++i) {
            const std::string act = "act" + std::to_string(i);
            model.activity->widgets.push_back(ActivityPanel::Button{"Go on", {act}, true});
        }
        static_cast<void>(panel.show(model, 0));
        const auto first = panel.place_of("do act0"), last = panel.place_of("do act" + std::to_string(count - 1));
        ASSERT_TRUE(first && last) << count;
        EXPECT_EQ(last->y > first->y, count > 6) << count;
        EXPECT_EQ(last->width, first->width) << count;
    }
}

TEST(SessionActivity, ThatGovernsHasNobodyChangeWhatIsFeltOrSeen) {
    using Change = std::function<void(SessionState&, Viewer&)>;
    const std::vector<std::pair<const char*, Change>> changes{
        {"tool", [](SessionState& s, Viewer&) { s.led().tool.shape.sizes_m[0] = 0.02; }},
        {"feel", [](SessionState& s, Viewer&) { s.feel.friction = 0.7; }},
        {"world", [](SessionState& s, Viewer&) { s.world = std::make_shared<WorldObjects>(); }},
        {"technique", [](SessionState& s, Viewer&) { s.led().technique = haptics::WorkspaceTechnique::moving; }},
        {"scale", [](SessionState& s, Viewer&) { s.led().workspace_gain = 2.0; }},
        {"force filter", [](SessionState& s, Viewer&) { s.led().force_filter = 0.5; }},
        {"velocity filter", [](SessionState& s, Viewer&) { s.led().velocity_filter = 0.5; }},
        {"force", [](SessionState& s, Viewer&) { s.led().force_on = false; }},
        {"drill", [](SessionState& s, Viewer&) { s.led().catch_drill = true; }},
        {"only touch", [](SessionState& s, Viewer&) { s.led().only_touch = true; }},
        {"scene", [](SessionState& s, Viewer&) { s.world_from_object.position_m.x = 0.1; }},
        {"device", [](SessionState& s, Viewer&) { s.led().world_from_device.position_m.x = 0.1; }},
        {"calibration", [](SessionState& s, Viewer&) { s.led().device_from_read.position_m.x = 0.1; }},
        {"arrow", [](SessionState&, Viewer& v) { v.force_shown = true; }},
        {"stereo", [](SessionState&, Viewer& v) { v.output.mode = wall::StereoMode::left; }},
        {"eyes", [](SessionState&, Viewer& v) { v.output.swap_eyes = true; }},
        {"edges", [](SessionState&, Viewer& v) { v.edge_comfort = EdgeComfort::off; }},
        {"pattern", [](SessionState&, Viewer& v) { v.output.test_pattern = wall::TestPattern::ghosting; }}};
    const Viewed begun = block_before_desk();
    const SessionState& before = begun.state;
    const Room& room = begun.room;
    const ViewerLook look;
    const haptics::TickParameters felt = parameters_of(before, room);
    for (const auto& [what, change] : changes) {
        SessionState state = before;
        Viewer viewer = begun.viewer;
        ViewerLead leader(viewer, room, begun.desk, look);
        change(state, viewer);
        viewer.interpupillary_m = 0.07;
        SessionOrders orders;
        orders.line = 7;
        keep_governed(before, state, orders, leader.keep_governed());
        EXPECT_EQ(viewer.interpupillary_m, 0.07) << "who looks is nobody's but the viewer's";
        ASSERT_EQ(orders.messages.size(), 1u) << what;
        EXPECT_EQ(orders.messages[0].line, 7u);
        EXPECT_EQ(state.led().force_on, before.led().force_on) << what;
        EXPECT_EQ(viewer.output, begun.viewer.output) << what;
        EXPECT_EQ(viewer.force_shown, begun.viewer.force_shown) << what;
        EXPECT_EQ(viewer.edge_comfort, begun.viewer.edge_comfort) << what;
        const haptics::TickParameters now = parameters_of(state, room);
        EXPECT_EQ(now.workspace.object_from_device, felt.workspace.object_from_device) << what;
        EXPECT_EQ(now.enabled, felt.enabled) << what;
        EXPECT_EQ(now.catch_drill, felt.catch_drill) << what;
        EXPECT_EQ(now.signals.force_alpha, felt.signals.force_alpha) << what;
        EXPECT_EQ(now.signals.velocity_alpha, felt.signals.velocity_alpha) << what;
        EXPECT_EQ(now.materials[0].static_friction, felt.materials[0].static_friction) << what;
        SessionOrders again;
        keep_governed(before, state, again, leader.keep_governed());
        EXPECT_TRUE(again.messages.empty()) << what << ": all is as it was";
    }
    SessionState state = before;
    SessionOrders orders;
    orders.carving.push_back(workpiece::CarveOrder{});
    keep_governed(before, state, orders, false);
    EXPECT_TRUE(orders.carving.empty());
    EXPECT_EQ(orders.messages.size(), 1u);
}

// The panel was laid out before the activity began to govern, as at the beginning of a stage: what it gives then is
// held back like any other's word.
TEST(SessionActivity, ThatGovernsIsNotOverruledByThePanel) {
    for (const bool governs : {false, true}) {
        const auto watching = std::make_shared<Watching>();
        WatchedSession watched(watching);
        watched.send({});
        const SessionState before = watched.desk->session().state();
        watching->governs_from_now = governs;
        std::set<std::string> changed;
        std::size_t clicked = 0;
        for (const char* label :
             {"tool cone", "object stiffness", "object scale", "object seen", "object felt", "force"}) {
            const auto place = watched.desk->place_on_panel(label);
            if (!place) continue;
            ++clicked;
            const Vec2 at(place->x + 0.3 * place->width, place->y + 0.5 * place->height);
            watched.send({MouseMove{at}});
            watched.send({MouseMove{at}, MouseClick{MouseButton::left, true, {}}});
            watched.send({MouseClick{MouseButton::left, false, {}}});
            const SessionState& now = watched.desk->session().state();
            if (now.led().force_on != before.led().force_on) changed.insert("force");
            if (!(now.led().tool == before.led().tool)) changed.insert("tool");
            if (now.world->objects != before.world->objects) changed.insert("objects");
        }
        EXPECT_GE(clicked, 3u);
        EXPECT_EQ(changed.empty(), governs) << testing::PrintToString(changed);
    }
}

TEST(SessionActivity, WhatItCannotDoIsToldByName) {
    WatchedSession watched(std::make_shared<Watching>());
    EXPECT_TRUE(watched.frame({{"do", {"hid", "t"}}}).contains("did you mean hide"));
    EXPECT_TRUE(watched.frame({{"do", {"hide"}}}).contains("command do hide: lacks its argument; write do hide NAME"));
    EXPECT_TRUE(watched.frame({{"do", {"hide", "t", "x"}}}).contains("one word too many: x"));
    EXPECT_TRUE(watched.frame({{"do", {"calm", "down"}}}).contains("takes no argument, and is given down"));
    EXPECT_TRUE(watched.desk->session().channels().parameters.newest().enabled) << "not calm";
    EXPECT_TRUE(watched.frame({{"do", {"hide", "x"}}}).contains("object x"));
    EXPECT_TRUE(watched.frame({{"do", {}}}).contains("lacks its argument"));
    WatchedSession alone(nullptr);
    EXPECT_TRUE(alone.frame({{"do", {"hide", "t"}}}).contains("this session has none"));
}

TEST(SessionActivity, ARecordingIsDoneAgainWithTheSameActivityAlone) {
    SessionSetup watched, plain;
    watched.activity = std::make_shared<Watching>();
    const std::string line = settings_line(watched);
    EXPECT_TRUE(options_as_recorded(line, watched));
    const auto without = options_as_recorded(line, plain);
    ASSERT_FALSE(without);
    EXPECT_TRUE(without.error().line().contains("watching --seed 5")) << without.error().line();
    EXPECT_FALSE(options_as_recorded(settings_line(plain), watched));
}

}  // namespace burin::session
