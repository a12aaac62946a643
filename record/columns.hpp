// SPDX-License-Identifier: MIT
// The columns of a recorded tick: which there are for a device and a probe, and the values that a tick record gives
// them. Both come from one list (columns.cpp), so that a name never stands over another column's numbers.
//
// Units are SI, times whole nanoseconds; each column names its unit and its frame (base/space.hpp). A value is kept bit
// for bit, as a word of 64 bits: the bits of a double, a signed 64-bit integer, or an unsigned 32-bit integer in the
// lower half. Pure; any thread; allocates, so it is not for the haptic thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace burin::devices {
struct DeviceDescription;  // devices/haptic/haptic_device.hpp
}  // namespace burin::devices

namespace burin::haptics {
struct Probe;       // haptics/contact/probe.hpp
struct TickRecord;  // haptics/tick_record.hpp
}  // namespace burin::haptics

namespace burin::record {

enum class ColumnType : std::uint8_t { f64, i64, u32 };

// Bytes of a value in a block.
[[nodiscard]] constexpr std::size_t size_of(ColumnType type) { return type == ColumnType::u32 ? 4 : 8; }
[[nodiscard]] std::string_view name_of(ColumnType type);
[[nodiscard]] std::optional<ColumnType> column_type_named(std::string_view name);

struct Column {
    std::string name;   // e.g. "hip0_object_x_m"
    std::string unit;   // e.g. "m"; empty: a number without a unit, bits or an index
    std::string frame;  // "device", "object" or empty
    ColumnType type = ColumnType::f64;

    bool operator==(const Column&) const = default;
};

using Word = std::uint64_t;

// What decides which columns there are.
struct RowShape {
    std::uint32_t joints = 0;  // of the device
    std::uint32_t points = 1;  // of the probe
    bool one_way = false;      // the part drives one way alone (devices::OneWayDrive)
};

[[nodiscard]] RowShape shape_of(const devices::DeviceDescription& device, const haptics::Probe& probe);
[[nodiscard]] std::vector<Column> columns_for(const RowShape& shape);
[[nodiscard]] std::vector<Column> columns_for(const devices::DeviceDescription& device, const haptics::Probe& probe);

// Returns the tick's values in the order of columns_for(shape). A point of the shape that the tick does not have is not
// a number (its triangle kNoTriangle); column "points" says how many the tick had.
[[nodiscard]] std::vector<Word> row_of(const haptics::TickRecord& record, const RowShape& shape);

// Returns the value as text that reads back to the same bits: the shortest decimal; "nan", "inf", "-inf".
[[nodiscard]] std::string text_of(Word word, ColumnType type);

// Returns the indices of the columns that a list names: names with commas between them, a star at a name's end for all
// that begin so; empty: all columns. Fails on a name that fits none, and says which is nearest.
[[nodiscard]] Result<std::vector<std::size_t>> choose_columns(std::span<const Column> columns, std::string_view list);

// A list of columns as text: a line "name,unit,frame,type" of them, then a line a column. Reading fails on a list that
// is none, on names that are empty or occur twice, and on commas in a name.
[[nodiscard]] std::string text_of(std::span<const Column> columns);
[[nodiscard]] Result<std::vector<Column>> columns_in(std::string_view text);

}  // namespace burin::record
