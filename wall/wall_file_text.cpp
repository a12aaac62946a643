// SPDX-License-Identifier: MIT
// Writes a wall file (wall_file.hpp).
#include <array>
#include <cstdio>
#include <sstream>

#include "base/toml_table.hpp"
#include "wall/wall_file.hpp"

namespace burin::wall {
namespace {

// Formats with twelve digits: a length read as 10 ft is written as 10 and not as 10.000000000000002.
std::string number(double value) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.12g", std::abs(value) < 1e-13 ? 0.0 : value);
    return text.data();
}

// Formats with all digits, for quaternions and matrices.
std::string exact(double value) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.17g", value);
    return text.data();
}

std::string quoted(const std::string& text) {
    std::ostringstream out;
    out << toml::value<std::string>(text);
    return out.str();
}

class Writer {
public:
    explicit Writer(const WallSetup& setup) : setup_(setup), unit_m_(metres_in(setup.unit)) {}

    std::string text() {
        line(
            "# A wall of Burin (docs/formats.md). Lengths whose name carries no unit are in `units`; corners, the "
            "fallback");
        line("# head and the tracker's origin are what the tracker reports, eyes are in the head sensor's own frame.");
        line("name = " + quoted(setup_.name));
        line("units = " + quoted(name_of(setup_.unit)));
        heading("world_from_tracker");
        pose(setup_.world_from_tracker);
        if (!setup_.tracker_toml.empty()) line("\n" + setup_.tracker_toml);
        for (const WallScreen& s : setup_.screens) screen(s);
        viewer();
        heading("comfort");
        line("crossed_deg = " + number(setup_.budget.crossed_deg));
        line("uncrossed_deg = " + number(setup_.budget.uncrossed_deg));
        heading("display");
        line("refresh_Hz = " + number(setup_.timing.refresh_Hz));
        line("eye_order = " + quoted(name_of(setup_.timing.eye_order)));
        return text_;
    }

private:
    void line(const std::string& text) { text_ += text + "\n"; }
    void heading(const std::string& name) { line("\n[" + name + "]"); }
    void length(const char* key, const Vec3& v) {
        line(std::string(key) + " = [" + number(v.x / unit_m_) + ", " + number(v.y / unit_m_) + ", " +
             number(v.z / unit_m_) + "]");
    }
    void pose(const Pose& p) {
        length("position", p.position_m);
        const Quat& q = p.orientation;
        line("orientation = [" + exact(q.x) + ", " + exact(q.y) + ", " + exact(q.z) + ", " + exact(q.w) + "]");
    }
    void screen(const WallScreen& s) {
        line("\n[[screen]]");
        line("name = " + quoted(s.name));
        length("lower_left", s.lower_left_tracker);
        length("lower_right", s.lower_right_tracker);
        length("upper_left", s.upper_left_tracker);
        line("pixels = [" + std::to_string(s.pixels[0]) + ", " + std::to_string(s.pixels[1]) + "]");
        line("output = " + quoted(s.output));
        if (s.direct) line("direct = " + quoted(name_of(*s.direct)));
        line("mode = " + quoted(s.mode));
        line(std::string("swap_eyes = ") + (s.swap_eyes ? "true" : "false"));
        if (s.homography) {
            std::string rows;
            for (const auto& row : *s.homography) {
                rows +=
                    (rows.empty() ? "[" : ", [") + exact(row[0]) + ", " + exact(row[1]) + ", " + exact(row[2]) + "]";
            }
            line("homography = [" + rows + "]");
        }
        const EdgeBlend& b = s.blend;
        line("blend = { left = " + number(b.left) + ", right = " + number(b.right) + ", top = " + number(b.top) +
             ", bottom = " + number(b.bottom) + ", gamma = " + number(b.gamma) + " }");
    }
    void viewer() {
        heading("viewer");
        length("left_eye", setup_.eyes.left_sensor);
        length("right_eye", setup_.eyes.right_sensor);
        heading("viewer.fallback_head");
        pose(setup_.fallback_head_tracker);
    }

    const WallSetup& setup_;
    double unit_m_;
    std::string text_;
};

}  // namespace

std::string wall_text(const WallSetup& setup) { return Writer(setup).text(); }

}  // namespace burin::wall
