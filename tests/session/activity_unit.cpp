// SPDX-License-Identifier: MIT
// A session's activity: it sees every tick, is told what commands say, and changes objects, ticks and pictures.
#include "session/state/activity.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "session/drive/session_frames.hpp"
#include "session/live/live_session.hpp"
#include "session/state/governed.hpp"
#include "session/state/session_settings.hpp"
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
        for (const haptics::StrokeSample& tick : view.ticks) ticks.push_back(tick.tick);
        objects = view.world != nullptr ? view.world->objects.size() : 0;
    }
    void adjust(haptics::TickParameters& parameters) const override { parameters.enabled = !calm; }
    void stage(renderer::Scene& scene, std::size_t) const override { scene.tool.colour = Vec3(0.0, 0.0, 1.0); }
    [[nodiscard]] ActivityPanel panel() const override {
        return {.title = "Watching",
                .aside = "",
                .page = page,
                .rows = {{"Ticks", "many"}},
                .buttons = {{"Calm", {"calm"}}}};
    }
    [[nodiscard]] Result<void> finish() override {
        finished = true;
        return {};
    }

    std::string page;
    std::vector<std::uint64_t> ticks;
    std::size_t objects = 0;
    bool calm = false, finished = false;
};

const std::string kPyramid = "OFF\n4 4 0\n0 0 0\n0.1 0 0\n0 0.1 0\n0 0 0.1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

struct WatchedSession {
    explicit WatchedSession(std::shared_ptr<Watching> watching, bool panel_window = false)
        : activity(std::move(watching)) {
        options.live.panel_window = panel_window;
        place.write("t.off", kPyramid);
        options.world = (place / "t.off").string();
        options.no_workpiece = true;
        options.activity = activity;
        auto made = LiveSession::create(options, session_wall(options.live).value(), clock);
        if (!made) throw std::runtime_error(made.error().line());
        session = std::move(*made);
        executor.emplace(clock, session->loop(), session->channels(), session->scene(),
                         [this](const auto& ended) { static_cast<void>(session->collect(ended)); });
    }
    // A frame of 10 ms with these commands. Returns what the session told meanwhile.
    std::string frame(const std::vector<CommandInput>& commands) {
        testing::internal::CaptureStderr();
        const Nanoseconds until_ns = clock.now_ns() + 10'000'000;
        EXPECT_TRUE(executor->advance_to(until_ns));
        std::vector<InputEvent> events;
        for (const CommandInput& command : commands) events.push_back({until_ns, command});
        session->step(
            {until_ns, until_ns, events}, {.size = {640, 360}}, session->newest_tool(),
            [&](Executor::Order order) { executor->order(std::move(order)); },
            options.live.panel_window ? ImageSize{340, 700} : ImageSize{});
        const Result<Executor::Taken> taken = executor->take_updates();
        EXPECT_TRUE(taken);
        if (taken) session->take_news(taken->collected);
        return testing::internal::GetCapturedStderr();
    }

    Workplace place;
    std::shared_ptr<Watching> activity;
    SculptOptions options;
    SimulatedClock clock;
    std::unique_ptr<LiveSession> session;
    std::optional<SteppedExecutor> executor;
};

}  // namespace

TEST(SessionActivity, SeesEveryTickOnceInOrder) {
    WatchedSession watched(std::make_shared<Watching>());
    for (int i = 0; i < 30; ++i) watched.frame({});
    watched.session->finish_scene();
    const std::vector<std::uint64_t>& ticks = watched.activity->ticks;
    ASSERT_GE(ticks.size(), 280u) << "all but those since the last update of the scene";
    for (std::size_t i = 0; i < ticks.size(); ++i) ASSERT_EQ(ticks[i], i + 1);
    EXPECT_EQ(watched.activity->objects, 1u);
    EXPECT_TRUE(watched.activity->finished);
}

TEST(SessionActivity, ItsActsChangeObjectsTicksAndPictures) {
    WatchedSession watched(std::make_shared<Watching>());
    watched.frame({});
    ASSERT_TRUE(watched.session->scene_on(0));
    EXPECT_EQ(watched.session->scene_on(0)->objects.size(), 1u);
    EXPECT_EQ(watched.session->scene_on(0)->tool.colour, Vec3(0.0, 0.0, 1.0));
    EXPECT_TRUE(watched.session->channels().parameters.newest().enabled);
    EXPECT_EQ(watched.frame({{"do", {"hide", "t"}}, {"do", {"calm"}}}), "");
    watched.frame({});
    EXPECT_EQ(watched.session->scene_on(0)->objects.size(), 0u);
    EXPECT_FALSE(watched.session->channels().parameters.newest().enabled);
    EXPECT_FALSE(watched.session->state().quit);
    watched.frame({{"do", {"leave"}}});
    EXPECT_TRUE(watched.session->state().quit);
}

