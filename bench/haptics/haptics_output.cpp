// SPDX-License-Identifier: MIT
// Writes the figures of touch as table, CSV, JSON and figure.
#include <algorithm>
#include <array>
#include <cstdio>

#include "base/statistics.hpp"
#include "bench/haptics/haptics_rows.hpp"

namespace burin::bench {
namespace {

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

Json parts_of(const PartsShare& p) {
    Json row = {{"scene", p.scene},         {"triangles", p.triangles},
                {"parts", p.parts},         {"points", p.points},
                {"ticks", p.ticks},         {"in_contact", p.in_contact},
                {"held_over", p.held_over}, {"left_behind", p.left_behind},
                {"let_go", p.let_go},       {"longest_wait_turns", p.longest_wait}};
    row.update(quantiles("turn_cost", "us", p.turn_cost_us));
    return row;
}

Json shape_of(const ShapeTicks& s) {
    Json row = {{"scene", s.scene},           {"tool", s.tool},
                {"triangles", s.triangles},   {"ticks", s.ticks},
                {"in_contact", s.in_contact}, {"limited", s.limited},
                {"frozen", s.frozen},         {"frozen_in_a_row", s.frozen_in_a_row}};
    row.update(quantiles("tick_cost", "us", s.cost_us));
    return row;
}

std::string shapes_table(const std::vector<ShapeTicks>& shapes) {
    if (shapes.empty()) return "";
    std::string text = formatted(
        "tools that touch with their shape, work of a tick as counted (us: p50, p99.9, most)\n"
        "%-16s %-10s %9s %8s %8s %8s %11s %8s %7s %9s\n",
        "scene", "tool", "triangles", "p50", "p99.9", "most", "in contact", "limited", "frozen", "in a row");
    for (const ShapeTicks& s : shapes) {
        const double ticks = static_cast<double>(std::max<std::uint64_t>(s.ticks, 1));
        text +=
            formatted("%-16s %-10s %9zu %8.1f %8.1f %8.1f %10.1f%% %7.2f%% %7llu %9llu\n", s.scene.c_str(),
                      s.tool.c_str(), s.triangles, median(s.cost_us), quantile(s.cost_us, 0.999), most(s.cost_us),
                      100.0 * static_cast<double>(s.in_contact) / ticks, 100.0 * static_cast<double>(s.limited) / ticks,
                      static_cast<unsigned long long>(s.frozen), static_cast<unsigned long long>(s.frozen_in_a_row));
    }
    return text + "\n";
}

Json carved_of(const CarvedFeel& c) {
    return {{"row", c.row},     {"tool", c.tool},       {"resolution", c.resolution},
            {"unit", c.unit},   {"right", c.right},     {"found", c.found},
            {"ticks", c.ticks}, {"limited", c.limited}, {"let_go", c.let_go}};
}

std::string carved_table(const std::vector<CarvedFeel>& carved) {
    if (carved.empty()) return "";
    std::string text = formatted("a tool in the groove that it cuts\n%-24s %-10s %5s %9s %9s %-5s %8s %7s\n", "",
                                 "tool", "cells", "right", "found", "", "limited", "let go");
    for (const CarvedFeel& c : carved)
        text +=
            formatted("%-24s %-10s %5d %9.3f %9.3f %-5s %7.2f%% %7llu\n", c.row.c_str(), c.tool.c_str(), c.resolution,
                      c.right, c.found, c.unit.c_str(),
                      100.0 * static_cast<double>(c.limited) / static_cast<double>(std::max<std::uint64_t>(c.ticks, 1)),
                      static_cast<unsigned long long>(c.let_go));
    return text + "\n";
}

// Returns how many times the work of one end, the mean of both alone, both together take.
double ends_ratio(const std::vector<WandWork>& wand, double share) {
    if (wand.size() != 3) return 0.0;
    const double one = 0.5 * (quantile(wand[1].cost_us, share) + quantile(wand[2].cost_us, share));
    return one > 0.0 ? quantile(wand[0].cost_us, share) / one : 0.0;
}

Json wand_of(const std::vector<WandWork>& wand) {
    Json rows = Json::array();
    for (const WandWork& w : wand) {
        Json row = {{"points", w.points}, {"ticks", w.cost_us.size()}, {"in_contact", w.in_contact}};
        row.update(quantiles("tick_cost", "us", w.cost_us));
        rows.push_back(row);
    }
    return {{"ends", rows}, {"both_to_one_p50", ends_ratio(wand, 0.5)}, {"both_to_one_p999", ends_ratio(wand, 0.999)}};
}

std::string wand_table(const std::vector<WandWork>& wand) {
    if (wand.empty()) return "";
    std::string text = "a wand in a tube, work of a tick as counted (us: p50, p99.9, most)\n";
    for (const WandWork& w : wand)
        text += formatted("  %-8s %7.2f %7.2f %7.2f, in contact in %.0f %% of %zu ticks\n", w.points.c_str(),
                          median(w.cost_us), quantile(w.cost_us, 0.999), most(w.cost_us),
                          100.0 * static_cast<double>(w.in_contact) / static_cast<double>(w.cost_us.size()),
                          w.cost_us.size());
    return text + formatted("  both take %.2f times one at p50, %.2f at p99.9; at most 2.2 is asked for\n\n",
                            ends_ratio(wand, 0.5), ends_ratio(wand, 0.999));
}

std::string parts_table(const std::vector<PartsShare>& parts) {
    if (parts.empty()) return "";
    std::string text = formatted(
        "parts of one device, a ball of 2 mm or five points each, work of a turn as counted (us: mean, p99.9, most), "
        "and of the parts' ticks\n"
        "%-16s %9s %6s %8s %8s %8s %11s %9s %12s %12s %7s\n",
        "scene", "triangles", "parts", "mean", "p99.9", "most", "in contact", "held over", "longest wait",
        "left behind", "let go");
    for (const PartsShare& p : parts) {
        double sum = 0.0;
        for (const double us : p.turn_cost_us) sum += us;
        const double ticks = static_cast<double>(std::max<std::uint64_t>(p.ticks, 1));
        text += formatted(
            "%-16s %9zu %2zu x %1zu %8.1f %8.1f %8.1f %10.1f%% %8.2f%% %12llu %11.2f%% %7llu\n", p.scene.c_str(),
            p.triangles, p.parts, p.points, sum / static_cast<double>(std::max<std::size_t>(p.turn_cost_us.size(), 1)),
            quantile(p.turn_cost_us, 0.999), most(p.turn_cost_us), 100.0 * static_cast<double>(p.in_contact) / ticks,
            100.0 * static_cast<double>(p.held_over) / ticks, static_cast<unsigned long long>(p.longest_wait),
            100.0 * static_cast<double>(p.left_behind) / ticks, static_cast<unsigned long long>(p.let_go));
    }
    return text + "\n";
}

}  // namespace

std::string haptics_table(const Haptics& all) {
    std::string text = all.machine + "; real time: " + all.realtime + "\n\n" + ticks_table(all.ticks);
    for (const std::string& note : all.notes) text += note + "\n";
    text += "\n" + peers_table(all.peers);
    text += parts_table(all.parts);
    text += shapes_table(all.shapes);
    text += carved_table(all.carved);
    text += wand_table(all.wand);
    const ProxyErrors& e = all.errors;
    text += formatted("proxy on %zu triangles at 100 mm/s (mesh within %.4f mm of the surface), mm: median, p99, max\n",
                      e.triangles, e.chord_mm);
    text += formatted("  from the surface               %8.4f %8.4f %8.4f\n", median(e.normal_mm),
                      quantile(e.normal_mm, 0.99), most(e.normal_mm));
    text += formatted("  from the nearest to the HIP    %8.4f %8.4f %8.4f\n", median(e.lag_mm),
                      quantile(e.lag_mm, 0.99), most(e.lag_mm));
    for (const LostContact& c : all.contact)
        text += formatted("contact lost, %-10s, scene in %-2s: %llu of %llu ticks inside (of %llu in all)\n",
                          c.part.c_str(), c.unit.c_str(), static_cast<unsigned long long>(c.lost),
                          static_cast<unsigned long long>(c.inside), static_cast<unsigned long long>(c.ticks));
    const std::vector<double>& differ = all.metres_and_millimetres_differ_um;
    text +=
        formatted("proxies in metres and in millimetres differ by, um: median %.6f, p99 %.6f, p99.99 %.4f, max %.1f\n",
                  median(differ), quantile(differ, 0.99), quantile(differ, 0.9999), most(differ));
    text += formatted("and in metres and in their 1024ths by at most %.6f um\n", all.metres_and_1024ths_differ_um);
    const EditCosts& d = all.edits;
    text += formatted("1 cm edit (%zu triangles) of %zu: median %.3f, p99 %.3f ms; %llu of %zu felt at the next tick\n",
                      d.edited_triangles, d.triangles, median(d.prepare_ms), quantile(d.prepare_ms, 0.99),
                      static_cast<unsigned long long>(d.felt_at_next_tick), d.prepare_ms.size());
    text += formatted("made in %.0f ms, first snapshot %.0f ms; all of %zu triangles deformed: median %.2f ms\n",
                      d.create_ms, d.first_snapshot_ms, d.deformed_triangles, median(d.deform_ms));
    for (const ForceJumps& j : all.jumps)
        text += formatted(
            "largest change of force in 0.1 mm on %zu triangles, shading %s: %.2f %% (the surface turns %.2f %%)\n",
            j.triangles, j.shading ? "on " : "off", j.largest_percent, j.turn_of_surface_percent);
    return text;
}

Json haptics_json(const Haptics& all) {
    Json report = {{"machine", all.machine}, {"real_time", all.realtime}};
    report["ticks"] = Json::array();
    for (const TickCosts& t : all.ticks) report["ticks"].push_back(tick_row(t));
    report["notes"] = all.notes;
    report["peers"] = Json::array();
    for (const PeerTicks& t : all.peers) report["peers"].push_back(peer_row(t));
    report["peer_ratios"] = peer_ratios(all.peers);
    report["parts"] = Json::array();
    for (const PartsShare& p : all.parts) report["parts"].push_back(parts_of(p));
    report["shapes"] = Json::array();
    for (const ShapeTicks& s : all.shapes) report["shapes"].push_back(shape_of(s));
    report["carved"] = Json::array();
    for (const CarvedFeel& c : all.carved) report["carved"].push_back(carved_of(c));
    report["wand"] = wand_of(all.wand);
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

}  // namespace burin::bench
