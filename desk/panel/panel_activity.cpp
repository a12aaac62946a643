// SPDX-License-Identifier: MIT
// The panel's section for the activity: its widgets in their order, each drawn as the panel's own sections draw theirs.
// Where the activity governs, those that give acts stand at the panel's foot.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "desk/panel/panel_sections.hpp"
#include "session/input/command_form.hpp"

namespace burin::session::panel {
namespace {

constexpr float kButtonHeight = 28.0f, kSliderHeight = 24.0f, kSwatchesHeight = 30.0f, kBetweenButtons = 6.0f;
constexpr float kNameWidth = 92.0f;  // of what stands left of a slider, a list and a choice
constexpr std::size_t kMostFieldBytes = 200;

using Widgets = std::span<const ActivityPanel::Widget>;

// Returns whether a widget is one that gives acts.
bool gives(const ActivityPanel::Widget& widget) {
    return !std::holds_alternative<ActivityPanel::Row>(widget) &&
           !std::holds_alternative<ActivityPanel::Page>(widget) && !std::holds_alternative<ActivityPanel::Plot>(widget);
}
bool is_button(const ActivityPanel::Widget& widget) { return std::holds_alternative<ActivityPanel::Button>(widget); }

// Returns how many widgets from here on stand side by side: buttons, or one of another kind.
std::size_t run_from(Widgets rest) {
    const auto end = std::ranges::find_if_not(rest, is_button);
    return std::max<std::size_t>(static_cast<std::size_t>(end - rest.begin()), 1);
}

// Returns how many buttons of so many stand side by side: no more than their titles have room for, in rows as full as
// each other.
std::size_t buttons_across(std::size_t buttons) {
    constexpr std::size_t kMostInARow = 6;
    const std::size_t rows = (buttons + kMostInARow - 1) / kMostInARow;
    return std::max<std::size_t>(rows > 0 ? (buttons + rows - 1) / rows : 1, 1);
}

std::string label_of(const ActivityPanel::ActWords& act) {
    std::string label = "do";
    for (const std::string& word : act) label += " " + word;
    return label;
}

// Gives an act, or has the panel ask first.
void give_or_ask(Kit& kit, const ActivityPanel::ActWords& act, const std::string& asks) {
    kit.memory.asking = asks.empty() ? std::string() : label_of(act);
    if (asks.empty()) kit.give(DoAct{act});
}

// Greys the widgets until the scope's end where they are not enabled.
class Enabled {
public:
    Enabled(Kit& kit, bool enabled) : kit_(kit) {
        if (!enabled) kit_.off("It cannot be changed now.");
    }
    ~Enabled() { kit_.off({}); }
    Enabled(const Enabled&) = delete;
    Enabled& operator=(const Enabled&) = delete;

private:
    Kit& kit_;
};

void show_buttons(Kit& kit, Widgets buttons) {
    const float space = kit.px(kBetweenButtons);
    const std::size_t across = buttons_across(buttons.size());
    const auto count = static_cast<float>(across);
    const float each = (kit.width() - space * (count - 1.0f)) / count;
    for (std::size_t i = 0; i < buttons.size(); ++i) {
        const auto& button = std::get<ActivityPanel::Button>(buttons[i]);
        if (i % across > 0) ImGui::SameLine(0.0f, space);
        if (kit.button(label_of(button.act), kit.shortened(button.title, each - kit.px(6.0f)), each, button.enabled))
            give_or_ask(kit, button.act, button.asks);
    }
}

// Returns the number with as many decimals as its steps can be told apart by, and its unit.
std::string text_of(const ActivityPanel::Slider& slider) {
    if (!std::isfinite(slider.value)) return "-";
    const double step = slider.units_in_one * (slider.step > 0.0 ? slider.step : 0.01 * (slider.to - slider.from));
    int decimals = step > 0.0 ? std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6) : 0;
    // A step of 0.25 has one decimal more than its size says.
    const double tenfold = step * std::pow(10.0, decimals);
    if (decimals < 6 && std::abs(tenfold - std::round(tenfold)) > 1e-6) ++decimals;
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*f", decimals, slider.units_in_one * slider.value);
    return slider.unit.empty() ? std::string(text.data()) : std::string(text.data()) + " " + slider.unit;
}

// Returns the value at a place from 0 to 1, on a step, with no more digits than it needs.
double value_of(const ActivityPanel::Slider& slider, double part) {
    if (!(slider.step > 0.0)) return value_at(part, slider.from, slider.to, false);
    if (part >= 1.0) return slider.to;
    const double steps = std::round(part * (slider.to - slider.from) / slider.step);
    return std::clamp(rounded(slider.from + steps * slider.step, 12), slider.from, slider.to);
}

// Writes a widget's name where it has one, and leaves the rest of the line to the widget.
void beside_name(Kit& kit, std::string_view name, float height, bool enabled) {
    if (name.empty()) return;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float top = at.y + 0.5f * (kit.px(height) - kit.type.text->FontSize);
    kit.write({at.x, top}, enabled ? kDim : kFaint, kit.shortened(name, kit.px(kNameWidth - 6.0f)));
    ImGui::SetCursorScreenPos({at.x + kit.px(kNameWidth), at.y});
}

void show(Kit& kit, const ActivityPanel::Row& row) { kit.figure(row.name, row.value); }
void show(Kit& kit, const ActivityPanel::Page& page) {
    kit.paragraph(kText, page.text);
    kit.gap(6.0f);
}
void show(Kit& kit, const ActivityPanel::Plot& plot) {
    kit.plot(plot.name, plot.value, {plot.values, plot.limit}, kAccent, plot.least_top, kit.width());
}
void show(Kit& kit, const ActivityPanel::Button& button) {
    const ActivityPanel::Widget one = button;
    show_buttons(kit, {&one, 1});
}

void show(Kit& kit, const ActivityPanel::Slider& slider) {
    const bool has_range = slider.from < slider.to;
    const Enabled enabled(kit, slider.enabled && has_range);
    const double at =
        has_range && std::isfinite(slider.value) ? part_of(slider.value, slider.from, slider.to, false) : 0;
    const auto part =
        kit.slider(label_of(slider.act), kit.shortened(slider.name, kit.px(kNameWidth - 2.0f)), at, text_of(slider));
    if (!part) return;
    const double wanted = value_of(slider, *part);
    if (wanted != slider.value) kit.give_held(DoAct{with_value(slider.act, exact_word(wanted))});
}

void show(Kit& kit, const ActivityPanel::Choice& choice) {
    const Enabled enabled(kit, choice.enabled);
    std::vector<Item> items;
    float widest = 0.0f;
    for (const ActivityPanel::Choice::Value& value : choice.values) {
        items.push_back({label_of(with_value(choice.act, value.word)), value.title});
        widest = std::max(widest, kit.size_of(value.title, kit.type.strong).x);
    }
    if (items.empty()) return;
    const float name = choice.name.empty() ? 0.0f : kit.px(kNameWidth);
    const float each = (kit.width() - name) / static_cast<float>(items.size());
    std::optional<std::size_t> chosen;
    if (widest + kit.px(10.0f) > each) {
        chosen =
            kit.list(label_of(choice.act), kit.shortened(choice.name, kit.px(kNameWidth - 6.0f)), items, choice.chosen);
    } else {
        beside_name(kit, choice.name, kButtonHeight, choice.enabled);
        chosen = kit.segments(items, choice.chosen);
    }
    if (chosen && *chosen != choice.chosen)
        give_or_ask(kit, with_value(choice.act, choice.values[*chosen].word), choice.asks);
}

void show(Kit& kit, const ActivityPanel::Swatches& swatches) {
    if (swatches.colours.empty()) return;
    const Enabled enabled(kit, swatches.enabled);
    const auto give = [&](const std::array<double, 3>& srgb) {
        kit.give(DoAct{with_value(swatches.act, exact_word(srgb))});
    };
    beside_name(kit, swatches.name, kSwatchesHeight, swatches.enabled);
    show_swatches(kit, label_of(swatches.act), {swatches.colours, swatches.chosen}, give);
}

void show(Kit& kit, const ActivityPanel::Field& field) {
    const Enabled enabled(kit, field.enabled);
    std::string& text = kit.memory.fields[label_of(field.act)];
    std::array<char, kMostFieldBytes> bytes{};
    text.copy(bytes.data(), bytes.size() - 1);
    const float button = std::max(kit.px(64.0f), kit.size_of(field.title).x + kit.px(16.0f));
    const float gap = kit.px(kBetweenButtons);
    ImGui::SetNextItemWidth(kit.width() - button - gap);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                        {kit.px(10.0f), 0.5f * (kit.px(kButtonHeight) - kit.type.text->FontSize)});
    const std::string id = "##" + label_of(field.act);
    const ImGuiInputTextFlags reads = field.enabled ? 0 : ImGuiInputTextFlags_ReadOnly;
    const bool entered = ImGui::InputTextWithHint(id.c_str(), field.hint.c_str(), bytes.data(), bytes.size(),
                                                  ImGuiInputTextFlags_EnterReturnsTrue | reads);
    kit.note("field " + label_of(field.act));
    ImGui::PopStyleVar();
    text = bytes.data();
    ImGui::SameLine(0.0f, gap);
    const bool written = !text.empty();
    const bool pressed = kit.button(label_of(field.act), field.title, button, written);
    if (!written || !field.enabled || !(pressed || entered)) return;
    kit.give(DoAct{with_value(field.act, text)});
    text.clear();
}

