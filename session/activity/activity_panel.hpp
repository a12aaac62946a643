// SPDX-License-Identifier: MIT
// What a panel shows of an activity (session/activity/activity.hpp), and what a person is told of it. Plain data.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "session/input/key.hpp"

namespace burin::session {

// Its section of the panel, from top to bottom.
struct ActivityPanel {
    struct Row {
        std::string name, value;
        bool operator==(const Row&) const = default;
    };
    struct Button {
        std::string title;
        std::vector<std::string> act;  // the words behind `do`
        bool enabled = true;
        std::string asks = {};  // a question that the panel asks before it gives the act; empty: it gives it at once
        std::optional<Key> key = std::nullopt;  // that gives the act too, before it is any short cut
        bool operator==(const Button&) const = default;
    };
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
    std::string title, aside;  // the aside stands right of the title, in a word or two
    std::string page;          // a paragraph for the person; empty: none
    std::vector<Row> rows;
    std::vector<Button> buttons;  // side by side, in several rows where there are many
    std::string field = {};       // the act that a line of text is for, behind the buttons; empty: there is no field
    // All that is felt and seen is the activity's alone (governed.hpp): no panel, key or command changes it, and the
    // panel shows none of its sections. Buttons and field then stand at the panel's foot, where nothing moves them.
    bool governs = false;
    // The panel shows none of the scene's sections, since they are no matter of the person's; all else stays as it is.
    bool hides_scene = false;
    std::optional<Task> task = std::nullopt;
    std::vector<Table> tables = {};      // for who leads the session
    std::vector<std::string> help = {};  // paragraphs, before all other help
    bool operator==(const ActivityPanel&) const = default;
};

}  // namespace burin::session
