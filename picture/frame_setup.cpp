// SPDX-License-Identifier: MIT
#include "picture/frame_setup.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "picture/contact_marks.hpp"
#include "picture/lamp_view.hpp"
#include "shaders/shared/srgb.h"
#include "wall/projection.hpp"

namespace burin::picture {

namespace {

// One lamp from above, slightly in front and to the left (Hornsey & Hibbard 2024: light above the target gives the most
// certain sense of shape; Hubona et al.: two lamps are worse than one).
const Vec3 kToLight = glm::normalize(Vec3{-0.30, 1.0, 0.52});
const Vec3 kLightColour{0.93, 0.89, 0.83};
const Vec3 kSkyColour{0.31, 0.33, 0.36};
const Vec3 kGroundColour{0.16, 0.15, 0.14};

glm::vec4 vec4_of(const Vec3& v, double w) { return {glm::vec3(v), static_cast<float>(w)}; }

double stylus_radius_m(const PictureTool& tool) { return std::clamp(0.42 * tool.radius_m, 0.002, 0.012); }
double stylus_length_m(const PictureTool& tool) { return std::max(20.0 * stylus_radius_m(tool), 6.0 * tool.radius_m); }
// Returns the thickness of a workspace box's edges.
double bar_m(const PictureBox& box) {
    return std::clamp(0.018 * std::min({box.size_m.x, box.size_m.y, box.size_m.z}), 0.0015, 0.008);
}
double half_diagonal(const Vec3& size) { return 0.5 * glm::length(size); }

Ball ball_around(const Box& box) { return {box.center(), box.empty() ? 0.0 : half_diagonal(box.extent())}; }

// Returns the smallest ball around two.
Ball around(const Ball& a, const Ball& b) {
    if (a.radius_m <= 0.0) return b;
    if (b.radius_m <= 0.0) return a;
    const Vec3 apart = b.center_world - a.center_world;
    const double distance = glm::length(apart);
    if (distance + b.radius_m <= a.radius_m) return a;
    if (distance + a.radius_m <= b.radius_m) return b;
    const double radius = 0.5 * (distance + a.radius_m + b.radius_m);
    return {a.center_world + apart * ((radius - a.radius_m) / distance), radius};
}

shared::DrawConstants constants_of(const Mat4& world_from_local, const Vec3& srgb, double opacity, double roughness,
                                   double gloss) {
    shared::DrawConstants c{};
    c.world_from_local = glm::mat4(world_from_local);
    c.tint = vec4_of(linear_of(srgb), opacity);
    c.material = {static_cast<float>(roughness), static_cast<float>(gloss), 0.0f, 0.0f};
    return c;
}

Mat4 matrix_of(const Pose& pose, const Vec3& scale) {
    return matrix(Similarity{pose.position_m, pose.orientation, 1.0}) * glm::scale(Mat4(1.0), scale);
}

void add_wall_frame(Shapes& shapes, const wall::Screen& screen, const Primitives& primitives) {
    // Bars just inside the screen's edges and behind its plane: the frame of the window that one looks through.
    constexpr double kWidth_m = 0.016, kDepth_m = 0.05;
    const Vec3 colour{0.30, 0.30, 0.31};
    const Vec3 across = screen.lower_right_world - screen.lower_left_world;
    const Vec3 upright = screen.upper_left_world - screen.lower_left_world;
    const double width = glm::length(across), height = glm::length(upright);
    const Vec3 x = across / width, y = upright / height, z = glm::cross(x, y);
    const Vec3 middle = screen.lower_left_world + 0.5 * (across + upright) - 0.5 * kDepth_m * z;
    const auto bar = [&](const Vec3& center, const Vec3& size) {
        const Mat4 m(glm::dvec4(x * size.x, 0), glm::dvec4(y * size.y, 0), glm::dvec4(z * size.z, 0),
                     glm::dvec4(center, 1));
        shapes.solid.push_back({primitives.cube, constants_of(m, colour, 1.0, 0.6, 0.5)});
    };
    for (const double side : {-1.0, 1.0}) {
        bar(middle + side * 0.5 * (height - kWidth_m) * y, {width, kWidth_m, kDepth_m});
        bar(middle + side * 0.5 * (width - kWidth_m) * x, {kWidth_m, height - 2 * kWidth_m, kDepth_m});
    }
}

// Opacity added to a box's faces towards its edges, as a share of the opacity of their middle (shaders/glass.frag).
constexpr double kDenserEdges = 0.9;

void add_box(Shapes& shapes, const PictureBox& box, const Primitives& primitives) {
    const Vec3 s = box.size_m;
    const double bar = bar_m(box);
    for (int axis = 0; axis < 3; ++axis) {
        for (int corner = 0; corner < 4; ++corner) {
            Vec3 offset(0.0), size(bar);
            offset[(axis + 1) % 3] = ((corner & 1) != 0 ? 0.5 : -0.5) * s[(axis + 1) % 3];
            offset[(axis + 2) % 3] = ((corner & 2) != 0 ? 0.5 : -0.5) * s[(axis + 2) % 3];
            size[axis] = s[axis] + bar;
            const Pose pose{box.center_world * offset, box.center_world.orientation};
            shapes.solid.push_back({primitives.cube, constants_of(matrix_of(pose, size), box.colour, 1.0, 0.5, 0.6)});
        }
    }
    if (box.face_opacity <= 0.0) return;
    shapes.glass.push_back(
        {primitives.cube, constants_of(matrix_of(box.center_world, s), box.colour, box.face_opacity, kDenserEdges, 0)});
}

void add_bubble(Shapes& shapes, const PictureBubble& bubble, const Primitives& primitives) {
    const Pose pose{bubble.center_world, Quat{1, 0, 0, 0}};
    shapes.glass.push_back(
        {primitives.balls.back(), constants_of(matrix_of(pose, Vec3(bubble.radius_m)), bubble.colour, 0.16, 0, 0)});
}

// Adds the objects through which one sees, the farthest first.
void add_clear_objects(Shapes& shapes, const Picture& picture) {
    constexpr double kNoEdges = 0.0, kShaded = 1.0;  // shaders/glass.frag
    const Vec3 eye = middle_of(wall::eyes_of(picture.viewer));
    std::vector<std::pair<double, const DrawnObject*>> clear;
    for (const DrawnObject& object : picture.objects)
        if (object.opacity < 1.0) clear.emplace_back(-glm::length(bounds_world(object).center() - eye), &object);
    std::ranges::stable_sort(clear, {}, &std::pair<double, const DrawnObject*>::first);
    for (const auto& [distance, object] : clear)
        shapes.glass.push_back(
            {{0, 0, object->mesh->bounds},
             constants_of(matrix(object->world_from_mesh), object->colour, object->opacity, kNoEdges, kShaded),
             object->mesh});
}

void add_tool(Shapes& shapes, const PictureTool& tool, const Primitives& primitives) {
    if (tool.mesh) {
        shapes.tool.push_back({{0, 0, tool.mesh->bounds},
                               constants_of(matrix(tool.world_from_mesh), tool.colour, 1.0, 0.28, 1.0),
                               tool.mesh});
    } else {
        const Pose ball{tool.center_world, tool.stylus_world.orientation};
        shapes.tool.push_back(
            {primitives.balls.back(), constants_of(matrix_of(ball, Vec3(tool.radius_m)), tool.colour, 1.0, 0.28, 1.0)});
    }
    constexpr double kFaint = 0.14, kNoEdges = 0.0, kOutlined = 2.0;  // shaders/glass.frag
    Shape hidden = shapes.tool.back();
    hidden.constants.tint.a = static_cast<float>(kFaint);
    hidden.constants.material.x = static_cast<float>(kNoEdges);
    hidden.constants.material.y = static_cast<float>(kOutlined);
    shapes.hidden.push_back(std::move(hidden));
    const double r = stylus_radius_m(tool);
    const Mat4 shaft = matrix_of(tool.stylus_world, {r, r, stylus_length_m(tool)});
    shapes.tool.push_back({primitives.stylus, constants_of(shaft, {0.27, 0.28, 0.30}, 1.0, 0.35, 1.0)});
}

// Returns the matrix that maps +Z to a direction and scales by `size` along the local axes.
Mat4 matrix_along(const Vec3& from, const Vec3& direction, const Vec3& size) {
    const Vec3 aside = std::abs(direction.y) < 0.9 ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
    const Vec3 x = glm::normalize(glm::cross(aside, direction)), y = glm::cross(direction, x);
    return {glm::dvec4(x * size.x, 0), glm::dvec4(y * size.y, 0), glm::dvec4(direction * size.z, 0),
            glm::dvec4(from, 1)};
}

void add_contact(Shapes& shapes, const Picture& picture, const Primitives& primitives) {
    const ContactMarks marks = contact_marks(picture);
    const auto add = [&](const PrimitiveRange& range, const Mat4& place) {
        shapes.solid.push_back({range, constants_of(place, marks.colour, 1.0, 0.4, 0.8)});
    };
    if (marks.ring) {
        const ContactRing& ring = *marks.ring;
        add(primitives.ring, matrix_along(ring.center_world, ring.axis_world, Vec3(ring.radius_m)));
    }
    if (!marks.arrow) return;
    const ForceArrow& a = *marks.arrow;
    const double shaft_m = a.length_m - a.head_m;
    add(primitives.rod, matrix_along(a.from_world, a.direction_world, {a.shaft_radius_m, a.shaft_radius_m, shaft_m}));
    add(primitives.cone, matrix_along(a.from_world + shaft_m * a.direction_world, a.direction_world,
                                      {a.head_radius_m, a.head_radius_m, a.head_m}));
}

}  // namespace

Box placed_box(const Box& own, const Similarity& world_from_own) {
    Box world;
    for (int i = 0; !own.empty() && i < 8; ++i)
        world.include(world_from_own * Vec3((i & 1) != 0 ? own.hi.x : own.lo.x, (i & 2) != 0 ? own.hi.y : own.lo.y,
                                            (i & 4) != 0 ? own.hi.z : own.lo.z));
    return world;
}

Vec3 linear_of(const Vec3& srgb) { return shared::linear_of(srgb); }

Mat4 world_from_patch(const Picture& picture) {
    return matrix(picture.world_from_object) * glm::translate(Mat4(1.0), picture.lattice_origin_object);
}

Ball ball_of(const PictureTool& tool) {
    if (!tool.visible) return {};
    const double half_length = 0.5 * stylus_length_m(tool);
    const Ball stylus{tool.stylus_world * Vec3{0, 0, half_length}, half_length + stylus_radius_m(tool)};
    Ball all = around({tool.center_world, tool.radius_m}, stylus);
    if (!tool.mesh) return all;
    all = around(all, {tool.center_world + tool.spine_m, tool.radius_m});
    return around(all, ball_around(head_of(tool)));
}

Box head_of(const PictureTool& tool) {
    Box head;
    if (!tool.visible) return head;
    if (!tool.mesh) {
        head.include(tool.center_world - Vec3(tool.radius_m));
        head.include(tool.center_world + Vec3(tool.radius_m));
        return head;
    }
    return placed_box(tool.mesh->bounds, tool.world_from_mesh);
}

Box bounds_world(const DrawnObject& object) { return placed_box(object.mesh->bounds, object.world_from_mesh); }

std::array<Ball, kSpineBalls + kStylusBalls> balls_of(const PictureTool& tool) {
    std::array<Ball, kSpineBalls + kStylusBalls> balls;
    if (!tool.visible) return balls;
    const double spine_m = glm::length(tool.spine_m);
    const double widths = tool.radius_m > 0.0 ? std::ceil(spine_m / (2.0 * tool.radius_m)) : 1.0;
    const auto on_spine = static_cast<std::size_t>(std::clamp(widths, 1.0, double{kSpineBalls}));
    const double half_spine_m = 0.5 * spine_m / static_cast<double>(on_spine);
    for (std::size_t i = 0; i < on_spine; ++i) {
        const double along = (static_cast<double>(i) + 0.5) / static_cast<double>(on_spine);
        balls[i] = {tool.center_world + along * tool.spine_m, half_spine_m + tool.radius_m};
    }
    const double half_m = 0.5 * stylus_length_m(tool) / static_cast<double>(kStylusBalls);
    for (std::size_t i = 0; i < kStylusBalls; ++i) {
        const Vec3 middle{0.0, 0.0, half_m * static_cast<double>(2 * i + 1)};
        balls[kSpineBalls + i] = {tool.stylus_world * middle, std::hypot(half_m, stylus_radius_m(tool))};
    }
    return balls;
}

Ball ball_of(const PictureBox& box) {
    // The box's edges are bars that stick out a little.
    return {box.center_world.position_m, box.visible ? half_diagonal(box.size_m) + bar_m(box) : 0.0};
}

Ball ball_of(const PictureBubble& bubble) { return {bubble.center_world, bubble.visible ? bubble.radius_m : 0.0}; }

const Vec3& direction_to_light() { return kToLight; }

Workpiece place_workpiece(const Picture& picture, const Box& patch_bounds, double reach_m) {
    if (!picture.workpiece_object.empty()) {
        const Vec3 center = picture.world_from_object * picture.workpiece_object.center();
        const Vec3 size = picture.workpiece_object.extent() * picture.world_from_object.scale;
        const Ball enclosing{center, 0.5 * glm::length(size)};
        if (patch_bounds.empty() && lamp_view(picture)) return {enclosing, {}};
        return {enclosing, {center, (size.x + size.y + size.z) / 6.0}};
    }
    if (patch_bounds.empty()) return {};
    const Vec3 center = picture.world_from_object * (picture.lattice_origin_object + patch_bounds.center());
    const Vec3 size = patch_bounds.extent() * picture.world_from_object.scale;
    return {{center, reach_m * picture.world_from_object.scale}, {center, (size.x + size.y + size.z) / 6.0}};
}

DepthRange depth_range(const Picture& picture, const Workpiece& workpiece) {
    const wall::Eyes eyes = wall::eyes_of(picture.viewer);
    const double eye_m = std::min(wall::distance_in_front(picture.screen, eyes.left_world),
                                  wall::distance_in_front(picture.screen, eyes.right_world));
    DepthRange range;
    const std::array signs = boxes_of(contact_marks(picture));
    Box panel;
    if (picture.panel)
        for (const Vec3& corner : corners_world(picture.panel->stand)) panel.include(corner);
    Box objects;
    for (const DrawnObject& object : picture.objects) {
        const Box bounds = bounds_world(object);
        if (bounds.empty()) continue;
        objects.include(bounds.lo);
        objects.include(bounds.hi);
    }
    for (const Ball& ball : {ball_around(objects), workpiece.enclosing, ball_of(picture.tool), ball_of(picture.box),
                             ball_of(picture.proposed_box), ball_of(picture.bubble), ball_around(signs[0]),
                             ball_around(signs[1]), ball_around(panel)}) {
        if (ball.radius_m <= 0.0) continue;
        const double center_m = eye_m - wall::distance_in_front(picture.screen, ball.center_world);
        range.near_m = std::min(range.near_m, 0.9 * (center_m - ball.radius_m));
        range.far_m = std::max(range.far_m, 1.5 * (center_m + ball.radius_m));
    }
    // If something reaches the eye or lies behind it, the near
    // plane stays: what is nearer than 1 cm cannot be seen anyway.
    range.near_m = std::exp2(std::floor(std::log2(std::max(range.near_m, 0.01))));
    range.far_m = std::exp2(std::ceil(std::log2(range.far_m)));
    return range;
}

shared::FrameUniforms frame_uniforms(const Picture& picture, const Workpiece& workpiece) {
    shared::FrameUniforms frame{};
    const wall::Eyes eyes = wall::eyes_of(picture.viewer);
    const DepthRange depth = depth_range(picture, workpiece);
    const std::array eye_world{eyes.left_world, eyes.right_world};
    for (std::size_t i = 0; i < 2; ++i) {
        const Mat4 guarded = glm::scale(Mat4(1.0), Vec3(1.0 / kGuard, 1.0 / kGuard, 1.0));
        frame.clip_from_world[i] =
            glm::mat4(guarded * off_axis_projection(picture.screen, eye_world[i], depth.near_m, depth.far_m));
        frame.eye_world[i] = vec4_of(eye_world[i], 1.0);
    }
    const Vec3 middle = middle_of(eyes);
    frame.clip_from_world_middle = glm::mat4(off_axis_projection(picture.screen, middle, depth.near_m, depth.far_m));
    frame.fade = {glm::vec4(glm::dvec4(picture.edge_fade, picture.edge_fade_band,
                                       wall::distance_in_front(picture.screen, middle), kGuard))};
    frame.light = vec4_of(kToLight, kLightHalfAngleTangent);
    frame.light_colour = vec4_of(kLightColour, 0.0);
    frame.sky_colour = vec4_of(kSkyColour, 0.0);
    frame.ground_colour = vec4_of(kGroundColour, 0.0);
    if (picture.tool.visible) {
        const Pose& stylus = picture.tool.stylus_world;
        frame.tool = vec4_of(picture.tool.center_world, picture.tool.radius_m);
        frame.tool_spine = vec4_of(picture.tool.spine_m, 0.0);
        frame.stylus_tip = vec4_of(stylus.position_m, stylus_radius_m(picture.tool));
        frame.stylus_end = vec4_of(stylus * Vec3{0, 0, stylus_length_m(picture.tool)}, 0.0);
    }
    frame.tool_colour = vec4_of(linear_of(picture.tool.colour), 0.0);
    frame.workpiece = vec4_of(workpiece.typical.center_world, workpiece.typical.radius_m);
    if (picture.pedestal.visible)
        frame.pedestal = vec4_of(picture.pedestal.top_center_world, picture.pedestal.radius_m);
    frame.background = vec4_of(linear_of(picture.background), 1.0);
    frame.background_root = vec4_of(glm::pow(linear_of(picture.background), Vec3(1.0 / 2.4)), 0.0);
    BURIN_CHECK(picture.capsules.size() <= shared::kMostCapsules);
    for (std::size_t i = 0; i < std::min<std::size_t>(picture.capsules.size(), shared::kMostCapsules); ++i) {
        frame.capsule_from[i] = vec4_of(picture.capsules[i].from_world, picture.capsules[i].radius_m);
        frame.capsule_to[i] = vec4_of(picture.capsules[i].to_world, 0.0);
    }
    if (const std::optional<LampView> lamp = lamp_view(picture)) {
        constexpr double kTexel = 1.0 / kShadowMapSide;
        frame.map_from_world = glm::mat4(lamp->map_from_world);
        frame.map = glm::vec4(glm::dvec4(kTexel, kTexel * lamp->side_m, lamp->deep_m, 0.0));
    }
    return frame;
}

Shapes shapes_of(const Picture& picture, const Primitives& primitives) {
    Shapes shapes;
    if (picture.tool.visible) add_tool(shapes, picture.tool, primitives);
    for (const DrawnObject& object : picture.objects) {
        if (object.opacity < 1.0) continue;
        shared::DrawConstants c =
            constants_of(matrix(object.world_from_mesh), object.colour, 1.0, object.roughness, object.gloss);
        c.material.z = 1.0f;  // shows how near the tool is
        c.material.w = object.own_capsule == kAllCapsules ? -1.0f : static_cast<float>(object.own_capsule + 1);
        shapes.solid.push_back({{0, 0, object.mesh->bounds}, c, object.mesh});
    }
    add_clear_objects(shapes, picture);
    add_contact(shapes, picture, primitives);
    if (picture.pedestal.visible) {
        const PicturePedestal& p = picture.pedestal;
        const Pose pose{p.top_center_world, Quat{1, 0, 0, 0}};
        const Vec3 size{p.radius_m, std::max(p.top_center_world.y, 0.001), p.radius_m};
        shapes.solid.push_back({primitives.plinth, constants_of(matrix_of(pose, size), p.colour, 1.0, 0.75, 0.4)});
        shapes.solid.back().constants.material.z = -1.0f;  // the workpiece casts its shadow on it
    }
    if (picture.show_wall_frame) add_wall_frame(shapes, picture.screen, primitives);
    for (const PictureBox* box : {&picture.box, &picture.proposed_box}) {
        if (box->visible) add_box(shapes, *box, primitives);
    }
    if (picture.bubble.visible) add_bubble(shapes, picture.bubble, primitives);
    return shapes;
}

shared::DrawConstants surface_constants(const Picture& picture) {
    shared::DrawConstants c = constants_of(world_from_patch(picture), Vec3(1.0), 1.0, 0.42, 0.9);
    c.material.z = 1.0f;  // shows how near the tool is
    return c;
}

shared::DrawConstants screen_constants(const wall::Screen& screen) {
    const Vec3 half_x = 0.5 * (screen.lower_right_world - screen.lower_left_world);
    const Vec3 half_y = 0.5 * (screen.upper_left_world - screen.lower_left_world);
    shared::DrawConstants c{};
    c.world_from_local[0] = glm::vec4(glm::vec3(kGuard * half_x), 0.0f);
    c.world_from_local[1] = glm::vec4(glm::vec3(kGuard * half_y), 0.0f);
    c.world_from_local[3] = glm::vec4(glm::vec3(screen.lower_left_world + half_x + half_y), 1.0f);
    return c;
}

std::vector<std::shared_ptr<const DrawnMesh>> meshes_of(const Picture& picture) {
    std::vector<std::shared_ptr<const DrawnMesh>> meshes;
    if (picture.tool.visible && picture.tool.mesh) meshes.push_back(picture.tool.mesh);
    for (const DrawnObject& object : picture.objects) meshes.push_back(object.mesh);
    std::ranges::sort(meshes);
    meshes.erase(std::unique(meshes.begin(), meshes.end()), meshes.end());
    return meshes;
}

}  // namespace burin::picture