// A question that the panel asks before it does what a widget is for.
struct Question {
    std::string label, title, asks;
    SessionCommand answer;
};

std::optional<Question> question_of(const Kit& kit, const ActivityPanel::Button& button) {
    if (!button.enabled || button.asks.empty() || label_of(button.act) != kit.memory.asking) return std::nullopt;
    return Question{kit.memory.asking, button.title, button.asks, DoAct{button.act}};
}
std::optional<Question> question_of(const Kit& kit, const ActivityPanel::Choice& choice) {
    if (!choice.enabled || choice.asks.empty()) return std::nullopt;
    for (const ActivityPanel::Choice::Value& value : choice.values) {
        const auto act = with_value(choice.act, value.word);
        if (label_of(act) == kit.memory.asking)
            return Question{kit.memory.asking, value.title, choice.asks, DoAct{act}};
    }
    return std::nullopt;
}

// Returns what is being asked: by a widget of the activity, or by Quit, which would break off what the activity has
// under way.
std::optional<Question> question_of(const Kit& kit, const ActivityPanel& activity) {
    if (activity.governs && kit.memory.asking == name_of(Action::quit))
        return Question{kit.memory.asking, "Quit", "Quit? A stage under way is broken off.", RunAction{Action::quit}};
    for (const ActivityPanel::Widget& widget : activity.widgets) {
        std::optional<Question> asked;
        if (const auto* const button = std::get_if<ActivityPanel::Button>(&widget)) asked = question_of(kit, *button);
        if (const auto* const choice = std::get_if<ActivityPanel::Choice>(&widget)) asked = question_of(kit, *choice);
        if (asked) return asked;
    }
    return std::nullopt;
}

