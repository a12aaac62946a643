// SPDX-License-Identifier: MIT
// The scene that the renderer draws besides the workpiece's surface, as plain data. Lengths in metres, world frame
// unless a name says otherwise (base/space.hpp). Colours are sRGB with components 0 to 1; light is computed linearly.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/space.hpp"
#include "picture/drawn_mesh.hpp"
#include "picture/panel_stand.hpp"
#include "wall/screen.hpp"

namespace burin::picture {

// What works at the tip of the hand's tool, and the stylus that carries it: a ball, or a mesh. Where its shadow falls,
// where it darkens what is near and where its ring of colour lies follow from its *spine*, a line that stands for the
// tool when it is thickened by a radius. A ball's spine is its middle.
struct PictureTool {
    double radius_m = 0.01;  // of the ball, or around the spine
    Vec3 center_world{0.0};  // of the ball, or one end of the spine
    Vec3 colour{0.85, 0.45, 0.15};
    Pose stylus_world;  // origin at the stylus's tip, its shaft along its own +Z (towards the hand)
    bool visible = false;
    std::shared_ptr<const DrawnMesh> mesh = nullptr;  // null: a ball
    Similarity world_from_mesh{};
    Vec3 spine_m{0.0};  // from one end of the spine to the other, along the world's axes; zero for a ball

    bool operator==(const PictureTool&) const = default;
};

inline constexpr std::int32_t kNoCapsule = -1, kAllCapsules = -2;

// An object of a world. It receives the shadow and ring of the tool as the workpiece does, and the shadows of capsules
// and of objects that cast some. One that changes its shape has another mesh in each scene; where these are of one size
// the renderer puts each in the place of the one before.
struct DrawnObject {
    std::shared_ptr<const DrawnMesh> mesh;  // not null
    Similarity world_from_mesh;
    Vec3 colour{0.78, 0.78, 0.78};
    double opacity = 1.0;  // below 1 it is drawn as glass, over all that is opaque, the farthest such object first
    double roughness = 0.42, gloss = 0.9;
    // Which of the scene's capsules stands for it, and keeps no light off it.
    std::int32_t own_capsule = kNoCapsule;
    // On other objects, itself, the workpiece, the plinth and the floor. What one sees through casts none.
    bool casts_shadow = false;

    bool operator==(const DrawnObject&) const = default;
};

// A segment that is thickened by a radius: it is not drawn, and casts a shadow on objects in closed form. The bones of
// a hand, whose skin is drawn as an object, are some of them.
struct PictureCapsule {
    Vec3 from_world{0.0}, to_world{0.0};
    double radius_m = 0.0;

    bool operator==(const PictureCapsule&) const = default;
};

// The transparent haptic workspace box.
struct PictureBox {
    Pose center_world;
    Vec3 size_m{0.1626, 0.1219, 0.0711};  // the Omni's workspace, 6.4 x 4.8 x 2.8 in
    Vec3 colour{0.35, 0.62, 0.80};
    bool visible = false;
    double face_opacity = 0.12;  // 0: only the edges are drawn

    bool operator==(const PictureBox&) const = default;
};

// A transparent ball around a part of the haptic workspace: within
// it the hand's position is mapped, beyond it the workspace drifts.
struct PictureBubble {
    Vec3 center_world{0.0};
    double radius_m = 0.03;
    Vec3 colour{0.45, 0.72, 0.62};
    bool visible = false;

    bool operator==(const PictureBubble&) const = default;
};

// A round matt plinth from the floor (y = 0) up to its top, which catches the workpiece's shadow.
struct PicturePedestal {
    Vec3 top_center_world{0.0};
    double radius_m = 0.3;
    Vec3 colour{0.74, 0.73, 0.71};
    bool visible = false;

    bool operator==(const PicturePedestal&) const = default;
};

// The contact point of the tool and the force that the hand feels there: a ring around the point, in the surface's
// plane, and an arrow along the force that begins where its line leaves the tool's ball. Both are marks, not objects:
// they are lit as the tool is but occlude no light, so that no shadow is mistaken for the tool's.
struct PictureContact {
    Vec3 point_world{0.0};
    Vec3 normal_world{0.0, 1.0, 0.0};  // of the surface, any length; zero: unknown, and no ring is drawn
    // Force on the hand, in newtons at the device, along the world's axes. Below 0.05 N there is no arrow: that is
    // sensor noise and friction in the device, not contact.
    Vec3 force_N{0.0};
    // Arrow length for each newton. The length is clamped to that of 0.6 N, so that the head is visible, and of 4 N,
    // which small devices do not exceed.
    double metres_per_N = 0.09;  // 1/25 of the wall's height
    // Magenta: neither the materials (clay, wood, plaster) nor tool, boxes or bubble have it, and its share of blue
    // keeps it distinct from the tool's orange for those who confuse red and green.
    Vec3 colour{0.88, 0.26, 0.62};
    bool visible = false;  // false: no contact

    bool operator==(const PictureContact&) const = default;
};

// A panel that stands in the room, with the picture given to Renderer::show_panel(). It is unlit, is hidden by nearer
// objects and hides farther ones.
struct PicturePanel {
    PanelStand stand;
    std::uint64_t version = 0;  // changes whenever its picture is repainted: only then is it redrawn

    bool operator==(const PicturePanel&) const = default;
};

struct Picture {
    wall::Wall wall;                                      // the drawn wall frame stands at its edges
    wall::Screen screen = wall::screen_of(wall::Wall{});  // the projection screen: screen_of(wall), or a calibrated one
    wall::Viewer viewer;
    Similarity world_from_object;     // pose and scale of the workpiece
    Vec3 lattice_origin_object{0.0};  // origin of the positions of surface patches
    // Extent of the workpiece, for its shadow on the room's floor. Empty: the patches' bounds, and then the whole
    // picture is redrawn when these change.
    Box workpiece_object;
    std::vector<DrawnObject> objects;
    std::vector<PictureCapsule> capsules;  // at most shared::kMostCapsules
    PictureTool tool;
    PictureContact contact;
    PictureBox box;
    PictureBox proposed_box{
        {}, {0.1626, 0.1219, 0.0711}, {0.93, 0.67, 0.25}, false, 0.22};  // where the workspace may move next
    PictureBubble bubble;
    PicturePedestal pedestal;
    std::optional<PicturePanel> panel = std::nullopt;
    // Strength of the fade of parallax towards the screen's edges, for what stands in
    // front of it, against window violations (parallax_fade.h): 0, none, to 1, no parallax
    // at the edge. The fade begins `edge_fade_band` from the edge, 1 = half the screen.
    double edge_fade = 0.0;
    double edge_fade_band = 0.2;
    bool show_wall_frame = true;
    bool show_grid = true;              // the room: floor with grid and shadow, blending into a backdrop
    Vec3 background{0.56, 0.57, 0.59};  // mid-grey: stereo glasses leak least at low contrast (Woods 2010)

    bool operator==(const Picture&) const = default;
};

}  // namespace burin::picture
