// SPDX-License-Identifier: MIT
// What the panel asks about the document before anything else goes on: whether the session may end with unsaved work,
// under which name the work is to be saved, whether that file may be replaced. It lies over all else and has the mouse
// and the keyboard: Tab and arrow keys choose an answer, Enter gives it, Esc goes back.
#include <algorithm>
#include <array>
#include <initializer_list>

#include "desk/panel/panel_sections.hpp"
#include "session/input/input_event.hpp"

namespace burin::session::panel {
namespace {

constexpr float kQuestionWidth = 470.0f, kQuestionInset = 18.0f, kAnswerHeight = 30.0f, kAnswerGap = 8.0f;
constexpr ImU32 kVeil = IM_COL32(18, 20, 23, 120);

struct Answer {
    std::string label, text;
    std::optional<SessionCommand> command;  // none: the panel itself does it
};

// A question as it is laid out.
struct Asking {
    std::string title;
    std::vector<std::string> lines;
    std::vector<Answer> answers;
    std::size_t first = 0, back = 0;  // chosen at first; given by Esc
    bool has_field = false;
};

std::string with_ending(std::string name) {
    while (!name.empty() && name.back() == ' ') name.pop_back();
    return name.ends_with(".burin") ? name : name + ".burin";
}

std::string short_of(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

Asking closing(const PanelQuestion& question) {
    return {.title = question.has_file ? "Save the changes to " + short_of(question.name) + "?" : "Save the work?",
            .lines = {question.has_file ? "Discard forgets what has changed since it was saved."
                                        : "It is in no file yet. Discard forgets it.",
                      "So far " + question.kept + "."},
            .answers = {{"quit save", question.has_file ? "Save" : "Save as\u2026", QuitSave{}},
                        {"save-as", "Save as\u2026", RunAction{Action::save_as}},
                        {"quit discard", "Discard", QuitDiscard{}},
                        {"quit stay", "Go on", QuitStay{}}},
            .first = 0,
            .back = 3};
}

Asking waiting(const PanelQuestion& question) {
    return {.title = "Saving " + short_of(question.name) + "\u2026",
            .lines = {"The window closes when the work is on the disk."},
            .answers = {{"quit stay", "Go on", QuitStay{}}}};
}

Asking naming(const PanelQuestion& question, const std::string& typed) {
    return {.title = question.has_file ? "Save " + short_of(question.name) + " as" : "Save the work as",
            .lines = {},
            .answers = {{"save-as ok", "Save", SaveAs{with_ending(typed), NameIs::given}},
                        {"save-as no", "Cancel", RunAction{Action::save_as}}},
            .first = 0,
            .back = 1,
            .has_field = true};
}

Asking replacing(const PanelQuestion& question) {
    return {.title = "Replace " + short_of(question.path) + "?",
            .lines = {question.path + " is there already. What is in it would be lost."},
            .answers = {{"save-as replaced", "Replace", SaveAs{question.path, NameIs::replaced}},
                        {"save-as again", "Another name", std::nullopt}},
            .first = 1,
            .back = 1};
}

Asking asking_of(const PanelQuestion& question, Memory& memory) {
    using What = PanelQuestion::What;
    if (question.what == What::close) {
        Asking asking = closing(question);
        if (!question.has_file) {  // Save would ask for a name as well
            asking.answers.erase(asking.answers.begin() + 1);
            asking.back = 2;
        }
        return asking;
    }
    if (question.what == What::saving) return waiting(question);
    if (question.what == What::replace && memory.refused_name != question.path) return replacing(question);
    return naming(question, memory.name);
}

bool is_pressed(std::initializer_list<Key> keys) {
    return std::ranges::any_of(keys, [](Key key) { return ImGui::IsKeyPressed(static_cast<int>(key), false); });
}

// How many answers stand side by side: all where each has room for its text, else two, else one below the other.
std::size_t answers_across(const Kit& kit, const std::vector<Answer>& answers, float inside) {
    float widest = 0.0f;
    for (const Answer& answer : answers) widest = std::max(widest, kit.size_of(answer.text, kit.type.strong).x);
    const float least = widest + kit.px(20.0f), gap = kit.px(kAnswerGap);
    for (const std::size_t across : {answers.size(), std::size_t{2}}) {
        const auto count = static_cast<float>(across);
        if (across <= answers.size() && (inside - gap * (count - 1.0f)) / count >= least) return across;
    }
    return 1;
}

// Chooses by keys, and returns the answer that Enter or Esc gives.
std::optional<std::size_t> answered_by_key(Kit& kit, const Asking& asking) {
    const std::size_t count = asking.answers.size();
    std::size_t& chosen = kit.memory.answer;
    if (is_pressed({Key::escape})) return asking.back;
    if (asking.has_field) return std::nullopt;  // where arrows move in the text, and Enter is the field's
    const bool is_back = is_pressed({Key::left, Key::up}) || (is_pressed({Key::tab}) && ImGui::GetIO().KeyShift);
    const bool is_on = is_pressed({Key::right, Key::down}) || (is_pressed({Key::tab}) && !ImGui::GetIO().KeyShift);
    if (is_on) chosen = (chosen + 1) % count;
    if (is_back) chosen = (chosen + count - 1) % count;
    if (is_pressed({Key::enter, Key::keypad_enter, Key::space})) return chosen;
    return std::nullopt;
}

// The field of the name; returns whether Enter was pressed in it.
bool show_name_field(Kit& kit, float wide, bool begins) {
    std::array<char, kMostTextBytes> bytes{};
    kit.memory.name.copy(bytes.data(), bytes.size() - 8);  // leaves room for the ending
    ImGui::SetNextItemWidth(wide);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                        {kit.px(10.0f), 0.5f * (kit.px(kAnswerHeight) - kit.type.text->FontSize)});
    // Whatever else was pressed, keys are for the name.
    if (begins || (!ImGui::IsAnyItemActive() && !ImGui::IsMouseDown(0))) ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputText("##name", bytes.data(), bytes.size() - 7,
                                          ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    kit.note("name");
    ImGui::PopStyleVar();
    kit.memory.name = bytes.data();
    return entered;
}

void give_answer(Kit& kit, const PanelQuestion& question, const Answer& answer) {
    if (answer.command) return kit.give(*answer.command);
    kit.memory.refused_name = question.path;
    kit.memory.name = question.path;
    kit.again = true;
}

// What a question was asked for the last time.
std::string key_of(const PanelQuestion& question, const Asking& asking) {
    return std::to_string(static_cast<int>(question.what)) + asking.title + asking.answers.front().label;
}

}  // namespace

void show_question(Kit& kit, const PanelQuestion& question, const Area& free) {
    Memory& memory = kit.memory;
    if (question.what != PanelQuestion::What::replace) memory.refused_name.clear();
    if (memory.asked_name != question.path && question.what == PanelQuestion::What::name) {
        memory.asked_name = question.path;
        memory.name = question.path;
    }
    if (question.what == PanelQuestion::What::close || question.what == PanelQuestion::What::saving)
        memory.asked_name.clear();
    const Asking asking = asking_of(question, memory);
    const std::string key = key_of(question, asking);
    const bool begins = memory.question != key;
    if (begins) {
        memory.question = key;
        memory.answer = asking.first;
        kit.again = true;
    }
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float inset = kit.px(kQuestionInset), gap = kit.px(kAnswerGap), row = kit.px(kAnswerHeight);
    // In the part that the panel leaves free, where the question has room there.
    const bool fits = free.hi.x - free.lo.x >= kit.px(kQuestionWidth) + 2.0f * inset;
    const ImVec2 lo_room = fits ? free.lo : ImVec2{0.0f, 0.0f}, hi_room = fits ? free.hi : screen;
    const float wide = std::min(kit.px(kQuestionWidth), hi_room.x - lo_room.x - 0.5f * inset);
    const float inside = wide - 2.0f * inset;
    if (inside <= 0.0f) return;
    const auto height_of = [&](ImFont* font, const std::string& text) {
        return font->CalcTextSizeA(font->FontSize, 1e6f, inside, text.data(), text.data() + text.size()).y;
    };
    float text_height = height_of(kit.type.title, asking.title) + gap;
    for (const std::string& line : asking.lines) text_height += height_of(kit.type.text, line) + gap;
    const std::size_t across = answers_across(kit, asking.answers, inside);
    const auto rows = static_cast<float>((asking.answers.size() + across - 1) / across);
    const float height = 2.0f * inset + text_height + (asking.has_field ? row + gap : 0.0f) + rows * (row + gap) - gap;
    const ImVec2 lo{std::floor(std::max(0.5f * (lo_room.x + hi_room.x - wide), 0.0f)),
                    std::floor(std::max(0.45f * (lo_room.y + hi_room.y - height), 0.0f))};

    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::SetNextWindowSize(screen);
    ImGui::SetNextWindowFocus();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
    ImGui::Begin("question", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoSavedSettings);
    ImGui::PopStyleVar();
    ImDrawList& d = *ImGui::GetWindowDrawList();
    d.AddRectFilled({0.0f, 0.0f}, screen, kVeil);
    d.AddRectFilled(lo, {lo.x + wide, lo.y + height}, kGround | IM_COL32_A_MASK, kit.px(10.0f));
    d.AddRect(lo, {lo.x + wide, lo.y + height}, kControl, kit.px(10.0f), 0, kit.px(1.0f));
    float y = lo.y + inset;
    const auto write = [&](ImFont* font, ImU32 colour, const std::string& text) {
        d.AddText(font, font->FontSize, {lo.x + inset, std::floor(y)}, colour, text.data(), text.data() + text.size(),
                  inside);
        y += height_of(font, text) + gap;
    };
    write(kit.type.title, kText, asking.title);
    for (const std::string& line : asking.lines) write(kit.type.text, kDim, line);
    std::optional<std::size_t> given = answered_by_key(kit, asking);
    if (asking.has_field) {
        ImGui::SetCursorScreenPos({lo.x + inset, y});
        if (show_name_field(kit, inside, begins)) given = asking.first;
        y += row + gap;
    }
    const float each = (inside - gap * static_cast<float>(across - 1)) / static_cast<float>(across);
    for (std::size_t i = 0; i < asking.answers.size(); ++i) {
        const ImVec2 at{lo.x + inset + (each + gap) * static_cast<float>(i % across),
                        y + (row + gap) * static_cast<float>(i / across)};
        ImGui::SetCursorScreenPos(at);
        const bool is_chosen = asking.has_field ? i == asking.first : i == memory.answer;
        if (kit.button(asking.answers[i].label, asking.answers[i].text, each, true, is_chosen, kAnswerHeight))
            given = i;
    }
    ImGui::End();
    kit.parts.push_back({0, 0, static_cast<std::uint32_t>(screen.x), static_cast<std::uint32_t>(screen.y)});
    kit.places["question"] = {static_cast<std::uint32_t>(lo.x), static_cast<std::uint32_t>(lo.y),
                              static_cast<std::uint32_t>(wide), static_cast<std::uint32_t>(height)};
    const bool is_empty_name = asking.has_field && memory.name.empty();
    if (given && !(is_empty_name && *given == asking.first)) give_answer(kit, question, asking.answers[*given]);
}

}  // namespace burin::session::panel
