// SPDX-License-Identifier: MIT
// What the renderer draws besides the workpiece's surface, as plain data. Lengths in metres, world frame unless a name says
// otherwise (base/space.hpp). Colours are sRGB with components 0 to 1, as people pick them; light is computed linearly.
#pragma once

#include "base/space.hpp"

namespace burin {

// A flat upright wall, standing on the floor line in the plane z = 0 with its lower edge's middle at the world's origin.
// The default is the 10 by 7.5 ft wall.
struct Wall {
    double width_m = 3.048;
    double height_m = 2.286;
};

// Any flat rectangular screen, by three corners as the viewer sees them.
struct Screen {
    Vec3 lower_left_world{-1.524, 0.0, 0.0};
    Vec3 lower_right_world{1.524, 0.0, 0.0};
    Vec3 upper_left_world{-1.524, 2.286, 0.0};
};

[[nodiscard]] inline Screen screen_of(const Wall& wall) {
    const double half_m = 0.5 * wall.width_m;
    return {{-half_m, 0.0, 0.0}, {half_m, 0.0, 0.0}, {-half_m, wall.height_m, 0.0}};
}

// The head frame has its origin midway between the eyes, +X to the viewer's right, +Y up, -Z ahead.
struct Viewer {
    Pose head_world{{0.0, 1.6, 2.0}, Quat{1.0, 0.0, 0.0, 0.0}};
    double interpupillary_m = 0.063;  // mean of adults (Dodgson 2004)
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

// The carving ball and the stylus that carries it.
struct SceneTool {
    double radius_m = 0.01;
    Vec3 center_world{0.0};
    Vec3 colour{0.85, 0.45, 0.15};
    Pose stylus_world;  // origin at the stylus's tip, its shaft along its own +Z (towards the hand)
    bool visible = false;
};

// The transparent haptic workspace box.
struct SceneBox {
    Pose center_world;
    Vec3 size_m{0.1626, 0.1219, 0.0711};  // the Omni's workspace, 6.4 x 4.8 x 2.8 in
    Vec3 colour{0.35, 0.62, 0.80};
    bool visible = false;
    double face_opacity = 0.12;  // 0: its edges alone
};

// A clear ball around a part of the haptic workspace: within it the hand's place counts, beyond it the workspace glides.
struct SceneBubble {
    Vec3 center_world{0.0};
    double radius_m = 0.03;
    Vec3 colour{0.45, 0.72, 0.62};
    bool visible = false;
};

// A round matt plinth from the floor (y = 0) up to its top, which catches the workpiece's shadow.
struct ScenePedestal {
    Vec3 top_center_world{0.0};
    double radius_m = 0.3;
    Vec3 colour{0.74, 0.73, 0.71};
    bool visible = false;
};

struct Scene {
    Wall wall;                          // the frame that is drawn stands at its edges
    Screen screen = screen_of(Wall{});  // what is projected on: screen_of(wall), or a calibrated one
    Viewer viewer;
    Similarity world_from_object;     // where the workpiece stands, and how large
    Vec3 lattice_origin_object{0.0};  // what the positions of surface patches are relative to
    SceneTool tool;
    SceneBox box;
    SceneBox proposed_box{
        {}, {0.1626, 0.1219, 0.0711}, {0.93, 0.67, 0.25}, false, 0.22};  // where the workspace may be next
    SceneBubble bubble;
    ScenePedestal pedestal;
    bool show_wall_frame = true;
    bool show_grid = true;              // the room: floor with grid and shadow, rising softly into a backdrop
    Vec3 background{0.56, 0.57, 0.59};  // mid-grey: stereo glasses leak least at low contrast (Woods 2010)
};

}  // namespace burin
