// SPDX-License-Identifier: MIT
// Writes the figures of touch as table, CSV, JSON and figure.
#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include "base/plot/figures.hpp"
#include "base/statistics.hpp"
#include "bench/haptics/haptics.hpp"

namespace burin::bench {
namespace {

template <typename... Values>
std::string line(const char* format, Values... values) {
    std::array<char, 256> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

Json quantiles(const std::string& name, const std::string& unit, const std::vector<double>& values) {
    return {{name + "_median_" + unit, median(values)},
            {name + "_p99_" + unit, quantile(values, 0.99)},
            {name + "_p999_" + unit, quantile(values, 0.999)},
            {name + "_max_" + unit, most(values)}};
}

// Returns the share of deadlines that passed while an earlier tick was still late; none where nothing paces the ticks.
std::optional<double> skipped_percent(const TickCosts& t) {
    if (t.lateness_us.empty()) return std::nullopt;
    const auto skipped = static_cast<double>(t.skipped_deadlines);
    return 100.0 * skipped / (skipped + static_cast<double>(t.tick_us.size()));
}

Json row_of(const TickCosts& t) {
    Json row = {{"scene", t.scene},
                {"triangles", t.triangles},
                {"probe", t.probe},
                {"pacing", t.pacing},
                {"ticks", t.tick_us.size()}};
    row.update(quantiles("tick", "us", t.tick_us));
    row["triangles_tested_mean"] = mean(t.triangles_tested);
    row["triangles_tested_max"] = most(t.triangles_tested);
    row["triangles_seen_mean"] = mean(t.triangles_seen);
    row["triangles_seen_max"] = most(t.triangles_seen);
    row["ticks_in_contact"] = t.in_contact;
    row["surfaces_used"] = t.surfaces_used;
    row["warm_up_median_us"] = median(t.warm_up_us);
    row["lateness_median_us"] = median(t.lateness_us);
    row["lateness_p99_us"] = quantile(t.lateness_us, 0.99);
    row["skipped_deadlines"] = t.skipped_deadlines;
    const auto percent = skipped_percent(t);
    row["skipped_deadlines_percent"] = percent ? Json(*percent) : Json(nullptr);
    return row;
}

Json errors_of(const ProxyErrors& e) {
    Json row = {{"triangles", e.triangles},
                {"ticks", e.ticks},
                {"ticks_in_contact", e.in_contact},
                {"not_solved", e.not_solved},
                {"mesh_chord_error_mm", e.chord_mm}};
    row.update(quantiles("normal_error", "mm", e.normal_mm));
    row.update(quantiles("distance_from_minimum", "mm", e.lag_mm));
    return row;
}

Json contact_of(const LostContact& c) {
    return {{"part", c.part},           {"coordinates", c.unit}, {"ticks", c.ticks},
            {"ticks_inside", c.inside}, {"ticks_lost", c.lost},  {"ticks_felt_outside", c.felt_outside}};
}

Json edits_of(const EditCosts& e) {
    Json row = {{"triangles", e.triangles},
                {"edits", e.prepare_ms.size()},
                {"triangles_an_edit", e.edited_triangles},
                {"create_ms", e.create_ms},
                {"first_snapshot_ms", e.first_snapshot_ms}};
    row.update(quantiles("prepare", "ms", e.prepare_ms));
    row["patches_made"] = e.patches_made;
    row["used_at_next_tick"] = e.used_at_next_tick;
    row["felt_at_next_tick"] = e.felt_at_next_tick;
    row["deformed_triangles"] = e.deformed_triangles;
    row.update(quantiles("deform", "ms", e.deform_ms));
    return row;
}

Json jump_of(const ForceJumps& j) {
    return {{"triangles", j.triangles},
            {"shading", j.shading},
            {"largest_jump_percent", j.largest_percent},
            {"p99_jump_percent", j.p99_percent},
            {"turn_of_surface_percent", j.turn_of_surface_percent}};
}

std::string skipped_text(const TickCosts& t) {
    const auto percent = skipped_percent(t);
    return percent ? line("%.2f", *percent) : "-";
}

std::string ticks_table(const Haptics& all) {
    std::string text = line("%-8s %9s %-10s %-12s %8s %8s %8s %8s %8s %8s %9s\n", "scene", "triangles", "probe",
                            "pacing", "median", "p99", "p99.9", "max us", "tested", "seen", "skipped %");
    for (const TickCosts& t : all.ticks)
        text += line("%-8s %9zu %-10s %-12s %8.1f %8.1f %8.1f %8.1f %8.1f %8.1f %9s\n", t.scene.c_str(), t.triangles,
                     t.probe.c_str(), t.pacing.c_str(), median(t.tick_us), quantile(t.tick_us, 0.99),
                     quantile(t.tick_us, 0.999), most(t.tick_us), mean(t.triangles_tested), mean(t.triangles_seen),
                     skipped_text(t).c_str());
    return text;
}

// Returns the curve of the share of ticks that take a time or longer, down to a single tick.
plot::PlotSeries exceeding(const TickCosts& t) {
    plot::PlotSeries series{.name = t.probe, .points = {}};
    std::vector<double> sorted = t.tick_us;
    std::ranges::sort(sorted);
    const auto count = static_cast<double>(sorted.size());
    double last_share = 2.0;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const double share = (count - static_cast<double>(i)) / count;
        if (share > 0.93 * last_share) continue;  // skips points too close to be told apart
        last_share = share;
        series.points.push_back({sorted[i], share, ""});
    }
    return series;
}

}  // namespace

std::string haptics_table(const Haptics& all) {
    std::string text = all.machine + "; real time: " + all.realtime + "\n\n" + ticks_table(all) + "\n";
    const ProxyErrors& e = all.errors;
    text += line("proxy on %zu triangles at 100 mm/s (mesh within %.4f mm of the surface), mm: median, p99, max\n",
                 e.triangles, e.chord_mm);
    text += line("  from the surface               %8.4f %8.4f %8.4f\n", median(e.normal_mm),
                 quantile(e.normal_mm, 0.99), most(e.normal_mm));
    text += line("  from the nearest to the HIP    %8.4f %8.4f %8.4f\n", median(e.lag_mm), quantile(e.lag_mm, 0.99),
                 most(e.lag_mm));
    for (const LostContact& c : all.contact)
        text += line("contact lost, %-10s, scene in %-2s: %llu of %llu ticks inside (of %llu in all)\n", c.part.c_str(),
                     c.unit.c_str(), static_cast<unsigned long long>(c.lost), static_cast<unsigned long long>(c.inside),
                     static_cast<unsigned long long>(c.ticks));
    const std::vector<double>& differ = all.metres_and_millimetres_differ_um;
    text += line("proxies in metres and in millimetres differ by, um: median %.6f, p99 %.6f, p99.99 %.4f, max %.1f\n",
                 median(differ), quantile(differ, 0.99), quantile(differ, 0.9999), most(differ));
    text += line("and in metres and in their 1024ths by at most %.6f um\n", all.metres_and_1024ths_differ_um);
    const EditCosts& d = all.edits;
    text += line("1 cm edit (%zu triangles) of %zu: median %.3f, p99 %.3f ms; %llu of %zu felt at the next tick\n",
                 d.edited_triangles, d.triangles, median(d.prepare_ms), quantile(d.prepare_ms, 0.99),
                 static_cast<unsigned long long>(d.felt_at_next_tick), d.prepare_ms.size());
    text += line("made in %.0f ms, first snapshot %.0f ms; all of %zu triangles deformed: median %.2f ms\n",
                 d.create_ms, d.first_snapshot_ms, d.deformed_triangles, median(d.deform_ms));
    for (const ForceJumps& j : all.jumps)
        text += line(
            "largest change of force in 0.1 mm on %zu triangles, shading %s: %.2f %% (the surface turns %.2f %%)\n",
            j.triangles, j.shading ? "on " : "off", j.largest_percent, j.turn_of_surface_percent);
    return text;
}

std::string haptics_csv(const Haptics& all) {
    std::string text = "# " + all.machine + "; real time: " + all.realtime + "\n";
    for (std::size_t i = 0; i < all.ticks.size(); ++i) {
        const Json row = row_of(all.ticks[i]);
        std::string names, values;
        for (const auto& [name, value] : row.items()) {
            names += (names.empty() ? "" : ",") + name;
            values += (values.empty() ? "" : ",") + (value.is_string() ? value.get<std::string>() : value.dump());
        }
        if (i == 0) text += names + "\n";
        text += values + "\n";
    }
    return text;
}

Json haptics_json(const Haptics& all) {
    Json report = {{"machine", all.machine}, {"real_time", all.realtime}};
    report["ticks"] = Json::array();
    for (const TickCosts& t : all.ticks) report["ticks"].push_back(row_of(t));
    report["proxy_error"] = errors_of(all.errors);
    report["contact"] = Json::array();
    for (const LostContact& c : all.contact) report["contact"].push_back(contact_of(c));
    Json units = quantiles("metres_and_millimetres_differ", "um", all.metres_and_millimetres_differ_um);
    units["metres_and_1024ths_differ_max_um"] = all.metres_and_1024ths_differ_um;
    report["units"] = units;
    report["edit"] = edits_of(all.edits);
    report["force_jumps"] = Json::array();
    for (const ForceJumps& j : all.jumps) report["force_jumps"].push_back(jump_of(j));
    return report;
}

std::string haptics_svg(const Haptics& all) {
    std::vector<plot::Plot> plots;
    for (const TickCosts& t : all.ticks) {
        if (t.pacing != "paced") continue;
        const std::string title = t.scene + ", " + std::to_string(t.triangles) + " triangles";
        if (plots.empty() || plots.back().title != title) {
            plot::Plot& plot = plots.emplace_back();
            plot.title = title;
            plot.x_label = "tick, us";
            plot.y_label = "share of ticks as long or longer";
            plot.markers = false;
        }
        plots.back().series.push_back(exceeding(t));
    }
    return plot::svg_figure("What a tick costs, paced at 1 kHz: " + all.machine, plots);
}

}  // namespace burin::bench
