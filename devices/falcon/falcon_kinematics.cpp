// SPDX-License-Identifier: MIT
#include "devices/falcon/falcon_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace burin::devices {
namespace {

// Metres; the names are Stamper's.
constexpr double kA = 0.060, kB = 0.1025, kC = 0.01443, kD = 0.01125, kE = 0.01125, kF = -0.025, kR = 0.0400,
                 kS = -0.02309;
constexpr double kDegree = std::numbers::pi / 180.0;
// Four edges of each of 320 slots turn the motor's shaft once; the arm's drum is larger than that by so much.
constexpr double kAngleOfCount_rad = 2.0 * std::numbers::pi / (4.0 * 320.0) * (0.01425 / 0.110);
constexpr double kAngleAtZero_rad = 35.0 * kDegree;

// u and v of a leg: the base is turned by 15 degrees on the desk.
struct LegFrame {
    Vec3 u, v;
};
const std::array<LegFrame, kFalconLegs>& legs() {
    static const std::array<LegFrame, kFalconLegs> all = [] {
        std::array<LegFrame, kFalconLegs> made;
        constexpr std::array<double, kFalconLegs> kDegrees{105.0, -15.0, -135.0};
        for (std::size_t i = 0; i < kFalconLegs; ++i) {
            const double angle = kDegrees[i] * kDegree;
            made[i] = {{std::cos(angle), std::sin(angle), 0.0}, {-std::sin(angle), std::cos(angle), 0.0}};
        }
        return made;
    }();
    return all;
}

// The grip as a leg sees it: how far beyond the leg's foot, and the length of the parallelogram in the leg's plane.
struct SeenByLeg {
    double out_m, along_m, across_m, length_m;
};
std::optional<SeenByLeg> seen_by(const LegFrame& leg, const Vec3& grip_m) noexcept {
    const double across_m = glm::dot(leg.v, grip_m) - kS + kF;
    const double square = kB * kB - across_m * across_m;
    if (!(square > 0.0)) return std::nullopt;
    return SeenByLeg{glm::dot(leg.u, grip_m) - kR + kC, grip_m.z, across_m, kD + kE + std::sqrt(square)};
}

}  // namespace

FalconAngles falcon_angles(const FalconCounts& encoders) noexcept {
    FalconAngles angles;
    for (std::size_t i = 0; i < kFalconLegs; ++i) angles[i] = kAngleAtZero_rad + kAngleOfCount_rad * encoders[i];
    return angles;
}

FalconCounts falcon_encoders(const FalconAngles& angles) noexcept {
    FalconCounts counts;
    for (std::size_t i = 0; i < kFalconLegs; ++i)
        counts[i] = static_cast<std::int16_t>(
            std::clamp(std::round((angles[i] - kAngleAtZero_rad) / kAngleOfCount_rad), -32768.0, 32767.0));
    return counts;
}

std::optional<FalconAngles> falcon_inverse(const Vec3& grip_m) noexcept {
    FalconAngles angles;
    for (std::size_t i = 0; i < kFalconLegs; ++i) {
        const auto seen = seen_by(legs()[i], grip_m);
        if (!seen) return std::nullopt;
        // The knee is on the arm's circle, and as far from the grip as the parallelogram is long: of the two places the
        // outer one, as the legs are built.
        const double reach_m = std::hypot(seen->out_m, seen->along_m);
        const double share = (reach_m * reach_m + kA * kA - seen->length_m * seen->length_m) / (2.0 * kA * reach_m);
        if (!(std::abs(share) <= 1.0)) return std::nullopt;
        angles[i] = std::atan2(seen->along_m, seen->out_m) - std::acos(share);
        if (angles[i] < -std::numbers::pi) angles[i] += 2.0 * std::numbers::pi;
    }
    return angles;
}

