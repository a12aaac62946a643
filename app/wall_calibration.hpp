// SPDX-License-Identifier: MIT
// burin wall calibrate: a screen's corners from where a wand touched it (renderer/stereo/calibration.hpp).
//
// Samples are lines "place,x,y,z" in the tracker's frame and the wall file's unit; empty lines, lines that begin with #,
// and a first line "place,x,y,z" are skipped. From standard input the procedure says what to touch next, and a line may be
// "x,y,z" alone: then it is the place that was asked for. A line that cannot be read is told and asked for again; "done" or
// the end of the input closes the procedure.
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "renderer/stereo/calibration.hpp"

namespace burin {

struct WallCalibrationOptions {
    std::string wall, samples, screen, out, json;
    bool keep_size = false;
};

[[nodiscard]] Result<std::vector<CalibrationSample>> parse_samples(std::string_view text, const std::string& name,
                                                                   double unit_m);
[[nodiscard]] std::vector<CalibrationSample> guided_samples(std::istream& in, std::ostream& prompts, double unit_m);

[[nodiscard]] Result<void> calibrate_wall(const WallCalibrationOptions& options);

}  // namespace burin
