// SPDX-License-Identifier: MIT
// Explores a world with a wand (burin world FILE --device simulated-wand): a simulated hand leads the wand along a
// stroke, positions and turns, and each of its points feels the world's objects.
//
// What is kept is what a study of such a wand records (W16 of the requirements): the handle's place and its turn as
// axis and angle; for each point its place, where its proxy rests, which object it touches, the force there and its
// deviation from the proxy; the sums; and the clock. In the scene's axes, at every update of the scene; every tick goes
// into the sums. Frame: the scene's, metres. Thread: the caller's; time is simulated.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "activities/wand/wand_run.hpp"
#include "sculpt/stroke_file.hpp"
#include "session/felt/rendered_tally.hpp"

namespace burin::activities {

// A point of the wand at one time.
struct PointFelt {
    Vec3 place_m{0.0}, proxy_m{0.0};
    Vec3 force_N{0.0};           // its part of what is given, but for the torque's
    scene::ObjectId object = 0;  // that it touches; 0: none
};

struct WandFelt {
    double time_s = 0.0;
    Pose scene_from_tool;
    std::vector<PointFelt> points;
    Vec3 force_N{0.0}, torque_Nm{0.0};              // desired, of the contact
    Vec3 given_force_N{0.0}, given_torque_Nm{0.0};  // commanded to the motors
};

// Sums up the touches of one object by one point.
struct PointTouch {
    scene::ObjectId object = 0;
    std::string object_name, point_name;
    std::uint64_t updates = 0;
    double first_s = 0.0;
    double force_max_N = 0.0, force_mean_N = 0.0;  // as given
    session::RenderedTally wall = {};              // of every tick
};

struct WandExploredWorld {
    WandRun run;
    Similarity scene_from_device;
    bool fitted = false;  // the stroke did not fit into the workspace where the description has it
    double force_max_N = 0.0, torque_max_Nm = 0.0;
    std::uint64_t ticks_in_contact = 0, ticks_faulted = 0;
    std::vector<WandFelt> trace;
    std::vector<PointTouch> touches;  // by object, then by point
};

// Moment at an update of the scene, for pictures: with an object that has now been touched long enough to be pressed.
struct WandMoment {
    double time_s = 0.0;
    const WandFelt* felt = nullptr;
    std::optional<std::string> newly_touched;    // name of an object
    const session::DrawnWorld* drawn = nullptr;  // as it is now; valid during the call
};
using OnWandMoment = std::function<Result<void>(const WandMoment&)>;

// Leads the wand along a stroke of at least one row. Where the stroke leaves the workspace it is centred in it, and the
// motion scaled up where it is larger. Only options.scene_from_device is not read. Fails when an update does, or what
// is called at one.
[[nodiscard]] Result<WandExploredWorld> explore_with_wand(const ExploredWorld& world, const sculpt::Stroke& stroke,
                                                          const WandOptions& options, const OnWandMoment& on_moment);

// Axis and angle of a rotation: a unit axis (x where there is no turn) and an angle from 0 to pi.
struct AxisAngle {
    Vec3 axis{1.0, 0.0, 0.0};
    double angle_rad = 0.0;
};
[[nodiscard]] AxisAngle axis_angle(const Quat& unit) noexcept;

// ---- Table and figure (felt_wand_figures.cpp)

// CSV, an update a line; names of the objects stand in it, "-" where none is touched.
[[nodiscard]] std::string wand_table(const WandExploredWorld& explored, const scene::World& world,
                                     const std::vector<devices::WandPoint>& points);
[[nodiscard]] std::string wand_figure(const WandExploredWorld& explored, const std::vector<devices::WandPoint>& points);

}  // namespace burin::activities
