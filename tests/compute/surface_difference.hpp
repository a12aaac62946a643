// SPDX-License-Identifier: MIT
// What tells the surface that a device makes from the one that the CPU makes of the same solid.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "compute/mesher/surface.hpp"
#include "compute/vulkan/device_surface.hpp"
#include "gpu/device.hpp"

namespace burin::compute::test {

inline bool same(const shared::SurfaceVertex& a, const shared::SurfaceVertex& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z && a.normal == b.normal && a.colour == b.colour;
}

inline std::string text(const shared::SurfaceVertex& v) {
    return "(" + std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z) + " " +
           std::to_string(v.normal) + " " + std::to_string(v.colour) + ")";
}

// A triangle by what its corners are, the least first, so that the order of vertices and triangles does not matter.
using Corner = std::array<std::uint32_t, 5>;
inline std::vector<std::array<Corner, 3>> triangles_of(const TileMesh& mesh) {
    std::vector<std::array<Corner, 3>> triangles;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        std::array<Corner, 3> t;
        for (std::size_t k = 0; k < 3; ++k) {
            const shared::SurfaceVertex& v = mesh.vertices[mesh.indices[i + k]];
            t[k] = {std::bit_cast<std::uint32_t>(v.x), std::bit_cast<std::uint32_t>(v.y),
                    std::bit_cast<std::uint32_t>(v.z), v.normal, v.colour};
        }
        std::ranges::rotate(t, std::ranges::min_element(t));
        triangles.push_back(t);
    }
    std::ranges::sort(triangles);
    return triangles;
}

// How far the device's surface may be from the CPU's. On a software driver every bit is the same. On a graphics card it
// should be too, since shaders divide and take roots in doubles (shaders/shared/portable.h); but the bounds below are
// those of a card that was measured before they did, and stay until one has been measured since. What is made of whole
// numbers is the same on both: how many vertices and triangles, and which material.
struct Tolerance {
    explicit Tolerance(const gpu::Device& device, double spacing_m) {
        if (device.info().is_software()) return;
        place_m = 1e-3 * spacing_m;
        elsewhere = 0.002;
        other_diagonals = 0.1;
    }
    double place_m = 0.0;    // of a vertex in each axis
    double elsewhere = 0.0;  // share of the vertices that may be farther away
    // Share of the triangles that may have other corners. The two diagonals of a flat quad are equally good, so that
    // the choice hangs on the last bits of its corners: an H100 took the other one in up to 4.4 % of the triangles of
    // noise.
    double other_diagonals = 0.0;
};

struct Differences {
    std::size_t vertices = 0, in_last_bits = 0, elsewhere = 0, triangles = 0, other_triangles = 0;
    double most_m = 0.0;  // of the vertices that are not elsewhere

    void add(const shared::SurfaceVertex& a, const shared::SurfaceVertex& b, const Tolerance& tolerance) {
        ++vertices;
        if (same(a, b)) return;
        ++in_last_bits;
        const double away =
            std::max({std::abs(double{a.x} - b.x), std::abs(double{a.y} - b.y), std::abs(double{a.z} - b.z)});
        if (away > tolerance.place_m) {
            ++elsewhere;
        } else {
            most_m = std::max(most_m, away);
        }
    }
    [[nodiscard]] bool within(const Tolerance& tolerance) const {
        return static_cast<double>(elsewhere) <= tolerance.elsewhere * static_cast<double>(vertices) &&
               static_cast<double>(other_triangles) <= tolerance.other_diagonals * static_cast<double>(triangles);
    }
    [[nodiscard]] std::string text() const {
        std::ostringstream out;
        out << "of " << vertices << " vertices " << in_last_bits << " differ, by up to " << most_m << " m, "
            << elsewhere << " are elsewhere; of " << triangles << " triangles " << other_triangles
            << " have other corners";
        return out.str();
    }
};

// Nothing when the device's tile is the CPU's, else how it differs. The vertices of the cells come in the same order;
// only the extra ones on faces, and the triangles of their fans, may come in another.
inline std::string difference(const TileMesh& device, const TileMesh& cpu, const Tolerance& tolerance,
                              Differences& all) {
    if (device.vertices.size() != cpu.vertices.size() || device.indices.size() != cpu.indices.size()) {
        return std::to_string(device.vertices.size()) + " vertices and " + std::to_string(device.indices.size()) +
               " indices in place of " + std::to_string(cpu.vertices.size()) + " and " +
               std::to_string(cpu.indices.size());
    }
    if (device.disagreeing_edges != cpu.disagreeing_edges) return "other disagreeing edges";
    for (std::size_t i = 0; i < cpu.cell_vertices(); ++i) {
        all.add(device.vertices[i], cpu.vertices[i], tolerance);
        if (device.vertices[i].colour != cpu.vertices[i].colour ||
            (tolerance.place_m == 0.0 && !same(device.vertices[i], cpu.vertices[i]))) {
            return "vertex " + std::to_string(i) + " is " + text(device.vertices[i]) + " in place of " +
                   text(cpu.vertices[i]);
        }
    }
    all.triangles += cpu.indices.size() / 3;
    if (tolerance.place_m == 0.0 && !cpu.face_keys.empty()) {
        return triangles_of(device) == triangles_of(cpu) ? "" : "other triangles, with fans";
    }
    if (!cpu.face_keys.empty()) return "";  // with fans, whose corners have no order
    std::size_t other = 0;
    for (std::size_t i = 0; i < cpu.indices.size(); i += 3) {
        other += !std::equal(&cpu.indices[i], &cpu.indices[i] + 3, &device.indices[i]);
    }
    all.other_triangles += other;
    return other == 0 || tolerance.other_diagonals > 0.0 ? "" : "other triangles";
}

inline testing::AssertionResult equal(DeviceSurface& device, const Surface& cpu, const Tolerance& tolerance) {
    const auto tiles = device.download();
    if (!tiles) return testing::AssertionFailure() << tiles.error().line();
    Differences all;
    for (std::uint32_t t = 0; t < cpu.tile_count(); ++t) {
        const std::string differs = difference((*tiles)[t], cpu.tile(t), tolerance, all);
        if (!differs.empty()) return testing::AssertionFailure() << "tile " << t << ": " << differs;
    }
    if (!all.within(tolerance)) return testing::AssertionFailure() << all.text();
    if (all.in_last_bits > 0) testing::Test::RecordProperty("differences", all.text());
    return testing::AssertionSuccess();
}

}  // namespace burin::compute::test
