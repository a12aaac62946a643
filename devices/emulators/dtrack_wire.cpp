// SPDX-License-Identifier: MIT
#include "devices/emulators/dtrack_wire.hpp"

#include <cmath>
#include <numbers>

#include "base/text.hpp"

namespace burin::devices {
namespace {

struct ControllerPose {
    Vec3 place_mm{0.0}, angles_deg{0.0};
    glm::dmat3 turn{0.0};  // glm counts columns first
};

// The angles are those of R = Rx(eta) Ry(theta) Rz(phi).
ControllerPose controller_pose(const DTrackBody& body) {
    ControllerPose pose;
    if (!body.is_tracked) return pose;
    pose.place_mm = body.pose.position_m / 0.001;
    pose.turn = glm::mat3_cast(body.pose.orientation);
    const auto row_column = [&](int row, int column) { return pose.turn[column - 1][row - 1]; };
    const double eta = std::atan2(-row_column(2, 3), row_column(3, 3));
    const double theta = std::atan2(row_column(1, 3), std::hypot(row_column(2, 3), row_column(3, 3)));
    const double phi = std::atan2(-row_column(1, 2), row_column(1, 1));
    pose.angles_deg = Vec3(eta, theta, phi) * (180.0 / std::numbers::pi);
    return pose;
}

std::string quality_of(const DTrackBody& body) { return body.is_tracked ? "1.000" : "-1.000"; }

std::string written_place(const Vec3& place_mm) {
    return formatted("%.3f %.3f %.3f", place_mm.x, place_mm.y, place_mm.z);
}

std::string written_turn(const glm::dmat3& turn) {
    std::string text;
    for (const glm::dvec3& column : {turn[0], turn[1], turn[2]})
        text += formatted("%s%.6f %.6f %.6f", text.empty() ? "[" : " ", column.x, column.y, column.z);
    return text + "]";
}

std::string written_body(const DTrackBody& body) {
    const ControllerPose pose = controller_pose(body);
    return formatted("[%d ", body.number) + quality_of(body) + "][" + written_place(pose.place_mm) +
           formatted(" %.4f %.4f %.4f]", pose.angles_deg.x, pose.angles_deg.y, pose.angles_deg.z) +
           written_turn(pose.turn) + " ";
}

// A state in place of a quality: 3 by cameras and inertial sensor; then how far the sensor has drifted, in degrees.
std::string written_hybrid(const DTrackBody& body) {
    const ControllerPose pose = controller_pose(body);
    return formatted("[%d %d %.3f][", body.number, body.is_tracked ? 3 : 0, body.is_tracked ? 0.2 : 0.0) +
           written_place(pose.place_mm) + "]" + written_turn(pose.turn) + " ";
}

std::string written_flystick(const DTrackFlystick& stick) {
    const ControllerPose pose = controller_pose(stick.body);
    std::string states = stick.button_count > 0 ? std::to_string(stick.buttons) : "";
    for (const double value : stick.sticks) states += formatted("%s%.2f", states.empty() ? "" : " ", value);
    return formatted("[%d ", stick.body.number) + quality_of(stick.body) +
           formatted(" %u %zu][", stick.button_count, stick.sticks.size()) + written_place(pose.place_mm) + "]" +
           written_turn(pose.turn) + "[" + states + "] ";
}

}  // namespace

std::string controller_datagram(const DTrackFrame& frame) {
    constexpr const char* kEndOfLine = "\r\n";
    std::string text;
    if (frame.number) text += "fr " + std::to_string(*frame.number) + kEndOfLine;
    // Counts the calibrated ones, and then those that are described: here all are both.
    text += formatted("6df2 %zu %zu ", frame.flysticks.size(), frame.flysticks.size());
    for (const DTrackFlystick& stick : frame.flysticks) text += written_flystick(stick);
    text += kEndOfLine;
    if (!frame.hybrids.empty()) {
        text += formatted("6di %zu ", frame.hybrids.size());
        for (const DTrackBody& body : frame.hybrids) text += written_hybrid(body);
        text += kEndOfLine;
    }
    text += formatted("6d %zu ", frame.bodies.size());
    for (const DTrackBody& body : frame.bodies) text += written_body(body);
    return text + kEndOfLine;
}

}  // namespace burin::devices
