// SPDX-License-Identifier: MIT
#include "activities/wand/felt_wand.hpp"
#include "base/plot/figures.hpp"
#include "base/text.hpp"
#include "scene/world_file.hpp"

namespace burin::activities {
namespace {

constexpr double kThousand = 1e3;

void add_vector(std::string& csv, const Vec3& v) { csv += formatted(",%.9g,%.9g,%.9g", v.x, v.y, v.z); }

// A name as one cell of a table: quoted where it would break the line.
std::string cell(const std::string& name) {
    if (name.find_first_of(",\"\n\r") == std::string::npos) return name;
    std::string quoted = "\"";
    for (const char c : name) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

// A column's name has no blanks or commas.
std::string column(const std::string& name) {
    std::string plain;
    for (const char c : name) plain += (c == ' ' || c == ',' || c == '"') ? '_' : c;
    return plain;
}

plot::TimePlot empty_plot(const std::string& title, const std::string& label, const WandExploredWorld& explored) {
    plot::TimePlot made{title, label, {}, {}};
    for (const WandFelt& felt : explored.trace) made.times_s.push_back(felt.time_s);
    return made;
}

}  // namespace

std::string wand_table(const WandExploredWorld& explored, const scene::World& world,
                       const std::vector<devices::WandPoint>& points) {
    std::string csv = "time_s,x_m,y_m,z_m,axis_x,axis_y,axis_z,angle_rad";
    for (const devices::WandPoint& point : points) {
        const std::string name = column(point.name);
        for (const char* of : {"", "_proxy"})
            for (const char* axis : {"_x_m", "_y_m", "_z_m"}) csv += "," + name + of + axis;
        csv += "," + name + "_touches";
        for (const char* of :
             {"_force_x_N", "_force_y_N", "_force_z_N", "_deviation_x_m", "_deviation_y_m", "_deviation_z_m"})
            csv += "," + name + of;
    }
    for (const char* of : {"force", "torque", "given_force", "given_torque"})
        for (const char* axis : {"_x", "_y", "_z"}) csv += std::string(",") + of + axis;
    csv += "\n";
    for (const WandFelt& felt : explored.trace) {
        csv += formatted("%.3f", felt.time_s);
        add_vector(csv, felt.scene_from_tool.position_m);
        const AxisAngle turn = axis_angle(felt.scene_from_tool.orientation);
        add_vector(csv, turn.axis);
        csv += formatted(",%.9g", turn.angle_rad);
        for (const PointFelt& point : felt.points) {
            add_vector(csv, point.place_m);
            add_vector(csv, point.proxy_m);
            csv += "," + (point.object == 0 ? std::string("-") : cell(name_in(world, point.object)));
            add_vector(csv, point.force_N);
            add_vector(csv, point.place_m - point.proxy_m);
        }
        for (const Vec3* sum : {&felt.force_N, &felt.torque_Nm, &felt.given_force_N, &felt.given_torque_Nm})
            add_vector(csv, *sum);
        csv += "\n";
    }
    return csv;
}

std::string wand_figure(const WandExploredWorld& explored, const std::vector<devices::WandPoint>& points) {
    plot::TimePlot depth = empty_plot("Each point behind its proxy", "mm", explored);
    plot::TimePlot alone = empty_plot("Force at each point", "N", explored);
    for (std::size_t i = 0; i < points.size(); ++i) {
        depth.series.push_back({points[i].name, {}});
        alone.series.push_back({points[i].name, {}});
        for (const WandFelt& felt : explored.trace) {
            const bool known = i < felt.points.size();
            const Vec3 deviation = known ? felt.points[i].place_m - felt.points[i].proxy_m : Vec3(0.0);
            depth.series.back().values.push_back(kThousand * glm::length(deviation));
            alone.series.back().values.push_back(known ? glm::length(felt.points[i].force_N) : 0.0);
        }
    }
    plot::TimePlot force = empty_plot("Force given", "N", explored);
    plot::TimePlot torque = empty_plot("Torque given", "N mm", explored);
    for (int axis = 0; axis < 3; ++axis) {
        force.series.push_back({std::string(1, "xyz"[axis]), {}});
        torque.series.push_back({std::string("about ") + "xyz" [axis], {}});
        for (const WandFelt& felt : explored.trace) {
            force.series.back().values.push_back(felt.given_force_N[axis]);
            torque.series.back().values.push_back(kThousand * felt.given_torque_Nm[axis]);
        }
    }
    return plot::time_figure("What the wand has felt", {depth, alone, force, torque}, 1);
}

}  // namespace burin::activities
