// SPDX-License-Identifier: MIT
// A course that the fingers of a simulated glove follow, and how strong they are: simulated-glove:FILE.
//
//   burin-fingers 1
//   holds_N 2.0 0.0 1.5 1.2          # thumb, index, middle, ring: the force at which each gives way
//   0.0  0 0 0 0                     # seconds since the glove was opened; how far each is closed, 0 open, 1 a grasp
//   1.5  0.5 0.5 0.5 0.5             # on straight lines from row to row; before the first and after the last as these
// A finger that nothing pushes is where its course has it. One that is pushed closes more slowly, stops at the force
// that it holds and opens beyond it: pressed against something that stands, it gives that force and no more.
// Pure; no heap once it is read; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "devices/gloves/grip_shape.hpp"

namespace burin::devices {

inline constexpr const char* kFingerCourseFiles = ".fingers";  // how their names end
inline constexpr std::uint64_t kMostFingerCourseBytes = 16 << 20;

struct FingerCourse {
    struct Row {
        double time_s = 0.0;
        std::array<double, kGloveFingers> closed{};
    };
    // A finger's speed in closures a second at most, and where it is pushed.
    static constexpr double kFree_per_s = 8.0, kPushed_per_s = 2.0;
    static constexpr double kPushed_N = 0.02;  // what fades away behind a push is none

    std::array<double, kGloveFingers> holds_N{Grip::kHolds_N, Grip::kHolds_N, Grip::kHolds_N, Grip::kHolds_N};
    std::vector<Row> rows;  // at least one, of times that rise

    [[nodiscard]] std::array<double, kGloveFingers> closed_at(double time_s) const;
};

// Fails with the line's number.
[[nodiscard]] Result<FingerCourse> parse_finger_course(std::string_view text, const std::string& name);
[[nodiscard]] std::string finger_course_text(const FingerCourse& course);

// Takes the fingers on to where the course has them at a time, by so long.
[[nodiscard]] Grip stepped(Grip grip, const FingerCourse& course, double at_s, const GloveForces& pushed_N,
                           double time_s);

}  // namespace burin::devices
