// SPDX-License-Identifier: MIT
// A tool's surface as the tick sees it: samples of it, each with its outward normal and the area that it stands for,
// and a table that finds the sample nearest to any place around the tool.
//
// Any closed shape is sampled alike: from the triangles of its mesh, farthest point by farthest point, where points
// with different normals count as apart, so that both sides of an edge get their own. Every triangle's area goes to the
// sample that a look at a bed of the tool's shape would give it to (engagement.hpp), so that both areas agree, and all
// add up to the shape's.
// Frame: tool, metres; where the tool is drawn from and turned about is the origin. Plain data, made before the haptic
// thread sees it (toolbox/tool_samples.hpp).
#pragma once

#include <array>
#include <cstdint>

#include "base/space.hpp"

namespace burin::haptics {

struct ToolSample {
    Vec3f position_m{0.0f};
    Vec3f normal{0.0f};  // unit, outward
    float area_m2 = 0.0f;
    float half_width_m = 0.0f;             // of a disc of this area
    float raised_m = 0.0f;                 // what this place lies outside the middle of its part of the surface
    std::array<std::uint8_t, 6> beside{};  // the samples nearest to this one
};

struct ToolSurface {
    static constexpr std::uint32_t kMost = 252;
    static constexpr std::uint32_t kCells = 16;  // of the table, along each axis
    static constexpr std::uint8_t kNone = 255;   // of the table: too far from the tool

    std::uint32_t count = 0;  // 0: the tool does not cut
    // The length of which tolerances are fractions: a ball's radius, for others about half their width.
    double size_m = 0.0;
    double reach_m = 0.0;          // how far around the tool the table goes
    Vec3f lo_m{0.0f}, hi_m{0.0f};  // the tool's bounds
    Vec3f table_lo_m{0.0f}, cells_per_m{0.0f};
    std::array<ToolSample, kMost> samples{};
    std::array<std::uint8_t, kCells * kCells * kCells> table{};

    // kNone where the table does not reach.
    [[nodiscard]] std::uint8_t nearest(const Vec3f& place_m) const noexcept {
        const Vec3f at = (place_m - table_lo_m) * cells_per_m;
        constexpr auto kEnd = static_cast<float>(kCells);
        // NaN fails this comparison.
        if (!(at.x >= 0.0f && at.x < kEnd && at.y >= 0.0f && at.y < kEnd && at.z >= 0.0f && at.z < kEnd)) return kNone;
        const auto x = static_cast<std::uint32_t>(at.x), y = static_cast<std::uint32_t>(at.y),
                   z = static_cast<std::uint32_t>(at.z);
        return nearest_from(table[(z * kCells + y) * kCells + x], place_m);
    }

    // Returns the sample nearest to a piece of surface, or of those beside it the nearest that faces the piece: at a
    // tool's edge the nearest may be on its other side. kNone where none faces it. `out`: the piece's normal, of any
    // length.
    [[nodiscard]] std::uint8_t nearest_facing(const Vec3f& place_m, const Vec3f& out) const noexcept {
        const std::uint8_t nearest_one = nearest(place_m);
        if (nearest_one == kNone || faces(samples[nearest_one], out)) return nearest_one;
        std::uint8_t found = kNone;
        float least = 0.0f;
        for (const std::uint8_t i : samples[nearest_one].beside) {
            const Vec3f way = samples[i].position_m - place_m;
            const float squared = glm::dot(way, way);
            if ((found == kNone || squared < least) && faces(samples[i], out)) found = i, least = squared;
        }
        return found;
    }

private:
    // A piece faces a sample if their normals are opposite by this much at least.
    static constexpr float kFacing = 0.05f;
    [[nodiscard]] static bool faces(const ToolSample& sample, const Vec3f& out) noexcept {
        const float facing = -glm::dot(out, sample.normal);
        return facing > 0.0f && facing * facing > kFacing * kFacing * glm::dot(out, out);
    }

    static constexpr int kMostSteps = 4;  // a table's cell is about as wide as a sample

    // Goes from sample to nearer sample.
    [[nodiscard]] std::uint8_t nearest_from(std::uint8_t sample, const Vec3f& place_m) const noexcept {
        const auto squared = [&](std::uint8_t i) {
            const Vec3f way = samples[i].position_m - place_m;
            return glm::dot(way, way);
        };
        float least = squared(sample);
        for (int step = 0; step < kMostSteps; ++step) {
            const std::uint8_t from = sample;
            for (const std::uint8_t other : samples[from].beside)
                if (const float d2 = squared(other); d2 < least) least = d2, sample = other;
            if (sample == from) break;
        }
        return sample;
    }
};

}  // namespace burin::haptics
