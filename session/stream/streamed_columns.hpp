// SPDX-License-Identifier: MIT
// The columns of a recorded tick that are streamed, each a channel of floats, with its label, unit and kind as the
// meta-data of XDF names them (github.com/sccn/xdf/wiki/Meta-Data). Names, units and values are the recording's own
// (record/columns.hpp, record/touched_columns.hpp), so that a channel is called what its column is.
//
// Left out are times, which the stamp has, numbers of surfaces and triangles, and points of a probe beyond the fourth.
// A tick's number is streamed without what a float cannot hold: its remainder of 2^24. Pure; allocates.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "record/columns.hpp"

namespace burin::session {

inline constexpr std::uint32_t kMostStreamedPoints = 4;
// Enough for every device: the columns without joints and points, joints, and four points.
inline constexpr std::size_t kMostStreamedColumns = 128;

struct StreamedColumn {
    std::string label;      // the column's name: "commanded_force_device_x_N"
    std::string unit;       // "N"; empty: a number without one
    std::string_view kind;  // "Force"
    std::size_t at = 0;     // in a row of session_row()
    record::ColumnType type = record::ColumnType::f64;
};

class StreamedColumns {
public:
    explicit StreamedColumns(const record::RowShape& shape);
    [[nodiscard]] std::span<const StreamedColumn> all() const { return columns_; }
    // Writes the values of a tick, one for each column; values.size() is all().size().
    void write(const haptics::TickRecord& tick, std::span<float> values) const;

private:
    record::RowShape shape_;
    std::vector<StreamedColumn> columns_;
};

}  // namespace burin::session
