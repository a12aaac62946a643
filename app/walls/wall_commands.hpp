// SPDX-License-Identifier: MIT
// burin wall: shows and checks a wall file, and calibrates a screen of it.
//   burin wall show FILE [--svg OUT] [--json OUT]
//   burin wall check FILE                                         exit status 1 when there is an error
//   burin wall calibrate --wall FILE --samples CSV --screen NAME --out FILE
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli/command_table.hpp"
#include "base/error.hpp"
#include "wall/calibration.hpp"

namespace burin::app {

[[nodiscard]] CommandRow wall_row();

// ---- burin wall calibrate (wall_calibrate_command.cpp): fits a screen's corners to where a wand touched it
//
// Samples are lines "place,x,y,z" in the tracker's frame and the wall file's unit; empty lines, lines that begin with
// #, and a first line "place,x,y,z" are skipped. From standard input the procedure prompts for each touch, and a line
// may be "x,y,z" alone, which stands for the place that was prompted for. A line that cannot be read is reported and
// prompted for again; "done" or the end of the input ends the procedure.

struct WallCalibrationOptions {
    std::string wall, samples, screen, out, json;
    bool keep_size = false;
};

// Parses the samples of a file; name and line stand in errors, unit_m is the file's unit.
[[nodiscard]] Result<std::vector<wall::CalibrationSample>> parse_samples(std::string_view text, const std::string& name,
                                                                         double unit_m);
// Prompts for samples and reads them.
[[nodiscard]] std::vector<wall::CalibrationSample> guided_samples(std::istream& in, std::ostream& prompts,
                                                                  double unit_m);

[[nodiscard]] Result<void> calibrate_wall(const WallCalibrationOptions& options);
[[nodiscard]] CommandRow wall_calibrate_row();

}  // namespace burin::app
