// SPDX-License-Identifier: MIT
// Keeps what hands have done for an activity: every tick of each part, and what they have begun and ended to touch. A
// part of the scene that touches nothing: so both reach the frames with the number of the update that read them, live
// as in a replay. Threads: as any part's (scene/scene_part.hpp).
#pragma once

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "scene/scene_part.hpp"

namespace burin::session {

// What the hands have done in some updates of the scene.
struct HandNews {
    std::vector<std::vector<haptics::TickRecord>> ticks;  // of each part of the hands, by its number
    std::vector<scene::ContactEvent> contacts;

    [[nodiscard]] bool empty() const {
        return contacts.empty() && std::ranges::all_of(ticks, [](const auto& of_part) { return of_part.empty(); });
    }
    // Adds later news.
    void add(HandNews later) {
        if (ticks.size() < later.ticks.size()) ticks.resize(later.ticks.size());
        for (std::size_t part = 0; part < later.ticks.size(); ++part)
            std::ranges::move(later.ticks[part], std::back_inserter(ticks[part]));
        std::ranges::move(later.contacts, std::back_inserter(contacts));
    }
};

class SampleTap final : public scene::ScenePart {
public:
    void take_ticks(std::size_t part, std::span<const haptics::TickRecord> ticks) override {
        if (news_.ticks.size() <= part) news_.ticks.resize(part + 1);
        news_.ticks[part].insert(news_.ticks[part].end(), ticks.begin(), ticks.end());
    }
    void take_contacts(std::span<const scene::ContactEvent> events) override {
        news_.contacts.insert(news_.contacts.end(), events.begin(), events.end());
    }
    [[nodiscard]] Result<void> update(Nanoseconds, const scene::PartSeen*) override { return {}; }
    [[nodiscard]] const scene::PartSeen& seen() const override { return seen_; }
    [[nodiscard]] Result<void> add_near(const scene::ProbeBall&, geometry::LocalSurface&) override { return {}; }
    [[nodiscard]] Nanoseconds period_ns() const override { return kPeriod_ns; }

    // Returns what has come since the last call.
    [[nodiscard]] HandNews take() { return std::exchange(news_, {}); }

private:
    // As often as a hand that moves asks for: an activity's clock runs while the hand rests.
    static constexpr Nanoseconds kPeriod_ns = 10'000'000;

    HandNews news_;
    scene::PartSeen seen_;
};

}  // namespace burin::session
