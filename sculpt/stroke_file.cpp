// SPDX-License-Identifier: MIT
#include "sculpt/stroke_file.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/csv.hpp"
#include "base/file_io.hpp"
#include "base/progress.hpp"
#include "base/try.hpp"

namespace burin::sculpt {
namespace {

constexpr std::string_view kHeader = "time_s,x_m,y_m,z_m,qx,qy,qz,qw,button";
// The same with turns as axis and angle, as tables of a wand have them.
constexpr std::string_view kAxisHeader = "time_s,x_m,y_m,z_m,axis_x,axis_y,axis_z,angle_rad,button";
constexpr std::size_t kColumns = 9;
constexpr double kLargest_m = 1e9;  // the limit for meshes, far from overflow
// A hand that feels its way ticks a thousand times a second: times in another unit would keep it going for weeks.
constexpr double kLongest_s = 86'400.0;
constexpr double kLeastStep_s = 1e-9;  // clocks count nanoseconds

std::string_view trimmed(std::string_view text) {
    const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!text.empty() && blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    return text;
}

// The names of a first line with commas between them, whatever separates them in the file.
std::string names_in(std::string_view line, char separator) {
    std::string names;
    for (const CsvField& field : split_csv(line, separator).fields)
        names += (names.empty() ? "" : ",") + column_name(field.text);
    return names;
}

// Parses the nine numbers of a line, in quotes or not; returns nullopt when there are not nine, or one is not a number.
std::optional<std::array<double, kColumns>> numbers(std::string_view line, char separator) {
    const CsvLine split = split_csv(line, separator);
    if (split.fields.size() != kColumns || split.unclosed_quote != 0) return std::nullopt;
    std::array<double, kColumns> values{};
    for (std::size_t i = 0; i < kColumns; ++i) {
        const std::string& field = split.fields[i].text;
        const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), values[i]);
        if (error != std::errc{} || end != field.data() + field.size()) return std::nullopt;
    }
    return values;
}

// Returns the turn about an axis of any length (Rodrigues), as a quaternion; none without a length, but for no turn.
std::optional<Quat> turn_about(const Vec3& axis, double angle_rad) {
    const double length = glm::length(axis);
    if (angle_rad == 0.0) return Quat(1.0, 0.0, 0.0, 0.0);
    if (!(length > 1e-9)) return std::nullopt;
    return glm::angleAxis(angle_rad, axis / length);
}

Result<Quat> turn_in(const std::array<double, kColumns>& n, bool as_axis, const std::string& where) {
    if (as_axis) {
        if (const auto turn = turn_about({n[4], n[5], n[6]}, n[7])) return glm::normalize(*turn);
        return fail(where, "its axis has no length, but its angle is not 0", "write 1,0,0,0 for no rotation");
    }
    const Quat q(n[7], n[4], n[5], n[6]);
    if (!(glm::length(q) > 1e-9)) return fail(where, "its quaternion has no length", "write 0,0,0,1 for no rotation");
    return glm::normalize(q);
}

Result<StrokeRow> make_row(const std::array<double, kColumns>& n, bool as_axis, const std::string& where,
                           const Stroke& before) {
    for (const double value : n) {
        if (!std::isfinite(value) || std::abs(value) > kLargest_m) {
            return fail(where, "holds a number that is not finite or is absurdly large", "correct the number");
        }
    }
    if (!before.empty() && !(n[0] - before.back().time_s >= kLeastStep_s)) {
        return fail(where, "its time does not come after the row before", "sort the rows by time_s, each time once");
    }
    if (!before.empty() && n[0] - before.front().time_s > kLongest_s)
        return fail(where, "its time is more than a day after that of the first row", "write time_s in seconds");
    BURIN_TRY(turn, turn_in(n, as_axis, where));
    if (n[8] != 0.0 && n[8] != 1.0) return fail(where, "its button is neither 0 nor 1", "write 0 or 1");
    return StrokeRow{n[0], {n[1], n[2], n[3]}, turn, n[8] == 1.0};
}

}  // namespace

Result<Stroke> parse_stroke(std::string_view text, const std::string& name) {
    Stroke stroke;
    bool header_seen = false, as_axis = false;
    std::optional<char> separator;
    for (std::size_t line_number = 1; !text.empty(); ++line_number) {
        const std::size_t end = text.find('\n');
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (line.empty() || line.front() == '#') continue;
        const std::string where = name + ":" + std::to_string(line_number);
        if (!separator && (separator = declared_separator(line))) continue;
        if (!header_seen) {
            if (!separator) separator = separator_in(line);
            const std::string header = names_in(line, *separator);
            as_axis = header == kAxisHeader;
            if (!as_axis && header != kHeader)
                return fail(where, "is not a stroke file",
                            "its first line must read " + std::string(kHeader) + ", or with a turn as axis and angle " +
                                std::string(kAxisHeader));
            header_seen = true;
            continue;
        }
        const auto values = numbers(line, *separator);
        if (!values)
            return fail(where,
                        std::string("does not hold nine numbers, each with a decimal point and between them ") +
                            name_of_separator(*separator),
                        "write " + std::string(as_axis ? kAxisHeader : kHeader));
        BURIN_TRY(row, make_row(*values, as_axis, where, stroke));
        stroke.push_back(row);
    }
    if (stroke.empty())
        return fail(name, "holds no stroke", "give it the header " + std::string(kHeader) + " and rows");
    return stroke;
}

Result<Stroke> read_stroke(const std::filesystem::path& path) {
    BURIN_TRY(text, read_text_file(path));
    return parse_stroke(text, path.string());
}

Result<void> carve_rigidly(Sculpture& sculpture, const Stroke& stroke, const toolbox::Tool& tool, bool merge_rows) {
    Progress progress("carving");
    const double tolerance_m = merge_rows ? tool.tolerance_cells * sculpture.surface().lattice().spacing_m : -1.0;
    std::vector<Pose> run;  // the rows from press to release
    for (std::size_t i = 0; i < stroke.size(); i += run.empty() ? 1 : run.size()) {
        run.clear();
        for (std::size_t k = i; k < stroke.size() && stroke[k].button; ++k) {
            run.push_back({stroke[k].position_object_m, stroke[k].orientation_object});
        }
        std::vector<compute::ToolSweep> sweeps = toolbox::sweeps_along(run, tool, tolerance_m);
        // Without merging, the first row is an update of its own, as if the tool had been set down before it moved.
        if (!merge_rows && run.size() > 1) sweeps.insert(sweeps.begin(), tool.sweep(run.front(), run.front()));
        for (std::size_t done = 0; done < sweeps.size(); ++done) {
            BURIN_TRY_DO(sculpture.update({&sweeps[done], 1}));
            const double of_run = static_cast<double>(done * run.size()) / static_cast<double>(sweeps.size());
            progress.show((static_cast<double>(i) + of_run) / static_cast<double>(stroke.size()));
        }
        sculpture.end_stroke();
    }
    return {};
}

}  // namespace burin::sculpt
