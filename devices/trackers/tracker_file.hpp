// SPDX-License-Identifier: MIT
// The description of a tracker, as TOML: where it is heard, which of its bodies is the head and which the wands, and
// what its reports mean in the world (tracker_bodies.hpp). A file of its own, or the table [tracker] of a wall's file.
// docs/formats.md describes every key.
//
// Reading refuses what it does not understand: all problems are told at once, each with FILE:LINE and the remedy.
// Any thread; allocates.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "devices/trackers/tracker_bodies.hpp"

namespace burin::devices {

struct TrackerDescription {
    std::string file;     // that has it, for messages
    std::string name;     // for people
    std::string address;  // as open_tracker() takes it, without settings
    TrackerBodies bodies;
};

// A description that is a file. `name` stands for the file in messages.
[[nodiscard]] Result<TrackerDescription> parse_tracker(std::string_view text, const std::string& name);
[[nodiscard]] Result<TrackerDescription> read_tracker(const std::filesystem::path& path);

// The table [tracker] of a wall's file: a description, or `file`, whose name is relative to the wall's file, with an
// `address` of this wall's own beside it. Nothing where the file has no such table.
[[nodiscard]] Result<std::optional<TrackerDescription>> tracker_of_wall(const std::filesystem::path& wall);

// Writes every setting, defaults included, as such a file; metres. `under` begins the names of its tables: "tracker"
// for a table of a wall's file, empty for a file of its own.
[[nodiscard]] std::string tracker_text(const TrackerDescription& tracker, const std::string& under = {});

}  // namespace burin::devices
