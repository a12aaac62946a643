// SPDX-License-Identifier: MIT
// Keeps what a hand has done for an activity: every tick whose stroke the scene's service has read, whole and in order.
// A part of the scene that touches nothing: so the ticks reach the frames with the number of the update that read them,
// live as in a replay. Threads: as any part's (scene/scene_part.hpp).
#pragma once

#include <utility>
#include <vector>

#include "scene/scene_part.hpp"

namespace burin::session {

class SampleTap final : public scene::ScenePart {
public:
    explicit SampleTap(std::size_t hand) : hand_(hand) {}

    void take_ticks(std::size_t hand, std::span<const haptics::TickRecord> ticks) override {
        if (hand == hand_) ticks_.insert(ticks_.end(), ticks.begin(), ticks.end());
    }
    [[nodiscard]] Result<void> update(Nanoseconds, const scene::PartSeen*) override { return {}; }
    [[nodiscard]] const scene::PartSeen& seen() const override { return seen_; }
    [[nodiscard]] Result<void> add_near(const scene::ProbeBall&, geometry::LocalSurface&) override { return {}; }
    [[nodiscard]] Nanoseconds period_ns() const override { return kPeriod_ns; }

    // Returns the ticks since the last call.
    [[nodiscard]] std::vector<haptics::TickRecord> take() { return std::exchange(ticks_, {}); }

private:
    // As often as a hand that moves asks for: an activity's clock runs while the hand rests.
    static constexpr Nanoseconds kPeriod_ns = 10'000'000;

    std::size_t hand_;
    std::vector<haptics::TickRecord> ticks_;
    scene::PartSeen seen_;
};

}  // namespace burin::session
