// SPDX-License-Identifier: MIT
// The widgets of an activity's section: where they stand, what they give for the mouse and for a wand, and that a
// session whose slider was dragged is done again to the bit.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "session/record/session_check.hpp"
#include "tests/desk/panel_models.hpp"
#include "tests/desk/recorded_session.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

using Commands = std::vector<CommandInput>;

CommandInput act(std::vector<std::string> words) { return {"do", std::move(words)}; }

// A panel that is used by the mouse or by a wand, which give it the same.
class WidgetDesk {
public:
    explicit WidgetDesk(ActivityPanel activity, ImageSize size = {340, 1180})
        : panel(std::move(*Panel::create({.size = size}))) {
        model = idle_model();
        model.activity = std::move(activity);
    }
    Commands show() { return panel.show(model, now_ns_ += 16'000'000).actions; }
    PixelRect place(const std::string& label) {
        static_cast<void>(show());
        const auto at = panel.place_of(label);
        EXPECT_TRUE(at) << label;
        return at.value_or(PixelRect{});
    }
    // Points at a place within a widget, each share from 0 to 1.
    Vec2 within(const std::string& label, double across) {
        const PixelRect at = place(label);
        return {at.x + across * at.width, at.y + 0.5 * at.height};
    }
    Commands at(const Vec2& at_px, bool pressed) {
        if (by_wand) {
            panel.point(at_px, pressed);
            return show();
        }
        std::vector<InputEvent> events{{now_ns_, MouseMove{at_px}}};
        if (pressed != was_pressed_) events.push_back({now_ns_, MouseClick{MouseButton::left, pressed, {}}});
        was_pressed_ = pressed;
        panel.feed(events);
        return show();
    }
    Commands click(const std::string& label) {
        const Vec2 there = within(label, 0.5);
        Commands given = at(there, false);
        for (const bool down : {true, false})
            for (CommandInput& command : at(there, down)) given.push_back(std::move(command));
        return given;
    }

    PanelModel model;
    Panel panel;
    bool by_wand = false;

private:
    Nanoseconds now_ns_ = 0;
    bool was_pressed_ = false;
};

ActivityPanel::Slider beads() {
    return {.name = "Apart",
            .value = 0.004,
            .from = 0.001,
            .to = 0.02,
            .step = 0.0005,
            .unit = "mm",
            .units_in_one = 1000.0,
            .act = {"apart"}};
}

// One of each kind.
ActivityPanel all_kinds() { return all_widgets_model().activity.value(); }

const std::vector<std::string>& labels_of_all() {
    static const std::vector<std::string> kLabels{"do apart",      "do shape ball", "do shape cube", "do kind",
                                                  "do colour 1",   "do colour 3",   "do clear",      "do stop",
                                                  "field do note", "do note"};
    return kLabels;
}

}  // namespace

TEST(ActivityWidgets, StandInTheirOrderAndWithinThePanel) {
    for (const bool governs : {false, true}) {
        WidgetDesk desk(all_kinds());
        desk.model.activity->governs = governs;
        std::uint32_t top = 0;
        for (const std::string& label : labels_of_all()) {
            const PixelRect at = desk.place(label);
            EXPECT_GE(at.y, top) << label << ", governs " << governs;
            EXPECT_LE(at.x + at.width, 340u) << label;
            top = at.y;
        }
        EXPECT_LE(desk.place("do note").y + desk.place("do note").height, 1180u);
        EXPECT_EQ(desk.place("do clear").y, desk.place("do stop").y) << "buttons that follow each other";
    }
    // In another order they stand in that.
    ActivityPanel turned = all_kinds();
    std::ranges::reverse(turned.widgets);
    WidgetDesk desk(turned);
    EXPECT_LT(desk.place("do note").y, desk.place("do apart").y);
}

