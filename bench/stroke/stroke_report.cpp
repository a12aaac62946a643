// SPDX-License-Identifier: MIT
#include "bench/stroke_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "bench/timing.hpp"
#include "compute/self_intersections.hpp"

namespace burin::bench {
namespace {

// CGAL needs about 2 KB a triangle and half an hour for a mesh of 512 cells a side.
constexpr std::size_t kMostTrianglesForCgal = 1'200'000;

Json or_null(const std::optional<std::uint64_t>& count) { return count ? Json(*count) : Json(nullptr); }

// cell_m: 0 where there are no cells.
void add_errors(Json& report, const SurfaceErrors& e, double cell_m) {
    const auto add = [&](const std::string& name, const Spread& spread, bool measured) {
        const bool in_cells = measured && cell_m > 0.0;
        report[name + "_rms_m"] = measured ? Json(spread.rms) : Json(nullptr);
        report[name + "_rms_h"] = in_cells ? Json(spread.rms / cell_m) : Json(nullptr);
        report[name + "_max_h"] = in_cells ? Json(spread.max / cell_m) : Json(nullptr);
    };
    report["triangles"] = e.triangles;
    report["volume_error_over_removed"] = e.volume_over_removed;
    add("surface", e.surface_m, true);
    add("cut", e.cut_m, true);
    add("edge", e.edge_m, cell_m > 0.0);
    add("corner", e.corner_m, cell_m > 0.0);
    add("rim", e.rim_m, cell_m > 0.0);
    add("crease", e.crease_m, cell_m > 0.0 && e.has_creases);
    report["bad_edges"] = e.bad_edges;
}

void add_update_times(Json& report, const std::vector<double>& update_ms, const std::vector<double>& cpu_ms) {
    const Ageing age = ageing(update_ms);
    report["updates"] = update_ms.size();
    report["update_ms_median"] = median(update_ms);
    report["update_ms_p99"] = quantile(update_ms, 0.99);
    report["update_ms_min"] = quantile(update_ms, 0.0);
    report["p99_over_median"] = quantile(update_ms, 0.99) / median(update_ms);
    report["update_cpu_ms_median"] = median(cpu_ms);
    report["first_100_ms_median"] = age.first_100_ms;
    report["last_100_ms_median"] = age.last_100_ms;
    report["last_over_first"] = age.last_100_ms / age.first_100_ms;
}

std::string text_of(const Json& value) {
    if (value.is_null()) return "-";
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_number_float()) return value.dump();
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.5g", value.get<double>());
    return text.data();
}

}  // namespace

SelfIntersections count_self_intersections(const TriangleMesh& mesh, unsigned threads) {
    SelfIntersections crossings;
    WorkerPool pool(threads);
    crossings.pairs = self_intersections(mesh, pool).size();
    if (has_peers() && mesh.triangles.size() <= kMostTrianglesForCgal) {
        if (const auto counted = count_self_intersections_with_cgal(mesh)) crossings.pairs_by_cgal = *counted;
    }
    return crossings;
}

Ageing ageing(const std::vector<double>& update_ms) {
    const auto hundred = static_cast<std::ptrdiff_t>(std::min<std::size_t>(100, update_ms.size()));
    return {median({update_ms.begin(), update_ms.begin() + hundred}),
            median({update_ms.end() - hundred, update_ms.end()})};
}

Json describe(const CarveScene& scene, const StrokeRun& run, const SurfaceErrors& errors,
              const SelfIntersections& crossings) {
    Json report = {{"scene", scene.name},    {"engine", run.engine},
                   {"device", run.device},   {"software_device", run.software_device},
                   {"threads", run.threads}, {"resolution", run.resolution}};
    add_update_times(report, run.update_ms, run.cpu_ms);
    report["carve_ms_median"] = median(run.carve_ms);
    report["mesh_ms_median"] = median(run.mesh_ms);
    report["publish_ms_median"] = median(run.publish_ms);
    report["first_mesh_ms"] = run.first_mesh_ms;
    const double updates = static_cast<double>(std::max<std::size_t>(1, run.update_ms.size()));
    report["boolean_rays_per_s"] = static_cast<double>(run.rays_touched) / (1e-3 * sum(run.carve_ms));
    report["rays_touched"] = run.rays_touched;
    report["rays_changed"] = run.rays_changed;
    report["rays_held"] = run.rays_held;
    report["bytes"] = run.bytes;
    report["bytes_per_ray"] = static_cast<double>(run.bytes) / static_cast<double>(run.rays_held);
    report["cells_per_update"] = static_cast<double>(run.cells_remeshed) / updates;
    report["triangles_per_update"] = static_cast<double>(run.triangles_remeshed) / updates;
    report["triangles_published_per_update"] = static_cast<double>(run.triangles_published) / updates;
    add_errors(report, errors, run.cell_m);
    report["self_intersections"] = or_null(crossings.pairs);
    report["self_intersections_mended"] = run.self_intersections_mended;
    report["self_intersections_by_cgal"] = or_null(crossings.pairs_by_cgal);
    report["disagreeing_edges"] = run.disagreeing_edges;
    report["rays_checked"] = run.intervals.rays;
    report["lost_intervals"] = run.intervals.lost;
    report["extra_intervals"] = run.intervals.extra;
    return report;
}

Json describe(const CarveScene& scene, const PeerRun& run, const SurfaceErrors& errors, double cell_m) {
    Json report = {{"scene", scene.name},
                   {"peer", run.peer},
                   {"method", run.method},
                   {"detail", run.detail},
                   {"threads", run.threads}};
    report["resolution"] = cell_m > 0.0 ? Json(std::lround(1.0 / cell_m)) : Json(nullptr);
    add_update_times(report, run.update_ms, run.cpu_ms);
    report["tool_ms_median"] = median(run.tool_ms);
    report["carve_ms_median"] = median(run.boolean_ms);
    report["mesh_ms_median"] = median(run.mesh_ms);
    report["whole_mesh_ms"] = run.whole_mesh_ms;
    report["triangles_per_update"] =
        sum(run.triangles_remeshed) / static_cast<double>(std::max<std::size_t>(1, run.triangles_remeshed.size()));
    report["bytes"] = run.bytes;
    add_errors(report, errors, cell_m);
    return report;
}

void add_openvdb(Json& report, const Json& peer) {
    const std::string prefix = peer["method"] == "csgDifference" ? "openvdb_" : "openvdb_brush_";
    const auto ratio = [&](const char* key) { return peer[key].get<double>() / report[key].get<double>(); };
    const double wall_ratio = ratio("update_ms_median"), cpu_ratio = ratio("update_cpu_ms_median");
    for (const auto& [key, value] : peer.items()) {
        if (key != "scene") report[prefix + key] = value;
    }
    report[prefix + "ratio"] = wall_ratio;
    report[prefix + "cpu_ratio"] = cpu_ratio;
}

std::string table(const Json& report) {
    std::size_t width = 0;
    for (const auto& [key, value] : report.items()) width = std::max(width, key.size());
    std::string text;
    for (const auto& [key, value] : report.items()) {
        text += "  " + key + std::string(width + 2 - key.size(), ' ') + text_of(value) + '\n';
    }
    return text;
}

}  // namespace burin::bench
