// SPDX-License-Identifier: MIT
// What a step of a session has to tell its other parts: a list of orders, as plain data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "document/history.hpp"
#include "scene/part_steps.hpp"
#include "session/notices/message_kind.hpp"
#include "session/objects/world_history.hpp"
#include "session/objects/world_orders.hpp"
#include "workpiece/carve_order.hpp"

namespace burin::session {

struct WorldObjects;  // session/objects/world_objects.hpp

// A file that is asked for, or a message about what was.
struct Asked {
    std::string text;
    std::size_t line = 0;  // of the log that asked; 0: none
    MessageKind kind = MessageKind::warning;
    bool replaces = false;  // a file that is there may go
};

// A save, of the work as it was when it was asked for.
struct AskedSave : Asked {
    std::size_t after = 0;                           // so many of the step's orders for the workpiece
    std::size_t after_goes = 0;                      // and so many of those to go
    std::shared_ptr<const WorldObjects> world = {};  // null: there is none
    WorldHistory edits = {};                         // of its objects
    document::History history = {};
};

// Has a part of the scene go a step back or forward.
struct GoOrder {
    std::uint32_t part = 0;
    scene::StepWay way = scene::StepWay::back;
    std::size_t after = 0;  // so many of the step's orders for the workpiece
};

// What the activity is told by a command.
struct AskedAct {
    std::vector<std::string> words;
    std::size_t line = 0;  // of the log that asked; 0: none
};

// How the device's amplifiers are to be switched.
struct AskedAmplifiers {
    bool on = true;
    std::size_t line = 0;  // of the log that asked; 0: none
};

// Orders that a step gives to the other parts of the session.
struct SessionOrders {
    std::size_t line = 0;  // of the log, for commands that are run now
    std::vector<workpiece::CarveOrder> carving;
    std::vector<GoOrder> goes;
    std::vector<WorldOrder> world;
    std::vector<HoldOrder> holds;  // after the edits of `world`
    std::vector<AskedAct> acts;
    std::vector<AskedAmplifiers> amplifiers;
    bool parameters = false;         // the haptic thread's parameters have changed
    std::vector<Asked> screenshots;  // names
    std::vector<AskedSave> saves;    // names of documents; empty: the one that there is
    std::vector<Asked> names;        // of documents whose places are to be looked at before they are saved there
    bool put_away = false;           // the messages that are shown
    std::vector<Asked> messages;     // for the user: why a command was not carried out; with the line of one in a log
};

}  // namespace burin::session
