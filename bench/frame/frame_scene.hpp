// SPDX-License-Identifier: MIT
// The scene that `burin bench frame` draws, as plain data given alike to Burin and its peers: one surface, as a whole
// and as patches; a screen, a head on a small path, one lamp, one material.
//
// Surface: bench/measure/bumpy_sphere.hpp with a radius of 1 m, centred at the world's
// origin, with the true surface's normals. Patches: the triangles whose centres lie
// in the same cube of a grid; a vertex on a seam belongs to each patch beside it.
// Screen: 16 : 9 in the plane z = 0 around the sphere's centre, 1.9 m from the head's mean position, 37 degrees high
// from there: the sphere covers 97 % of it, and protrudes from it by its radius.
// Frames: all positions are world. Thread: plain data and pure
// functions; making it allocates (1 M triangles: 0.4 s, 80 MB).
#pragma once

#include <cstdint>
#include <vector>

#include "base/image.hpp"
#include "base/space.hpp"
#include "picture/picture.hpp"

namespace burin::bench {

struct FrameVertex {
    Vec3f position_world_m{0.0f};
    Vec3f normal_world{0.0f};
};

struct FrameMesh {
    std::vector<FrameVertex> vertices;
    std::vector<std::uint32_t> indices;  // three a triangle, counter-clockwise from outside
};

// The shading that all use: ambient + diffuse max(n.l, 0) times the surface's colour, plus specular
// max(n.h, 0)^exponent of white. Values are written into the picture as they are; no gamma is applied.
struct FrameLook {
    Vec3 to_light_world{-0.25, 0.87, 0.42};  // normalised by make_frame_scene
    Vec3 surface{0.80, 0.74, 0.66};
    Vec3 background{0.10, 0.12, 0.30};  // bluer than the surface can be, so that pictures show which pixels are covered
    double ambient = 0.25, diffuse = 0.70, specular = 0.25, exponent = 32.0;
};

struct FrameScene {
    ImageSize size{1280, 720};  // of one eye
    wall::Screen screen;
    Vec3 head_middle_world{0.0, 0.0, 1.9};
    double interpupillary_m = 0.063;
    double near_m = 0.5, far_m = 4.0;
    FrameLook look;
    FrameMesh whole;
    std::vector<FrameMesh> patches;
    std::vector<std::vector<std::uint32_t>> whole_vertices;  // for each patch, its vertices' indices in `whole`
    [[nodiscard]] std::size_t triangles() const { return whole.indices.size() / 3; }
};

inline constexpr std::size_t kTrianglesAPatch = 512;  // about that of a carved tile

[[nodiscard]] FrameScene make_frame_scene(std::size_t triangles, std::size_t triangles_a_patch = kTrianglesAPatch);

// Returns the viewer in a frame of the path: once around a
// figure of eight of 0.1 m each way in x and in y, in 60 frames.
inline constexpr unsigned kFramesAround = 60;
[[nodiscard]] wall::Viewer moving_viewer(const FrameScene& scene, unsigned frame);
[[nodiscard]] wall::Viewer still_viewer(const FrameScene& scene);

// A patch's vertices from a frame on; their number and the triangles stay.
struct PatchChange {
    std::uint32_t patch = 0;
    std::vector<FrameVertex> vertices;
};
// Moves a dent of 60 mm radius and 4 mm depth on a small circle near the picture's middle. Returns all patches that the
// dent touches in this frame or touched in the previous one, so that the surface closes behind it.
[[nodiscard]] std::vector<PatchChange> wandering_dent(const FrameScene& scene, unsigned frame);

// Returns the share of an eye's pixels whose centres a sphere of the surface's mean radius covers, by intersecting
// lines with the sphere, without a matrix.
[[nodiscard]] double expected_coverage(const FrameScene& scene, const Vec3& eye_world);
// Returns the share of a picture's pixels that are not the background.
[[nodiscard]] double coverage(const FrameLook& look, const Image& image);

}  // namespace burin::bench