TEST(ActivityWidgets, SliderGivesItsActOncePerValueWithTheValueAtTheEnd) {
    for (const bool by_wand : {false, true}) {
        WidgetDesk desk({.title = "Trail", .widgets = {beads()}});
        desk.by_wand = by_wand;
        EXPECT_TRUE(desk.at(desk.within("do apart", 0.5), false).empty()) << "nothing is pressed";
        const Commands pressed = desk.at(desk.within("do apart", 0.5), true);
        ASSERT_EQ(pressed.size(), 1u);
        EXPECT_EQ(pressed[0], act({"apart", "0.0105"})) << "the middle, on a step";
        EXPECT_TRUE(desk.at(desk.within("do apart", 0.5), true).empty()) << "held, at rest";
        std::get<ActivityPanel::Slider>(desk.model.activity->widgets[0]).value = 0.0105;
        EXPECT_TRUE(desk.at(desk.within("do apart", 0.5), true).empty()) << "as the activity has it now";
        EXPECT_EQ(desk.at(desk.within("do apart", 2.0), true), (Commands{act({"apart", "0.02"})})) << "beyond its end";
        EXPECT_EQ(desk.at(desk.within("do apart", -1.0), true), (Commands{act({"apart", "0.001"})}));
        EXPECT_TRUE(desk.at(desk.within("do apart", -1.0), false).empty()) << "let go";
        EXPECT_TRUE(desk.at(desk.within("do apart", 0.7), false).empty());
    }
}

// Every value that a hand can choose is one that the act takes, with no more digits than its step.
TEST(ActivityWidgets, SliderGivesWholeStepsAndBothEnds) {
    for (const double step : {0.0005, 0.003, 0.0, 1.0}) {
        ActivityPanel::Slider slider = beads();
        slider.step = step;
        WidgetDesk desk({.title = "Trail", .widgets = {slider}});
        for (int place = 0; place <= 20; ++place) {
            const Commands given = desk.at(desk.within("do apart", 0.05 * place), true);
            for (const CommandInput& command : given) {
                const double value = std::stod(command.arguments[1]);
                EXPECT_GE(value, 0.001);
                EXPECT_LE(value, 0.02);
                EXPECT_LE(command.arguments[1].size(), 7u) << command.arguments[1];
                if (step > 0.0 && value != 0.02) {
                    EXPECT_NEAR(std::remainder(value - 0.001, step), 0.0, 1e-12) << step;
                }
            }
        }
    }
}

TEST(ActivityWidgets, ThatHaveNoSoundValueAreDrawnAndGiveNoNonsense) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const auto& [value, from, to] :
         {std::tuple{nan, 0.0, 1.0}, std::tuple{0.5, 1.0, 1.0}, std::tuple{0.5, nan, 1.0}, std::tuple{0.5, 2.0, 1.0},
          std::tuple{7.0, 0.0, 1.0}}) {
        ActivityPanel::Slider slider{
            .name = "Odd", .value = value, .from = from, .to = to, .step = 0.1, .act = {"odd"}};
        WidgetDesk desk({.title = "Odd",
                         .widgets = {slider, ActivityPanel::Choice{.name = "None", .values = {}, .act = {"none"}},
                                     ActivityPanel::Swatches{.name = "None", .colours = {}, .act = {"bare"}},
                                     ActivityPanel::Plot{"Flat", "-", {}, 0.0f, 1.0f},
                                     ActivityPanel::Plot{"Gap", "-", {1.0f, std::nanf(""), 2.0f}, 0.0f, 1.0f}}});
        for (const CommandInput& command : desk.at(desk.within("do odd", 0.5), true))
            EXPECT_EQ(command.arguments[1], "0.5") << value << from << to;
    }
}

TEST(ActivityWidgets, ChoicesSwatchesButtonsAndFieldsGiveTheirWordsOnce) {
    for (const bool by_wand : {false, true}) {
        WidgetDesk desk(all_kinds());
        desk.by_wand = by_wand;
        EXPECT_EQ(desk.click("do shape cube"), (Commands{act({"shape", "cube"})}));
        EXPECT_TRUE(desk.click("do shape ball").empty()) << "it is chosen";
        EXPECT_EQ(desk.click("do colour 3"), (Commands{act({"colour", "0.2,0.4,0.8"})}));
        EXPECT_TRUE(desk.click("do colour 1").empty()) << "it is chosen";
        EXPECT_EQ(desk.click("do clear"), (Commands{act({"clear"})}));
        EXPECT_TRUE(desk.click("do stop").empty()) << "it asks";
        EXPECT_EQ(desk.click("yes, do stop"), (Commands{act({"stop"})}));
        // Too many names for a row are a list.
        EXPECT_TRUE(desk.click("do kind").empty());
        EXPECT_EQ(desk.click("do kind squeeze"), (Commands{act({"kind", "squeeze"})}));
        EXPECT_TRUE(desk.click("field do note").empty());
        desk.panel.feed(std::vector<InputEvent>{{0, TextInput{"two words"}}});
        EXPECT_TRUE(desk.show().empty());
        desk.panel.feed(std::vector<InputEvent>{{0, KeyInput{Key::enter, KeyMotion::press, {}}}});
        EXPECT_EQ(desk.show(), (Commands{act({"note", "two words"})}));
        EXPECT_TRUE(desk.click("do note").empty()) << "it was written once";
    }
}

