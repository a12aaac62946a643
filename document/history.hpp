// SPDX-License-Identifier: MIT
// The one history of a session: in which order the steps of all parts of its scene were made, whatever these are.
//
// A step is named by its part and the part's own number of it (scene/part_steps.hpp). What a step was, the part alone
// knows; it goes back and forward by itself. The history says whose turn it is. Those before done() lead back, the last
// of them first; those behind lead forward.
//
// Data flow: a part makes steps, wherever it works -> PartSteps -> follow() on the frame's thread -> undo: back() says
// which part -> order to that part, ordered() -> what the part says once it was carried out -> follow().
//
// Hardest failure: a list that names steps which a part has not, so that undo takes back something else. So whatever a
// part says of itself holds: follow() takes out what the part has dropped, adds what it has made, and moves what it has
// gone without being told. What a part says of before an order that is under way is left out; the next says it.
// A new step of any part ends redo in every part; take_forgotten() says which parts have to drop steps for it.
//
// Format of bytes(), little-endian: the count of steps that lead back (u32); then, for each run of steps of one part
// with rising numbers, the part (u32), the count (u32) and the first number (i64).
// Pure; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "scene/part_steps.hpp"

namespace burin::document {

struct StepName {
    std::uint32_t part = 0;  // by its number in the document, which is the one in the scene
    std::int64_t number = 0;

    bool operator==(const StepName&) const = default;
};

class History {
public:
    static constexpr std::size_t kMostSteps = 4'000'000;  // that are read

    // Takes a part's own account of its steps.
    void follow(std::uint32_t part, const scene::PartSteps& now);
    // Takes the steps of a part at an opening: the list is made to name just these. Those that it does not name come
    // behind all others.
    void adopt(std::uint32_t part, const scene::PartSteps& now);
    // Takes over another list and goes on with what is known of the parts.
    void replace_order(const History& order);

    // Returns whose step is the next back, or forward; nothing: there is none.
    [[nodiscard]] std::optional<StepName> back() const;
    [[nodiscard]] std::optional<StepName> forward() const;
    // Says that an order to go was given to a part that carries it out later. Where its step is the next, it has gone.
    void ordered(std::uint32_t part, scene::StepWay way);
    // Returns whether steps of the part could be repeated until another part made a step; once.
    [[nodiscard]] bool take_forgotten(std::uint32_t part) { return forgotten_.erase(part) > 0; }
    // Returns all other such parts, once.
    [[nodiscard]] std::set<std::uint32_t> take_forgotten() { return std::exchange(forgotten_, {}); }

    [[nodiscard]] std::size_t done() const { return done_; }
    [[nodiscard]] std::span<const StepName> steps() const { return steps_; }
    // Returns whether a step of the part could be repeated.
    [[nodiscard]] bool leads_forward(std::uint32_t part) const;

    [[nodiscard]] std::vector<std::byte> bytes() const;
    // Reads what bytes() has written; returns nothing for other bytes.
    [[nodiscard]] static std::optional<History> from(std::span<const std::byte> bytes);

    // Compares the lists.
    bool operator==(const History& other) const { return steps_ == other.steps_ && done_ == other.done_; }

private:
    // Counts, of one part, the steps that it has stated last and the orders to go that it was given.
    struct Known {
        std::uint64_t made = 0, ordered = 0;
    };
    void drop_forward(std::uint32_t by);
    void settle(std::uint32_t part, const scene::PartSteps& now);
    void add(std::uint32_t part, const scene::PartSteps& now);

    std::vector<StepName> steps_;
    std::size_t done_ = 0;
    std::map<std::uint32_t, Known> known_;
    std::set<std::uint32_t> forgotten_;
};

}  // namespace burin::document
