// SPDX-License-Identifier: MIT
// What the panel is put together from: cards, sliders, segments, switches, lists, buttons, plots. Each is laid out and drawn here, from
// plain values; what the user does with one becomes a command. For the files of the panel alone; the toolkit's context is current.
// Lengths are pixels at scale 1 until px() has been applied.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/command_table.hpp"
#include "app/session/panel_look.hpp"
#include "app/session/panel_model.hpp"

namespace burin::panel {

// What the panel remembers from frame to frame, of its own; nothing of the session's.
struct Memory {
    std::vector<std::string> closed;  // sections
    std::string path;                 // in the text field
    std::string model_path;           // as the model had it
    CommandInput last;                // given by what is held, so that a hand that rests gives it once
    std::string open_list;            // the label of the list that is open
};

struct Item {
    std::string label;  // also its command's, for Panel::place_of
    std::string text;
    bool enabled = true;
};

struct Kit {
    Type type;
    float scale = 1.0f;
    Memory memory;
    // Of this frame.
    std::map<std::string, PixelRect, std::less<>> places;
    std::vector<CommandInput> actions;
    bool again = false;  // what has just opened is seen in the next layout only: make one at once
    ImVec2 visible_lo{}, visible_hi{};
    float card_top = 0.0f;
    bool first_in_card = true;

    [[nodiscard]] float px(float length) const { return length * scale; }
    void give(const SessionCommand& command);
    // Once for each value, however long the hand rests on it.
    void give_held(const SessionCommand& command);
    // Remembers the last item's place.
    void note(const std::string& label);

    // Text from a place on; how wide it is.
    float write(ImVec2 at, ImU32 colour, std::string_view text, ImFont* font = nullptr);
    void write_right(float right, float top, ImU32 colour, std::string_view text, ImFont* font = nullptr);
    void write_middle(ImVec2 lo, ImVec2 hi, ImU32 colour, std::string_view text, ImFont* font = nullptr);
    [[nodiscard]] ImVec2 size_of(std::string_view text, ImFont* font = nullptr) const;
    // What of it fits, with an ellipsis in place of the rest.
    [[nodiscard]] std::string shortened(std::string_view text, float room, ImFont* font = nullptr) const;
    // Broken into lines, as wide as the card; below what was laid out before.
    void paragraph(ImU32 colour, std::string_view text, ImFont* font = nullptr);
    void gap(float height);

    // A card with a title that opens and closes it; false: closed. end_card() in both cases.
    bool begin_card(const char* title, std::string_view aside = {});
    void end_card();
    [[nodiscard]] float width() const;  // of what is laid out

    // One of several; the place of the one that was pressed.
    std::optional<std::size_t> segments(std::span<const Item> items, std::size_t selected, float height = 28.0f);
    // Between 0 and 1; a new value while it is held.
    std::optional<double> slider(const std::string& label, std::string_view title, double part, std::string_view value);
    void quantity(Quantity quantity, std::string_view title, double value, std::string_view text);
    // Whether it was switched.
    bool toggle(const std::string& label, std::string_view title, bool on, std::string_view aside = {});
    // A list that opens over the panel.
    std::optional<std::size_t> list(const std::string& label, std::string_view title, std::span<const Item> items,
                                    std::size_t selected);
    bool button(const std::string& label, std::string_view text, float width, bool enabled = true, bool strong = false,
                float height = 28.0f);
    // whole: its width in pixels.
    void plot(std::string_view title, std::string_view value, const PanelPlot& plot, ImU32 colour, float least_top,
              float whole);
    void progress(double part, std::string_view text);
    void banner(Condition condition, std::string_view title, std::string_view text);
    // A line of "name ..... value".
    void figure(std::string_view name, std::string_view value, ImU32 colour = kText);
    void lamp(ImVec2 middle, Condition condition);
};

[[nodiscard]] ImU32 colour_of(Condition condition);
// Where a value stands on a quantity's slider, and back, rounded to what a hand can mean.
[[nodiscard]] double part_of(double value, double from, double to, bool by_ratio);
[[nodiscard]] double value_at(double part, double from, double to, bool by_ratio);
// To so many significant digits, as short as it gets: 0.00412 -> 0.0041.
[[nodiscard]] double rounded(double value, int digits);
// printf with a number.
[[nodiscard]] std::string written(const char* format, double value);

}  // namespace burin::panel
