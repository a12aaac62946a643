// SPDX-License-Identifier: MIT
// Widgets of the panel: cards, sliders, segments, switches, lists, buttons, plots. Each is laid out and drawn from
// plain values; what the user does with one becomes a command. For the panel's files alone; the toolkit's context is
// current. Lengths are pixels at scale 1 until px() has been applied.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "desk/panel/panel_look.hpp"
#include "desk/panel/panel_model.hpp"
#include "session/input/command_input.hpp"
#include "session/state/session_command.hpp"

namespace burin::session::panel {

// State that the panel itself keeps from frame to frame; nothing of the session's.
struct Memory {
    std::vector<std::string> closed;  // collapsed sections
    std::string path;                 // text of the path field
    std::string model_path;           // the model's path that it was copied from
    // Last command of the held widget, so that a hand at rest gives it once.
    CommandInput last;
    std::string last_for;                       // the hand that it was for; empty: the one in use
    std::string open_list;                      // the label of the list that is open
    std::string asking;                         // the label of the activity's button whose question stands there
    std::map<std::string, std::string> fields;  // texts of the activity's fields, by label
    // The question about the document: what it was when it was shown last, the answer that Enter gives, the name that
    // is typed, the one with which typing began, and one that is not to be replaced.
    std::string question;
    std::size_t answer = 0;
    std::string name, asked_name, refused_name;
};

struct Item {
    std::string label;  // also its command's, for Panel::place_of
    std::string text;
    bool enabled = true;
};

// The hand that commands are for, and the one in use, which is led again after each.
struct ForHand {
    std::string name, in_use;  // both empty: the hand in use
};

struct Kit {
    Type type;
    float scale = 1.0f;
    Memory memory;
    // State of this frame.
    std::map<std::string, PixelRect, std::less<>> places;
    std::vector<CommandInput> actions;
    // A list has just opened and appears only in the next layout: make one at once.
    bool again = false;
    ImVec2 visible_lo{}, visible_hi{};
    float card_top = 0.0f;
    bool first_in_card = true;
    ForHand for_hand;
    std::string off_because;  // why the widgets that follow can do nothing; empty: they can
    std::map<std::string, std::string, std::less<>> why_off;  // of this frame's widgets, by label
    std::string hovered;                                      // the label under the mouse
    std::vector<PixelRect> parts;                             // of what lies over all else

    [[nodiscard]] float px(float length) const { return length * scale; }
    void give(const SessionCommand& command);
    // Has what is given from now on be for another hand than the one in use, which is led for as long as it takes;
    // neither: for the hand in use again. Labels of quantities bear the name of such a hand.
    void speak_for(ForHand hand) { for_hand = std::move(hand); }
    // Greys the widgets that follow, which say why they can do nothing; empty: no more.
    void off(std::string_view because) { off_because = because; }
    // Gives the command once for each value, however long the hand rests on it.
    void give_held(const SessionCommand& command);
    void add(CommandInput input);
    // Records the last item's rectangle under its label, and whether the mouse is there.
    void note(const std::string& label);

    // Draws text from a position on; returns its width.
    float write(ImVec2 at, ImU32 colour, std::string_view text, ImFont* font = nullptr);
    void write_right(float right, float top, ImU32 colour, std::string_view text, ImFont* font = nullptr);
    void write_middle(ImVec2 lo, ImVec2 hi, ImU32 colour, std::string_view text, ImFont* font = nullptr);
    [[nodiscard]] ImVec2 size_of(std::string_view text, ImFont* font = nullptr) const;
    // Returns the part of the text that fits, with an ellipsis in place of the rest.
    [[nodiscard]] std::string shortened(std::string_view text, float room, ImFont* font = nullptr) const;
    // Draws text broken into lines as wide as the card, below what was laid out before.
    void paragraph(ImU32 colour, std::string_view text, ImFont* font = nullptr);
    void gap(float height);

    // Begins a card with a title that opens and closes it; returns false when closed. Call end_card() in both cases.
    bool begin_card(const char* title, std::string_view aside = {});
    void end_card();
    [[nodiscard]] float width() const;  // of the current layout

    // Draws one choice of several; returns the index of the one that was pressed.
    std::optional<std::size_t> segments(std::span<const Item> items, std::size_t selected, float height = 28.0f);
    // Draws a slider between 0 and 1; returns a new value while it is held.
    std::optional<double> slider(const std::string& label, std::string_view title, double part, std::string_view value);
    void quantity(Quantity quantity, std::string_view title, double value, std::string_view text);
    // Draws a switch; returns whether it was switched.
    bool toggle(const std::string& label, std::string_view title, bool on, std::string_view aside = {});
    // Draws a list that opens over the panel; returns the index chosen.
    std::optional<std::size_t> list(const std::string& label, std::string_view title, std::span<const Item> items,
                                    std::size_t selected);
    bool button(const std::string& label, std::string_view text, float width, bool enabled = true, bool strong = false,
                float height = 28.0f);
    // Draws a plot. whole: its width in pixels.
    void plot(std::string_view title, std::string_view value, const PanelPlot& plot, ImU32 colour, float least_top,
              float whole);
    // Draws a line of "name ..... value".
    void figure(std::string_view name, std::string_view value, ImU32 colour = kText);
    void lamp(ImVec2 middle, Condition condition);
};

[[nodiscard]] ImU32 colour_of(Condition condition);
// Convert a value to its position on a quantity's slider, and back, rounded to what a hand can mean.
[[nodiscard]] double part_of(double value, double from, double to, bool by_ratio);
[[nodiscard]] double value_at(double part, double from, double to, bool by_ratio);
// Rounds to so many significant digits: 0.00412 -> 0.0041.
[[nodiscard]] double rounded(double value, int digits);
// Formats one number as printf does.
[[nodiscard]] std::string written(const char* format, double value);

}  // namespace burin::session::panel
