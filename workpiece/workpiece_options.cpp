// SPDX-License-Identifier: MIT
#include "workpiece/workpiece_options.hpp"

namespace burin::workpiece {

bool is_shape(const std::string& source) { return source.starts_with("block:") || source.starts_with("ball:"); }

Result<void> check_units(const WorkpieceOptions& options, bool tool_is_a_file) {
    const LengthUnit unit = options.units.value_or(LengthUnit::m);
    if (unit == LengthUnit::m || tool_is_a_file || !is_shape(options.source)) return {};
    return fail(std::string("--units ") + name_of(unit), "is for mesh files, and " + options.source + " is in metres",
                "leave --units out and write the sizes in metres");
}

}  // namespace burin::workpiece
