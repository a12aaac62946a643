// SPDX-License-Identifier: MIT
// Writes the runs of a comparison as table, CSV and figure.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/plot/figures.hpp"
#include "bench/stroke/pareto.hpp"

namespace burin::bench {
namespace {

constexpr std::array kParetoColumns{"series",
                                    "detail",
                                    "threads",
                                    "resolution",
                                    "updates",
                                    "update_ms_median",
                                    "update_ms_p99",
                                    "update_ms_min",
                                    "update_cpu_ms_median",
                                    "tool_ms_median",
                                    "carve_ms_median",
                                    "mesh_ms_median",
                                    "publish_ms_median",
                                    "first_100_ms_median",
                                    "last_100_ms_median",
                                    "boolean_rays_per_s",
                                    "bytes",
                                    "bytes_per_ray",
                                    "triangles",
                                    "triangles_per_update",
                                    "volume_error_over_removed",
                                    "surface_rms_h",
                                    "surface_max_h",
                                    "cut_rms_h",
                                    "cut_rms_m",
                                    "edge_rms_h",
                                    "rim_rms_h",
                                    "rim_max_h",
                                    "crease_rms_h",
                                    "crease_max_h",
                                    "crease_rms_m",
                                    "bad_edges",
                                    "self_intersections",
                                    "lost_intervals",
                                    "burin_cpu_faster_at_equal_cut_error"};

std::string pareto_text(const Json& row, const char* key, const char* absent) {
    if (!row.contains(key) || row[key].is_null()) return absent;
    if (row[key].is_string()) {
        std::string text = row[key].get<std::string>();
        std::ranges::replace(text, ',', ';');
        return text;
    }
    if (!row[key].is_number_float()) return row[key].dump();
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.4g", row[key].get<double>());
    return text.data();
}

// Returns the label of a series' point: cells a side, or the peer's detail.
std::string label_of(const Json& row) {
    if (row.contains("detail")) return row["detail"].get<std::string>();
    return row["resolution"].dump();
}

plot::Plot plot_of(const Pareto& pareto, const char* title, const char* y_label, const char* key) {
    plot::Plot plot{title, "median time of an update, ms", y_label, {}};
    for (const Json& row : pareto.rows) {
        const std::string name = row["series"].get<std::string>();
        if (plot.series.empty() || plot.series.back().name != name) plot.series.push_back({name, {}});
        if (!row.contains(key) || row[key].is_null()) continue;
        plot.series.back().points.push_back(
            {row["update_ms_median"].get<double>(), std::abs(row[key].get<double>()), label_of(row)});
    }
    return plot;
}

}  // namespace

std::string pareto_table(const Pareto& pareto) {
    std::array<char, 400> line{};
    std::snprintf(line.data(), line.size(), "%-58s %12s %9s %9s %9s %10s %9s %9s %9s %9s %8s\n", "series", "N",
                  "median ms", "p99 ms", "cpu ms", "vol/removed", "cut h", "edge h", "rim h", "crease h", "x slower");
    std::string text = line.data();
    for (const Json& row : pareto.rows) {
        const auto cell = [&](const char* key) { return pareto_text(row, key, "-"); };
        std::snprintf(line.data(), line.size(), "%-58s %12s %9s %9s %9s %10s %9s %9s %9s %9s %8s\n",
                      row["series"].get<std::string>().c_str(), label_of(row).c_str(), cell("update_ms_median").c_str(),
                      cell("update_ms_p99").c_str(), cell("update_cpu_ms_median").c_str(),
                      cell("volume_error_over_removed").c_str(), cell("cut_rms_h").c_str(), cell("edge_rms_h").c_str(),
                      cell("rim_rms_h").c_str(), cell("crease_rms_h").c_str(),
                      cell("burin_cpu_faster_at_equal_cut_error").c_str());
        text += line.data();
    }
    text += "x slower: median time over that of Burin cpu at the same rms error of the cut region\n";
    for (const std::string& reason : pareto.left_out) text += "left out: " + reason + '\n';
    return text;
}

std::string pareto_csv(const Pareto& pareto) {
    std::string text = "# " + pareto.machine + "; wall times; burin bench pareto --csv\n";
    for (std::size_t i = 0; i < kParetoColumns.size(); ++i) text += std::string(i > 0 ? "," : "") + kParetoColumns[i];
    text += '\n';
    for (const Json& row : pareto.rows) {
        for (std::size_t i = 0; i < kParetoColumns.size(); ++i) {
            text += std::string(i > 0 ? "," : "") + pareto_text(row, kParetoColumns[i], "");
        }
        text += '\n';
    }
    return text;
}

std::string pareto_svg(const Pareto& pareto) {
    return plot::svg_figure(
        "STROKE-1000: what an update costs, and how far the surface is from the exact one",
        {plot_of(pareto, "Error of the cut region", "rms distance from the exact surface, sides of the cube",
                 "cut_rms_m"),
         plot_of(pareto, "Error of the volume", "share of the removed volume", "volume_error_over_removed"),
         plot_of(pareto, "Error where two balls meet sharply", "rms distance of exact crease points, sides of the cube",
                 "crease_rms_m")});
}

}  // namespace burin::bench