bool may_ask(const ActivityPanel& activity) {
    const auto asks = [](const auto& widget) { return !widget.asks.empty(); };
    return activity.governs || std::ranges::any_of(activity.buttons(), asks) ||
           std::ranges::any_of(activity.all<ActivityPanel::Choice>(), asks);
}

// The line in which a widget's question stands, empty while there is none. The answer that does it lies at the left:
// buttons that ask stand at the right, so that a second click in the same place does nothing.
void show_question(Kit& kit, const ActivityPanel& activity) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const std::optional<Question> asking = question_of(kit, activity);
    if (!asking) {
        kit.memory.asking.clear();
        if (may_ask(activity)) ImGui::Dummy({kit.width(), kit.px(kButtonHeight)});
        return;
    }
    const float each = kit.px(84.0f), space = kit.px(kBetweenButtons);
    const bool yes = kit.button("yes, " + asking->label, asking->title, each, true, true);
    ImGui::SameLine(0.0f, space);
    const bool no = kit.button("no", "No", 0.5f * each);
    const float left = at.x + 1.5f * each + 2.0f * space;
    kit.write({left, at.y + 0.5f * (kit.px(kButtonHeight) - kit.type.small->FontSize)}, kWarning, asking->asks,
              kit.type.small);
    if (yes) kit.give(asking->answer);
    if (!yes && !no) return;
    kit.memory.asking.clear();
    kit.again = true;  // without the question
}

float height_of(Widgets run) {
    if (is_button(run.front())) {
        const std::size_t across = buttons_across(run.size());
        const auto rows = static_cast<float>((run.size() + across - 1) / across);
        return rows * (kButtonHeight + kBetweenButtons);
    }
    if (std::holds_alternative<ActivityPanel::Slider>(run.front())) return kSliderHeight + kBetweenButtons;
    if (std::holds_alternative<ActivityPanel::Swatches>(run.front())) return kSwatchesHeight + kBetweenButtons;
    return kButtonHeight + kBetweenButtons;
}

