// SPDX-License-Identifier: MIT
#include "wall/projection.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include "base/error.hpp"

namespace burin::wall {

namespace {

// The screen's axes: right, up, and outwards to the viewer.
struct Axes {
    Vec3 right, up, normal;
};

Axes axes_of(const Screen& screen) {
    const Vec3 right = glm::normalize(screen.lower_right_world - screen.lower_left_world);
    const Vec3 up = glm::normalize(screen.upper_left_world - screen.lower_left_world);
    return {right, up, glm::normalize(glm::cross(right, up))};
}

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

Mat4 off_axis_projection(const Screen& screen, const Vec3& eye_world, double near_m, double far_m) {
    const Axes axes = axes_of(screen);
    const Vec3 to_lower_left = screen.lower_left_world - eye_world;
    const double eye_to_screen_m = -glm::dot(to_lower_left, axes.normal);
    BURIN_CHECK(near_m > 0.0 && far_m > near_m && eye_to_screen_m > 0.0);
    // Projects the screen's edges onto the near plane.
    const double scale = near_m / eye_to_screen_m;
    const double left = glm::dot(axes.right, to_lower_left) * scale;
    const double right = glm::dot(axes.right, screen.lower_right_world - eye_world) * scale;
    const double bottom = glm::dot(axes.up, to_lower_left) * scale;
    const double top = glm::dot(axes.up, screen.upper_left_world - eye_world) * scale;

    Mat4 clip_from_eye(0.0);  // columns
    clip_from_eye[0][0] = 2.0 * near_m / (right - left);
    clip_from_eye[1][1] = -2.0 * near_m / (top - bottom);  // y downwards
    clip_from_eye[2][0] = (right + left) / (right - left);
    clip_from_eye[2][1] = -(top + bottom) / (top - bottom);
    clip_from_eye[2][2] = far_m / (near_m - far_m);
    clip_from_eye[2][3] = -1.0;
    clip_from_eye[3][2] = near_m * far_m / (near_m - far_m);

    // The eye's axes are parallel to the screen's: rows of the rotation.
    Mat4 eye_from_world(1.0);
    for (int i = 0; i < 3; ++i) {
        eye_from_world[i] = glm::dvec4(axes.right[i], axes.up[i], axes.normal[i], 0.0);
    }
    return clip_from_eye * eye_from_world * glm::translate(Mat4(1.0), -eye_world);
}

ScreenPlane::ScreenPlane(const Screen& screen) : origin_world_(screen.lower_left_world) {
    const Axes axes = axes_of(screen);
    right_ = axes.right;
    up_ = axes.up;
    normal_ = axes.normal;
}

Vec2 ScreenPlane::point_seen(const Vec3& eye_world, const Vec3& point_world) const {
    const double eye_m = distance_in_front(eye_world), point_m = distance_in_front(point_world);
    const Vec3 hit = eye_world + (point_world - eye_world) * (eye_m / (eye_m - point_m));
    return {glm::dot(hit - origin_world_, right_), glm::dot(hit - origin_world_, up_)};
}

double ScreenPlane::distance_in_front(const Vec3& point_world) const {
    return glm::dot(point_world - origin_world_, normal_);
}

Vec2 point_on_screen(const Screen& screen, const Vec3& eye_world, const Vec3& point_world) {
    return ScreenPlane(screen).point_seen(eye_world, point_world);
}

double distance_in_front(const Screen& screen, const Vec3& point_world) {
    return ScreenPlane(screen).distance_in_front(point_world);
}

bool can_be_seen(const Screen& screen, const Eyes& eyes) {
    const Vec3 right = screen.lower_right_world - screen.lower_left_world;
    const Vec3 up = screen.upper_left_world - screen.lower_left_world;
    constexpr double kLeastSize_m = 0.01, kLeastDistance_m = 0.01;
    for (const Vec3& v : {screen.lower_left_world, right, up, eyes.left_world, eyes.right_world}) {
        if (!finite(v)) return false;
    }
    if (glm::length(right) < kLeastSize_m || glm::length(up) < kLeastSize_m) return false;
    // Kooima's frustum requires a rectangle: other corners would shear the picture.
    if (std::abs(glm::dot(glm::normalize(right), glm::normalize(up))) > 1e-3) return false;
    return distance_in_front(screen, eyes.left_world) >= kLeastDistance_m &&
           distance_in_front(screen, eyes.right_world) >= kLeastDistance_m;
}

}  // namespace burin::wall
