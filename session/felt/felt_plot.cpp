// SPDX-License-Identifier: MIT
#include "session/felt/felt_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>

#include "base/plot/figures.hpp"

namespace burin::session {
namespace {

using Trace = std::vector<TracePoint>;
using Reading = std::function<double(const TracePoint&)>;

constexpr double kMillimetres = 1e3;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

plot::TimeSeries series(const std::string& name, const Trace& trace, const Reading& reading) {
    plot::TimeSeries s{name, {}};
    s.values.reserve(trace.size());
    for (const TracePoint& p : trace) s.values.push_back(reading(p));
    return s;
}

plot::TimePlot plot(const std::string& title, const std::string& y_label, const Trace& trace) {
    plot::TimePlot made{title, y_label, {}, {}};
    made.times_s.reserve(trace.size());
    for (const TracePoint& p : trace) made.times_s.push_back(p.time_s);
    return made;
}

bool in_contact(const TracePoint& p) { return (p.flags & haptics::kTickInContact) != 0; }
bool cutting(const TracePoint& p) { return (p.flags & haptics::kTickCutting) != 0; }

plot::TimePlot positions(const Trace& trace) {
    plot::TimePlot made = plot("Tool on the surface (proxy), object frame", "mm", trace);
    for (int axis = 0; axis < 3; ++axis) {
        made.series.push_back(series(std::string(1, "xyz"[axis]), trace,
                                     [axis](const TracePoint& p) { return kMillimetres * p.proxy_object_m[axis]; }));
    }
    return made;
}

plot::TimePlot depths(const Trace& trace) {
    plot::TimePlot made = plot("Below the proxy", "mm", trace);
    made.series.push_back(series("hand (HIP)", trace, [](const TracePoint& p) {
        return in_contact(p) ? kMillimetres * p.penetration_m : kNothing;
    }));
    made.series.push_back(series("tool, where it has cut to", trace, [](const TracePoint& p) {
        return cutting(p) ? kMillimetres * glm::length(p.cut_object_m - p.proxy_object_m) : kNothing;
    }));
    return made;
}

plot::TimePlot forces(const Trace& trace) {
    plot::TimePlot made = plot("Force on the hand", "N", trace);
    made.series.push_back(series("force", trace, [](const TracePoint& p) { return glm::length(p.force_device_N); }));
    return made;
}

// Of a tool that is no ball.
plot::TimePlot torques(const std::string& title, const Trace& trace) {
    plot::TimePlot made = plot(title, "N mm", trace);
    for (int axis = 0; axis < 3; ++axis) {
        made.series.push_back(series(std::string("about ") + "xyz"[axis], trace,
                                     [axis](const TracePoint& p) { return kMillimetres * p.torque_device_Nm[axis]; }));
    }
    return made;
}
bool has_torque(const Trace& trace) {
    return std::ranges::any_of(trace, [](const TracePoint& p) { return p.torque_device_Nm != Vec3(0.0); });
}

// Returns the unit mean normal of the contacts, perpendicular to the way from the first contact to the last.
Vec3 mean_normal(const Trace& trace) {
    Vec3 sum(0.0);
    const TracePoint *first = nullptr, *last = nullptr;
    for (const TracePoint& p : trace) {
        sum += p.normal_object;
        if (!in_contact(p)) continue;
        if (first == nullptr) first = &p;
        last = &p;
    }
    if (first != nullptr) {
        const Vec3 way = last->proxy_object_m - first->proxy_object_m;
        const double l2 = glm::dot(way, way);
        if (l2 > 0.0) sum -= way * (glm::dot(sum, way) / l2);
    }
    const double l = glm::length(sum);
    return l > 0.0 ? sum / l : Vec3(0.0, 1.0, 0.0);
}

plot::TimePlot heights(const Trace& trace, const Vec3& up) {
    plot::TimePlot made = plot("Close up: height across the way of the tool", "mm", trace);
    Vec3 origin(0.0);
    for (const TracePoint& p : trace) {
        if (!in_contact(p)) continue;
        origin = p.proxy_object_m;
        break;
    }
    const auto height = [&](const std::string& name, Vec3 TracePoint::* what) {
        made.series.push_back(series(
            name, trace, [&, what](const TracePoint& p) { return kMillimetres * glm::dot(p.*what - origin, up); }));
    };
    height("hand (HIP)", &TracePoint::hip_object_m);
    height("proxy", &TracePoint::proxy_object_m);
    height("tool", &TracePoint::cut_object_m);
    return made;
}

plot::TimePlot parts_of_force(const Trace& trace, const Similarity& object_from_device, const Vec3& up) {
    plot::TimePlot made = plot("Close up: force on the hand", "N", trace);
    const auto force = [&](const TracePoint& p) { return object_from_device.orientation * p.force_device_N; };
    made.series.push_back(
        series("along the normal", trace, [&](const TracePoint& p) { return glm::dot(force(p), up); }));
    made.series.push_back(series(
        "across", trace, [&](const TracePoint& p) { return glm::length(force(p) - glm::dot(force(p), up) * up); }));
    return made;
}

std::string beside(const std::string& report, const char* ending) {
    const std::filesystem::path path(report);
    return (path.parent_path() / (path.stem().string() + ending)).string();
}

}  // namespace

std::string felt_figure(const FeltFigures& felt) {
    const Vec3 up = mean_normal(felt.closeup);
    plot::TimePlot near = depths(felt.closeup);
    near.title = "Close up: below the proxy";
    std::vector<plot::TimePlot> plots{positions(felt.trace), heights(felt.closeup, up),
                                      depths(felt.trace),    near,
                                      forces(felt.trace),    parts_of_force(felt.closeup, felt.object_from_device, up)};
    if (has_torque(felt.trace)) {
        plots.push_back(torques("Torque on the tool, device axes", felt.trace));
        plots.push_back(torques("Close up: torque on the tool", felt.closeup));
    }
    return plot::time_figure("Position, proxy and force over time", plots, 2);
}

std::string felt_table(const FeltFigures& felt) {
    std::string text =
        "time_s,hip_x_m,hip_y_m,hip_z_m,proxy_x_m,proxy_y_m,proxy_z_m,cut_x_m,cut_y_m,cut_z_m,"
        "force_x_N,force_y_N,force_z_N,torque_x_Nm,torque_y_Nm,torque_z_Nm,penetration_m,in_contact,cutting\n";
    std::array<char, 480> line{};
    for (const TracePoint& p : felt.trace) {
        const Vec3 &h = p.hip_object_m, &x = p.proxy_object_m, &c = p.cut_object_m, &f = p.force_device_N,
                   &t = p.torque_device_Nm;
        std::snprintf(line.data(), line.size(),
                      "%.4f,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%d,%d\n",
                      p.time_s, h.x, h.y, h.z, x.x, x.y, x.z, c.x, c.y, c.z, f.x, f.y, f.z, t.x, t.y, t.z,
                      p.penetration_m, in_contact(p) ? 1 : 0, cutting(p) ? 1 : 0);
        text += line.data();
    }
    return text;
}

std::string felt_figure_path(const std::string& report) { return beside(report, "-felt.svg"); }
std::string felt_table_path(const std::string& report) { return beside(report, "-felt.csv"); }
std::string felt_depth_path(const std::string& report) { return beside(report, "-depth.svg"); }

}  // namespace burin::session
