// SPDX-License-Identifier: MIT
#include "desk/viewer/view_cube.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <variant>

#include "desk/viewer/viewer_lead.hpp"
#include "session/state/session_room.hpp"
#include "toolbox/tool_mesh.hpp"
#include "wall/seen_place.hpp"

namespace burin::session {
namespace {

// Its edge, and how far its middle is from the borders of the picture, as shares of the picture's height.
constexpr double kCubeEdge = 0.1, kCubeFromBorder = 0.112;
// How far it stands before the screen, as a share of the way to the eye, so that the workpiece does not hide it. In
// stereo it is in the screen's own plane, where eyes rest.
constexpr double kMonoBefore = 0.45;

struct Face {
    Action view;
    std::string_view name;
    Vec3 out, right;  // as it is read
};
const std::array<Face, 6>& faces() {
    static const std::array<Face, 6> all{{{Action::view_front, "FRONT", {0, 0, 1}, {1, 0, 0}},
                                          {Action::view_back, "BACK", {0, 0, -1}, {-1, 0, 0}},
                                          {Action::view_side, "RIGHT", {1, 0, 0}, {0, 0, -1}},
                                          {Action::view_left, "LEFT", {-1, 0, 0}, {0, 0, 1}},
                                          {Action::view_top, "TOP", {0, 1, 0}, {1, 0, 0}},
                                          {Action::view_bottom, "BOTTOM", {0, -1, 0}, {1, 0, 0}}}};
    return all;
}

// Letters of 5 by 7 squares, the upper row first; the highest bit is at the left.
constexpr int kAcross = 5, kHigh = 7;
struct Letter {
    char name;
    std::array<unsigned, kHigh> rows;
};
constexpr std::array<Letter, 16> kLetters{{{'A', {0x0e, 0x11, 0x11, 0x1f, 0x11, 0x11, 0x11}},
                                           {'B', {0x1e, 0x11, 0x11, 0x1e, 0x11, 0x11, 0x1e}},
                                           {'C', {0x0e, 0x11, 0x10, 0x10, 0x10, 0x11, 0x0e}},
                                           {'E', {0x1f, 0x10, 0x10, 0x1e, 0x10, 0x10, 0x1f}},
                                           {'F', {0x1f, 0x10, 0x10, 0x1e, 0x10, 0x10, 0x10}},
                                           {'G', {0x0e, 0x11, 0x10, 0x17, 0x11, 0x11, 0x0e}},
                                           {'H', {0x11, 0x11, 0x11, 0x1f, 0x11, 0x11, 0x11}},
                                           {'I', {0x0e, 0x04, 0x04, 0x04, 0x04, 0x04, 0x0e}},
                                           {'K', {0x11, 0x12, 0x14, 0x18, 0x14, 0x12, 0x11}},
                                           {'L', {0x10, 0x10, 0x10, 0x10, 0x10, 0x10, 0x1f}},
                                           {'M', {0x11, 0x1b, 0x15, 0x15, 0x11, 0x11, 0x11}},
                                           {'N', {0x11, 0x19, 0x15, 0x13, 0x11, 0x11, 0x11}},
                                           {'O', {0x0e, 0x11, 0x11, 0x11, 0x11, 0x11, 0x0e}},
                                           {'P', {0x1e, 0x11, 0x11, 0x1e, 0x10, 0x10, 0x10}},
                                           {'R', {0x1e, 0x11, 0x11, 0x1e, 0x14, 0x12, 0x11}},
                                           {'T', {0x1f, 0x04, 0x04, 0x04, 0x04, 0x04, 0x04}}}};

// A rectangle of a face, in its own plane, somewhat above the cube.
void add_rectangle(geometry::TriangleMesh& mesh, const Face& face, const Vec2& lo, const Vec2& hi, double above) {
    const Vec3 up = glm::cross(face.out, face.right), middle = (0.5 + above) * face.out;
    const auto first = static_cast<std::uint32_t>(mesh.positions_m.size());
    for (const Vec2& at : {lo, Vec2(hi.x, lo.y), hi, Vec2(lo.x, hi.y)})
        mesh.positions_m.push_back(middle + at.x * face.right + at.y * up);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
}

// Writes a face's name across it, each row of a letter in as few rectangles as it has runs of squares.
void write_on(geometry::TriangleMesh& mesh, const Face& face) {
    constexpr double kWidest = 0.88, kLargest = 0.032;
    const double squares = static_cast<double>((kAcross + 1) * face.name.size()) - 1.0;
    const double square = std::min(kWidest / squares, kLargest), left = -0.5 * squares * square;
    for (std::size_t i = 0; i < face.name.size(); ++i) {
        const auto letter = std::ranges::find(kLetters, face.name[i], &Letter::name);
        for (int row = 0; letter != kLetters.end() && row < kHigh; ++row)
            for (int from = 0, to = 0; from < kAcross; from = to + 1) {
                const auto is_on = [&](int x) {
                    return x < kAcross &&
                           (letter->rows.at(static_cast<std::size_t>(row)) >> (kAcross - 1 - x) & 1) != 0;
                };
                for (to = from; is_on(to); ++to) {
                }
                const double x = left + square * (static_cast<double>((kAcross + 1) * i) + from);
                const double y = square * (0.5 * kHigh - row);
                if (to > from) add_rectangle(mesh, face, {x, y - square}, {x + square * (to - from), y}, 0.004);
            }
    }
}

std::shared_ptr<const picture::DrawnMesh> letters() {
    static const auto mesh = [] {
        geometry::TriangleMesh all;
        for (const Face& face : faces()) write_on(all, face);
        return picture::drawn_mesh(all);
    }();
    return mesh;
}

std::shared_ptr<const picture::DrawnMesh> cube() {
    static const auto mesh = picture::drawn_mesh(toolbox::drawing_of(compute::BoxTool{Vec3(0.5)}));
    return mesh;
}

std::shared_ptr<const picture::DrawnMesh> plate(std::size_t face) {
    static const auto plates = [] {
        std::array<std::shared_ptr<const picture::DrawnMesh>, 6> all;
        for (std::size_t i = 0; i < all.size(); ++i) {
            geometry::TriangleMesh mesh;
            add_rectangle(mesh, faces().at(i), Vec2(-0.5), Vec2(0.5), 0.002);
            all.at(i) = picture::drawn_mesh(mesh);
        }
        return all;
    }();
    return plates.at(face);
}

// Returns the smallest rotation that takes one direction to another.
Quat from_to(const Vec3& a, const Vec3& b) {
    const Vec3 axis = glm::cross(a, b);
    const double s = glm::length(axis);
    return s < 1e-12 ? Quat{1.0, 0.0, 0.0, 0.0} : glm::angleAxis(std::atan2(s, glm::dot(a, b)), axis / s);
}

}  // namespace

std::optional<Similarity> view_cube(const ViewedSession& seen) {
    const auto& [state, room, viewer, desk] = seen;
    if (!desk.wall.desk || state.mouse != MouseMode::surface || desk.wall.has_panel_window()) return std::nullopt;
    const wall::Screen& s = viewer.seen_from.screen;
    const Vec3 across = s.lower_right_world - s.lower_left_world, upright = s.upper_left_world - s.lower_left_world;
    const double high_m = glm::length(upright), wide_m = glm::length(across);
    const double free_m = desk.free_width * wide_m, from_m = kCubeFromBorder * high_m;
    if (free_m < 4.0 * from_m) return std::nullopt;
    const Vec3& eye = viewer.seen_from.eye_world;
    const Vec3 on_screen =
        s.lower_left_world + ((free_m - from_m) / wide_m) * across + ((high_m - from_m) / high_m) * upright;
    const bool mono = wall::needs_of(seen.output_on(desk.wall.main).mode).one_eye_point;
    const double before = mono ? kMonoBefore : 0.0;
    const Vec3 middle = state.world_from_object * room.workpiece_object.center();
    // As the workpiece is seen in the middle of the picture, and not from the side that the corner would show.
    const Quat turn = from_to(glm::normalize(eye - middle), glm::normalize(eye - on_screen));
    const Quat home = state.home_world_from_object.orientation;
    return Similarity{
        glm::mix(on_screen, eye, before),
        glm::normalize(turn * state.world_from_object.orientation * glm::conjugate(home) * world_from_screen(s)),
        kCubeEdge * high_m * (1.0 - before)};
}

std::optional<Action> face_met(const Similarity& world_from_cube, const Vec3& eye_world, const Vec3& through_world) {
    const Similarity cube_from_world = inverse(world_from_cube);
    const Vec3 from = cube_from_world * eye_world, along = cube_from_world * through_world - from;
    double enters = -std::numeric_limits<double>::infinity(), leaves = std::numeric_limits<double>::infinity();
    Vec3 out(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(along[axis]) < 1e-12) {
            if (std::abs(from[axis]) > 0.5) return std::nullopt;
            continue;
        }
        const double side = along[axis] > 0.0 ? -1.0 : 1.0;  // by which it comes in
        const double in = (0.5 * side - from[axis]) / along[axis];
        leaves = std::min(leaves, (-0.5 * side - from[axis]) / along[axis]);
        if (in <= enters) continue;
        enters = in;
        out = Vec3(0.0);
        out[axis] = side;
    }
    if (enters < 0.0 || enters > leaves) return std::nullopt;
    for (const Face& face : faces())
        if (glm::dot(face.out, out) > 0.5) return face.view;
    return std::nullopt;
}

