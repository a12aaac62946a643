// SPDX-License-Identifier: MIT
#include "session/stream/streamed_columns.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>

#include "haptics/tick_record.hpp"
#include "record/touched_columns.hpp"
#include "session/record/session_file.hpp"

namespace burin::session {
namespace {

struct StreamedKind {
    std::string_view begins;  // the column's name
    std::string_view kind;
};

// The first that fits counts. Columns that none fits are not streamed.
constexpr std::array kStreamedKinds{
    StreamedKind{"tick", "Index"},
    StreamedKind{"position_device_", "Position"},
    StreamedKind{"orientation_device_", "Orientation"},
    StreamedKind{"buttons", "Button"},
    StreamedKind{"fault", "Fault"},
    StreamedKind{"joint", "Joint"},
    StreamedKind{"drive_length_m", "Position"},
    StreamedKind{"drive_measured_N", "Force"},
    StreamedKind{"velocity_device_", "Velocity"},
    StreamedKind{"angular_velocity_device_", "AngularVelocity"},
    StreamedKind{"points", "Contact"},
    StreamedKind{"hip", "Position"},
    StreamedKind{"proxy", "Position"},
    StreamedKind{"penetration", "Contact"},
    StreamedKind{"contact_force_device_", "Force"},
    StreamedKind{"contact_torque_device_", "Torque"},
    StreamedKind{"desired_force_device_", "Force"},
    StreamedKind{"desired_torque_device_", "Torque"},
    StreamedKind{"commanded_force_device_", "Force"},
    StreamedKind{"commanded_torque_device_", "Torque"},
    StreamedKind{"saturated_axes", "Limit"},
    StreamedKind{"flags", "Flags"},
    StreamedKind{"cause", "Fault"},
    StreamedKind{"object", "Contact"},
};

std::optional<std::string_view> streamed_kind(const record::Column& column) {
    if (column.name.starts_with("object_from_device")) return std::nullopt;
    for (const StreamedKind& kind : kStreamedKinds)
        if (column.name.starts_with(kind.begins)) return kind.kind;
    return std::nullopt;
}

float streamed_value(record::Word word, record::ColumnType type) {
    constexpr std::uint64_t kWholeInFloat = std::uint64_t{1} << 24;
    switch (type) {
        case record::ColumnType::f64: return static_cast<float>(std::bit_cast<double>(word));
        case record::ColumnType::i64: return static_cast<float>(word % kWholeInFloat);
        case record::ColumnType::u32: break;
    }
    return static_cast<float>(static_cast<std::uint32_t>(word));
}

}  // namespace

StreamedColumns::StreamedColumns(const record::RowShape& shape) : shape_(shape) {
    shape_.points = std::min(shape.points, kMostStreamedPoints);
    std::vector<record::Column> all = record::columns_for(shape_);
    std::ranges::move(record::touched_columns(shape_), std::back_inserter(all));
    for (std::size_t i = 0; i < all.size(); ++i)
        if (const auto kind = streamed_kind(all[i]))
            columns_.push_back({all[i].name, all[i].unit, *kind, i, all[i].type});
}

void StreamedColumns::write(const haptics::TickRecord& tick, std::span<float> values) const {
    const std::vector<record::Word> row = session_row(tick, shape_);
    for (std::size_t i = 0; i < columns_.size(); ++i) values[i] = streamed_value(row[columns_[i].at], columns_[i].type);
}

}  // namespace burin::session
