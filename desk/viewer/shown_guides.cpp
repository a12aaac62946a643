// SPDX-License-Identifier: MIT
#include "desk/viewer/shown_guides.hpp"

#include <algorithm>
#include <variant>

#include "session/held/held_tool.hpp"
#include "session/state/session_room.hpp"
#include "session/state/session_state.hpp"
#include "toolbox/tool_mesh.hpp"

namespace burin::session {
namespace {

constexpr double kBeyond = 0.06;     // of the longest side, how far a pane stands out
constexpr double kThickness = 5e-4;  // of the longest side
constexpr double kFrame = 4e-3;      // likewise, half of what its frame is wide
constexpr double kPaneOpacity = 0.22, kImageOpacity = 0.55;
// Of the axes x, y and z, as they are coloured everywhere.
constexpr std::array<Vec3, 3> kColours{{{0.80, 0.30, 0.28}, {0.36, 0.66, 0.32}, {0.28, 0.46, 0.82}}};

std::shared_ptr<const picture::DrawnMesh> ball() {
    static const auto mesh = picture::drawn_mesh(toolbox::drawing_of(compute::BallTool{1.0}));
    return mesh;
}

// Returns four bars around a pane across an axis, which is so large on both sides of its middle.
geometry::TriangleMesh frame_of(int axis, const Vec3& half, double bar_m) {
    geometry::TriangleMesh frame;
    for (const int along : {(axis + 1) % 3, (axis + 2) % 3}) {
        const int across = 3 - axis - along;
        for (const double side : {-1.0, 1.0}) {
            Vec3 size(bar_m);
            size[along] = half[along] + bar_m;
            const geometry::TriangleMesh bar = toolbox::drawing_of(compute::BoxTool{size});
            const auto first = static_cast<std::uint32_t>(frame.positions_m.size());
            for (Vec3 place_m : bar.positions_m) {
                place_m[across] += side * half[across];
                frame.positions_m.push_back(place_m);
            }
            for (const auto& [a, b, c] : bar.triangles) frame.triangles.push_back({first + a, first + b, first + c});
        }
    }
    return frame;
}

constexpr Vec3 kBorderColour{0.93, 0.67, 0.25};

}  // namespace

MirrorPanes mirror_panes(const Box& workpiece_object) {
    const Vec3 size = workpiece_object.extent();
    const double longest_m = std::max({size.x, size.y, size.z});
    MirrorPanes panes;
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 half = 0.5 * size + Vec3(kBeyond * longest_m);
        half[axis] = kThickness * longest_m;
        const auto placed = [&](geometry::TriangleMesh mesh) {
            for (Vec3& place_m : mesh.positions_m) place_m += workpiece_object.center();
            return picture::drawn_mesh(mesh);
        };
        panes.at(static_cast<std::size_t>(axis)) = {placed(toolbox::drawing_of(compute::BoxTool{half})),
                                                    placed(frame_of(axis, half, kFrame * longest_m))};
    }
    return panes;
}

void add_mirror(picture::Picture& scene, const SessionState& state, const Room& room, const MirrorPanes& panes,
                const haptics::ToolState& tool) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const MirrorPane& plane = panes.at(axis);
        if (!state.mirror.across.at(axis) || !plane.pane) continue;
        scene.objects.push_back({plane.pane, state.world_from_object, kColours.at(axis), kPaneOpacity});
        scene.objects.push_back({plane.frame, state.world_from_object, kColours.at(axis)});
    }
    const std::shared_ptr<const HeldTool>& held = state.led().held;
    if (!scene.tool.visible || tool.tick == 0 || !held || !room.carved_object) return;
    const bool is_mesh = std::holds_alternative<compute::MeshTool>(held->shape);
    for (const toolbox::MirrorImage& image : toolbox::images_of(state.mirror)) {
        if (is_mesh && image.reverses()) continue;
        const Pose there = toolbox::image_of(Pose{tool.proxy_object_m, tool.tool_orientation_object}, image,
                                             room.carved_object->center());
        const Similarity object_from_tool{there.position_m, there.orientation,
                                          held->drawn ? 1.0 : scene.tool.radius_m / state.world_from_object.scale};
        scene.objects.push_back({held->drawn ? held->drawn : ball(), state.world_from_object * object_from_tool,
                                 scene.tool.colour, kImageOpacity});
    }
}

void add_border(picture::Picture& scene, const SessionState& state, const Room& room, const haptics::ToolState& tool) {
    const Box& border = room.lattice_object;
    const HandState& hand = state.led();
    if (border.empty() || !hand.held || hand.tool.operation != compute::Operation::fill || tool.tick == 0) return;
    const Vec3& at = tool.proxy_object_m;
    const Vec3 inside = glm::min(at - border.lo, border.hi - at);
    if (std::min({inside.x, inside.y, inside.z}) > 2.0 * hand.held->half_width_m()) return;
    scene.proposed_box = {{state.world_from_object * border.center(), state.world_from_object.orientation},
                          border.extent() * state.world_from_object.scale,
                          kBorderColour,
                          true,
                          0.0};
}

}  // namespace burin::session
