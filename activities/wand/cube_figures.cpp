// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <functional>

#include "activities/wand/pressed_cube.hpp"
#include "base/plot/figures.hpp"
#include "base/text.hpp"

namespace burin::activities {
namespace {

using CubeReading = std::function<double(const CubeTick&)>;

constexpr std::size_t kEveryTick = 4;  // of a figure; the table has them all

plot::TimePlot cube_plot(const std::string& title, const std::string& label, const std::vector<CubeTick>& ticks) {
    plot::TimePlot made{title, label, {}, {}};
    for (std::size_t i = 0; i < ticks.size(); i += kEveryTick) made.times_s.push_back(ticks[i].time_s);
    return made;
}

plot::TimeSeries cube_series(const std::string& name, const std::vector<CubeTick>& ticks, const CubeReading& reading) {
    plot::TimeSeries series{name, {}};
    for (std::size_t i = 0; i < ticks.size(); i += kEveryTick) series.values.push_back(reading(ticks[i]));
    return series;
}

// Adds a series for each component of a vector.
void add_components(plot::TimePlot& to, const std::string& prefix, const std::vector<CubeTick>& ticks, double factor,
                    const std::function<Vec3(const CubeTick&)>& vector) {
    for (int axis = 0; axis < 3; ++axis)
        to.series.push_back(cube_series(prefix + "xyz"[axis], ticks, [&vector, axis, factor](const CubeTick& t) {
            return factor * vector(t)[axis];
        }));
}

Vec3 force_of_point(const CubeTick& tick, std::size_t point) {
    return point < tick.point_forces_N.size() ? tick.point_forces_N[point] : Vec3(0.0);
}

// Names the case that a time belongs to: the last whose hold began by then, with the way to it.
std::string case_at(const PressedCube& test, bool two_points, double time_s) {
    std::string name;
    for (const CubeMeasure& m : test.measures) {
        const bool is_two = m.which == CubeCase::top || m.which == CubeCase::bottom || m.which == CubeCase::both;
        if (is_two != two_points) continue;
        if (name.empty() || time_s >= m.from_s - 2.0) name = text(m.which);
    }
    return name;
}

constexpr double kMilli = 1e3;

// The ticks around one case's hold, press and return included, for a curve of torque over force.
plot::PlotSeries torque_over_force(const PressedCube& test, CubeCase which) {
    plot::PlotSeries series{text(which), {}};
    const CubeMeasure& measure = test.measures[static_cast<std::size_t>(which)];
    for (std::size_t i = 0; i < test.two_points.size(); i += kEveryTick) {
        const CubeTick& tick = test.two_points[i];
        if (tick.time_s < measure.from_s - 1.0 || tick.time_s > measure.to_s + 0.7) continue;
        series.points.push_back({tick.force_N.z, kMilli * tick.torque_Nm.x, ""});
    }
    return series;
}

plot::PlotSeries force_over_time(const PressedCube& test, const std::string& name, std::size_t point) {
    plot::PlotSeries series{name, {}};
    for (std::size_t i = 0; i < test.two_points.size(); i += kEveryTick)
        series.points.push_back({test.two_points[i].time_s, force_of_point(test.two_points[i], point).z, ""});
    return series;
}

void add_rows(std::string& csv, const PressedCube& test, bool two_points) {
    for (const CubeTick& tick : two_points ? test.two_points : test.one_point) {
        csv += formatted("%.3f,", tick.time_s) + case_at(test, two_points, tick.time_s);
        const Quat& q = tick.scene_from_handle.orientation;
        const Vec3& p = tick.scene_from_handle.position_m;
        csv += formatted(",%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g", p.x, p.y, p.z, q.x, q.y, q.z, q.w);
        const auto add = [&](const Vec3& v) { csv += formatted(",%.9g,%.9g,%.9g", v.x, v.y, v.z); };
        add(tick.top_scene_m);
        add(tick.bottom_scene_m);
        for (std::size_t i = 0; i < 2; ++i) {
            const bool touches = i < tick.touches.size() && tick.touches[i];
            csv += touches ? ",1" : ",0";
            add(force_of_point(tick, i));
        }
        add(tick.force_N);
        add(tick.torque_Nm);
        add(tick.given_force_N);
        add(tick.given_torque_Nm);
        csv += "\n";
    }
}

}  // namespace

std::string cube_table(const PressedCube& test) {
    std::string csv =
        "# The cube test: forces in newtons, torques about the handle's middle in newton metres, in the scene's axes.\n"
        "# Point 1 is the top end, or the middle in the control case; point 2 the bottom end.\n"
        "time_s,case,x_m,y_m,z_m,qx,qy,qz,qw,top_x_m,top_y_m,top_z_m,bottom_x_m,bottom_y_m,bottom_z_m";
    for (const char* point : {"point1", "point2"})
        csv += formatted(",%s_touches,%s_fx,%s_fy,%s_fz", point, point, point, point);
    csv += ",force_x,force_y,force_z,torque_x,torque_y,torque_z";
    csv += ",given_force_x,given_force_y,given_force_z,given_torque_x,given_torque_y,given_torque_z\n";
    add_rows(csv, test, true);
    add_rows(csv, test, false);
    return csv;
}

std::string figure_forces(const PressedCube& test) {
    const std::vector<CubeTick>& ticks = test.two_points;
    plot::TimePlot top = cube_plot("Force at the top end", "N", ticks);
    add_components(top, "", ticks, 1.0, [](const CubeTick& t) { return force_of_point(t, 0); });
    plot::TimePlot bottom = cube_plot("Force at the bottom end", "N", ticks);
    add_components(bottom, "", ticks, 1.0, [](const CubeTick& t) { return force_of_point(t, 1); });
    plot::TimePlot torque = cube_plot("Torque about x", "N mm", ticks);
    torque.series.push_back(cube_series("about x", ticks, [](const CubeTick& t) { return kMilli * t.torque_Nm.x; }));
    return plot::time_figure("Figure 23: top end, bottom end, both ends at a cube", {top, bottom, torque}, 1);
}

std::string figure_torques(const PressedCube& test) {
    const std::vector<CubeTick>& ticks = test.two_points;
    plot::TimePlot contact = cube_plot("Torque of the contact", "N mm", ticks);
    add_components(contact, "about ", ticks, kMilli, [](const CubeTick& t) { return t.torque_Nm; });
    plot::TimePlot given = cube_plot("Torque given by the motors", "N mm", ticks);
    add_components(given, "about ", ticks, kMilli, [](const CubeTick& t) { return t.given_torque_Nm; });
    return plot::time_figure("Figure 24: torques about three axes", {contact, given}, 1);
}

std::string figure_sums(const PressedCube& test) {
    plot::Plot forces{"Force of each end along z", "time, s", "N", {}};
    forces.x_linear = forces.y_linear = true;
    forces.markers = false;
    forces.series = {force_over_time(test, "top end", 0), force_over_time(test, "bottom end", 1)};
    plot::Plot torque{"Torque about x against force along z", "force, N", "N mm", {}};
    torque.x_linear = torque.y_linear = true;
    torque.markers = false;
    for (const CubeCase which : {CubeCase::top, CubeCase::bottom, CubeCase::both})
        torque.series.push_back(torque_over_force(test, which));
    return plot::svg_figure("Figure 25: forces of both ends, and torque against force", {forces, torque});
}

std::string figure_control(const PressedCube& test) {
    const std::vector<CubeTick>& ticks = test.one_point;
    const double face_m = test.face_m;
    plot::TimePlot sunk = cube_plot("Place behind the cube's face; above 0 it is inside", "mm", ticks);
    sunk.series.push_back(
        cube_series("top end", ticks, [face_m](const CubeTick& t) { return kMilli * (t.top_scene_m.z - face_m); }));
    sunk.series.push_back(cube_series("middle, which touches", ticks, [face_m](const CubeTick& t) {
        return kMilli * (t.scene_from_handle.position_m.z - face_m);
    }));
    plot::TimePlot force = cube_plot("Force given", "N", ticks);
    add_components(force, "", ticks, 1.0, [](const CubeTick& t) { return t.given_force_N; });
    plot::TimePlot torque = cube_plot("Torque given", "N mm", ticks);
    add_components(torque, "about ", ticks, kMilli, [](const CubeTick& t) { return t.given_torque_Nm; });
    return plot::time_figure("Figure 15: a wand felt in its middle alone", {sunk, force, torque}, 1);
}

}  // namespace burin::activities
