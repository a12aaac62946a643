// SPDX-License-Identifier: MIT
// What a participant's picture shows beside the study's world: the page, and nothing of the operator's.
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "activities/train/participant_session.hpp"
#include "activities/train/study_activity.hpp"
#include "desk/live/desk.hpp"
#include "desk/run/session.hpp"
#include "desk/run/session_frames.hpp"
#include "session/drive/executors.hpp"

namespace burin::app {
namespace {

// A participant's session of the thesis' study, without any picture drawn.
class ParticipantSession {
public:
    ParticipantSession(const std::string& stage, std::size_t group, bool asks_for_panel_window) {
        protocol_ = study::parse_protocol(*study::known_protocol("kinesthetic-path")).protocol;
        worlds_ = activities::felt_worlds(protocol_).value();
        session::SessionSetup setup;
        setup.desk.panel_window = asks_for_panel_window;
        const session::SessionSetup options = activities::participant_session(
            setup,
            std::make_shared<activities::StudyActivity>(protocol_, protocol_.groups.at(group), worlds_,
                                                        std::vector<study::StagePlace>{{1, 1, protocol_.stage(stage)}},
                                                        "study", activities::StudyDevice{}, activities::StageKeeper{}));
        auto made = session::Desk::create(options, session::session_wall(options.desk).value(), clock_);
        if (!made) throw std::runtime_error(made.error().line());
        desk_ = std::move(*made);
        executor_.emplace(clock_, desk_->session().loop(), desk_->session().channels_of_parts(),
                          desk_->session().scene(),
                          [this](const auto& ended) { static_cast<void>(desk_->session().collect(ended)); });
        for (int i = 0; i < 5; ++i) frame({});
    }
    void frame(const std::vector<session::CommandInput>& commands) {
        const Nanoseconds until_ns = clock_.now_ns() + 10'000'000;
        ASSERT_TRUE(executor_->advance_to(until_ns));
        std::vector<session::InputEvent> events;
        for (const session::CommandInput& command : commands) events.push_back({until_ns, command});
        desk_->step({until_ns, until_ns, events}, {.size = {1280, 720}}, desk_->session().newest_tool(),
                    [&](session::Executor::Order order) { executor_->order(std::move(order)); }, {340, 700});
        const auto taken = executor_->take_updates();
        ASSERT_TRUE(taken);
        desk_->take_news(taken->collected);
    }
    // The panel's share of the participant's picture, and of the operator's window.
    [[nodiscard]] std::optional<session::PanelPicture> picture() const { return desk_->panel_on(0); }
    [[nodiscard]] std::optional<session::PanelPicture> operators() const { return desk_->panel_on(1); }

private:
    study::Protocol protocol_;
    activities::FeltWorlds worlds_;
    SimulatedClock clock_;
    std::unique_ptr<session::Desk> desk_;
    std::optional<session::SteppedExecutor> executor_;
};

}  // namespace

TEST(ParticipantSessions, ShowNothingOfTheOperatorsPanelBesideThePicture) {
    for (const bool asks : {false, true}) {
        for (const char* stage : {"test", "interactive"}) {
            ParticipantSession visit(stage, 0, asks);
            EXPECT_FALSE(visit.picture()) << stage << ", between stages";
            ASSERT_TRUE(visit.operators()) << stage << ": the operator has a window whatever was asked for";
            visit.frame({{"do", {"start"}}});
            visit.frame({{"toggle-panel", {}}});
            visit.frame({{"toggle-frame-figures", {}}});
            EXPECT_FALSE(visit.picture()) << stage << ", within it";
            EXPECT_TRUE(visit.operators()) << stage;
        }
    }
}

TEST(ParticipantSessions, ShowThePageAndTheSameToEachGroup) {
    std::optional<renderer::PanelMesh> first;
    for (const std::size_t group : {0u, 1u}) {
        ParticipantSession visit("introduction", group, false);
        EXPECT_FALSE(visit.picture());
        visit.frame({{"do", {"start"}}});
        visit.frame({});
        ASSERT_TRUE(visit.picture()) << "the page";
        EXPECT_EQ(visit.picture()->size.width, 340u);
        const renderer::PanelMesh page = visit.picture()->mesh;
        EXPECT_FALSE(page.vertices.empty());
        if (!first) first = page;
        EXPECT_TRUE(page == *first) << "its group is not on it";
        for (int i = 0; i < 20; ++i) visit.frame({});
        ASSERT_TRUE(visit.picture());
        EXPECT_TRUE(visit.picture()->mesh == *first) << "nor any figure";
    }
}

}  // namespace burin::app
