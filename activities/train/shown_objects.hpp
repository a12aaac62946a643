// SPDX-License-Identifier: MIT
// What of a study's world a participant sees at a moment of a stage, object by object: pictures and live sessions take
// it from here. Pure; any thread.
#pragma once

#include <array>
#include <vector>

#include "study/felt/stage_session.hpp"

namespace burin::activities {

struct StageMoment {
    std::array<Vec3, 2> points_m{};  // top, bottom
    Quat orientation{1.0, 0.0, 0.0, 0.0};
    bool touches_wall = false, start_touched = false, end_touched = false;
    double time_s = 0.0;  // since the stage's beginning
};
// The moment of the session's last tick. touches_wall: in it.
[[nodiscard]] StageMoment moment_of(const study::FeltWorld& world, const study::StageSession& session,
                                    bool touches_wall);

// Returns whether a point touches the tube in a tick, whose objects have the study's own numbers.
[[nodiscard]] bool touches_wall(const haptics::TickRecord& record);

// Says how an object of study/felt/felt_world.hpp looks.
struct ShownObject {
    scene::ObjectId id = 0;
    bool seen = false;
    scene::Colour colour{};
    double opacity = 1.0;

    bool operator==(const ShownObject&) const = default;
};

// Returns whether the group sees the tube in the stage; by default nobody does in a trial.
[[nodiscard]] bool sees_tube(const study::Stage& stage, const study::Group& group);

// Returns whether the group feels the tube in the stage; by default nobody does in a trial. study/felt/stage_touch.hpp
// has the same of a stage's own ticks.
[[nodiscard]] bool feels_tube(const study::Stage& stage, const study::Group& group);

// The tube is green, and red while either point touches its wall; the wand is seen in it, as in the funnels. A cap is
// grey, and green while both points are in it.
[[nodiscard]] std::vector<ShownObject> shown_objects(const study::FeltWorld& world, const study::Stage& stage,
                                                     const study::Group& group, const StageMoment& moment);

}  // namespace burin::activities