std::optional<FalconPose> falcon_forward(const FalconAngles& angles, const Vec3& near_m) noexcept {
    FalconPose pose;
    pose.grip_m = near_m;
    for (const double angle : angles)
        if (!(angle > kFalconLeast_rad && angle < kFalconMost_rad)) return std::nullopt;
    for (int step = 0; step < kFalconSteps; ++step) {
        // Each leg: the square of the distance between knee and grip in its plane, less that of its parallelogram.
        glm::dmat3 rows_transposed;
        Vec3 misses, turns;
        for (std::size_t i = 0; i < kFalconLegs; ++i) {
            const LegFrame& leg = legs()[i];
            const auto seen = seen_by(leg, pose.grip_m);
            if (!seen) return std::nullopt;
            const double out_m = seen->out_m - kA * std::cos(angles[i]);
            const double along_m = seen->along_m - kA * std::sin(angles[i]);
            const double length_m = seen->length_m;
            const auto k = static_cast<int>(i);
            misses[k] = out_m * out_m + along_m * along_m - length_m * length_m;
            // dL/dv = -v / (L - d - e)
            const double across = 2.0 * length_m * seen->across_m / (length_m - kD - kE);
            rows_transposed[k] = 2.0 * out_m * leg.u + across * leg.v + Vec3(0.0, 0.0, 2.0 * along_m);
            turns[k] = 2.0 * kA * (out_m * std::sin(angles[i]) - along_m * std::cos(angles[i]));
        }
        const double volume = glm::determinant(rows_transposed);
        if (!(std::abs(volume) > 1e-9)) return std::nullopt;  // of (2 x 0.1 m)^3: the legs lie in a plane
        const glm::dmat3 back = glm::inverse(glm::transpose(rows_transposed));
        const Vec3 by_m = back * misses;
        if (!finite(by_m)) return std::nullopt;
        for (int k = 0; k < 3; ++k) pose.moves_m_per_rad[static_cast<std::size_t>(k)] = -turns[k] * back[k];
        constexpr double kRounding_m = 1e-14;
        if (glm::length(by_m) < kRounding_m) {
            // The mirror image behind the base, and knees that are bent inwards, are no poses of a Falcon.
            const bool is_one = pose.grip_m.z > 0.0 && turns.x < 0.0 && turns.y < 0.0 && turns.z < 0.0;
            return is_one ? std::optional(pose) : std::nullopt;
        }
        // A step is no longer than the legs can be wrong about.
        constexpr double kMostStep_m = 0.015;
        const double size_m = glm::length(by_m);
        pose.grip_m -= size_m > kMostStep_m ? by_m * (kMostStep_m / size_m) : by_m;
    }
    return std::nullopt;
}

FalconAngles falcon_torques(const FalconPose& pose, const Vec3& force_N) noexcept {
    FalconAngles torques;
    for (std::size_t i = 0; i < kFalconLegs; ++i) torques[i] = glm::dot(pose.moves_m_per_rad[i], force_N);
    return torques;
}

FalconCounts falcon_commands(const FalconAngles& torques_Nm) noexcept {
    double most = 0.0;
    for (const double torque : torques_Nm) {
        if (!std::isfinite(torque)) return {};
        most = std::max(most, std::abs(torque) * kFalconCommands_per_Nm);
    }
    const double share = most > kFalconMostCommand ? kFalconMostCommand / most : 1.0;
    FalconCounts commands;
    // A motor that is commanded forwards turns its arm backwards.
    for (std::size_t i = 0; i < kFalconLegs; ++i)
        commands[i] = static_cast<std::int16_t>(std::round(-share * kFalconCommands_per_Nm * torques_Nm[i]));
    return commands;
}

FalconAngles falcon_torques_of(const FalconCounts& commands) noexcept {
    FalconAngles torques;
    for (std::size_t i = 0; i < kFalconLegs; ++i) torques[i] = -commands[i] / kFalconCommands_per_Nm;
    return torques;
}

Vec3 falcon_force(const FalconPose& pose, const FalconAngles& torques_Nm) noexcept {
    // Each torque is the force along the way that its arm moves the grip.
    glm::dmat3 ways;
    Vec3 torques;
    for (std::size_t i = 0; i < kFalconLegs; ++i) {
        ways[static_cast<int>(i)] = pose.moves_m_per_rad[i];
        torques[static_cast<int>(i)] = torques_Nm[i];
    }
    return glm::inverse(glm::transpose(ways)) * torques;
}

}  // namespace burin::devices
