// SPDX-License-Identifier: MIT
#include "wall/wall_file.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "base/file_io.hpp"
#include "base/toml_table.hpp"
#include "base/try.hpp"

namespace burin::wall {
namespace {

constexpr std::uint64_t kMostBytes = 1 << 20;

// Writes a value, tables and arrays within braces and brackets. (toml++ writes a table too, but works out how wide its
// numbers are by a logarithm that is below zero for numbers below one, and then undefined.)
void write_on_a_line(std::ostream& out, const toml::node& node) {
    const char* separator = "";
    if (const toml::array* array = node.as_array()) {
        out << "[";
        for (const toml::node& one : *array) {
            out << std::exchange(separator, ", ");
            write_on_a_line(out, one);
        }
        out << "]";
    } else if (const toml::table* table = node.as_table()) {
        out << "{";
        for (const auto& [key, value] : *table) {
            out << std::exchange(separator, ", ") << toml::value<std::string>(std::string(key)) << " = ";
            write_on_a_line(out, value);
        }
        out << "}";
    } else {
        node.visit([&out](const auto& value) {
            if constexpr (toml::is_value<decltype(value)>) out << value;
        });
    }
}

void read_blend(TableReading& reading, const toml::table* table, EdgeBlend& blend) {
    TableReader t(reading, table, "[screen.blend]");
    blend.left = t.number("left").value_or(blend.left);
    blend.right = t.number("right").value_or(blend.right);
    blend.top = t.number("top").value_or(blend.top);
    blend.bottom = t.number("bottom").value_or(blend.bottom);
    blend.gamma = t.number("gamma").value_or(blend.gamma);
    t.refuse_unknown();
}

std::array<std::array<double, 3>, 3> matrix_of(const std::vector<std::vector<double>>& rows) {
    std::array<std::array<double, 3>, 3> h{};
    for (std::size_t i = 0; i < 3; ++i) std::ranges::copy(rows[i], h[i].begin());
    return h;
}

std::optional<DisplayStereo> read_direct(TableReader& t) {
    const auto word = t.text("direct");
    if (!word) return std::nullopt;
    std::string words;
    for (const DisplayStereo stereo : display_stereos()) {
        if (*word == name_of(stereo)) return stereo;
        words += (words.empty() ? "" : ", ") + std::string(name_of(stereo));
    }
    t.refuse("direct", "is " + *word, "write one of: " + words + "; or leave it out for a monitor of the desktop");
    return std::nullopt;
}

WallScreen read_screen(TableReading& reading, const toml::table* table, std::size_t index, double unit_m) {
    TableReader t(reading, table, "[[screen]]");
    WallScreen s;
    s.name = t.text("name").value_or("screen " + std::to_string(index));
    const std::string corners = "give lower_left, lower_right and upper_left, as the viewer sees them";
    for (const auto& [key, corner] : {std::pair{"lower_left", &s.lower_left_tracker},
                                      {"lower_right", &s.lower_right_tracker},
                                      {"upper_left", &s.upper_left_tracker}}) {
        t.require(key, corners);
        *corner = unit_m * t.vector(key).value_or(Vec3(0.0));
    }
    if (const auto pixels = t.numbers("pixels", 2)) {
        for (std::size_t i = 0; i < 2; ++i) {
            const double p = (*pixels)[i];
            if (p != std::floor(p) || std::abs(p) > 1e6)
                t.refuse("pixels", "are not whole numbers", "write [1920, 1080], say");
            s.pixels[i] = static_cast<int>(std::clamp(p, -1e6, 1e6));
        }
    }
    s.output = t.text_or_index("output").value_or(std::to_string(index));
    s.direct = read_direct(t);
    s.mode = t.text("mode").value_or(s.mode);
    s.swap_eyes = t.flag("swap_eyes").value_or(s.swap_eyes);
    if (const auto rows = t.rows("homography", 3)) s.homography = matrix_of(*rows);
    read_blend(reading, t.table("blend"), s.blend);
    t.refuse_unknown();
    return s;
}

Pose read_pose(TableReading& reading, const toml::table* table, const char* name, const Pose& otherwise,
               double unit_m) {
    TableReader t(reading, table, name);
    Pose pose = otherwise;
    if (const auto p = t.vector("position")) pose.position_m = unit_m * *p;
    if (const auto q = t.quaternion("orientation")) pose.orientation = *q;
    t.refuse_unknown();
    return pose;
}

void read_viewer(TableReading& reading, const toml::table* table, WallSetup& setup) {
    const double unit_m = metres_in(setup.unit);
    TableReader t(reading, table, "[viewer]");
    const auto left = t.vector("left_eye"), right = t.vector("right_eye"), middle = t.vector("middle_of_eyes");
    const auto apart_m = t.number("interpupillary_m");
    if ((left || right) && (apart_m || middle)) {
        t.refuse(left ? "left_eye" : "right_eye", "stands beside interpupillary_m or middle_of_eyes",
                 "give left_eye and right_eye, or the other two");
    }
    if (left) t.require("right_eye", "give both eyes, in the head sensor's frame");
    if (right) t.require("left_eye", "give both eyes, in the head sensor's frame");
    if (left && right) {
        setup.eyes = {unit_m * *left, unit_m * *right};
    } else {
        setup.eyes = eyes_about(unit_m * middle.value_or(Vec3(0.0)), apart_m.value_or(0.063));
    }
    setup.fallback_head_tracker =
        read_pose(reading, t.table("fallback_head"), "[viewer.fallback_head]", setup.fallback_head_tracker, unit_m);
    t.refuse_unknown();
}

void read_comfort(TableReading& reading, const toml::table* table, ParallaxBudget& budget) {
    TableReader t(reading, table, "[comfort]");
    budget.crossed_deg = t.number("crossed_deg").value_or(budget.crossed_deg);
    budget.uncrossed_deg = t.number("uncrossed_deg").value_or(budget.uncrossed_deg);
    t.refuse_unknown();
}

void read_display(TableReading& reading, const toml::table* table, DisplayTiming& timing) {
    TableReader t(reading, table, "[display]");
    timing.refresh_Hz = t.number("refresh_Hz").value_or(timing.refresh_Hz);
    if (const auto order = t.text("eye_order")) {
        bool known = false;
        for (const EyeOrder o : {EyeOrder::simultaneous, EyeOrder::left_first, EyeOrder::right_first}) {
            if (*order == name_of(o)) timing.eye_order = o, known = true;
        }
        if (!known) t.refuse("eye_order", "is " + *order, "write simultaneous, left-first or right-first");
    }
    t.refuse_unknown();
}

WallSetup read_setup(TableReading& reading, const toml::table& root) {
    TableReader t(reading, &root, "the file");
    WallSetup setup;
    setup.name = t.text("name").value_or("");
    t.require("units", "write units = \"m\" (or mm, cm, in, ft): of every length whose name carries no unit");
    if (const auto units = t.text("units")) {
        const auto unit = length_unit(*units);
        if (!unit) t.refuse("units", "is " + *units, "write m, mm, cm, in or ft");
        setup.unit = unit.value_or(LengthUnit::m);
    }
    const double unit_m = metres_in(setup.unit);
    setup.world_from_tracker =
        read_pose(reading, t.table("world_from_tracker"), "[world_from_tracker]", setup.world_from_tracker, unit_m);
    if (const toml::table* table = t.table("tracker")) {
        std::ostringstream out;
        out << "[tracker]\n";
        for (const auto& [key, value] : *table) {
            out << toml::value<std::string>(std::string(key)) << " = ";
            write_on_a_line(out, value);
            out << "\n";
        }
        setup.tracker_toml = out.str();
    }
    t.require("screen", "add a [[screen]]");
    for (const toml::table* table : t.tables("screen")) {
        setup.screens.push_back(read_screen(reading, table, setup.screens.size(), unit_m));
    }
    read_viewer(reading, t.table("viewer"), setup);
    read_comfort(reading, t.table("comfort"), setup.budget);
    read_display(reading, t.table("display"), setup.timing);
    t.refuse_unknown();
    return setup;
}

}  // namespace

Result<WallSetup> parse_wall(std::string_view text, const std::string& name) {
    BURIN_TRY(root, parse_toml(text, name));
    TableReading reading{name};
    WallSetup setup = read_setup(reading, root);
    if (!reading.errors.empty()) return std::unexpected(reading.errors.front());
    return setup;
}

Result<WallSetup> read_wall(const std::filesystem::path& path) {
    BURIN_TRY(text, read_text_file(path, kMostBytes));
    return parse_wall(text, path.string());
}

}  // namespace burin::wall
