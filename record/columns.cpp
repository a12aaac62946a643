// SPDX-License-Identifier: MIT
#include "record/columns.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "devices/haptic/haptic_device.hpp"
#include "haptics/tick_record.hpp"

namespace burin::record {
namespace {

constexpr std::string_view kColumnsHead = "name,unit,frame,type\n";
constexpr std::size_t kMostListBytes = 1 << 20, kMostListed = 1024;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// A column's name in pieces, put together only where names are asked for.
struct Name {
    const char* before;
    int number = -1;  // between the two; -1: none
    const char* after = "";

    [[nodiscard]] std::string text() const {
        return number < 0 ? std::string(before) + after : before + std::to_string(number) + after;
    }
};

// Collects names, units and frames.
struct ColumnSink {
    std::vector<Column> columns;

    void f64(const Name& name, const char* unit, const char* frame, double) {
        columns.push_back({name.text(), unit, frame, ColumnType::f64});
    }
    void i64(const Name& name, const char* unit, std::int64_t) {
        columns.push_back({name.text(), unit, "", ColumnType::i64});
    }
    void u32(const Name& name, std::uint32_t) { columns.push_back({name.text(), "", "", ColumnType::u32}); }
};

// Collects values.
struct ValueSink {
    std::vector<Word> words;

    void f64(const Name&, const char*, const char*, double value) { words.push_back(std::bit_cast<Word>(value)); }
    void i64(const Name&, const char*, std::int64_t value) { words.push_back(static_cast<Word>(value)); }
    void u32(const Name&, std::uint32_t value) { words.push_back(value); }
};

template <typename Sink>
void vector(Sink& sink, const char* before, int number, const std::array<const char*, 3>& after, const char* unit,
            const char* frame, const Vec3& v) {
    for (int i = 0; i < 3; ++i) sink.f64({before, number, after[static_cast<std::size_t>(i)]}, unit, frame, v[i]);
}

// The rotation as axis times angle, in radians; zero for none.
Vec3 rotation_vector(const Quat& q) {
    const Vec3 axis(q.x, q.y, q.z);
    const double sine = glm::length(axis);
    if (sine == 0.0) return Vec3(0.0);
    // The shorter way round: of q and -q, which turn alike, the one with w >= 0.
    const double angle = 2.0 * std::atan2(sine, std::abs(q.w));
    return axis * ((q.w < 0.0 ? -angle : angle) / sine);
}

template <typename Sink>
void quaternion(Sink& sink, const char* before, const char* frame, const Quat& q) {
    sink.f64({before, -1, "_qx"}, "", frame, q.x);
    sink.f64({before, -1, "_qy"}, "", frame, q.y);
    sink.f64({before, -1, "_qz"}, "", frame, q.z);
    sink.f64({before, -1, "_qw"}, "", frame, q.w);
}

// Bits 0 to 2: force x, y, z; 3 to 5: torque. Set where the limits made the component smaller than desired.
std::uint32_t saturated_axes(const haptics::TickRecord& r) {
    if (!r.gate.saturated) return 0;
    std::uint32_t axes = 0;
    for (int i = 0; i < 3; ++i) {
        if (std::abs(r.gate.given.force_device_N[i]) < std::abs(r.wanted.force_device_N[i])) axes |= 1u << i;
        if (std::abs(r.gate.given.torque_device_Nm[i]) < std::abs(r.wanted.torque_device_Nm[i])) axes |= 8u << i;
    }
    return axes;
}

template <typename Sink>
void visit_drive(Sink& sink, const devices::OneWayDrive& drive) {
    vector(sink, "drive_device", -1, {"_x", "_y", "_z"}, "", "device", drive.along_device);
    vector(sink, "drive_moves_device", -1, {"_x", "_y", "_z"}, "", "device", drive.moves_device);
    sink.f64({"drive_length_m"}, "m", "", drive.length_m);
    sink.f64({"drive_measured_N"}, "N", "", drive.measured_N);
    sink.u32({"drive_state"}, drive.state);
}

template <typename Sink>
void visit_device(Sink& sink, const RowShape& shape, const haptics::TickRecord& r) {
    sink.i64({"tick"}, "", static_cast<std::int64_t>(r.tick));
    sink.i64({"time_ns"}, "ns", r.time_ns);
    sink.i64({"lateness_ns"}, "ns", r.lateness_ns);
    sink.i64({"sample_time_ns"}, "ns", r.sample.time_ns);
    vector(sink, "position_device", -1, {"_x_m", "_y_m", "_z_m"}, "m", "device", r.sample.position_device_m);
    quaternion(sink, "orientation_device", "device", r.sample.orientation_device);
    vector(sink, "rotation_device", -1, {"_x_rad", "_y_rad", "_z_rad"}, "rad", "device",
           rotation_vector(r.sample.orientation_device));
    sink.u32({"buttons"}, r.sample.buttons);
    sink.u32({"fault"}, static_cast<std::uint32_t>(r.sample.fault));
    for (std::uint32_t i = 0; i < shape.joints; ++i)
        sink.f64({"joint", static_cast<int>(i)}, "rad or m", "", r.sample.joints[i]);
    if (shape.one_way) visit_drive(sink, r.sample.drive);
    vector(sink, "velocity_device", -1, {"_x_m_per_s", "_y_m_per_s", "_z_m_per_s"}, "m/s", "device",
           r.motion.velocity_device_m_per_s);
    vector(sink, "angular_velocity_device", -1, {"_x_rad_per_s", "_y_rad_per_s", "_z_rad_per_s"}, "rad/s", "device",
           r.motion.angular_velocity_device_rad_per_s);
    const Similarity& map = r.motion.object_from_device;
    vector(sink, "object_from_device", -1, {"_x_m", "_y_m", "_z_m"}, "m", "object", map.position_m);
    quaternion(sink, "object_from_device", "object", map.orientation);
    sink.f64({"object_from_device_scale"}, "", "", map.scale);
}

template <typename Sink>
void visit_point(Sink& sink, int number, const haptics::PointRecord& p) {
    const std::array<const char*, 3> in_m{"_object_x_m", "_object_y_m", "_object_z_m"};
    vector(sink, "hip", number, in_m, "m", "object", p.hip_object_m);
    vector(sink, "proxy", number, in_m, "m", "object", p.proxy_object_m);
    vector(sink, "normal", number, {"_object_x", "_object_y", "_object_z"}, "", "object", p.normal_object);
    vector(sink, "force", number, {"_device_x_N", "_device_y_N", "_device_z_N"}, "N", "device", p.force_device_N);
    sink.f64({"penetration", number, "_m"}, "m", "object", p.penetration_m);
    sink.u32({"triangle", number}, p.active_triangle);
    sink.u32({"planes", number}, p.constraints);
}

template <typename Sink>
void visit_points(Sink& sink, const RowShape& shape, const haptics::TickRecord& r) {
    haptics::PointRecord absent;
    absent.hip_object_m = absent.proxy_object_m = absent.normal_object = absent.force_device_N = Vec3(kNone);
    absent.penetration_m = kNone;
    sink.u32({"points"}, r.contact.point_count);
    for (std::uint32_t i = 0; i < shape.points; ++i)
        visit_point(sink, static_cast<int>(i), i < r.contact.point_count ? r.contact.points[i] : absent);
}

template <typename Sink>
void wrench(Sink& sink, const char* force, const char* torque, const devices::DeviceWrench& w) {
    vector(sink, force, -1, {"_x_N", "_y_N", "_z_N"}, "N", "device", w.force_device_N);
    vector(sink, torque, -1, {"_x_Nm", "_y_Nm", "_z_Nm"}, "Nm", "device", w.torque_device_Nm);
}

// The list of all columns, in their order.
template <typename Sink>
void visit_columns(Sink& sink, const RowShape& shape, const haptics::TickRecord& r) {
    visit_device(sink, shape, r);
    visit_points(sink, shape, r);
    vector(sink, "cut_object", -1, {"_x_m", "_y_m", "_z_m"}, "m", "object", r.contact.cut_object_m);
    wrench(sink, "contact_force_device", "contact_torque_device", r.contact.wrench);
    wrench(sink, "desired_force_device", "desired_torque_device", r.wanted);
    wrench(sink, "commanded_force_device", "commanded_torque_device", r.gate.given);
    sink.u32({"saturated_axes"}, saturated_axes(r));
    sink.u32({"flags"}, r.flags);
    sink.u32({"cause"}, static_cast<std::uint32_t>(r.gate.cause));
    sink.u32({"stiffness_bound"}, static_cast<std::uint32_t>(r.contact.stiffness_bound));
    sink.u32({"phase"}, static_cast<std::uint32_t>(r.motion.workspace.phase));
    sink.i64({"surface_sequence"}, "", static_cast<std::int64_t>(r.surface_sequence));
    sink.i64({"parameter_sequence"}, "", static_cast<std::int64_t>(r.parameter_sequence));
}

template <typename T>
std::string shortest(T value) {
    std::array<char, 40> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

bool fits(const Column& column, std::string_view wanted) {
    if (wanted.ends_with('*')) return column.name.starts_with(wanted.substr(0, wanted.size() - 1));
    return column.name == wanted;
}

}  // namespace

std::string_view name_of(ColumnType type) {
    switch (type) {
        case ColumnType::f64: return "f64";
        case ColumnType::i64: return "i64";
        case ColumnType::u32: return "u32";
    }
    return "";
}

std::optional<ColumnType> column_type_named(std::string_view name) {
    for (const ColumnType type : {ColumnType::f64, ColumnType::i64, ColumnType::u32})
        if (name_of(type) == name) return type;
    return {};
}

RowShape shape_of(const devices::DeviceDescription& device, const haptics::Probe& probe) {
    return {std::min<std::uint32_t>(device.joints.count, devices::kMostJoints),
            std::min(probe.count, haptics::kMostProbePoints), device.drives_one_way};
}

std::vector<Column> columns_for(const RowShape& shape) {
    ColumnSink sink;
    visit_columns(sink, shape, haptics::TickRecord{});
    return std::move(sink.columns);
}

std::vector<Column> columns_for(const devices::DeviceDescription& device, const haptics::Probe& probe) {
    return columns_for(shape_of(device, probe));
}

std::vector<Word> row_of(const haptics::TickRecord& record, const RowShape& shape) {
    ValueSink sink;
    sink.words.reserve(80 + 16 * shape.points);
    visit_columns(sink, shape, record);
    return std::move(sink.words);
}

std::string text_of(Word word, ColumnType type) {
    switch (type) {
        case ColumnType::f64: {
            const auto value = std::bit_cast<double>(word);
            return std::isnan(value) ? "nan" : shortest(value);  // the sign of "not a number" says nothing
        }
        case ColumnType::i64: return shortest(static_cast<std::int64_t>(word));
        case ColumnType::u32: return shortest(static_cast<std::uint32_t>(word));
    }
    return {};
}

namespace {

std::vector<std::string_view> pieces_of(std::string_view name) {
    std::vector<std::string_view> pieces;
    for (std::size_t begin = 0; begin <= name.size();) {
        const std::size_t end = std::min(name.find('_', begin), name.size());
        pieces.push_back(name.substr(begin, end - begin));
        begin = end + 1;
    }
    return pieces;
}

// Whether a name has the pieces of another in their order, each at least as a beginning: "force0_device_x_N" those of
// "force_x".
bool has_pieces(std::string_view name, std::string_view wanted) {
    const std::vector<std::string_view> pieces = pieces_of(name);
    auto at = pieces.begin();
    for (const std::string_view piece : pieces_of(wanted)) {
        at = std::find_if(at, pieces.end(), [&](std::string_view p) { return p.starts_with(piece); });
        if (at++ == pieces.end()) return false;
    }
    return true;
}

// Returns the name that may have been meant: most columns are far longer than what is typed for them, so that one with
// its pieces comes before one of its length.
std::string meant_column(std::span<const Column> columns, std::string_view wanted) {
    std::vector<std::string_view> all, with_pieces;
    for (const Column& column : columns) {
        all.push_back(column.name);
        if (has_pieces(column.name, wanted)) with_pieces.push_back(column.name);
    }
    const std::vector<std::string_view>& names = with_pieces.empty() ? all : with_pieces;
    return names.empty() ? "" : std::string(nearest_name(wanted, names));
}

}  // namespace

Result<std::vector<std::size_t>> choose_columns(std::span<const Column> columns, std::string_view list) {
    std::vector<std::size_t> chosen;
    if (list.empty()) list = "*";
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        const std::string_view wanted = list.substr(begin, end - begin);
        const std::size_t before = chosen.size();
        for (std::size_t i = 0; i < columns.size(); ++i)
            if (fits(columns[i], wanted) && std::ranges::find(chosen, i) == chosen.end()) chosen.push_back(i);
        const bool known = std::ranges::any_of(columns, [&](const Column& c) { return fits(c, wanted); });
        if (chosen.size() == before && !known) {
            return fail("column '" + std::string(wanted) + "'", "is not in the recording",
                        "did you mean " + meant_column(columns, wanted) + "? burin session info lists all");
        }
        begin = end + 1;
    }
    return chosen;
}

std::string text_of(std::span<const Column> columns) {
    std::string text(kColumnsHead);
    for (const Column& column : columns)
        text += column.name + "," + column.unit + "," + column.frame + "," + std::string(name_of(column.type)) + "\n";
    return text;
}

Result<std::vector<Column>> columns_in(std::string_view text) {
    const auto wrong = [] { return fail("list of columns", "is none", "name a file that --record has written"); };
    if (!text.starts_with(kColumnsHead) || text.size() > kMostListBytes) return wrong();
    text.remove_prefix(kColumnsHead.size());
    std::vector<Column> columns;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        std::array<std::string, 4> fields;
        for (std::size_t i = 0; i < fields.size(); ++i) {
            const std::size_t comma = line.find(',');
            if ((comma == std::string_view::npos) != (i + 1 == fields.size())) return wrong();
            fields[i] = line.substr(0, comma);
            line.remove_prefix(std::min(comma == std::string_view::npos ? line.size() : comma + 1, line.size()));
        }
        const auto type = column_type_named(fields[3]);
        const bool is_known = std::ranges::any_of(columns, [&](const Column& c) { return c.name == fields[0]; });
        if (!type || fields[0].empty() || is_known || columns.size() >= kMostListed) return wrong();
        columns.push_back({fields[0], fields[1], fields[2], *type});
    }
    if (columns.empty()) return wrong();
    return columns;
}

}  // namespace burin::record
