// SPDX-License-Identifier: MIT
#include "toolbox/mirror.hpp"

#include <cctype>
#include <utility>

#include "base/try.hpp"

namespace burin::toolbox {
namespace {

constexpr std::string_view kAxes = "xyz";

// Half a turn about an axis; with 3 no turn at all.
Quat half_turn(std::size_t axis) {
    switch (axis) {
        case 0: return {0.0, 1.0, 0.0, 0.0};
        case 1: return {0.0, 0.0, 1.0, 0.0};
        case 2: return {0.0, 0.0, 0.0, 1.0};
        default: return {1.0, 0.0, 0.0, 0.0};
    }
}

// Returns the turn H of an image's reflections: their product is H, or -H where they reverse.
Quat turn_of(const MirrorImage& image) {
    Quat turn{1.0, 0.0, 0.0, 0.0};
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (image.across.at(axis)) turn = turn * half_turn(axis);
    return turn;
}

}  // namespace

Result<Mirror> parse_mirror(std::string_view text, const std::string& where) {
    Mirror mirror;
    if (text == "none") return mirror;
    const auto wrong = [&](const char* what) { return fail(where, what, "write none or axes, such as x or xz"); };
    if (text.empty()) return wrong("names no planes");
    for (const char axis : text) {
        const std::size_t at = kAxes.find(static_cast<char>(std::tolower(static_cast<unsigned char>(axis))));
        if (at == std::string_view::npos) return wrong("names a plane other than x, y and z");
        if (std::exchange(mirror.across.at(at), true)) return wrong("names a plane twice");
    }
    return mirror;
}

std::string name_of(const Mirror& mirror) {
    std::string name;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (mirror.across.at(axis)) name += kAxes[axis];
    return name.empty() ? "none" : name;
}

std::vector<MirrorImage> images_of(const Mirror& mirror) {
    std::vector<MirrorImage> images;
    for (unsigned chosen = 1; chosen < 8; ++chosen) {
        MirrorImage image;
        bool of_mirror = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            image.across.at(axis) = ((chosen >> axis) & 1u) != 0;
            of_mirror = of_mirror && (mirror.across.at(axis) || !image.across.at(axis));
        }
        if (of_mirror) images.push_back(image);
    }
    return images;
}

Vec3 image_of(const Vec3& p_object, const MirrorImage& image, const Vec3& middle_object) {
    Vec3 p = p_object;
    for (int axis = 0; axis < 3; ++axis)
        if (image.across.at(static_cast<std::size_t>(axis))) p[axis] = 2.0 * middle_object[axis] - p[axis];
    return p;
}

// With the reflections M = -H and the tool's own N = -Hx, the image of R is M R N = H R Hx. Without reversal it is H R.
Pose image_of(const Pose& object_from_tool, const MirrorImage& image, const Vec3& middle_object) {
    Quat turned = turn_of(image) * object_from_tool.orientation;
    if (image.reverses()) turned = turned * half_turn(0);
    return {image_of(object_from_tool.position_m, image, middle_object), turned};
}

}  // namespace burin::toolbox