BesideCube take_presses(Viewer& viewer, const ViewedSession& seen, std::span<const InputEvent> events,
                        const ViewerLook& look) {
    BesideCube left{{events.begin(), events.end()}, {}};
    const std::optional<Similarity> place = view_cube(seen);
    viewer.over_cube.reset();
    if (!place) return left;
    const CursorView cursor{
        seen.output_on(seen.desk.wall.main), look.output, viewer.seen_from.screen, viewer.seen_from.eye_world, {}};
    std::optional<Vec2> at_px = viewer.desk.mouse_px;
    const auto face = [&]() -> std::optional<Action> {
        if (!at_px || look.captured.mouse || viewer.desk.drag || viewer.desk.on_surface.pressed) return std::nullopt;
        const std::optional<Ray> ray = cursor.ray_object(*at_px);
        return ray ? face_met(*place, ray->origin, ray->origin + ray->direction) : std::nullopt;
    };
    std::erase_if(left.events, [&](const InputEvent& event) {
        if (const auto* move = std::get_if<MouseMove>(&event.input)) at_px = move->position_px;
        const auto* click = std::get_if<MouseClick>(&event.input);
        if (click == nullptr || click->button != MouseButton::left) return false;
        if (!click->pressed) return std::exchange(viewer.pressed_cube, false);
        const std::optional<Action> pressed = face();
        if (pressed) left.views.push_back(*pressed);
        viewer.pressed_cube = pressed.has_value();
        return pressed.has_value();
    });
    viewer.over_cube = face();
    return left;
}

void add_view_cube(picture::Picture& scene, const ViewedSession& seen) {
    const std::optional<Similarity> place = view_cube(seen);
    if (!place) return;
    constexpr Vec3 kBody{0.95, 0.95, 0.94}, kInk{0.16, 0.17, 0.18}, kLit{0.93, 0.67, 0.25};
    scene.objects.push_back({cube(), *place, kBody, 1.0, 0.8, 0.3});
    scene.objects.push_back({letters(), *place, kInk, 1.0, 0.9, 0.1});
    for (std::size_t i = 0; i < faces().size(); ++i)
        if (seen.viewer.over_cube == faces().at(i).view)
            scene.objects.push_back({plate(i), *place, kLit, 1.0, 0.8, 0.3});
}

}  // namespace burin::session
