// SPDX-License-Identifier: MIT
// Engagement: which parts of a tool's surface lie in or on the material around it, read from the known surface.
//
// Data flow: the triangles near the tool, cut into pieces, go to the nearest sample of the tool's surface
// (tool_surface.hpp) if they face it. Each sample then has an area, what the pieces cover of its own, and a plane,
// their mean: how deep the sample lies in the material behind this plane, wherever the tool has moved since. The tool's
// own bed, which the known surface shows some milliseconds after it was cut, fits the tool; there a sample counts as
// engaged within kBed of the tool's size, which facets and the difference between the tool that cuts and the balls that
// touch take up.
// Hardest case: a tool that plunges from a free face while no new surface arrives. The planes go on beyond the pieces,
// so that what is engaged grows with the depth as it would on the real face.
// Frame: object, metres. Work: the triangles near and their pieces, counted; when they are more than the caller
// affords, the pieces are longer, and then each second, fourth, ... triangle stands for all. Pure; no heap, lock,
// throw; + - * / and sqrt only.
#pragma once

#include <array>
#include <cstdint>

#include "base/space.hpp"
#include "geometry/contact/local_surface.hpp"
#include "haptics/forces/tool_surface.hpp"

namespace burin::haptics {

// Of the tool's size.
inline constexpr double kBed = 0.015;

struct EngagedSample {
    Vec3f normal{0.0f};     // unit, of the surface: out of the material
    float offset_m = 0.0f;  // dot(normal, x) on the surface, x relative to Engagement::place_object_m
    float area_m2 = 0.0f;
    float fit = 0.0f;  // 1: the surface around follows the tool's, as in its own bed; 0: it does not, as on a plane
    std::uint32_t sample = 0;
};

// What lies around the tool.
struct Engagement {
    static constexpr std::uint32_t kMost = ToolSurface::kMost;  // in a deep bed each sees something
    std::uint32_t count = 0;
    std::array<EngagedSample, kMost> samples{};
    Vec3 place_object_m{0.0};  // where the tool was when it was looked at
    Quat orientation_object{1.0, 0.0, 0.0, 0.0};
    std::uint64_t surface_sequence = 0;
    std::uint32_t stride = 1;   // how coarsely it was looked at: with about one piece in so many
    bool for_bearing = false;   // it says where the tool bears, not what it would cut
    std::uint32_t missed = 0;   // ticks since, in which there was too little work left to look
    float next_look_ns = 0.0f;  // what another look will cost, by what this one did; 0: not known
};

struct EngagementWork {
    std::uint32_t looks = 0;   // triangles and boxes checked
    std::uint32_t pieces = 0;  // of triangles, given to a sample
};

struct EngagementLook {
    Engagement engagement;
    EngagementWork work;
    bool complete = true;  // false: there were more pieces than allowed; the next look takes twice the stride
};

// What a look is for. For bearing it goes less far, and the vertices of fine meshes stand for their triangles, so that
// it suffices however fine they are: a sample's area is then its own where as many vertices as elsewhere are before it.
enum class LookFor : std::uint8_t { cutting, bearing };

// Looks at the surface around a tool.
[[nodiscard]] EngagementLook look_around(const geometry::LocalSurface& surface, const ToolSurface& tool,
                                         const Vec3& place_object_m, const Quat& orientation_object,
                                         std::uint32_t stride, const EngagementWork& most,
                                         LookFor purpose = LookFor::cutting) noexcept;

// Returns the unit direction into the material near a place, from the vector area of the surface that faces it within
// reach_m, or of a place within the material, which no surface faces, from what is around it; zero where there is none.
// A vector area depends on a surface's border alone, so a groove that lies wholly within does not tilt it.
[[nodiscard]] Vec3 into_material(const geometry::LocalSurface& surface, const Vec3& place_object_m,
                                 double reach_m) noexcept;

}  // namespace burin::haptics
