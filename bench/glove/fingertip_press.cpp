// SPDX-License-Identifier: MIT
#include "bench/glove/fingertip_press.hpp"

#include "base/try.hpp"

#include <algorithm>
#include <cmath>

namespace burin::bench {
namespace {

using geometry::PatchPoint;
using Patch = std::vector<PatchPoint>;

// The plate is the plane z = 0, the ball's top is the origin: both lie below it.
double depth_at(const Vec3& place, PressedOn on, double ball_m) {
    if (on == PressedOn::plate) return -place.z;
    return ball_m - glm::length(place - Vec3(0.0, 0.0, -ball_m));
}
Vec3 normal_at(const Vec3& place, PressedOn on, double ball_m) {
    return on == PressedOn::plate ? Vec3(0.0, 0.0, 1.0) : glm::normalize(place - Vec3(0.0, 0.0, -ball_m));
}

// Finds the height to which the turned pad is lifted so that its deepest place is at the depth. By bisection: the
// higher the pad, the less deep it is.
double lift_of(const Patch& pad, const Quat& turn, PressedOn on, const PressTask& task) {
    const auto deepest = [&](double lift) {
        double depth = -HUGE_VAL;
        for (const PatchPoint& p : pad)
            depth = std::max(depth, depth_at(turn * p.place_tip_m + Vec3(0.0, 0.0, lift), on, task.ball_m));
        return depth;
    };
    double low = -0.02, high = 0.05;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (deepest(middle) > task.depth_m ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

Quat turn_by(double angle_rad, TurnedAbout about) {
    return glm::angleAxis(angle_rad, about == TurnedAbout::bone ? Vec3(0.0, 1.0, 0.0) : Vec3(1.0, 0.0, 0.0));
}

std::vector<double> forces_over(const Patch& patch, const Patch& pad, const std::vector<double>& angles,
                                TurnedAbout about, PressedOn on, const PressTask& task) {
    std::vector<double> forces;
    forces.reserve(angles.size());
    const double flat = force_of(patch, pad, Quat(1.0, 0.0, 0.0, 0.0), on, task);
    for (const double angle : angles) forces.push_back(force_of(patch, pad, turn_by(angle, about), on, task) / flat);
    return forces;
}

// The force that a departure is divided by: the reference's at the same angle, or the reference's when flat.
enum class ShareOf { force, flat_force };

Departure departure_of(const std::vector<double>& forces, const std::vector<double>& reference,
                       const std::vector<double>& angles, ShareOf share_of) {
    Departure found;
    double squares = 0.0;
    for (std::size_t i = 0; i < forces.size(); ++i) {
        const double away = std::abs(forces[i] - reference[i]) / (share_of == ShareOf::force ? reference[i] : 1.0);
        squares += away * away;
        if (away <= found.worst) continue;
        found.worst = away;
        found.worst_rad = angles[i];
    }
    found.rms = std::sqrt(squares / static_cast<double>(forces.size()));
    return found;
}

// The largest pad that the fingertip has skin for.
Result<std::pair<double, Patch>> pad_of(const geometry::HandModel& hand, geometry::Finger finger,
                                        const PressTask& task) {
    Result<Patch> pad = geometry::fingertip_patch(hand, finger, {task.reference_points, task.pad_m});
    double extent_m = task.pad_m;
    while (!pad && extent_m > 0.001) {
        extent_m -= 0.00025;
        pad = geometry::fingertip_patch(hand, finger, {task.reference_points, extent_m});
    }
    if (!pad) return std::unexpected(pad.error());
    return std::pair{extent_m, std::move(*pad)};
}

constexpr PressedOn kSurfaces[] = {PressedOn::plate, PressedOn::ball};
constexpr TurnedAbout kTurns[] = {TurnedAbout::bone, TurnedAbout::across};

}  // namespace

double force_of(const Patch& patch, const Patch& pad, const Quat& turn, PressedOn on, const PressTask& task) {
    const double lift = lift_of(pad, turn, on, task);
    Vec3 force(0.0);
    for (const PatchPoint& p : patch) {
        const Vec3 place = turn * p.place_tip_m + Vec3(0.0, 0.0, lift);
        force += p.share * std::max(0.0, depth_at(place, on, task.ball_m)) * normal_at(place, on, task.ball_m);
    }
    return glm::length(force);
}

Result<PressFigures> press_fingertip(const geometry::HandModel& hand, geometry::Finger finger, const PressTask& task) {
    BURIN_TRY(pad, pad_of(hand, finger, task));
    PressFigures figures;
    figures.pad_m = pad.first;
    for (std::size_t i = 0; i < task.angles; ++i) {
        const double part = 2.0 * static_cast<double>(i) / static_cast<double>(task.angles - 1) - 1.0;
        figures.angles_rad.push_back(part * task.most_rad);
    }
    const Quat flat(1.0, 0.0, 0.0, 0.0);
    const double pad_flat = force_of(pad.second, pad.second, flat, PressedOn::plate, task);
    std::vector<double> of_pad[2][2];
    for (std::size_t s = 0; s < 2; ++s)
        for (std::size_t t = 0; t < 2; ++t)
            of_pad[s][t] = forces_over(pad.second, pad.second, figures.angles_rad, kTurns[t], kSurfaces[s], task);
    for (std::size_t t = 0; t < 2; ++t) figures.pad_force[t] = of_pad[0][t];
    for (const double extent_m : task.extents_m) {
        const auto dense = geometry::fingertip_patch(hand, finger, {task.reference_points, extent_m});
        if (!dense) continue;  // there is no skin so far out
        std::vector<double> of_dense[2][2];
        for (std::size_t s = 0; s < 2; ++s)
            for (std::size_t t = 0; t < 2; ++t)
                of_dense[s][t] = forces_over(*dense, pad.second, figures.angles_rad, kTurns[t], kSurfaces[s], task);
        for (const std::size_t points : task.points) {
            if (points == 1 && extent_m != task.extents_m.front()) continue;  // one point has no extent
            BURIN_TRY(patch, geometry::fingertip_patch(hand, finger, {points, extent_m}));
            PatchFigures f{points,
                           points == 1 ? 0.0 : extent_m,
                           force_of(patch, pad.second, flat, PressedOn::plate, task) / pad_flat,
                           {},
                           {}};
            for (std::size_t s = 0; s < 2; ++s)
                for (std::size_t t = 0; t < 2; ++t) {
                    const auto forces =
                        forces_over(patch, pad.second, figures.angles_rad, kTurns[t], kSurfaces[s], task);
                    f.departures[s][t] = departure_of(forces, of_pad[s][t], figures.angles_rad, ShareOf::force);
                    f.of_own_extent[s][t] =
                        departure_of(forces, of_dense[s][t], figures.angles_rad, ShareOf::flat_force);
                    if (s == 0) figures.patch_forces[t].push_back(forces);
                }
            figures.patches.push_back(f);
        }
    }
    return figures;
}

}  // namespace burin::bench
