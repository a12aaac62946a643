// SPDX-License-Identifier: MIT
// Who sees the tube, who feels it and who is led: every group in every kind of stage, in the rules of the pictures, in
// a stage's own ticks and in a live session's orders. Asked without a picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "activities/train/study_activity.hpp"
#include "base/text.hpp"
#include "tests/activities/one_hand.hpp"

namespace burin::activities {
namespace {

using scene::ObjectProperty;
using study::StageKind;

constexpr const char* kAllGroups = R"(format = 1
name = "all-groups"
consent = "2026-11"
[limits]
guidance_N_per_m = 300
[[group]]
code = "touch"
feels_tube = true
[[group]]
code = "sight"
sees_tube = true
[[group]]
code = "both"
sees_tube = true
feels_tube = true
[[group]]
code = "none"
[[world]]
name = "tube"
tube_radius_m = 0.045
cap_half_width_m = 0.068
funnel_half_width_m = 0.045
spine_m = [[-0.12, 0.19, 0.0], [-0.06, 0.21, 0.0], [0.0, 0.22, 0.0], [0.06, 0.21, 0.0], [0.12, 0.19, 0.0]]
)";

// What of a kind of stage concerns a group that sees the tube, and one that feels it.
struct Rule {
    const char* stage;
    const char* text;  // TOML of the stage
    bool seen, pressed, led;
};
constexpr std::array kRules{
    Rule{"page", "kind = \"page\"\ntext = \"read\"\nends_by_operator = true", false, false, false},
    Rule{"model", "kind = \"show_model\"\nworld = \"tube\"\nends_by_operator = true", false, true, false},
    Rule{"free", "kind = \"free_training\"\nworld = \"tube\"\nends_by_operator = true", true, true, false},
    Rule{"led", "kind = \"led_training\"\nworld = \"tube\"\nends_by_operator = true", true, true, true},
    Rule{"test", "kind = \"trial\"\nworld = \"tube\"\nends_at_exit = true\noutcome = true", false, false, false},
    Rule{"free-dark", "kind = \"free_training\"\nworld = \"tube\"\nends_by_operator = true\nsees_world = false", false,
         true, false},
    Rule{"free-soft", "kind = \"free_training\"\nworld = \"tube\"\nends_by_operator = true\nfeels_world = false", true,
         false, false},
    Rule{"test-seen", "kind = \"trial\"\nworld = \"tube\"\nends_at_exit = true\nsees_world = true", true, false, false},
    Rule{"test-felt", "kind = \"trial\"\nworld = \"tube\"\nends_at_exit = true\nfeels_world = true", false, true,
         false}};

std::string protocol_of_rules() {
    std::string text = kAllGroups, stages;
    for (const Rule& rule : kRules) {
        text += formatted("[[stage]]\nname = \"%s\"\n%s\n", rule.stage, rule.text);
        stages += formatted("%s\"%s\"", stages.empty() ? "" : ", ", rule.stage);
    }
    return text + "[[day]]\nstages = [" + stages + "]\n";
}

// Calls with each group and each rule; told in the test's trace.
class GroupRules : public testing::Test {
protected:
    void SetUp() override {
        study::ParsedProtocol parsed = study::parse_protocol(protocol_of_rules());
        ASSERT_TRUE(parsed.faults.empty()) << line_of(parsed.faults.front(), "p");
        protocol_ = std::move(parsed.protocol);
        auto worlds = felt_worlds(protocol_);
        ASSERT_TRUE(worlds);
        worlds_ = std::move(*worlds);
    }
    template <typename Each>
    void each_cell(const Each& each) {
        for (const study::Group& group : protocol_.groups)
            for (const Rule& rule : kRules) {
                SCOPED_TRACE("group " + group.code + ", stage " + rule.stage);
                each(group, rule, *protocol_.stage(rule.stage));
            }
    }