// Shows a run of widgets that stand side by side.
void show_run(Kit& kit, Widgets run) {
    if (is_button(run.front())) return show_buttons(kit, run);
    std::visit([&](const auto& widget) { show(kit, widget); }, run.front());
}

// Shows the widgets in order, and the question's line below the last button; below all where there is none.
void show_widgets(Kit& kit, const ActivityPanel& activity, Widgets widgets) {
    const float beside = ImGui::GetStyle().ItemSpacing.x, below = ImGui::GetStyle().ItemSpacing.y;
    const auto last = std::find_if(widgets.rbegin(), widgets.rend(), is_button);
    const auto asks_after = last != widgets.rend() ? static_cast<std::size_t>(widgets.rend() - last) : widgets.size();
    const bool has_acts = std::ranges::any_of(widgets, gives);
    for (std::size_t i = 0; i < widgets.size();) {
        const std::size_t run = run_from(widgets.subspan(i));
        if (i > 0 && gives(widgets[i]) && !gives(widgets[i - 1])) kit.gap(4.0f);
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {beside, gives(widgets[i]) ? kit.px(kBetweenButtons) : below});
        show_run(kit, widgets.subspan(i, run));
        i += run;
        if (has_acts && i == asks_after) show_question(kit, activity);
        ImGui::PopStyleVar();
    }
}

std::vector<ActivityPanel::Widget> those_that(const ActivityPanel& activity, bool give) {
    std::vector<ActivityPanel::Widget> some;
    std::ranges::copy_if(activity.widgets, std::back_inserter(some),
                         [&](const ActivityPanel::Widget& widget) { return gives(widget) == give; });
    return some;
}

}  // namespace

std::string texts_of(const ActivityPanel& activity) {
    struct Texts {
        std::string operator()(const ActivityPanel::Row& row) const { return row.name + row.value; }
        std::string operator()(const ActivityPanel::Page& page) const { return page.text; }
        std::string operator()(const ActivityPanel::Plot& plot) const { return plot.name + plot.value; }
        std::string operator()(const ActivityPanel::Button& button) const { return button.title + button.asks; }
        std::string operator()(const ActivityPanel::Slider& slider) const { return slider.name + slider.unit; }
        std::string operator()(const ActivityPanel::Choice& choice) const {
            std::string text = choice.name + choice.asks;
            for (const ActivityPanel::Choice::Value& value : choice.values) text += value.title;
            return text;
        }
        std::string operator()(const ActivityPanel::Swatches& swatches) const { return swatches.name; }
        std::string operator()(const ActivityPanel::Field& field) const { return field.title + field.hint; }
    };
    std::string texts;
    for (const ActivityPanel::Widget& widget : activity.widgets) texts += std::visit(Texts{}, widget);
    return texts;
}

float acts_height(const ActivityPanel& activity) {
    const std::vector<ActivityPanel::Widget> acts = those_that(activity, true);
    float height = kButtonHeight + kBetweenButtons + 8.0f;  // of the question
    for (Widgets rest = acts; !rest.empty();) {
        const std::size_t run = run_from(rest);
        height += height_of(rest.first(run));
        rest = rest.subspan(run);
    }
    return height;
}

void show_acts(Kit& kit, const ActivityPanel& activity) {
    const std::vector<ActivityPanel::Widget> acts = those_that(activity, true);
    show_widgets(kit, activity, acts);
    if (acts.empty()) show_question(kit, activity);
}

void show_activity(Kit& kit, const PanelModel& model) {
    if (!model.activity) return;
    const ActivityPanel& activity = *model.activity;
    if (kit.begin_card(activity.title.c_str(), activity.aside)) {
        if (!activity.page.empty()) {
            kit.paragraph(kText, activity.page);
            kit.gap(6.0f);
        }
        // What governs asks at the panel's foot.
        ActivityPanel in_card = activity;
        if (activity.governs) in_card.widgets = those_that(activity, false);
        in_card.governs = false;
        show_widgets(kit, in_card, in_card.widgets);
    }
    kit.end_card();
}

}  // namespace burin::session::panel
