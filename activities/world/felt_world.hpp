// SPDX-License-Identifier: MIT
// Explores a world by feel (burin world FILE --stroke): a simulated hand leads a simulated Omni along a stroke, feels
// the world's objects, and is pushed back by them. Objects on paths move meanwhile. It is a session that nobody sees
// (activities/world/exploration.hpp); here is the hand's script, and what is collected of the ticks.
// In simulated time, on the caller's thread: every run gives the same bits.
// Frame: the scene's, metres; forces at the device, newtons.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "activities/world/explored_world.hpp"
#include "base/error.hpp"
#include "devices/hand/simulated_hand.hpp"
#include "sculpt/stroke_file.hpp"
#include "session/felt/felt_figures.hpp"
#include "session/felt/rendered_tally.hpp"

namespace burin::session {
class DrawnWorld;  // session/objects/drawn_world.hpp
}  // namespace burin::session

namespace burin::activities {

struct ExploreOptions {
    double tool_radius_m = 0.004;  // of the ball that touches
    devices::HandGrip grip;
    // Facts for a recording, besides the settings of the exploration.
    std::vector<std::pair<std::string, std::string>> facts = {};
};

// One update at which an object was touched.
struct TouchedPoint {
    double time_s = 0.0;    // since the beginning
    double force_N = 0.0;   // on the hand
    double beyond_m = 0.0;  // of the hand from where its tool rests, in the scene
};

// Sums up the touches of one object: when it was touched first, how long, how strongly.
struct ObjectTouch {
    scene::ObjectId id = 0;
    std::string name;
    std::uint64_t updates = 0;  // of the service, at which it was the object touched
    double first_s = 0.0;       // since the beginning
    double force_max_N = 0.0, force_mean_N = 0.0;
    std::vector<TouchedPoint> course = {};
    session::RenderedTally wall = {};  // of every tick
};

struct WorldFigures {
    session::FeltFigures felt;
    std::vector<ObjectTouch> touches;  // in the order of the objects; those that were touched
};

// The tool, and an object newly touched, at an update of the service: enough to draw a picture of it.
struct WorldMoment {
    double time_s = 0.0;  // since the beginning
    haptics::ToolState tool;
    // Name of an object that has been touched for the first time, some updates ago: pressed by now.
    std::optional<std::string> newly_touched;
    const session::DrawnWorld* drawn = nullptr;  // as it is now; valid during the call
};
using OnUpdate = std::function<Result<void>(const WorldMoment& moment)>;

// Feels the objects of the world along a stroke of at least one row. Where the stroke is larger than the workspace, the
// motion is scaled up. Fails when an update does, or what is called at one, or the recording.
[[nodiscard]] Result<WorldFigures> explore_by_feel(const ExploredWorld& world, const sculpt::Stroke& stroke,
                                                   const ExploreOptions& options, const OnUpdate& on_update);

}  // namespace burin::activities
