// SPDX-License-Identifier: MIT
#include "bench/haptics/haptics_rows.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "base/plot/figures.hpp"
#include "base/statistics.hpp"

namespace burin::bench {
namespace {

constexpr const char *kCold = "cold", *kRehearsed = "rehearsed", *kBackToBack = "back_to_back";

double percent(std::uint64_t part, std::uint64_t whole) {
    return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

std::uint64_t deadlines_of(const TickCosts& t) {
    return t.pacing == kBackToBack ? 0 : t.skipped_deadlines + t.tick_us.size();
}

// The runs of one combination of scene, probe and friction; null where there was none.
struct RunsOfCombination {
    const TickCosts *cold = nullptr, *rehearsed = nullptr, *back_to_back = nullptr;
};

// Returns the combinations in the order in which they first occur.
std::vector<RunsOfCombination> combinations_of(const std::vector<TickCosts>& ticks) {
    std::vector<RunsOfCombination> all;
    std::map<std::tuple<std::string, std::size_t, std::string, bool>, std::size_t> known;
    for (const TickCosts& t : ticks) {
        const auto [at, is_new] = known.try_emplace({t.scene, t.triangles, t.probe, t.friction}, all.size());
        if (is_new) all.emplace_back();
        RunsOfCombination& runs = all[at->second];
        (t.pacing == kCold ? runs.cold : t.pacing == kRehearsed ? runs.rehearsed : runs.back_to_back) = &t;
    }
    return all;
}

std::string time_cell(const TickCosts* t, double share) {
    return t == nullptr ? formatted("%8s", "-") : formatted("%8.1f", quantile(t->tick_us, share));
}

std::string lost_cell(const TickCosts& t) {
    return t.contact_lost ? formatted("%6llu", static_cast<unsigned long long>(*t.contact_lost))
                          : formatted("%6s", "-");
}

std::string table_row(const RunsOfCombination& runs) {
    const TickCosts& counted = runs.back_to_back != nullptr ? *runs.back_to_back : *runs.cold;
    const double edges = counted.mean_edge_m > 0.0 ? counted.radius_m / counted.mean_edge_m : 0.0;
    std::string text = formatted("%-16s %9zu %-14s %6.1f %-3s", counted.scene.c_str(), counted.triangles,
                                 counted.probe.c_str(), edges, counted.friction ? "on" : "off");
    for (const double share : {0.5, 0.99, 0.999, 1.0}) text += time_cell(runs.cold, share);
    for (const double share : {0.5, 0.999}) text += time_cell(runs.rehearsed, share);
    for (const double share : {0.5, 0.999}) text += time_cell(runs.back_to_back, share);
    text += formatted("%8.1f%7.0f%7.0f", mean(counted.tests), quantile(counted.tests, 0.999), most(counted.tests));
    text += formatted("%8.1f%7.0f%8.0f", mean(counted.looks), quantile(counted.looks, 0.999), most(counted.looks));
    text += formatted("%6.1f%5.0f%8.1f%6.0f%6.0f", mean(counted.steps), most(counted.steps), mean(counted.cost_us),
                      quantile(counted.cost_us, 0.999), most(counted.cost_us));
    text += formatted("%8.2f", percent(counted.work_limited, counted.tick_us.size())) + lost_cell(counted);
    const std::uint64_t skipped = (runs.cold != nullptr ? runs.cold->skipped_deadlines : 0) +
                                  (runs.rehearsed != nullptr ? runs.rehearsed->skipped_deadlines : 0);
    return text + formatted("%8llu\n", static_cast<unsigned long long>(skipped));
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

Json quantiles(const std::string& name, const std::string& unit, const std::vector<double>& values) {
    return {{name + "_median_" + unit, median(values)},
            {name + "_p99_" + unit, quantile(values, 0.99)},
            {name + "_p999_" + unit, quantile(values, 0.999)},
            {name + "_max_" + unit, most(values)}};
}

Json tick_row(const TickCosts& t) {
    const bool paced = t.pacing != kBackToBack;
    Json row = {{"scene", t.scene},
                {"triangles", t.triangles},
                {"probe", t.probe},
                {"radius_mm", 1e3 * t.radius_m},
                {"radius_per_edge", t.mean_edge_m > 0.0 ? t.radius_m / t.mean_edge_m : 0.0},
                {"friction", t.friction},
                {"pacing", t.pacing},
                {"ticks", t.tick_us.size()}};
    row.update(quantiles("tick", "us", t.tick_us));
    for (const auto& [name, values] :
         {std::pair{"tests", &t.tests}, std::pair{"looks", &t.looks}, std::pair{"gathered", &t.gathered},
          std::pair{"steps", &t.steps}, std::pair{"solves", &t.solves}, std::pair{"cost_us", &t.cost_us}}) {
        const std::string of = name;
        row[of + "_mean"] = mean(*values);
        row[of + "_p50"] = median(*values);
        row[of + "_p999"] = quantile(*values, 0.999);
        row[of + "_max"] = most(*values);
    }
    row["work_limited_percent"] = percent(t.work_limited, t.tick_us.size());
    row["ticks_in_contact"] = t.in_contact;
    row["contact_lost"] = t.contact_lost ? Json(*t.contact_lost) : Json(nullptr);
    row["pushed_out"] = t.pushed_out;
    row["left_behind"] = t.left_behind;
    row["surfaces_used"] = t.surfaces_used;
    row["warm_up_median_us"] = median(t.warm_up_us);
    row["lateness_median_us"] = median(t.lateness_us);
    row["lateness_p99_us"] = quantile(t.lateness_us, 0.99);
    row["skipped_deadlines"] = t.skipped_deadlines;
    row["skipped_deadlines_percent"] = paced ? Json(percent(t.skipped_deadlines, deadlines_of(t))) : Json(nullptr);
    return row;
}

void sort_worst_first(std::vector<TickCosts>& ticks) {
    const auto group_of = [](const TickCosts& t) { return std::tuple(t.scene, t.triangles, t.probe, t.friction); };
    std::map<decltype(group_of(ticks.front())), double> worst_us;
    for (const TickCosts& t : ticks)
        if (t.pacing == kCold) worst_us[group_of(t)] = quantile(t.tick_us, 0.999);
    const auto place_of = [](const TickCosts& t) { return t.pacing == kCold ? 0 : t.pacing == kRehearsed ? 1 : 2; };
    std::ranges::sort(ticks, [&](const TickCosts& a, const TickCosts& b) {
        const auto of_a = group_of(a), of_b = group_of(b);
        if (of_a == of_b) return place_of(a) < place_of(b);
        return std::pair(worst_us[of_a], of_a) > std::pair(worst_us[of_b], of_b);
    });
}

std::string ticks_table(const std::vector<TickCosts>& ticks) {
    std::string text =
        formatted("%-16s %9s %-14s %6s %-3s%32s%16s%16s%22s%23s%11s%20s%8s%6s%8s\n", "", "", "", "radius", "fri",
                  "cold, us: p50 p99 p99.9 max", "rehearsed", "back to back", "tests: mean p99.9 max",
                  "looks: mean p99.9 max", "steps", "cost by count, us", "limit", "lost", "skipped");
    text += formatted("%-16s %9s %-14s %6s %-3s%32s%16s%16s%22s%23s%11s%20s%8s%6s%8s\n", "scene", "triangles", "probe",
                      "/ edge", "ct.", "", "p50, p99.9", "p50, p99.9", "", "", "mean max", "mean p99.9 max", "%",
                      "ticks", "");
    for (const RunsOfCombination& runs : combinations_of(ticks)) text += table_row(runs);
    std::uint64_t deadlines = 0, skipped = 0, runs_that_skipped = 0, limited = 0, counted = 0;
    for (const TickCosts& t : ticks) {
        deadlines += deadlines_of(t), skipped += t.skipped_deadlines;
        if (t.skipped_deadlines > 0) ++runs_that_skipped;
        limited += t.work_limited, counted += t.tick_us.size();
    }
    const auto count = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    text += skipped > 0 ? formatted("%llu of %llu deadlines were SKIPPED, in %llu runs\n", count(skipped),
                                    count(deadlines), count(runs_that_skipped))
                        : formatted("no deadline of %llu was skipped\n", count(deadlines));
    return text + formatted("the work ran into its limit in %llu of %llu ticks\n", count(limited), count(counted));
}

std::string haptics_csv(const Haptics& all) {
    std::string text = "# " + all.machine + "; real time: " + all.realtime + "\n";
    for (std::size_t i = 0; i < all.ticks.size(); ++i) {
        const Json row = tick_row(all.ticks[i]);
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

std::string haptics_svg(const Haptics& all) {
    constexpr std::size_t kMostPlots = 6;
    std::vector<plot::Plot> plots;
    for (const TickCosts& t : all.ticks) {
        if (t.pacing != kCold || !t.friction) continue;
        const std::string title = t.scene + ", " + std::to_string(t.triangles) + " triangles";
        auto at = std::ranges::find(plots, title, &plot::Plot::title);
        if (at == plots.end()) {
            if (plots.size() == kMostPlots) continue;
            plot::Plot plot;
            plot.title = title;
            plot.x_label = "tick, us";
            plot.y_label = "share of ticks as long or longer";
            plot.markers = false;
            at = plots.insert(plots.end(), plot);
        }
        at->series.push_back(exceeding(t));
    }
    return plot::svg_figure("What a cold tick costs, the worst scenes: " + all.machine, plots);
}

}  // namespace burin::bench
