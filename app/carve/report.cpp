// SPDX-License-Identifier: MIT
#include "app/carve/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/statistics.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "sculpt/sculpture.hpp"
#include "session/felt/felt_figures.hpp"
#include "toolbox/feel_options.hpp"

namespace burin::app {

Json describe_traffic(const compute::DeviceTraffic& traffic) {
    return {{"submissions", traffic.submissions},
            {"blocking_waits", traffic.blocking_waits},
            {"bytes_to_device", traffic.bytes_to_device},
            {"bytes_to_host", traffic.bytes_to_host},
            {"bytes_written_to_host", traffic.bytes_written_to_host},
            {"most_memory_bytes", traffic.most_memory_bytes}};
}

Json describe_carving(const sculpt::Sculpture& carving) {
    const sculpt::SculptFigures& f = carving.figures();
    const compute::Solid& solid = carving.engine().solid();
    const compute::Lattice& lattice = solid.lattice;
    const double volume_m3 = carving.surface().volume_m3();
    return {{"lattice_cells", lattice.cells},
            {"lattice_spacing_m", lattice.spacing_m},
            {"rays_held", solid.rays_held()},
            {"bytes_per_ray", static_cast<double>(solid.bytes()) / static_cast<double>(solid.rays_held())},
            {"updates", f.updates},
            {"sweeps", f.sweeps},
            {"rays_touched", f.rays_touched},
            {"rays_changed", f.rays_changed},
            {"tiles_remeshed", f.tiles_remeshed},
            {"triangles_remeshed", f.triangles_remeshed},
            {"triangles_held", carving.surface().triangles()},
            {"disagreeing_edges", carving.surface().disagreeing_edges()},
            {"volume_before_m3", carving.initial_volume_m3()},
            {"volume_after_m3", volume_m3},
            {"volume_removed_m3", carving.initial_volume_m3() - volume_m3}};
}

Json describe_mesh(const geometry::TriangleMesh& numbers, LengthUnit unit) {
    const geometry::MeshHealth health = geometry::examine(numbers);
    const auto to_power = [unit](double value, int power) {
        for (; power > 0; --power) value = to_metres(value, unit);
        return value;
    };
    return {{"triangles", health.triangles},
            {"vertices", health.vertices},
            {"open_edges", health.boundary_edges},
            {"nonmanifold_edges", health.nonmanifold_edges},
            {"nonmanifold_vertices", health.nonmanifold_vertices},
            {"misoriented_edges", health.misoriented_edges},
            {"shells", health.shells},
            {"volume_m3", to_power(health.signed_volume_m3, 3)},
            {"area_m2", to_power(health.area_m2, 2)}};
}

namespace {

Json occurrences(const std::map<std::string, session::Occurrence>& of) {
    Json list = Json::array();
    for (const auto& [what, o] : of)
        list.push_back({{"what", what}, {"ticks", o.ticks}, {"times", o.times}, {"first_s", o.first_s}});
    return list;
}

}  // namespace

Json describe_feel(const session::FeltFigures& felt, const toolbox::Feel& feel) {
    return {{"device", "simulated Omni, held by a simulated hand"},
            {"material", toolbox::describe_feel_settings(feel)},
            {"object_from_device_scale", felt.object_from_device.scale},
            {"duration_s", felt.duration_s},
            {"ticks", felt.ticks},
            {"ticks_in_contact", felt.ticks_in_contact},
            {"ticks_cutting", felt.ticks_cutting},
            {"stroke_samples_dropped", felt.samples_dropped},
            {"tick_records_lost", felt.records_lost},
            {"surfaces_published", felt.surfaces_published},
            {"force_max_N", felt.force_max_N},
            {"force_mean_in_contact_N", felt.force_mean_in_contact_N},
            {"force_mean_cutting_N", felt.force_mean_cutting_N},
            {"penetration_max_m", felt.penetration_max_m},
            {"silent", occurrences(felt.silent)},
            {"stiffness_limited", occurrences(felt.limited)},
            {"degraded", occurrences(felt.degraded)},
            {"notices", felt.notices}};
}

Json describe_timing(const sculpt::Sculpture& carving, const session::FeltFigures* felt) {
    const std::vector<double>& update_ms = carving.figures().update_ms;
    Json timing = {{"first_mesh_ms", carving.first_mesh_ms()},
                   {"update_ms_median", quantile(update_ms, 0.5)},
                   {"update_ms_p99", quantile(update_ms, 0.99)}};
    if (felt != nullptr && !felt->tick_ns.empty()) {
        std::vector<double> tick_us;
        tick_us.reserve(felt->tick_ns.size());
        for (const std::uint32_t ns : felt->tick_ns) tick_us.push_back(ns * 1e-3);
        timing["tick_us_median"] = quantile(tick_us, 0.5);
        timing["tick_us_p999"] = quantile(tick_us, 0.999);
    }
    if (felt != nullptr && felt->loop.known) {
        const session::LoopTimes& l = felt->loop;
        timing["skipped_deadlines"] = l.skipped_deadlines;
        timing["wake_up_late_us"] = {
            {"median", l.late_us_median}, {"p99", l.late_us_p99}, {"p999", l.late_us_p999}, {"max", l.late_us_max}};
        timing["tick_us"] = {
            {"median", l.tick_us_median}, {"p99", l.tick_us_p99}, {"p999", l.tick_us_p999}, {"max", l.tick_us_max}};
    }
    return timing;
}

void print_table(const Json& report) {
    const auto number = [&](const char* pointer) {
        const Json* at = find_value(report, pointer);
        return at != nullptr && at->is_number() ? at->get<double>() : 0.0;
    };
    const double updates = std::max(1.0, number("/carving/updates"));
    const auto row = [](const char* name, const std::string& value) {
        std::printf("  %-34s %s\n", name, value.c_str());
    };
    const auto text = [](const char* format, auto... values) {
        std::array<char, 160> line{};
        std::snprintf(line.data(), line.size(), format, values...);
        return std::string(line.data());
    };
    row("engine",
        report["engine"]["name"].get<std::string>() + " (" + report["engine"]["device"].get<std::string>() + ")");
    row("updates", text("%.0f", number("/carving/updates")));
    row("rays touched an update, of held",
        text("%.0f of %.0f", number("/carving/rays_touched") / updates, number("/carving/rays_held")));
    row("triangles re-meshed an update",
        text("%.0f of %.0f", number("/carving/triangles_remeshed") / updates, number("/carving/triangles_held")));
    if (number("/carving/updates") > 0.0) {
        row("an update takes (median, p99)",
            text("%.2f ms, %.2f ms", number("/timing/update_ms_median"), number("/timing/update_ms_p99")));
    }
    const double removed_cm3 = 1e6 * number("/carving/volume_removed_m3");
    row(removed_cm3 < 0.0 ? "volume added" : "volume removed", text("%.2f cm3", std::abs(removed_cm3)));
    if (report["timing"].contains("tick_us_median")) {  // in real time the ticks are not timed one by one
        row("a haptic tick takes (median, p99.9)",
            text("%.1f us, %.1f us", number("/timing/tick_us_median"), number("/timing/tick_us_p999")));
    }
    if (report["timing"].contains("wake_up_late_us")) {
        row("a tick begins late by (median, max)",
            text("%.0f us, %.0f us", number("/timing/wake_up_late_us/median"), number("/timing/wake_up_late_us/max")));
        row("a haptic tick takes (median, p99.9)",
            text("%.1f us, %.1f us", number("/timing/tick_us/median"), number("/timing/tick_us/p999")));
    }
    if (report.contains("feel")) {
        row("largest, mean force in contact",
            text("%.2f N, %.2f N", number("/feel/force_max_N"), number("/feel/force_mean_in_contact_N")));
        if (number("/feel/ticks_cutting") > 0.0) {
            row("mean force while cutting", text("%.2f N", number("/feel/force_mean_cutting_N")));
        }
        for (const Json& silence : report["feel"]["silent"]) {
            row(silence["what"].get<std::string>().c_str(), text("%.0f ticks", silence["ticks"].get<double>()));
        }
    }
    row("mesh",
        text("%.0f triangles; %.0f open, %.0f non-manifold, %.0f wrongly oriented edges", number("/mesh/triangles"),
             number("/mesh/open_edges"), number("/mesh/nonmanifold_edges"), number("/mesh/misoriented_edges")));
}

}  // namespace burin::app