TEST(ActivityWidgets, ThatAreNotEnabledGiveNothing) {
    ActivityPanel activity = all_kinds();
    for (ActivityPanel::Widget& widget : activity.widgets)
        std::visit(
            [](auto& one) {
                if constexpr (requires { one.enabled; }) one.enabled = false;
            },
            widget);
    WidgetDesk desk(activity, {340, 2400});
    for (const std::string& label : labels_of_all()) EXPECT_TRUE(desk.click(label).empty()) << label;
    EXPECT_FALSE(desk.panel.place_of("do kind squeeze")) << "its list stays closed";
    EXPECT_TRUE(desk.click("force").size() == 1u) << "what stands below is the panel's own, and works";
}

TEST(ActivityWidgets, ChoiceMayAskFirst) {
    ActivityPanel::Choice choice{
        .name = "Shape", .values = {{"Ball", "ball"}, {"Cube", "cube"}}, .act = {"shape"}, .asks = "Begin anew?"};
    WidgetDesk desk({.title = "Trail", .widgets = {choice}});
    EXPECT_TRUE(desk.click("do shape cube").empty());
    EXPECT_TRUE(desk.click("no").empty());
    EXPECT_TRUE(desk.click("do shape cube").empty());
    EXPECT_EQ(desk.click("yes, do shape cube"), (Commands{act({"shape", "cube"})}));
}

namespace {

// Goes by the distance that its slider says, adds up what the hand has moved in such steps, and has a key for a choice.
class Stepping final : public Activity {
public:
    [[nodiscard]] std::string settings() const override { return "stepping"; }
    [[nodiscard]] std::span<const Act> acts() const override {
        static constexpr std::array<std::string_view, 2> kWays{"up", "down"};
        static constexpr std::array kSteppingActs{Act{"apart", "METRES", "", {number_within(0.001, 0.02, "m")}},
                                                  Act{"way", "NAME", "", {name_of_these(kWays)}}};
        return kSteppingActs;
    }
    [[nodiscard]] Result<void> act(std::span<const std::string> words, ActivityOrders&) override {
        given.push_back(words[0] + " " + words[1]);
        if (words[0] == "way") is_down = words[1] == "down";
        if (words[0] == "apart") apart_m = number_of(words[1]);
        return {};
    }
    void step(const ActivityView& view, ActivityOrders&) override {
        for (const haptics::TickRecord& tick : view.first_part().ticks)
            sum += (is_down ? -1.0 : 1.0) * tick.contact.points[0].proxy_object_m.z / apart_m;
    }
    [[nodiscard]] std::uint64_t check() const override {
        CheckSum of_all;
        of_all.add(sum);
        of_all.add(apart_m);
        return of_all.sum();
    }
    [[nodiscard]] bool is_running() const override { return true; }
    [[nodiscard]] ActivityPanel panel() const override {
        ActivityPanel::Slider slider = beads();
        slider.value = apart_m;
        return {.title = "Stepping",
                .widgets = {slider, ActivityPanel::Choice{.name = "Way",
                                                          .values = {{"Up", "up"}, {"Down", "down"}},
                                                          .chosen = is_down ? 1u : 0u,
                                                          .act = {"way"},
                                                          .key = Key::f6}}};
    }
    std::vector<std::string> given;
    double sum = 0.0, apart_m = 0.004;
    bool is_down = false;
};

constexpr ImageSize kWithPanel{1280, 720};

SessionSetup stepping_options(const std::string& record, std::shared_ptr<Stepping> activity) {
    SessionSetup options = short_options(record);
    options.activity = std::move(activity);
    return options;
}

}  // namespace

