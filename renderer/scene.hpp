// SPDX-License-Identifier: MIT
// What the renderer draws besides the workpiece's surface, as plain data. Lengths in metres, world frame unless a name says
// otherwise (base/space.hpp). Colours are sRGB with components 0 to 1, as people pick them; light is computed linearly.
#pragma once

#include <cstdint>
#include <optional>

#include "base/space.hpp"
#include "renderer/panel/panel_stand.hpp"

namespace burin {

// A flat upright wall, standing on the floor line in the plane z = 0 with its lower edge's middle at the world's origin.
// The default is the 10 by 7.5 ft wall.
struct Wall {
    double width_m = 3.048;
    double height_m = 2.286;

    bool operator==(const Wall&) const = default;
};

// Any flat rectangular screen, by three corners as the viewer sees them.
struct Screen {
    Vec3 lower_left_world{-1.524, 0.0, 0.0};
    Vec3 lower_right_world{1.524, 0.0, 0.0};
    Vec3 upper_left_world{-1.524, 2.286, 0.0};

    bool operator==(const Screen&) const = default;
};

[[nodiscard]] inline Screen screen_of(const Wall& wall) {
    const double half_m = 0.5 * wall.width_m;
    return {{-half_m, 0.0, 0.0}, {half_m, 0.0, 0.0}, {-half_m, wall.height_m, 0.0}};
}

// The head frame has its origin midway between the eyes, +X to the viewer's right, +Y up, -Z ahead.
struct Viewer {
    Pose head_world{{0.0, 1.6, 2.0}, Quat{1.0, 0.0, 0.0, 0.0}};
    double interpupillary_m = 0.063;  // mean of adults (Dodgson 2004)

    bool operator==(const Viewer&) const = default;
};

struct Eyes {
    Vec3 left_world;
    Vec3 right_world;
};

// The eyes lie at +-half the interpupillary distance on the head's own X axis, however the head is turned.
[[nodiscard]] inline Eyes eyes_of(const Viewer& viewer) {
    const Vec3 half{0.5 * viewer.interpupillary_m, 0.0, 0.0};
    return {viewer.head_world * -half, viewer.head_world * half};
}
[[nodiscard]] inline Vec3 middle_of(const Eyes& eyes) { return 0.5 * (eyes.left_world + eyes.right_world); }

// The carving ball and the stylus that carries it.
struct SceneTool {
    double radius_m = 0.01;
    Vec3 center_world{0.0};
    Vec3 colour{0.85, 0.45, 0.15};
    Pose stylus_world;  // origin at the stylus's tip, its shaft along its own +Z (towards the hand)
    bool visible = false;

    bool operator==(const SceneTool&) const = default;
};

// The transparent haptic workspace box.
struct SceneBox {
    Pose center_world;
    Vec3 size_m{0.1626, 0.1219, 0.0711};  // the Omni's workspace, 6.4 x 4.8 x 2.8 in
    Vec3 colour{0.35, 0.62, 0.80};
    bool visible = false;
    double face_opacity = 0.12;  // 0: its edges alone

    bool operator==(const SceneBox&) const = default;
};

// A clear ball around a part of the haptic workspace: within it the hand's place counts, beyond it the workspace glides.
struct SceneBubble {
    Vec3 center_world{0.0};
    double radius_m = 0.03;
    Vec3 colour{0.45, 0.72, 0.62};
    bool visible = false;

    bool operator==(const SceneBubble&) const = default;
};

// A round matt plinth from the floor (y = 0) up to its top, which catches the workpiece's shadow.
struct ScenePedestal {
    Vec3 top_center_world{0.0};
    double radius_m = 0.3;
    Vec3 colour{0.74, 0.73, 0.71};
    bool visible = false;

    bool operator==(const ScenePedestal&) const = default;
};

// Where the tool touches, and the force that the hand feels there: a ring around the point, in the surface's plane, and an arrow
// along the force that begins where its line leaves the tool's ball. Both are signs, not things: they are lit as the tool is, but keep no
// light off anything, so that no shadow is taken for the tool's.
struct SceneContact {
    Vec3 point_world{0.0};
    Vec3 normal_world{0.0, 1.0, 0.0};  // of the surface, any length; zero: not known, and no ring
    // On the hand, in newtons at the device, along the world's axes. Below 0.05 N there is no arrow: that is sensor noise and friction
    // in the device, not touch.
    Vec3 force_N{0.0};
    // The arrow's length is bounded: at least 0.6 N's, so that its head can be seen; at most 4 N's, which small devices do not exceed.
    double metres_per_N = 0.09;  // 1/25 of the wall's height
    // Magenta: neither what is carved (clay, wood, plaster) nor tool, boxes or bubble have it, and it stays apart from the tool's
    // orange for those who see red and green alike, by its share of blue.
    Vec3 colour{0.88, 0.26, 0.62};
    bool visible = false;  // false: no contact

    bool operator==(const SceneContact&) const = default;
};

// A panel that stands in the room; its picture is the one given to Renderer::show_panel(). It glows by itself, is hidden by what stands
// nearer and hides what is behind.
struct ScenePanel {
    PanelStand stand;
    std::uint64_t version = 0;  // another one whenever its picture was painted anew: only then is it drawn anew

    bool operator==(const ScenePanel&) const = default;
};

struct Scene {
    Wall wall;                          // the frame that is drawn stands at its edges
    Screen screen = screen_of(Wall{});  // what is projected on: screen_of(wall), or a calibrated one
    Viewer viewer;
    Similarity world_from_object;     // where the workpiece stands, and how large
    Vec3 lattice_origin_object{0.0};  // what the positions of surface patches are relative to
    // What the room's floor takes the workpiece to be when it lies in its shadow. Empty: the patches' bounds; then the whole
    // picture is drawn anew when these change.
    Box workpiece_object;
    SceneTool tool;
    SceneContact contact;
    SceneBox box;
    SceneBox proposed_box{
        {}, {0.1626, 0.1219, 0.0711}, {0.93, 0.67, 0.25}, false, 0.22};  // where the workspace may be next
    SceneBubble bubble;
    ScenePedestal pedestal;
    std::optional<ScenePanel> panel = std::nullopt;
    // How much the parallax of what stands in front of the screen fades towards its edges, against window violations (parallax_fade.h): 0,
    // as it is, to 1, none at the edge. The fade begins `edge_fade_band` from the edge, 1 = half the screen.
    double edge_fade = 0.0;
    double edge_fade_band = 0.2;
    bool show_wall_frame = true;
    bool show_grid = true;              // the room: floor with grid and shadow, rising softly into a backdrop
    Vec3 background{0.56, 0.57, 0.59};  // mid-grey: stereo glasses leak least at low contrast (Woods 2010)

    bool operator==(const Scene&) const = default;
};

}  // namespace burin
