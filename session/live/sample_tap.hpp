// SPDX-License-Identifier: MIT
// Keeps every tick of each part of the hands for an activity. A part of the scene that touches nothing: so they reach
// the frames with the number of the update that read them, live as in a replay. Threads: as any ScenePart's.
#pragma once

#include <utility>
#include <vector>

#include "haptics/tick_record.hpp"
#include "scene/scene_changes.hpp"
#include "scene/scene_part.hpp"

namespace burin::session {

using scene::HandNews;

class SampleTap final : public scene::ScenePart {
public:
    void take_ticks(std::size_t part, std::span<const haptics::TickRecord> ticks) override {
        if (news_.ticks.size() <= part) news_.ticks.resize(part + 1);
        news_.ticks[part].insert(news_.ticks[part].end(), ticks.begin(), ticks.end());
    }
    [[nodiscard]] Result<void> update(Nanoseconds, const scene::PartSeen*) override { return {}; }
    [[nodiscard]] const scene::PartSeen& seen() const override { return seen_; }
    [[nodiscard]] Result<void> add_near(const scene::ProbeBall&, geometry::LocalSurface&) override { return {}; }
    [[nodiscard]] Nanoseconds period_ns() const override { return kPeriod_ns; }

    void take_changes(scene::SceneChanges& changes) override { changes.hands.add(std::exchange(news_, {})); }

private:
    // As often as a hand that moves asks for: an activity's clock runs while the hand rests.
    static constexpr Nanoseconds kPeriod_ns = 10'000'000;

    HandNews news_;
    scene::PartSeen seen_;
};

}  // namespace burin::session
