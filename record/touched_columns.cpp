// SPDX-License-Identifier: MIT
#include "record/touched_columns.hpp"

#include "haptics/tick_record.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <limits>
#include <string>

namespace burin::record {

std::vector<Column> touched_columns(const RowShape& shape) {
    std::vector<Column> columns;
    const auto add = [&](const char* before, std::uint32_t i, const char* after, const char* unit, ColumnType type) {
        columns.push_back({before + std::to_string(i) + after, unit, "", type});
    };
    for (std::uint32_t i = 0; i < shape.points; ++i) add("object", i, "", "", ColumnType::u32);
    for (std::uint32_t i = 0; i < shape.points; ++i) {
        add("asked_stiffness", i, "_N_per_m", "N/m", ColumnType::f64);
        add("asked_damping", i, "_Ns_per_m", "Ns/m", ColumnType::f64);
        add("rendered_stiffness", i, "_N_per_m", "N/m", ColumnType::f64);
        add("rendered_damping", i, "_Ns_per_m", "Ns/m", ColumnType::f64);
    }
    columns.push_back({"energy_share", "", "", ColumnType::f64});
    return columns;
}

void append_objects(const haptics::TickRecord& tick, const RowShape& shape, std::vector<Word>& row) {
    for (std::uint32_t i = 0; i < shape.points; ++i)
        row.push_back(i < tick.contact.point_count ? tick.contact.points[i].object : 0u);
}

void append_walls(const haptics::TickRecord& tick, const RowShape& shape, std::vector<Word>& row) {
    constexpr double kNoWall = std::numeric_limits<double>::quiet_NaN();
    for (std::uint32_t i = 0; i < shape.points; ++i) {
        const haptics::PointRecord& point = tick.contact.points[i];
        const bool is_there = i < tick.contact.point_count;
        for (const double value : {point.asked.stiffness_N_per_m, point.asked.damping_Ns_per_m,
                                   point.rendered.stiffness_N_per_m, point.rendered.damping_Ns_per_m})
            row.push_back(std::bit_cast<Word>(is_there ? value : kNoWall));
    }
    row.push_back(std::bit_cast<Word>(tick.passivity.share));
}

void append_touched(const haptics::TickRecord& tick, const RowShape& shape, std::vector<Word>& row) {
    append_objects(tick, shape, row);
    append_walls(tick, shape, row);
}

bool can_be_replayed(std::span<const Column> recorded, const RowShape& shape) {
    std::vector<Column> all = columns_for(shape);
    const std::size_t without_walls = all.size() + shape.points;
    std::ranges::copy(touched_columns(shape), std::back_inserter(all));
    return (recorded.size() == all.size() || recorded.size() == without_walls) &&
           std::equal(recorded.begin(), recorded.end(), all.begin());
}

}  // namespace burin::record
