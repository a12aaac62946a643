// SPDX-License-Identifier: MIT
// Writes the stability bench's rows as table, CSV, JSON and figure.
#include <algorithm>
#include <array>
#include <cstdio>

#include "base/plot/figures.hpp"
#include "bench/stability/stability.hpp"

namespace burin::bench {
namespace {

std::string line_of(const char* format, auto... values) {
    std::array<char, 400> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

std::string text_of(const Json& row, const char* key, const char* absent) {
    if (!row.contains(key) || row[key].is_null()) return absent;
    if (row[key].is_string()) return row[key].get<std::string>();
    if (!row[key].is_number_float()) return row[key].dump();
    return line_of("%.4g", row[key].get<double>());
}

bool is(const Json& row, const char* key, std::string_view text) {
    return row[key].get_ref<const std::string&>() == text;
}
bool is_of(const Json& row, std::string_view section) { return is(row, "section", section); }

// The first failure, and the share of failures from there to the end of the scan.
std::string stiffness_cell(const Json& row) {
    if (row.value("any_stiffness", false)) return "any";
    return line_of("%.0f %3.0f%%", row["first_failure_N_per_m"].get<double>(),
                   100.0 * row["failing_share_above"].get<double>());
}

std::string theory_table(const std::vector<Json>& rows) {
    std::string text =
        "Onset of shaking against K = b / (T/2 + delay), which is 2b/T without delay: device alone, no friction, no "
        "encoder steps\n" +
        line_of("%8s %10s %9s %12s %12s %8s\n", "rate Hz", "b Ns/m", "delay ms", "K found", "K theory", "ratio");
    for (const Json& row : rows) {
        if (!is_of(row, "theory")) continue;
        text += line_of("%8s %10s %9s %12.1f %12.1f %8.4f%s\n", text_of(row, "rate_Hz", "").c_str(),
                        text_of(row, "device_damping_Ns_per_m", "").c_str(), text_of(row, "delay_ms", "").c_str(),
                        row["largest_stable_stiffness_N_per_m"].get<double>(), row["theory_N_per_m"].get<double>(),
                        row["ratio"].get<double>(),
                        row["theory_applies"].get<bool>() ? "" : "  (b T / m > 0.1: does not apply)");
    }
    return text;
}

// Returns a table over `key`: one line a grip and delay, one column a value.
std::string sweep_table(const std::vector<Json>& rows, const char* section, const char* key, const char* title) {
    std::vector<std::string> values, lines;
    const auto line_name = [&](const Json& row) {
        std::string name = row["grip"].get<std::string>();
        if (std::string(section) == "filter") name += ", delay " + text_of(row, "delay_ms", "") + " ms";
        return name;
    };
    for (const Json& row : rows) {
        if (!is_of(row, section)) continue;
        const std::string value = text_of(row, key, ""), name = line_name(row);
        if (std::ranges::find(values, value) == values.end()) values.push_back(value);
        if (std::ranges::find(lines, name) == lines.end()) lines.push_back(name);
    }
    std::string text = line_of("\nFirst stiffness that shakes, N/m, over %-15s", title);
    for (const std::string& value : values) text += line_of(" %12s", value.c_str());
    text += '\n';
    for (const std::string& name : lines) {
        std::string found = line_of("%54s", name.c_str()), published = line_of("%54s", "published");
        bool any = false;
        for (const Json& row : rows) {
            if (!is_of(row, section) || line_name(row) != name) continue;
            found += line_of(" %12s", stiffness_cell(row).c_str());
            published += line_of(" %12s", row["published_N_per_m"].is_null()
                                              ? "-"
                                              : line_of("%.0f", row["published_N_per_m"].get<double>()).c_str());
            any = any || !row["published_N_per_m"].is_null();
        }
        text += found + '\n' + (any ? published + '\n' : "");
    }
    return text;
}

std::string list_table(const std::vector<Json>& rows) {
    std::string text = "\nFirst stiffness that shakes, N/m, 1 kHz, 1 ms delay\n" +
                       line_of("%8s %18s %12s %24s %12s\n", "grip", "velocity", "wall Ns/m", "controller", "K");
    for (const Json& row : rows) {
        if (!is_of(row, "velocity") && !is_of(row, "controller")) continue;
        text += line_of("%8s %18s %12s %24s %12s\n", text_of(row, "grip", "").c_str(),
                        is_of(row, "velocity") ? text_of(row, "velocity", "").c_str() : "-",
                        text_of(row, "wall_damping_Ns_per_m", "").c_str(), text_of(row, "controller", "").c_str(),
                        stiffness_cell(row).c_str());
    }
    return text;
}

std::string contact_table(const std::vector<Json>& rows) {
    std::string text =
        "\nOne tap, 1 kHz, 1 ms delay (other grips and controllers in the CSV). net: energy the wall gave out in a "
        "contact "
        "beyond what "
        "the device took; |dF|: a tick\n" +
        line_of("%7s %8s %9s %24s %9s %8s %9s %10s %8s %10s %8s\n", "grip", "tap m/s", "K wanted", "controller",
                "K given", "settles", "cycle mm", "|dF| N", "net mJ", "deepest mm", "acts");
    for (const Json& row : rows) {
        if (!is_of(row, "contact") || !(is(row, "grip", "light") || is(row, "grip", "hand"))) continue;
        if (!is(row, "controller", "none") && !is(row, "controller", "passivity")) continue;
        text +=
            line_of("%7s %8s %9s %24s %9s %8s %9.3f %10.4f %8.3f %10.2f %8s\n", text_of(row, "grip", "").c_str(),
                    text_of(row, "tap_speed_m_per_s", "").c_str(), text_of(row, "wanted_stiffness_N_per_m", "").c_str(),
                    text_of(row, "controller", "").c_str(), text_of(row, "rendered_stiffness_N_per_m", "").c_str(),
                    row["settles"].get<bool>() ? "yes" : "no", row["limit_cycle_mm"].get<double>(),
                    row["force_change_a_tick_N"].get<double>(), row["net_energy_mJ"].get<double>(),
                    row["deepest_mm"].get<double>(), text_of(row, "controller_ticks", "").c_str());
    }
    return text;
}

std::string whole_ticks_table(const std::vector<Json>& rows) {
    std::string text = line_of(
        "\nA tool that a hand presses on a plate, at rest, over bursts of lost ticks (one of thirty)\n"
        "%10s %11s %9s %14s\n",
        "pressed N", "lost ticks", "sunk mm", "force after N");
    for (const Json& row : rows) {
        if (!is_of(row, "lost ticks")) continue;
        text += line_of("%10.1f %11s %9.3f %14.3f\n", row["pressed_N"].get<double>(),
                        text_of(row, "lost_ticks", "").c_str(), row["sunk_mm"].get<double>(),
                        row["force_after_N"].get<double>());
    }
    text += line_of(
        "\nA plate that goes to and fro by 3 mm, published at random 60 to 120 times a second\n"
        "%10s %9s %9s %7s %22s\n",
        "speed m/s", "felt N", "true N", "share", "steepest rise N a tick");
    for (const Json& row : rows) {
        if (!is_of(row, "moving plate")) continue;
        const double felt_N = row["felt_N"].get<double>(), true_N = row["true_N"].get<double>();
        text += line_of("%10s %9.3f %9.3f %7.2f %22.3f\n", text_of(row, "speed_m_per_s", "").c_str(), felt_N, true_N,
                        felt_N / true_N, row["steepest_N"].get<double>());
    }
    return text;
}

plot::Plot plot_of(const std::vector<Json>& rows, const char* section, const char* key, const char* title,
                   const char* x_label) {
    plot::Plot plot{title, x_label, "stable up to, N/m", {}};
    for (const Json& row : rows) {
        if (!is_of(row, section)) continue;
        if (std::string(section) == "filter" && row["delay_ms"].get<double>() > 0.0) continue;
        const std::string name = row["grip"].get<std::string>();
        if (plot.series.empty() || plot.series.back().name != name) plot.series.push_back({name, {}});
        plot.series.back().points.push_back(
            {row[key].get<double>(), row["largest_stable_stiffness_N_per_m"].get<double>(), ""});
    }
    plot::PlotSeries published{"published, hand", {}};
    for (const Json& row : rows) {
        if (!is_of(row, section) || !is(row, "grip", "hand") || row["published_N_per_m"].is_null()) continue;
        published.points.push_back({row[key].get<double>(), row["published_N_per_m"].get<double>(), ""});
    }
    plot.series.push_back(published);
    return plot;
}

constexpr std::array kStabilityColumns{"section",
                                       "grip",
                                       "rate_Hz",
                                       "delay_ms",
                                       "force_alpha",
                                       "velocity",
                                       "wall_damping_Ns_per_m",
                                       "controller",
                                       "device_damping_Ns_per_m",
                                       "largest_stable_stiffness_N_per_m",
                                       "first_failure_N_per_m",
                                       "failing_share_above",
                                       "any_stiffness",
                                       "published_N_per_m",
                                       "theory_N_per_m",
                                       "ratio",
                                       "theory_applies",
                                       "tap_speed_m_per_s",
                                       "wanted_stiffness_N_per_m",
                                       "rendered_stiffness_N_per_m",
                                       "settles",
                                       "limit_cycle_mm",
                                       "force_change_a_tick_N",
                                       "late_force_change_a_tick_N",
                                       "net_energy_mJ",
                                       "deepest_mm",
                                       "controller_ticks"};

}  // namespace

std::string stability_table(const Stability& stability) {
    const std::vector<Json>& rows = stability.rows;
    return "An Omni (45 g, 0.05 Ns/m, 0.26 N, 0.055 mm, 3.3 N) in a simulated hand that taps at 0.1 m/s and rests with "
           "1 N; 1 "
           "kHz without delay where\nnothing else is said. Stable: it stays within two encoder steps, and its force "
           "changes "
           "by at most 0.01 N a tick. From (1 N + 0.26 N) / 0.055 mm =\n22.9 kN/m on, one encoder step throws a "
           "resting tool "
           "off. Scanned from 10 N/m to 100 kN/m in steps of 0.5 %, in a quick run of 10 %: the first stiffness that "
           "shakes,\nand how many of those from there on do, for shaking comes in windows. any: none does. published: "
           "another simulation, which does not look at the force.\n\n" +
           theory_table(rows) + sweep_table(rows, "rate", "rate_Hz", "rate, Hz") +
           sweep_table(rows, "delay", "delay_ms", "delay, ms") +
           sweep_table(rows, "filter", "force_alpha", "alpha on the force") + list_table(rows) + contact_table(rows) +
           whole_ticks_table(stability.whole_ticks) + "\n" + figure7_table(stability.figure7);
}

std::string stability_csv(const Stability& stability) {
    std::string text = "# simulated, the same on every machine; burin bench stability --csv\n";
    for (std::size_t i = 0; i < kStabilityColumns.size(); ++i)
        text += std::string(i > 0 ? "," : "") + kStabilityColumns[i];
    text += '\n';
    for (const Json& row : stability.rows) {
        for (std::size_t i = 0; i < kStabilityColumns.size(); ++i) {
            text += std::string(i > 0 ? "," : "") + text_of(row, kStabilityColumns[i], "");
        }
        text += '\n';
    }
    return text;
}

std::string stability_svg(const Stability& stability) {
    const std::vector<Json>& rows = stability.rows;
    plot::Plot filter =
        plot_of(rows, "filter", "force_alpha", "Force filter at 1 kHz, no delay", "alpha of the average");
    filter.x_linear = true;
    plot::Plot delay = plot_of(rows, "delay", "delay_ms", "Delay at 1 kHz", "delay beside the hold, ms");
    delay.x_linear = true;
    return plot::svg_figure(
        "How stiff a wall an Omni bears before it shakes",
        {plot_of(rows, "rate", "rate_Hz", "Rate, no delay", "rate of the loop, Hz"), delay, filter});
}

Json stability_json(const Stability& stability) {
    return {
        {"rows", stability.rows}, {"whole_ticks", stability.whole_ticks}, {"figure7", figure7_json(stability.figure7)}};
}

std::string figure7_table(const Figure7& figure) {
    std::string text =
        line_of("Figure 7: pressed on a ball and moved over it, %.0f N/m, %.1f Ns/m\n%32s %12s %12s %10s %8s %12s\n",
                figure.stiffness_N_per_m, figure.damping_Ns_per_m, "", "rms dF N", "mean |dF| N", "noise N", "lag ms",
                "K stable N/m");
    for (const Figure7Run& run : figure.runs) {
        const std::string stiffest = run.largest_stable_stiffness_N_per_m > 0.0
                                         ? line_of("%.0f", run.largest_stable_stiffness_N_per_m)
                                         : std::string("-");
        text += line_of("%32s %12.4f %12.4f %10.4f %8.2f %12s\n", run.name.c_str(), run.change_rms_N, run.change_mean_N,
                        run.noise_rms_N, run.lag_ms, stiffest.c_str());
    }
    return text +
           "dF: change of the force from one tick to the next; noise: against the force of the true motion, at the "
           "lag\n";
}

std::string figure7_svg(const Figure7& figure) {
    std::vector<plot::Plot> plots;
    for (const Figure7Run& run : figure.runs) {
        plot::Plot plot{run.name, "time, s", "force, N", {{"x", {}}, {"y", {}}, {"z", {}}}};
        plot.x_linear = plot.y_linear = true;
        plot.markers = false;
        for (const Figure7Run& any : figure.runs) {
            for (const Vec3& f : any.forces_N) {
                plot.y_lowest = std::min({plot.y_lowest, f.x, f.y, f.z});
                plot.y_highest = std::max({plot.y_highest, f.x, f.y, f.z});
            }
        }
        for (std::size_t i = 0; i < run.forces_N.size(); ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                plot.series[static_cast<std::size_t>(axis)].points.push_back(
                    {figure.tick_s * static_cast<double>(i), run.forces_N[i][axis], ""});
            }
        }
        plots.push_back(plot);
    }
    return plot::svg_figure("Components of the force on a ball, without and with a filter", plots);
}

Json figure7_json(const Figure7& figure) {
    Json runs = Json::array();
    for (const Figure7Run& run : figure.runs) {
        runs.push_back({{"name", run.name},
                        {"force_alpha", run.signals.force_alpha},
                        {"force_change_rms_N", run.change_rms_N},
                        {"force_change_mean_N", run.change_mean_N},
                        {"noise_rms_N", run.noise_rms_N},
                        {"lag_ms", run.lag_ms}});
        if (run.largest_stable_stiffness_N_per_m > 0.0) {
            runs.back()["largest_stable_stiffness_N_per_m"] = run.largest_stable_stiffness_N_per_m;
        }
    }
    return {
        {"stiffness_N_per_m", figure.stiffness_N_per_m}, {"damping_Ns_per_m", figure.damping_Ns_per_m}, {"runs", runs}};
}

}  // namespace burin::bench
