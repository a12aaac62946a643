// SPDX-License-Identifier: MIT
// Where the tool is when the mouse points at a surface: the ray from between the eyes through the cursor meets the
// surface, and there the tool stands upright on its tip. While the left button is down it stands deeper by a set depth.
//
// The depth of a stroke is measured from the surface as it was when the stroke began. So a tool does not drill on by
// itself where the mouse rests, two passes of one stroke are as deep as one, the ray does not fall through a hole that
// the stroke cuts, and the tool's way depends on the mouse alone and not on how many frames show it
// (docs/decisions/038-the-mouse-is-a-hand.md).
// Hardest case: the ray leaves what the stroke is on, for the air, a hole, or something before or behind it. A stroke
// goes on where the ray meets the surface about where the last contact's plane lets it expect, and into what lies below
// that plane where the tool has room there and no air is in between; elsewhere the tool is lifted. Behind, over a hole
// and over air it hovers at the depth of the last contact, and the stroke goes on where it returns; before it rests on
// what hides the stroke, without working.
// Frame: object, metres; pixels of the output. Pure; one thread.
#pragma once

#include <optional>

#include "desk/input/seen_surface.hpp"
#include "wall/output_settings.hpp"
#include "wall/screen.hpp"

namespace burin::session {

// From where the cursor is seen.
struct CursorView {
    wall::OutputSettings shown;
    wall::OutputPlace place;
    wall::Screen screen;
    Vec3 eye_world{0.0, 1.6, 2.0};  // the middle of both
    Similarity object_from_world;

    // Returns the ray of a pixel, from the eye; nothing where the output is black.
    [[nodiscard]] std::optional<Ray> ray_object(const Vec2& px) const;
};

// What of a tool matters for how it stands.
struct ToolOnSurface {
    double tip_m = 0.0;         // from its origin to its tip, against its axis +Y
    double half_width_m = 0.0;  // a ball's radius
    double depth_m = 0.0;       // of a stroke
    double roll_rad = 0.0;      // about its axis, from the screen's right
};

struct SurfaceContact {
    Vec3 place_object_m{0.0};
    Vec3 normal_object{0.0, 0.0, 1.0};
};

struct SurfaceHand {
    bool pressed = false;
    SeenSurface as_it_was;               // of the stroke, while pressed
    std::optional<SurfaceContact> last;  // while pressed: of the stroke
};

struct StandingTool {
    Pose object_from_tool;
    bool works = false;   // stands in the surface, or hovers within a stroke; false: takes nothing away where it is
    double sunk_m = 0.0;  // along its axis, below where it would hover
    bool in_air = false;  // hovers within a stroke
};

// Moves the hand to where a ray points. now: the surface as it is; middle_object: what the tool is beside where it has
// touched nothing yet; object_from_screen: the screen's right, up and out.
struct PointedAt {
    SurfaceHand hand;
    StandingTool tool;
    bool on_surface = false;
};
[[nodiscard]] PointedAt pointed_at(SurfaceHand hand, const Ray& ray_object, const SeenSurface& now,
                                   const ToolOnSurface& tool, const Quat& object_from_screen,
                                   const Vec3& middle_object);

}  // namespace burin::session
