// SPDX-License-Identifier: MIT
#include "study/felt/reach.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.hpp"
#include "base/try.hpp"
#include "study/felt/felt_world.hpp"
#include "study/felt/stage_touch.hpp"

namespace burin::study {
namespace {

using devices::kDegree_rad;

constexpr double kSamePlace_m = 1e-5;
constexpr double kTurnStep_degrees = 1.0;

// Where the wand's middle can be in the world.
Box workspace_in_world(const devices::WandDescription& wand, const Box& world_m) {
    const Similarity placed = world_from_wand(wand, world_m);
    const Vec3 half = 0.5 * devices::device_of(wand).workspace_m;
    Box reached;
    for (const Vec3& corner : {-half, half}) reached.include(placed * corner);
    return reached;
}

// A cap as far as a wand's middle may be in it with both points inside: half widths, and depths from the face on.
struct MiddleBox {
    CapBox cap;
    std::array<double, 3> low_m{}, high_m{};

    [[nodiscard]] double room_m() const {
        double room = high_m[0] - low_m[0];
        for (std::size_t i = 1; i < 3; ++i) room = std::min(room, high_m[i] - low_m[i]);
        return room;
    }
    [[nodiscard]] Vec3 nearest(const Vec3& point_m) const {
        const std::array axes{cap.x, cap.y, cap.z};
        Vec3 place = cap.centre_m;
        for (std::size_t i = 0; i < 3; ++i)
            place += std::clamp(glm::dot(point_m - cap.centre_m, axes[i]), low_m[i], high_m[i]) * axes[i];
        return place;
    }
};

// along: from the wand's middle to its top point.
MiddleBox middle_box(const CapBox& cap, const Vec3& along_m) {
    MiddleBox box{cap, {-cap.half_width_m, -cap.half_width_m, 0.0}, {cap.half_width_m, cap.half_width_m, cap.depth_m}};
    const std::array axes{cap.x, cap.y, cap.z};
    for (std::size_t i = 0; i < 3; ++i) {
        const double reach_m = std::abs(glm::dot(along_m, axes[i]));
        box.low_m[i] += reach_m;
        box.high_m[i] -= reach_m;
    }
    return box;
}

// Whether two boxes meet: each other's nearest places come together where they do (von Neumann's projections).
bool meets(const MiddleBox& box, const Box& workspace_m) {
    Vec3 place = workspace_m.center();
    for (int i = 0; i < 500; ++i) {
        const Vec3 in_box = box.nearest(place);
        place = glm::clamp(in_box, workspace_m.lo, workspace_m.hi);
        if (glm::distance(in_box, place) < kSamePlace_m) return true;
    }
    return false;
}

Vec3 top_m(const devices::WandDescription& wand, double pitch_degrees, double roll_degrees) {
    const Quat turn = glm::angleAxis(pitch_degrees * kDegree_rad, Vec3(1.0, 0.0, 0.0)) *
                      glm::angleAxis(roll_degrees * kDegree_rad, Vec3(0.0, 0.0, 1.0));
    return turn * (0.5 * (wand.points[0].offset_m - wand.points[1].offset_m));
}

bool fits(const CapBox& cap, const Vec3& along_m, const Box& workspace_m) {
    const MiddleBox box = middle_box(cap, along_m);
    return box.room_m() >= 0.0 && meets(box, workspace_m);
}

// Over the wand's turn, in its own axes, which are the maker's.
std::optional<double> least_lean(const CapBox& cap, const devices::WandDescription& wand, const Box& workspace_m) {
    std::optional<double> least;
    const auto degrees = [](double rad) { return std::trunc(rad / kDegree_rad); };
    for (double pitch = degrees(wand.lowest_turn_rad.x); pitch <= degrees(wand.highest_turn_rad.x);
         pitch += kTurnStep_degrees) {
        for (double roll = degrees(wand.lowest_turn_rad.z); roll <= degrees(wand.highest_turn_rad.z);
             roll += kTurnStep_degrees) {
            const Vec3 along_m = top_m(wand, pitch, roll);
            const double lean = std::acos(std::clamp(along_m.y / glm::length(along_m), -1.0, 1.0)) / kDegree_rad;
            if ((!least || lean < *least) && fits(cap, along_m, workspace_m)) least = lean;
        }
    }
    return least;
}

// How far beyond the workspace the farthest place of the axis is.
double farthest_out_m(const StudyWorld& world, const Box& workspace_m) {
    double out_m = 0.0;
    for (const Vec3& p : world.spine_m)
        out_m = std::max(out_m, glm::distance(p, glm::clamp(p, workspace_m.lo, workspace_m.hi)));
    return out_m;
}

std::string lean_text(const CapReach& reach) {
    return reach.least_lean_degrees ? formatted("only a wand that leans by %.0f degrees or more would fit",
                                                std::ceil(*reach.least_lean_degrees))
                                    : std::string("no turn of the wand fits");
}

// Through a funnel's mouth, which is square, and the tube behind it, which is round.
bool passes_mouth(const StudyWorld& world, const CapBox& cap, const Vec3& along_m) {
    const double x_m = std::abs(glm::dot(along_m, cap.x)), y_m = std::abs(glm::dot(along_m, cap.y));
    const bool funnel = world.funnel_half_width_m <= 0.0 || std::max(x_m, y_m) < world.funnel_half_width_m;
    return funnel && std::hypot(x_m, y_m) < world.tube_radius_m;
}

}  // namespace

CapReach cap_reach(const CapBox& cap, const devices::WandDescription& wand, const Box& workspace_m) {
    CapReach reach;
    reach.slope_degrees = std::asin(std::clamp(std::abs(cap.z.y), 0.0, 1.0)) / kDegree_rad;
    const MiddleBox upright = middle_box(cap, top_m(wand, 0.0, 0.0));
    reach.room_m = upright.room_m();
    reach.in_workspace = reach.room_m < 0.0 || meets(upright, workspace_m);
    reach.least_lean_degrees = reach.fits() ? 0.0 : least_lean(cap, wand, workspace_m);
    return reach;
}

std::vector<ReachFault> reach_faults(const Protocol& protocol, const StudyWorld& world, const Box& bounds_m) {
    const devices::WandDescription wand = study_wand(protocol);
    const Box workspace_m = workspace_in_world(wand, bounds_m);
    const Vec3 along_m = top_m(wand, 0.0, 0.0);
    std::vector<ReachFault> faults;
    for (const auto& [name, cap] : {std::pair{"start", start_cap(world)}, std::pair{"end", end_cap(world)}}) {
        const std::string which = formatted("world %s: the %s cap cannot ", world.name.c_str(), name);
        const CapReach reach = cap_reach(cap, wand, workspace_m);
        const double apart_m = 2.0 * std::abs(glm::dot(along_m, cap.z));
        if (reach.room_m < 0.0)
            faults.push_back(
                {which +
                     formatted("hold both points at %.1f degrees: upright they are %.1f mm apart "
                               "along the path's end, and the cap is %g mm deep and %g mm wide; ",
                               reach.slope_degrees, 1e3 * apart_m, 1e3 * cap.depth_m, 2e3 * cap.half_width_m) +
                     lean_text(reach),
                 formatted("write cap_depth_m = %.3f or more, or have the path end less steeply",
                           std::ceil(1e3 * (apart_m + kLittleRoom_m)) * 1e-3)});
        else if (!reach.in_workspace)
            faults.push_back(
                {which + "be reached: the wand's middle does not come where both points are in it; " + lean_text(reach),
                 "move the path's end into what the wand reaches, 0.48 x 0.25 x 0.45 m"});
        if (!passes_mouth(world, cap, along_m))
            faults.push_back(
                {formatted("world %s: both points do not pass the mouth behind the %s cap", world.name.c_str(), name),
                 "widen funnel or tube"});
    }
    const double out_m = farthest_out_m(world, workspace_m);
    if (out_m > world.tube_radius_m)
        faults.push_back({formatted("world %s: the path goes %.0f mm beyond what the wand's middle reaches, and the "
                                    "tube is %.0f mm wide about it",
                                    world.name.c_str(), 1e3 * out_m, 1e3 * world.tube_radius_m),
                          "make the path smaller: the wand reaches 0.48 x 0.25 x 0.45 m"});
    return faults;
}

std::vector<std::string> reach_warnings(const Protocol& protocol, const StudyWorld& world, const Box& bounds_m) {
    const devices::WandDescription wand = study_wand(protocol);
    const Box workspace_m = workspace_in_world(wand, bounds_m);
    std::vector<std::string> warnings;
    for (const auto& [name, cap] : {std::pair{"start", start_cap(world)}, std::pair{"end", end_cap(world)}}) {
        const CapReach reach = cap_reach(cap, wand, workspace_m);
        if (!reach.fits() || reach.room_m >= kLittleRoom_m) continue;
        warnings.push_back(formatted("world %s: the %s cap leaves an upright wand %.1f mm of room at %.1f degrees",
                                     world.name.c_str(), name, 1e3 * reach.room_m, reach.slope_degrees));
    }
    return warnings;
}

Result<std::vector<WorldReach>> reach_of(const Protocol& protocol) {
    std::vector<WorldReach> found;
    for (const StudyWorld& world : protocol.worlds) {
        BURIN_TRY(felt, FeltWorld::create(world));
        const Box& bounds_m = felt->bounds();
        found.push_back({reach_faults(protocol, world, bounds_m), reach_warnings(protocol, world, bounds_m)});
    }
    return found;
}

}  // namespace burin::study
