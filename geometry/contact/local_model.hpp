// SPDX-License-Identifier: MIT
// What a tick knows of a body that gives, at one point of a probe: a plane, the force there when the body was last
// stepped, how that force changes as the point moves, and the time of it.
//
//   F = f0 + k (way of the point against the normal since then), never below 0
// A body is stepped each few milliseconds, and between two steps its surface as published stands still: a tick that
// touched that would feel a far stiffer body, each step a jump. k is the stiffness with which the body gives when it is
// pressed slowly, not that of its surface. f0 may be below 0: so it is for a point that is still outside, by k times
// its distance. What is old fades out, and never stays: see kFresh_ns.
// Units: SI, forces as the body feels them. Frame: the object frame. Pure.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/clock.hpp"
#include "base/space.hpp"

namespace burin::geometry {

struct LocalModel {
    // A body that has not been stepped for kFresh_ns begins to fade, and at kGone_ns there is nothing left of it.
    static constexpr Nanoseconds kFresh_ns = 30'000'000, kGone_ns = 100'000'000;

    std::uint32_t point = 0;   // of the probe
    std::uint32_t object = 0;  // number of the scene's object
    Vec3 normal_object{0.0};   // unit, out of the body
    Vec3 place_object_m{0.0};  // of the point when the body was stepped
    double force_N = 0.0;      // along the normal, then
    double stiffness_N_per_m = 0.0;
    double damping_Ns_per_m = 0.0;
    double surface_N_per_m = 0.0;       // of the contact alone: the surface is F over this above the point
    Vec3 velocity_object_m_per_s{0.0};  // of the body there
    Nanoseconds time_ns = 0;

    [[nodiscard]] bool is_sensible() const noexcept {
        const double square = glm::dot(normal_object, normal_object);
        return square > 0.999 && square < 1.001 && finite(place_object_m) && finite(velocity_object_m_per_s) &&
               finite(Vec3(force_N, stiffness_N_per_m, damping_Ns_per_m)) && stiffness_N_per_m > 0.0 &&
               damping_Ns_per_m >= 0.0 && surface_N_per_m > 0.0 && surface_N_per_m < 1e12;
    }
    // Returns the share of the force that is left at this time.
    [[nodiscard]] double share_at(Nanoseconds now_ns) const noexcept {
        const double left = seconds(kGone_ns - (now_ns - time_ns)) / seconds(kGone_ns - kFresh_ns);
        return std::clamp(left, 0.0, 1.0);
    }
    // Returns the force on the point where it is now; 0 or more.
    [[nodiscard]] double force_at(const Vec3& point_object_m, Nanoseconds now_ns) const noexcept {
        const double age_s = std::clamp(seconds(now_ns - time_ns), 0.0, seconds(kGone_ns));
        const Vec3 way = place_object_m + age_s * velocity_object_m_per_s - point_object_m;
        return share_at(now_ns) * std::max(force_N + stiffness_N_per_m * glm::dot(way, normal_object), 0.0);
    }
};

// The models of one probe. Those beyond kMost are dropped.
struct LocalModels {
    static constexpr std::uint32_t kMost = 32;
    std::array<LocalModel, kMost> list{};
    std::uint32_t count = 0;

    void add(const LocalModel& model) noexcept {
        if (count < kMost && model.is_sensible()) list[count++] = model;
    }
};

}  // namespace burin::geometry
