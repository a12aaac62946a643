// SPDX-License-Identifier: MIT
#include "record/motion.hpp"

#include <bit>
#include <string>

namespace burin::record {
namespace {

constexpr std::array kMotionIntegers{"tick",           "time_ns",          "lateness_ns",
                                     "sample_time_ns", "surface_sequence", "parameter_sequence"};
constexpr std::array kMotionDoubles{"position_device_x_m",    "position_device_y_m",    "position_device_z_m",
                                    "orientation_device_qx",  "orientation_device_qy",  "orientation_device_qz",
                                    "orientation_device_qw",  "object_from_device_x_m", "object_from_device_y_m",
                                    "object_from_device_z_m", "object_from_device_qx",  "object_from_device_qy",
                                    "object_from_device_qz",  "object_from_device_qw",  "object_from_device_scale"};
constexpr std::array kMotionBits{"buttons", "fault"};
constexpr const char* kDriveState = "drive_state";
constexpr std::array kDriveDoubles{"drive_device_x",       "drive_device_y",       "drive_device_z",
                                   "drive_moves_device_x", "drive_moves_device_y", "drive_moves_device_z",
                                   "drive_length_m",       "drive_measured_N"};

}  // namespace

Result<MotionColumns> MotionColumns::find(const RecordReader& reader, std::size_t hand) {
    const HandRecord& of = reader.table(hand);
    MotionColumns columns;
    Result<void> outcome;
    const auto add = [&](std::vector<std::size_t>& to, const char* name, ColumnType type) {
        to.push_back(find_column(of, name, type));
        if (to.back() == of.columns.size() && outcome)
            outcome = fail(reader.path(), "has no column " + std::string(name) + " for " + of.name,
                           "replay a recording that has all columns");
    };
    for (const char* name : kMotionIntegers) add(columns.integers_, name, ColumnType::i64);
    for (const char* name : kMotionDoubles) add(columns.doubles_, name, ColumnType::f64);
    for (const char* name : kMotionBits) add(columns.bits_, name, ColumnType::u32);
    columns.drive_state_ = find_column(of, kDriveState, ColumnType::u32);
    if (columns.drive_state_ != of.columns.size())
        for (const char* name : kDriveDoubles) add(columns.drive_, name, ColumnType::f64);
    if (!outcome) return std::unexpected(outcome.error());
    for (std::size_t i = 0; i < devices::kMostJoints; ++i) {
        const std::size_t joint = find_column(of, "joint" + std::to_string(i), ColumnType::f64);
        if (joint == of.columns.size()) break;
        columns.joints_.push_back(joint);
    }
    return columns;
}

RecordedTick MotionColumns::at(const Block& block, std::uint32_t row) const {
    const auto integer = [&](std::size_t i) { return static_cast<std::int64_t>(block.at(integers_[i], row)); };
    const auto number = [&](std::size_t i) { return std::bit_cast<double>(block.at(doubles_[i], row)); };
    const auto vector = [&](std::size_t i) { return Vec3(number(i), number(i + 1), number(i + 2)); };
    const auto turn = [&](std::size_t i) { return Quat(number(i + 3), number(i), number(i + 1), number(i + 2)); };
    RecordedTick tick{integer(0),
                      integer(1),
                      integer(2),
                      {},
                      {},
                      static_cast<std::uint64_t>(integer(4)),
                      static_cast<std::uint64_t>(integer(5))};
    tick.sample.time_ns = integer(3);
    tick.sample.position_device_m = vector(0);
    tick.sample.orientation_device = turn(3);
    tick.sample.buttons = static_cast<std::uint32_t>(block.at(bits_[0], row));
    tick.sample.fault = static_cast<devices::DeviceFault>(block.at(bits_[1], row));
    for (std::size_t i = 0; i < joints_.size(); ++i)
        tick.sample.joints[i] = std::bit_cast<double>(block.at(joints_[i], row));
    if (!drive_.empty()) {
        const auto of_drive = [&](std::size_t i) { return std::bit_cast<double>(block.at(drive_[i], row)); };
        tick.sample.drive = {{of_drive(0), of_drive(1), of_drive(2)},
                             {of_drive(3), of_drive(4), of_drive(5)},
                             of_drive(6),
                             of_drive(7),
                             static_cast<std::uint32_t>(block.at(drive_state_, row))};
    }
    tick.object_from_device = {vector(7), turn(10), number(14)};
    return tick;
}

}  // namespace burin::record
