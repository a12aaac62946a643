// SPDX-License-Identifier: MIT
// What a panel shows of an activity (session/activity/activity.hpp), and what a person is told of it. Plain data.
//
//   panel.widgets.push_back(ActivityPanel::Slider{
//       .name = "Apart", .value = apart_m, .from = 0.001, .to = 0.02, .step = 0.0005, .unit = "mm",
//       .units_in_one = 1000.0, .act = {"apart"}});
//
// shows "Apart ---o--- 4.0 mm", and gives the act `do apart 0.004` where it is dragged there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "session/input/key.hpp"

namespace burin::session {

// Its section of the panel, from top to bottom.
struct ActivityPanel {
    using ActWords = std::vector<std::string>;  // the words behind `do`

    // Widgets that show.
    struct Row {
        std::string name, value;
        bool operator==(const Row&) const = default;
    };
    struct Page {
        std::string text;  // a paragraph
        bool operator==(const Page&) const = default;
    };
    struct Plot {
        std::string name, value;
        std::vector<float> values = {};  // the newest last
        float limit = 0.0f;              // drawn as a line; 0: none
        float least_top = 1.0f;          // of the scale
        bool operator==(const Plot&) const = default;
    };
    // Widgets that give an act. All but a button put the new value behind its words.
    struct Button {
        std::string title;
        ActWords act;
        bool enabled = true;
        std::string asks = {};  // a question that the panel asks before it gives the act; empty: it gives it at once
        std::optional<Key> key = std::nullopt;  // that gives the act too, before it is any short cut
        bool operator==(const Button&) const = default;
    };
    struct Slider {
        std::string name;
        double value = 0.0, from = 0.0, to = 1.0;
        double step = 0.0;          // values are whole steps above `from`, and `to`; 0: about a hundredth of the range
        std::string unit = {};      // shown behind the number
        double units_in_one = 1.0;  // 1000 for millimetres, where the value is in metres
        ActWords act = {};
        bool enabled = true;
        bool operator==(const Slider&) const = default;
    };
    struct Choice {
        struct Value {
            std::string title, word;
            bool operator==(const Value&) const = default;
        };
        std::string name;
        std::vector<Value> values;
        std::size_t chosen = 0;  // as many as there are: none
        ActWords act = {};
        bool enabled = true;
        std::string asks = {};                  // as a button's
        std::optional<Key> key = std::nullopt;  // that gives the value behind the chosen one, and the first at the end
        bool operator==(const Choice&) const = default;
    };
    struct Swatches {
        std::string name;                            // left of the colours; empty: none
        std::vector<std::array<double, 3>> colours;  // sRGB
        std::size_t chosen = 0;                      // as many as there are: none
        ActWords act = {};                           // the word is "R,G,B"
        bool enabled = true;
        bool operator==(const Swatches&) const = default;
    };
    struct Field {
        std::string title;  // of the button behind the line of text
        ActWords act = {};
        std::string hint = {};  // shown while nothing is written
        bool enabled = true;
        bool operator==(const Field&) const = default;
    };
    // Buttons that follow each other stand side by side, in several rows where there are many.
    using Widget = std::variant<Row, Page, Plot, Button, Slider, Choice, Swatches, Field>;

    // What a person is doing now, drawn large over the picture: forces against what is asked, how long they are to be
    // held, and what comes next.
    struct Task {
        struct Bar {
            std::string name;               // "index"
            double asked_N = 0.0;           // what the device is told to give
            std::optional<double> given_N;  // what it measures that it gives
            double target_N = 0.0;          // 0: none is asked
            double full_N = 1.0;            // the bar's length
            std::uint32_t colour_srgb = 0;  // 0xRRGGBB
            bool operator==(const Bar&) const = default;
        };
        std::string state;          // "Paused"; empty: it is under way
        std::string next;           // "Squeeze the ball"
        std::string progress = {};  // "2 of 5"
        std::vector<Bar> bars = {};
        double hold_s = 0.0, held_s = 0.0;  // how long it is to be held, and has been; 0: it is not
        bool operator==(const Task&) const = default;
    };
    // A table for who leads the session, which a panel in a window of its own shows. Cells of a row: as many as heads.
    struct Table {
        std::string title;
        std::vector<std::string> heads;
        std::vector<std::vector<std::string>> rows;
        bool operator==(const Table&) const = default;
    };
    std::string title = {}, aside = {};  // the aside stands right of the title, in a word or two
    // A paragraph for the person, above all widgets; where the panel has a window of its own, all that the person sees
    // of it. Empty: none.
    std::string page = {};
    std::vector<Widget> widgets = {};
    // All that is felt and seen is the activity's alone (governed.hpp): no panel, key or command changes it, and the
    // panel shows none of its sections. Widgets that give acts then stand at the panel's foot, where nothing moves
    // them.
    bool governs = false;
    // The panel shows none of the scene's sections, since they are no matter of the person's; all else stays as it is.
    bool hides_scene = false;
    std::optional<Task> task = std::nullopt;
    std::vector<Table> tables = {};      // for who leads the session
    std::vector<std::string> help = {};  // paragraphs, before all other help
    bool operator==(const ActivityPanel&) const = default;

    // Adds widgets of one kind, in order.
    template <typename Kind>
    void add(std::vector<Kind> more) {
        for (Kind& one : more) widgets.emplace_back(std::move(one));
    }
    // Returns the widgets of a kind, in order.
    template <typename Kind>
    [[nodiscard]] std::vector<Kind> all() const {
        std::vector<Kind> found;
        for (const Widget& widget : widgets)
            if (const auto* const one = std::get_if<Kind>(&widget)) found.push_back(*one);
        return found;
    }
    [[nodiscard]] std::vector<Row> rows() const { return all<Row>(); }
    [[nodiscard]] std::vector<Button> buttons() const { return all<Button>(); }
};

// Returns the act's words with a value behind them.
[[nodiscard]] inline ActivityPanel::ActWords with_value(ActivityPanel::ActWords act, std::string value) {
    act.push_back(std::move(value));
    return act;
}

}  // namespace burin::session