    study::Protocol protocol_;
    FeltWorlds worlds_;
};

// What a session was ordered last of an object; nothing where it was not.
class LiveStage {
public:
    LiveStage(const study::Protocol& protocol, const study::Group& group, const FeltWorlds& worlds,
              const study::Stage& stage)
        : activity_(protocol, group, worlds, {{1, 1, &stage}}, "study", StudyDevice{study::study_wand(protocol)},
                    StageKeeper{}),
          place_m_(worlds.at("tube")->world().spine_m.front()) {
        frame();
    }
    void frame() {
        std::vector<haptics::TickRecord> ticks(2);
        for (haptics::TickRecord& tick : ticks) {
            tick.tick = ++tick_;
            tick.time_ns = static_cast<Nanoseconds>(1000 + tick_) * 1'000'000;
            tick.contact.point_count = 2;
            for (std::size_t i = 0; i < 2; ++i)
                tick.contact.points[i].hip_object_m = place_m_ + Vec3(0.0, i == 0 ? 0.03 : -0.03, 0.0);
        }
        session::ActivityOrders orders;
        hand_.step(activity_, ticks, orders, nullptr, tool_);
        take(orders);
    }
    void say(const std::string& word) {
        session::ActivityOrders orders;
        const std::vector<std::string> words{word};
        EXPECT_TRUE(activity_.act(words, orders));
        take(orders);
        frame();
    }
    [[nodiscard]] std::optional<double> last(const std::string& object, ObjectProperty property) const {
        const auto found = ordered_.find({object, property});
        return found != ordered_.end() ? std::optional(found->second) : std::nullopt;
    }
    // The tube that a session opens with presses: that it does not has to be ordered.
    [[nodiscard]] bool pressed() const { return last("tube", ObjectProperty::stiffness).value_or(600.0) > 1.0; }
    [[nodiscard]] bool seen() const { return last("seen tube", ObjectProperty::seen).value_or(1.0) != 0.0; }
    [[nodiscard]] bool led() const {
        haptics::TickParameters parameters;
        activity_.adjust({}, parameters);
        return parameters.curve.count > 0 && parameters.guidance.stiffness_N_per_m > 0.0;
    }

private:
    void take(const session::ActivityOrders& orders) {
        for (const session::EditObject& edit : orders.edits) ordered_[{edit.object, edit.property}] = edit.value[0];
    }

    StudyActivity activity_;
    Vec3 place_m_;
    haptics::ToolState tool_;
    OneHand hand_;
    std::map<std::pair<std::string, ObjectProperty>, double> ordered_;
    std::uint64_t tick_ = 0;
};

TEST_F(GroupRules, ShowTheTubeToWhomTheyShowItAndToNobodyElse) {
    each_cell([&](const study::Group& group, const Rule& rule, const study::Stage& stage) {
        EXPECT_EQ(sees_tube(stage, group), rule.seen && group.sees_tube);
        for (const bool touching : {false, true}) {
            StageMoment moment;
            moment.touches_wall = touching;
            const auto shown = shown_objects(*worlds_.at("tube"), stage, group, moment);
            const auto of = [&](scene::ObjectId id) { return *std::ranges::find(shown, id, &ShownObject::id); };
            EXPECT_EQ(of(study::kSeenTubeObject).seen, rule.seen && group.sees_tube);
            EXPECT_FALSE(of(study::kTubeObject).seen) << "the felt one stands where the seen one is";
            EXPECT_TRUE(of(study::kStartCapObject).seen && of(study::kEndCapObject).seen);
        }
    });
}

TEST_F(GroupRules, PressTheTubeOnWhomTheyPressItAndOnNobodyElse) {
    each_cell([&](const study::Group& group, const Rule& rule, const study::Stage& stage) {
        EXPECT_EQ(feels_tube(stage, group), rule.pressed && group.feels_tube);
        if (stage.world.empty()) return;
        const study::StageTouch touch(protocol_, stage, group, *worlds_.at("tube"));
        const auto& materials = touch.parameters().materials;
        EXPECT_EQ(materials[study::kTubeMaterial].stiffness_N_per_m, rule.pressed && group.feels_tube ? 600.0 : 0.0);
        EXPECT_EQ(materials[study::kFunnelMaterial].stiffness_N_per_m, 600.0) << "funnels press on everybody";
        EXPECT_EQ(touch.leads(), rule.led && group.feels_tube);
    });
}

TEST_F(GroupRules, HaveALiveSessionShowPressAndLeadLikewiseWithinAStageAndBesideIt) {
    each_cell([&](const study::Group& group, const Rule& rule, const study::Stage& stage) {
        LiveStage live(protocol_, group, worlds_, stage);
        EXPECT_FALSE(live.seen() || live.pressed() || live.led()) << "before the stage";
        live.say("start");
        EXPECT_EQ(live.seen(), rule.seen && group.sees_tube);
        EXPECT_EQ(live.pressed(), rule.pressed && group.feels_tube);
        EXPECT_EQ(live.led(), rule.led && group.feels_tube);
        live.say("stop");
        EXPECT_FALSE(live.seen() || live.pressed() || live.led()) << "after the stage";
    });
}

}  // namespace
}  // namespace burin::activities