// Each eye has its own panel in its half of the output: the slider is dragged where it is seen, with either.
TEST(ActivityWidgets, AreLedInEitherHalfOfASideBySidePicture) {
    for (const char* const mode : {"side_by_side_half", "side_by_side"}) {
        const auto stepping = std::make_shared<Stepping>();
        SimulatedClock clock;
        const SessionSetup options = stepping_options("", stepping);
        auto desk = *Desk::create(options, *session_wall(options.desk), clock);
        Nanoseconds now_ns = 0;
        const auto send = [&](const std::vector<Input>& inputs) {
            std::vector<InputEvent> events;
            for (const Input& input : inputs) events.push_back({now_ns, input});
            now_ns += 16'000'000;
            desk->step({now_ns, now_ns, events}, {.size = kWithPanel}, desk->session().newest_tool(),
                       [](Executor::Order) {});
        };
        send({CommandInput{"stereo-mode", {mode}}});
        send({});
        const auto slider = desk->place_on_panel("do apart");
        ASSERT_TRUE(slider) << mode;
        const wall::OutputSettings output = desk->output_on(0);
        const ImageSize eye = wall::eye_size(output.mode, kWithPanel);
        for (const double half : {0.0, 0.5}) {
            const std::size_t before = stepping->given.size();
            const auto at = [&](double part) {
                return Vec2((half + 0.5 * (slider->x + part * slider->width) / eye.width) * kWithPanel.width,
                            (slider->y + 0.5 * slider->height) / eye.height * kWithPanel.height);
            };
            send({MouseMove{at(0.4)}});
            send({MouseClick{MouseButton::left, true, {}}});
            send({MouseMove{at(0.9)}});
            send({MouseClick{MouseButton::left, false, {}}});
            send({});
            EXPECT_GE(stepping->given.size(), before + 2) << mode << ", half " << half;
            EXPECT_GT(stepping->apart_m, 0.015) << mode << ", half " << half;
        }
    }
}

// The slider is dragged with the mouse, said by a script, and the choice's key is pressed: what the recording keeps of
// all that is words, which give the same ticks and the same state of the activity in each frame.
TEST(ActivityWidgets, SessionWhoseSliderWasDraggedIsDoneAgainToTheBit) {
    std::string script;
    {
        SimulatedClock clock;
        const SessionSetup options = stepping_options("", std::make_shared<Stepping>());
        auto desk = *Desk::create(options, *session_wall(options.desk), clock);
        desk->step({0, 0, {}}, {.size = kWithPanel}, desk->session().newest_tool(), [](Executor::Order) {});
        const auto slider = desk->place_on_panel("do apart");
        ASSERT_TRUE(slider);
        const int y = static_cast<int>(slider->y + slider->height / 2);
        const auto x = [&](double part) { return std::to_string(static_cast<int>(slider->x + part * slider->width)); };
        script = "burin-input 1 test\n0.02 mouse 100 180\n0.05 scroll 0 9\n0.1 mouse " + x(0.3) + " " +
                 std::to_string(y) + "\n0.15 button press left\n";
        for (int i = 1; i <= 10; ++i)
            script += formatted("%.2f mouse ", 0.15 + 0.02 * i) + x(0.3 + 0.05 * i) + " " + std::to_string(y) + "\n";
        script +=
            "0.4 button release left\n0.45 command do apart 0.0123\n0.5 key press f6\n0.55 key release f6\n0.7 close\n";
    }
    const Workplace place;
    const std::string path = (place / "a.session").string();
    const auto live = std::make_shared<Stepping>(), again = std::make_shared<Stepping>();
    const std::uint64_t ticks = record_live(stepping_options(path, live), script, kWithPanel);
    EXPECT_GE(live->given.size(), 5u) << testing::PrintToString(live->given);
    EXPECT_TRUE(live->is_down);
    EXPECT_EQ(live->apart_m, 0.0123);
    EXPECT_NE(live->sum, 0.0);

    auto log = log_in(path);
    ASSERT_TRUE(log) << log.error().line();
    const Judged is = judged(std::move(*log), path, stepping_options("", again), kWithPanel);
    ASSERT_TRUE(is.done) << is.done.error().line();
    EXPECT_EQ(is.found.ticks, ticks);
    EXPECT_FALSE(is.found.difference);
    EXPECT_EQ(is.departed, 0u);
    EXPECT_EQ(again->given, live->given);
    EXPECT_EQ(again->sum, live->sum);
}

}  // namespace burin::session
