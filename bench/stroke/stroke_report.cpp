// SPDX-License-Identifier: MIT
#include "bench/stroke/stroke_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <utility>

#include "base/statistics.hpp"
#include "compute/repair/self_intersections.hpp"
#include "geometry/mesh/mesh_health.hpp"

namespace burin::bench {
namespace {

// CGAL needs about 2 KB a triangle and half an hour for a mesh of 512 cells a side.
constexpr std::size_t kMostTrianglesForCgal = 1'200'000;

Json or_null(const std::optional<std::uint64_t>& count) { return count ? Json(*count) : Json(nullptr); }

// cell_m is 0 for a method without cells. is_known: whether the exact surface is; only the counts are measured without.
void add_errors(Json& report, const SurfaceErrors& e, double cell_m, bool is_known = true) {
    const auto add = [&](const std::string& name, const Spread& spread, bool measured) {
        measured = measured && is_known;
        const bool in_cells = measured && cell_m > 0.0;
        report[name + "_rms_m"] = measured ? Json(spread.rms) : Json(nullptr);
        report[name + "_rms_h"] = in_cells ? Json(spread.rms / cell_m) : Json(nullptr);
        report[name + "_max_h"] = in_cells ? Json(spread.max / cell_m) : Json(nullptr);
    };
    const bool has_edges = cell_m > 0.0 && e.of_cube;
    report["triangles"] = e.triangles;
    report["volume_error_over_removed"] = e.of_cube && is_known ? Json(e.volume_over_removed) : Json(nullptr);
    add("surface", e.surface_m, true);
    add("cut", e.cut_m, true);
    add("edge", e.edge_m, has_edges);
    add("corner", e.corner_m, has_edges);
    add("rim", e.rim_m, has_edges);
    add("crease", e.crease_m, has_edges && e.has_creases);
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

// Adds the times of the same updates with undo or light.
void add_times_with(Json& report, const std::string& what, const UpdateTimes& times) {
    const auto or_null = [&](double value) { return times.update_ms.empty() ? Json(nullptr) : Json(value); };
    const std::string prefix = "update_with_" + what;
    report[prefix + "_ms_median"] = or_null(median(times.update_ms));
    report[prefix + "_ms_p99"] = or_null(quantile(times.update_ms, 0.99));
    report[prefix + "_cpu_ms_median"] = or_null(median(times.cpu_ms));
}

// Returns the errors of a mesh whose exact surface is not known: its counts alone.
SurfaceErrors counts_of(const geometry::TriangleMesh& mesh) {
    const geometry::MeshHealth health = geometry::examine(mesh);
    SurfaceErrors counts;
    counts.triangles = health.triangles;
    counts.bad_edges = health.boundary_edges + health.nonmanifold_edges + health.misoriented_edges;
    return counts;
}

Json spread_of(const std::vector<double>& counts) {
    return {{"median", median(counts)},
            {"p99", quantile(counts, 0.99)},
            {"most", quantile(counts, 1.0)},
            {"all", sum(counts)}};
}

// Returns the spread of each count over the updates; null without a device.
Json counts_json(const UpdateCounts& counts) {
    if (counts.submissions.empty()) return nullptr;
    return {{"submissions", spread_of(counts.submissions)},
            {"blocking_waits", spread_of(counts.blocking_waits)},
            {"bytes_to_device", spread_of(counts.bytes_to_device)},
            {"bytes_to_host", spread_of(counts.bytes_to_host)},
            {"rays_changed", spread_of(counts.rays_changed)}};
}

void add_counts(Json& report, const StrokeRun& run) {
    const double updates = static_cast<double>(std::max<std::size_t>(1, run.update_ms.size()));
    for (const auto& [key, of] : {std::pair{"submissions_per_update", &compute::DeviceTraffic::submissions},
                                  std::pair{"blocking_waits_per_update", &compute::DeviceTraffic::blocking_waits},
                                  std::pair{"bytes_to_device_per_update", &compute::DeviceTraffic::bytes_to_device},
                                  std::pair{"bytes_to_host_per_update", &compute::DeviceTraffic::bytes_to_host}})
        report[key] = run.traffic ? Json(static_cast<double>((*run.traffic).*of) / updates) : Json(nullptr);
    report["device_memory_bytes"] = run.traffic ? Json(run.traffic->most_memory_bytes) : Json(nullptr);
    report["counts_per_update"] = counts_json(run.counts);
}

double number_of(const Json& value) { return value.is_number() ? value.get<double>() : 0.0; }

// Returns the number of faults in the carved solid and its mesh.
double faults_of(const Json& report) {
    double faults = 0.0;
    for (const char* key : {"disagreeing_edges", "self_intersections", "lost_intervals", "extra_intervals"}) {
        faults += number_of(report[key]);
    }
    return faults;
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

SelfIntersections count_self_intersections(const geometry::TriangleMesh& mesh, unsigned threads) {
    SelfIntersections crossings;
    WorkerPool pool(threads);
    crossings.pairs = compute::self_intersections(mesh, pool).size();
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

Json describe(const CarveScene& scene, const StrokeRun& run, const std::optional<SurfaceErrors>& errors,
              const SelfIntersections& crossings) {
    Json report = {{"scene", scene.name},    {"engine", run.engine},
                   {"device", run.device},   {"software_device", run.software_device},
                   {"threads", run.threads}, {"resolution", run.resolution}};
    add_update_times(report, run.update_ms, run.cpu_ms);
    add_times_with(report, "undo", run.with_undo);
    add_times_with(report, "light", run.with_light);
    const bool has_parts = !run.carve_ms.empty();
    report["carve_ms_median"] = has_parts ? Json(median(run.carve_ms)) : Json(nullptr);
    report["mesh_ms_median"] = has_parts ? Json(median(run.mesh_ms)) : Json(nullptr);
    report["publish_ms_median"] = has_parts ? Json(median(run.publish_ms)) : Json(nullptr);
    report["first_mesh_ms"] = run.first_mesh_ms;
    const double updates = static_cast<double>(std::max<std::size_t>(1, run.update_ms.size()));
    report["boolean_rays_per_s"] =
        has_parts ? Json(static_cast<double>(run.rays_touched) / (1e-3 * sum(run.carve_ms))) : Json(nullptr);
    report["rays_touched"] = run.rays_touched;
    report["rays_changed"] = run.rays_changed;
    report["rays_held"] = run.rays_held;
    report["bytes"] = run.bytes;
    report["bytes_per_ray"] = static_cast<double>(run.bytes) / static_cast<double>(run.rays_held);
    report["cells_per_update"] = static_cast<double>(run.cells_remeshed) / updates;
    report["triangles_per_update"] = static_cast<double>(run.triangles_remeshed) / updates;
    report["triangles_published_per_update"] = static_cast<double>(run.triangles_published) / updates;
    add_counts(report, run);
    add_errors(report, errors ? *errors : counts_of(run.mesh), run.cell_m, errors.has_value());
    report["self_intersections"] = or_null(crossings.pairs);
    report["self_intersections_mended"] = run.self_intersections_mended;
    report["self_intersections_by_cgal"] = or_null(crossings.pairs_by_cgal);
    report["disagreeing_edges"] = run.disagreeing_edges;
    report["rays_checked"] = run.intervals ? run.intervals->rays : 0;
    report["lost_intervals"] = run.intervals ? Json(run.intervals->lost) : Json(nullptr);
    report["extra_intervals"] = run.intervals ? Json(run.intervals->extra) : Json(nullptr);
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
    const std::string prefix =
        peer["method"].get_ref<const std::string&>() == "csgDifference" ? "openvdb_" : "openvdb_brush_";
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
        if (value.is_structured()) continue;
        text += "  " + key + std::string(width + 2 - key.size(), ' ') + text_of(value) + '\n';
    }
    return text;
}

std::string counts_table(const Json& report) {
    const Json counts = report.value("counts_per_update", Json());
    if (counts.is_null()) return {};
    std::array<char, 128> line{};
    const auto row = [&](const char* name, const std::array<std::string, 4>& cells) {
        std::snprintf(line.data(), line.size(), "  %-24s%12s%12s%12s%14s\n", name, cells[0].c_str(), cells[1].c_str(),
                      cells[2].c_str(), cells[3].c_str());
        return std::string(line.data());
    };
    std::string text = row("asked of an update", {"median", "p99", "most", "all updates"});
    for (const auto& [key, title] :
         {std::pair{"submissions", "submissions"}, std::pair{"blocking_waits", "blocking waits"},
          std::pair{"bytes_to_device", "bytes to the device"}, std::pair{"bytes_to_host", "bytes to the host"},
          std::pair{"rays_changed", "rays changed"}}) {
        std::array<std::string, 4> cells;
        for (std::size_t i = 0; const char* of : {"median", "p99", "most", "all"})
            cells.at(i++) = std::to_string(std::llround(counts[key][of].get<double>()));
        text += row(title, cells);
    }
    return text;
}

void sort_worst_first(std::vector<Json>& reports) {
    std::ranges::stable_sort(reports, [](const Json& a, const Json& b) {
        const double faults_a = faults_of(a), faults_b = faults_of(b);
        if (faults_a != faults_b) return faults_a > faults_b;
        return number_of(a["cut_rms_h"]) > number_of(b["cut_rms_h"]);
    });
}

std::string scene_table(const std::vector<Json>& reports) {
    constexpr std::array kColumns{std::pair{"scene", "scene"},
                                  std::pair{"updates", "updates"},
                                  std::pair{"update_ms_median", "ms"},
                                  std::pair{"update_ms_p99", "p99 ms"},
                                  std::pair{"update_with_undo_ms_median", "with undo"},
                                  std::pair{"update_with_light_ms_median", "with light"},
                                  std::pair{"submissions_per_update", "submissions"},
                                  std::pair{"blocking_waits_per_update", "waits"},
                                  std::pair{"bytes_to_device_per_update", "B to device"},
                                  std::pair{"bytes_to_host_per_update", "B to host"},
                                  std::pair{"device_memory_bytes", "device memory"},
                                  std::pair{"disagreeing_edges", "disagreeing"},
                                  std::pair{"self_intersections", "crossing"},
                                  std::pair{"lost_intervals", "lost"},
                                  std::pair{"extra_intervals", "extra"},
                                  std::pair{"cut_rms_h", "cut rms h"},
                                  std::pair{"cut_max_h", "cut max h"},
                                  std::pair{"edge_rms_h", "edge rms h"},
                                  std::pair{"rim_rms_h", "rim rms h"},
                                  std::pair{"crease_rms_h", "crease rms h"}};
    std::string text;
    for (std::size_t row = 0; row <= reports.size(); ++row) {
        for (const auto& [key, title] : kColumns) {
            const std::string cell = row == 0 ? title : text_of(reports[row - 1].value(key, Json()));
            const std::size_t width = std::string_view(key) == "scene" ? 28 : 12;
            text += std::string(width > cell.size() ? width - cell.size() : 1, ' ') + cell;
        }
        text += '\n';
    }
    return text;
}

}  // namespace burin::bench
