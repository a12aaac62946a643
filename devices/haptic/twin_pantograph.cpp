// SPDX-License-Identifier: MIT
#include "devices/haptic/twin_pantograph.hpp"

#include <algorithm>
#include <cmath>

namespace burin::devices {
namespace {

// One linkage: its shoulders' angles and its waist's, and on which side of its plane the tip is.
struct Linkage {
    double right = 0.0, left = 0.0, waist = 0.0;
    double side = 1.0;  // 1: the upper, whose tip and waist are above; -1: the lower
};
Linkage upper_of(const WandJoints& q) { return {q[0], q[1], q[4], 1.0}; }
Linkage lower_of(const WandJoints& q) { return {q[2], q[3], q[5], -1.0}; }

struct Planar {
    Vec2 right_elbow{0.0}, left_elbow{0.0}, tip{0.0};
};

std::optional<Planar> planar_tip(const TwinPantograph& arm, const Linkage& link) noexcept {
    Planar p;
    p.right_elbow = Vec2(0.5 * arm.shoulders_m, 0.0) + arm.upper_m * Vec2(std::cos(link.right), std::sin(link.right));
    p.left_elbow = Vec2(-0.5 * arm.shoulders_m, 0.0) + arm.upper_m * Vec2(std::cos(link.left), std::sin(link.left));
    const Vec2 apart = p.right_elbow - p.left_elbow;
    const double distance = glm::length(apart);
    const double out2 = arm.fore_m * arm.fore_m - 0.25 * distance * distance;
    const double least = kStretched * arm.fore_m;
    // Elbows that coincide let the tip turn about both of them.
    if (!(distance > least) || !(out2 > least * least)) return std::nullopt;
    p.tip = 0.5 * (p.right_elbow + p.left_elbow) + std::sqrt(out2) / distance * Vec2(-apart.y, apart.x);
    return p;
}

Vec3 out_of_plane(const TwinPantograph& arm, const Linkage& link, const Vec2& tip) noexcept {
    const double c = std::cos(link.waist), s = std::sin(link.waist), o = link.side * arm.offset_m;
    return {tip.x, tip.y * c - o * s, tip.y * s + o * c + link.side * 0.5 * arm.waists_m};
}

// The joints of one linkage that bring its tip there.
std::optional<Linkage> linkage_to(const TwinPantograph& arm, const Vec3& tip, double side) noexcept {
    const double z = tip.z - side * 0.5 * arm.waists_m, o = side * arm.offset_m;
    const double out2 = tip.y * tip.y + z * z - o * o;
    if (!(out2 > 0.0)) return std::nullopt;
    const double out = std::sqrt(out2);
    Linkage link;
    link.side = side;
    link.waist = std::atan2(z, tip.y) - std::atan2(o, out);
    const auto shoulder = [&](double place_x, double elbow_side) -> std::optional<double> {
        const Vec2 from(tip.x - place_x, out);
        const double reach = glm::length(from);
        const double cosine =
            (arm.upper_m * arm.upper_m + reach * reach - arm.fore_m * arm.fore_m) / (2.0 * arm.upper_m * reach);
        if (!(std::abs(cosine) <= 1.0)) return std::nullopt;
        return std::atan2(from.y, from.x) - elbow_side * std::acos(cosine);
    };
    const auto right = shoulder(0.5 * arm.shoulders_m, 1.0), left = shoulder(-0.5 * arm.shoulders_m, -1.0);
    if (!right || !left) return std::nullopt;
    link.right = *right;
    link.left = *left;
    return link;
}

std::optional<glm::dmat3> jacobian_of(const TwinPantograph& arm, const Linkage& link) noexcept {
    const auto p = planar_tip(arm, link);
    if (!p) return std::nullopt;
    // |P - E| stays f: (P - E) . P' = (P - E) . E', for both elbows.
    const Vec2 to_right = p->tip - p->right_elbow, to_left = p->tip - p->left_elbow;
    const double area = to_right.x * to_left.y - to_right.y * to_left.x;
    const Vec2 right_moves = arm.upper_m * Vec2(-std::sin(link.right), std::cos(link.right));
    const Vec2 left_moves = arm.upper_m * Vec2(-std::sin(link.left), std::cos(link.left));
    const Vec2 by_right = glm::dot(to_right, right_moves) / area * Vec2(to_left.y, -to_left.x);
    const Vec2 by_left = glm::dot(to_left, left_moves) / area * Vec2(-to_right.y, to_right.x);
    const double c = std::cos(link.waist), s = std::sin(link.waist), o = link.side * arm.offset_m;
    glm::dmat3 moves;
    moves[0] = {by_right.x, by_right.y * c, by_right.y * s};
    moves[1] = {by_left.x, by_left.y * c, by_left.y * s};
    moves[2] = {0.0, -p->tip.y * s - o * c, p->tip.y * c - o * s};
    return moves;
}

}  // namespace

std::optional<WandTips> wand_tips(const TwinPantograph& arm, const WandJoints& joints) noexcept {
    const Linkage upper = upper_of(joints), lower = lower_of(joints);
    const auto above = planar_tip(arm, upper), below = planar_tip(arm, lower);
    if (!above || !below) return std::nullopt;
    return WandTips{out_of_plane(arm, upper, above->tip), out_of_plane(arm, lower, below->tip)};
}

WandAxis wand_axis(const WandTips& tips) noexcept {
    const Vec3 along = tips.upper_m - tips.lower_m;
    const double length = glm::length(along);
    return {0.5 * (tips.upper_m + tips.lower_m), length > 0.0 ? along / length : Vec3(0.0, 0.0, 1.0)};
}

double handle_error_m(const TwinPantograph& arm, const WandTips& tips) noexcept {
    return glm::length(tips.upper_m - tips.lower_m) - handle_length_m(arm);
}

Pose pose_of(const WandAxis& axis) noexcept {
    // Half the turn: its axis is z x along, and its cosine is of half the angle. Upside down has no shortest way.
    const double w = 1.0 + axis.along.z;
    if (!(w > 1e-9)) return {axis.middle_m, Quat(0.0, 1.0, 0.0, 0.0)};
    return {axis.middle_m, glm::normalize(Quat(w, -axis.along.y, axis.along.x, 0.0))};
}

WandAxis axis_of(const Pose& mechanism_from_handle) noexcept {
    return {mechanism_from_handle.position_m, mechanism_from_handle.orientation * Vec3(0.0, 0.0, 1.0)};
}

std::optional<WandJoints> wand_joints(const TwinPantograph& arm, const WandAxis& axis) noexcept {
    const Vec3 half = 0.5 * handle_length_m(arm) * axis.along;
    const auto upper = linkage_to(arm, axis.middle_m + half, 1.0), lower = linkage_to(arm, axis.middle_m - half, -1.0);
    if (!upper || !lower) return std::nullopt;
    const WandJoints joints{upper->right, upper->left, lower->right, lower->left, upper->waist, lower->waist};
    // A pose at which both fore links are in one line cannot be told from its mirror image.
    if (!wand_tips(arm, joints)) return std::nullopt;
    return joints;
}

std::optional<WandJacobian> wand_jacobian(const TwinPantograph& arm, const WandJoints& joints) noexcept {
    const auto upper = jacobian_of(arm, upper_of(joints)), lower = jacobian_of(arm, lower_of(joints));
    if (!upper || !lower) return std::nullopt;
    return WandJacobian{*upper, *lower};
}

WandJoints motor_torques_Nm(const TwinPantograph& arm, const WandAxis& axis, const WandJacobian& jacobian,
                            const WandForce& force) noexcept {
    const Vec3 couple = glm::cross(force.torque_Nm, axis.along) / handle_length_m(arm);
    const Vec3 upper = glm::transpose(jacobian.upper) * (0.5 * force.force_N + couple);
    const Vec3 lower = glm::transpose(jacobian.lower) * (0.5 * force.force_N - couple);
    return {upper.x, upper.y, lower.x, lower.y, upper.z, lower.z};
}

std::optional<WandForce> force_of(const TwinPantograph& arm, const WandAxis& axis, const WandJacobian& jacobian,
                                  const WandJoints& torques_Nm) noexcept {
    const glm::dmat3 up = glm::transpose(jacobian.upper), down = glm::transpose(jacobian.lower);
    // Of a well shaped arm the determinant is about u^2 f; a thousandth of that is a tip that gives way.
    const double least = 1e-3 * arm.upper_m * arm.upper_m * arm.fore_m;
    if (!(std::abs(glm::determinant(up)) > least) || !(std::abs(glm::determinant(down)) > least)) return std::nullopt;
    const Vec3 upper_N = glm::inverse(up) * Vec3(torques_Nm[0], torques_Nm[1], torques_Nm[4]);
    const Vec3 lower_N = glm::inverse(down) * Vec3(torques_Nm[2], torques_Nm[3], torques_Nm[5]);
    return WandForce{upper_N + lower_N, 0.5 * handle_length_m(arm) * glm::cross(axis.along, upper_N - lower_N)};
}

}  // namespace burin::devices