// Where the panel has a window of its own, the person before the picture sees the activity's page and no more of it.
TEST(SessionActivity, ItsPageIsOnThePictureWhereThePanelIsNot) {
    const auto watching = std::make_shared<Watching>();
    WatchedSession watched(watching, true);
    watched.frame({});
    EXPECT_FALSE(watched.session->panel_on(0)) << "no page";
    watching->page = "Touch the red pyramid.";
    watched.frame({});
    ASSERT_TRUE(watched.session->panel_on(0));
    const ImageSize low = watched.session->panel_on(0)->size;
    EXPECT_EQ(low.width, 340u);
    EXPECT_LT(low.height, 80u) << "as high as its one line";
    for (int i = 0; i < 5; ++i) watching->page += " Then go round it once and come back to where you began.";
    watched.frame({});
    ASSERT_TRUE(watched.session->panel_on(0));
    EXPECT_GT(watched.session->panel_on(0)->size.height, 2 * low.height) << "as high as its lines";
    EXPECT_LT(watched.session->panel_on(0)->size.height, 340u);
    EXPECT_EQ(watched.session->panel_on(1)->size.height, 700u) << "the operator's";
}

TEST(SessionActivity, ThatGovernsLeavesThePanelNeitherToolNorObjects) {
    PanelModel model;
    model.object = PanelObject{};
    model.object_names = {"stone"};
    model.activity = ActivityPanel{.title = "Study", .aside = "", .page = "", .rows = {}, .buttons = {}};
    Panel panel = Panel::create({.size = {340, 2000}}).value();
    const auto offers = [&](const std::string& label) {
        static_cast<void>(panel.show(model, 0));
        const std::vector<std::string> labels = panel.labels();
        return std::ranges::find(labels, label) != labels.end();
    };
    for (const char* section : {"Tool", "Material", "Objects", "Workspace", "Touch", "View", "Study"})
        EXPECT_TRUE(offers(section)) << section;
    model.activity->governs = true;
    for (const char* section : {"Tool", "Material", "Objects", "Workspace"}) EXPECT_FALSE(offers(section)) << section;
    for (const char* section : {"Touch", "View", "Study"}) EXPECT_TRUE(offers(section)) << section;
    for (const char* filter : {"velocity-filter", "force-filter"}) EXPECT_FALSE(offers(filter)) << filter;
}

TEST(SessionActivity, ManyButtonsStandInRowsSoThatTheirTitlesHaveRoom) {
    Panel panel = Panel::create({.size = {340, 2000}}).value();
    for (const std::size_t count : {6u, 7u}) {
        PanelModel model;
        model.activity = ActivityPanel{.title = "Study", .aside = "", .page = "", .rows = {}, .buttons = {}};
        for (std::size_t i = 0; i < count; ++i) {
            const std::string act = "act" + std::to_string(i);
            model.activity->buttons.push_back({"Go on", {act}, true});
        }
        static_cast<void>(panel.show(model, 0));
        const auto first = panel.place_of("do act0"), last = panel.place_of("do act" + std::to_string(count - 1));
        ASSERT_TRUE(first && last) << count;
        EXPECT_EQ(last->y > first->y, count > 6) << count;
        EXPECT_EQ(last->width, first->width) << count;
    }
}

TEST(SessionActivity, ThatGovernsHasNobodyChangeToolObjectsOrWorkspace) {
    SessionState before, state;
    before.workspace_gain = 1.0;
    state.workspace_gain = 2.0;
    state.force_filter = 0.5;
    state.interpupillary_m = 0.07;
    SessionOrders orders;
    orders.line = 7;
    orders.carving.push_back(sculpt::SculptOrder{});
    keep_governed(before, state, orders);
    EXPECT_EQ(state.workspace_gain, 1.0);
    EXPECT_EQ(state.force_filter, 0.0);
    EXPECT_EQ(state.interpupillary_m, 0.07) << "who looks is nobody's but the viewer's";
    EXPECT_TRUE(orders.carving.empty());
    ASSERT_EQ(orders.messages.size(), 1u);
    EXPECT_EQ(orders.messages[0].line, 7u);
    SessionOrders none;
    keep_governed(before, state, none);
    EXPECT_TRUE(none.messages.empty()) << "nobody asked for anything";
}

TEST(SessionActivity, WhatItCannotDoIsToldByName) {
    WatchedSession watched(std::make_shared<Watching>());
    EXPECT_TRUE(watched.frame({{"do", {"hid", "t"}}}).contains("did you mean hide"));
    EXPECT_TRUE(watched.frame({{"do", {"hide"}}}).contains("command do hide: lacks its argument; write do hide NAME"));
    EXPECT_TRUE(watched.frame({{"do", {"hide", "t", "x"}}}).contains("one word too many: x"));
    EXPECT_TRUE(watched.frame({{"do", {"calm", "down"}}}).contains("takes no argument, and is given down"));
    EXPECT_TRUE(watched.session->channels().parameters.newest().enabled) << "not calm";
    EXPECT_TRUE(watched.frame({{"do", {"hide", "x"}}}).contains("object x"));
    EXPECT_TRUE(watched.frame({{"do", {}}}).contains("lacks its argument"));
    WatchedSession alone(nullptr);
    EXPECT_TRUE(alone.frame({{"do", {"hide", "t"}}}).contains("this session has none"));
}

TEST(SessionActivity, ARecordingIsDoneAgainWithTheSameActivityAlone) {
    SculptOptions watched, plain;
    watched.activity = std::make_shared<Watching>();
    const std::string line = settings_line(watched);
    EXPECT_TRUE(options_as_recorded(line, watched));
    const auto without = options_as_recorded(line, plain);
    ASSERT_FALSE(without);
    EXPECT_TRUE(without.error().line().contains("watching --seed 5")) << without.error().line();
    EXPECT_FALSE(options_as_recorded(settings_line(plain), watched));
}

}  // namespace burin::session
