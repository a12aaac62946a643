// SPDX-License-Identifier: MIT
// Writes the cost of drawing as table, CSV and JSON.
#include <algorithm>
#include <array>
#include <cstdio>

#include "base/statistics.hpp"
#include "bench/frame/frame.hpp"

namespace burin::bench {
namespace {

constexpr std::array<std::pair<const char*, const char*>, 2> kPeers{
    {{"OpenSceneGraph", "own_over_osg"}, {"VTK", "own_over_vtk"}}};

template <typename... Values>
std::string line(const char* format, Values... values) {
    std::array<char, 320> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

Json row_of(const FrameReport& report, const FrameTimes& t) {
    Json row = {{"subject", t.subject},
                {"scene", name_of(t.motion)},
                {"triangles", report.triangles},
                {"samples", report.options.samples},
                {"frames", t.cpu_ms.size()},
                {"cpu_min_ms", least(t.cpu_ms)},
                {"cpu_median_ms", median(t.cpu_ms)},
                {"cpu_p99_ms", quantile(t.cpu_ms, 0.99)},
                {"wall_min_ms", least(t.wall_ms)},
                {"wall_median_ms", median(t.wall_ms)},
                {"wall_p99_ms", quantile(t.wall_ms, 0.99)},
                {"coverage", t.coverage},
                {"expected_coverage", t.expected_coverage},
                {"lit_at", name_of(t.way.lit_at)},
                {"light", name_of(t.way.light)},
                {"levels", t.way.levels},
                {"levels_patches", t.way.levels ? Json(t.levels.patches) : Json()},
                {"levels_ms", t.way.levels ? Json(t.levels.cpu_ms) : Json()},
                {"levels_after_patches", t.way.levels ? Json(t.levels_after.patches) : Json()},
                {"levels_after_ms", t.way.levels ? Json(t.levels_after.cpu_ms) : Json()},
                {"flip_from_own", t.flip_from_own ? Json(*t.flip_from_own) : Json()},
                {"note", t.note}};
    return row;
}

// Returns a CSV field; one with a comma or quote is quoted (RFC 4180).
std::string csv_field(const Json& value) {
    if (value.is_null()) return {};
    if (!value.is_string()) return value.dump();
    const auto text = value.get<std::string>();
    if (text.find_first_of(",\"") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

std::string counters_line(const FrameTimes& t) {
    std::string text;
    for (const auto& [name, value] : t.counters)
        text += line("%s%s %.0f", text.empty() ? "" : ", ", name.c_str(), value);
    return text;
}

// Calls row(scene, comparison, peer's key, peer, ratio) for each ratio that was measured.
template <typename Row>
void for_each_ratio(const FrameReport& report, Row row) {
    for (const FrameMotion motion : report.options.motions)
        for (const FrameComparison& compared : kComparisons)
            for (const auto& [peer, key] : kPeers)
                if (const auto ratio = own_over_peer(report, motion, peer, compared))
                    row(name_of(motion), compared.name, key, peer, *ratio);
}

Json ratios(const FrameReport& report) {
    Json all = Json::array();
    for_each_ratio(report, [&](const std::string& scene, const char* compared, const char* key, const char*, double r) {
        if (all.empty() || all.back()["scene"] != scene || all.back()["compared"] != compared)
            all.push_back({{"scene", scene}, {"compared", compared}});
        all.back()[key] = r;
    });
    return all;
}

std::string ratio_lines(const FrameReport& report) {
    std::string text;
    for_each_ratio(report,
                   [&](const std::string& scene, const char* compared, const char*, const char* peer, double r) {
                       text += line("%s, %s: Burin uses %.3f of what %s uses\n", scene.c_str(), compared, r, peer);
                   });
    return text;
}

// Says what is not in the frames' times: levels of detail, made anew in the first warm-up, and after the frames.
std::string levels_lines(const FrameReport& report) {
    std::string text;
    for (const FrameTimes& t : report.times) {
        if (t.levels.patches + t.levels_after.patches == 0) continue;
        text += line(
            "%s, %s, %s: levels of detail of %.0f patches made before in %.1f ms, %.1f frames' worth; of %.0f "
            "after, %.2f ms a frame\n",
            t.subject.c_str(), name_of(t.way).c_str(), name_of(t.motion).c_str(), static_cast<double>(t.levels.patches),
            t.levels.cpu_ms, t.levels.cpu_ms / median(t.cpu_ms), static_cast<double>(t.levels_after.patches),
            t.levels_after.cpu_ms / static_cast<double>(t.cpu_ms.size()));
    }
    return text;
}

constexpr const char* kHowPicturesDiffer =
    "FLIP is that from the picture of Burin as set up. Simple light has one lamp and a constant, written as it is; "
    "Burin's\nhas lamp, sky and room, in sRGB: most of what FLIP finds is that, and goes where a peer is given Burin's "
    "light. At pixels\nBurin also computes the tool's ring and shadow, which peers do not. Peers draw all triangles, "
    "no "
    "levels of detail.\n";

}  // namespace

std::string frame_table(const FrameReport& report) {
    std::string text = report.machine + "\nBurin on " + report.device + "\n";
    text += line(
        "%zu triangles in %zu patches, 2 x 1280 x 720, %u sample%s a pixel; ms a frame of processor time, and of "
        "wall\n\n",
        report.triangles, report.patches, report.options.samples, report.options.samples == 1 ? "" : "s");
    text += line("%-29s %-8s %-8s %-8s %-7s %8s %8s %8s | %8s %8s | %8s %7s\n", "", "scene", "lit at", "light", "drawn",
                 "min", "median", "p99", "median", "p99", "covered", "FLIP");
    for (const FrameTimes& t : report.times) {
        text += line("%-29s %-8s %-8s %-8s %-7s %8.2f %8.2f %8.2f | %8.2f %8.2f | %6.1f %%", t.subject.c_str(),
                     name_of(t.motion).c_str(), name_of(t.way.lit_at).c_str(), name_of(t.way.light).c_str(),
                     t.way.levels ? "levels" : "all", least(t.cpu_ms), median(t.cpu_ms), quantile(t.cpu_ms, 0.99),
                     median(t.wall_ms), quantile(t.wall_ms, 0.99), 100.0 * t.coverage);
        text += t.flip_from_own ? line(" %7.3f\n", *t.flip_from_own) : "\n";
    }
    text += "\n";
    for (const FrameTimes& t : report.times) {
        if (!t.counters.empty())
            text +=
                t.subject + ", " + name_of(t.way) + ", " + name_of(t.motion) + ", a frame: " + counters_line(t) + "\n";
    }
    text += ratio_lines(report) + levels_lines(report);
    if (report.options.osg || report.options.vtk) text += kHowPicturesDiffer;
    std::vector<std::string> notes;  // each note once
    for (const FrameTimes& t : report.times) {
        const std::string note = t.subject + ": " + t.note + "\n";
        if (!t.note.empty() && std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
    }
    for (const std::string& note : notes) text += note;
    if (report.idle)
        text += line("idle: %.3f %% of a core over %.1f s\n", 100.0 * report.idle->cpu_share, report.idle->seconds);
    if (report.first)
        text += line("first picture: %.0f ms after the start (%.0f ms of processor time), without making the surface\n",
                     report.first->wall_ms, report.first->cpu_ms);
    for (const std::string& why : report.left_out) text += "left out: " + why + "\n";
    return text;
}

std::string frame_csv(const FrameReport& report) {
    std::string text = "# " + report.machine + "; Burin on " + report.device + "\n";
    for (std::size_t i = 0; i < report.times.size(); ++i) {
        std::string names, values;
        const Json row = row_of(report, report.times[i]);
        for (const auto& [name, value] : row.items()) {
            names += (names.empty() ? "" : ",") + name;
            values += (values.empty() ? "" : ",") + csv_field(value);
        }
        if (i == 0) text += names + "\n";
        text += values + "\n";
    }
    return text;
}

std::string ratio_rows(const FrameReport& report, const std::string& driver_threads, bool with_names) {
    std::string text;
    if (with_names)
        text =
            "triangles,samples,driver_threads,scene,compared,peer,own_over_peer,levels_ms,levels_in_frames,machine\n";
    const auto made = std::ranges::find_if(report.times, [](const FrameTimes& t) { return t.levels.patches > 0; });
    const std::string levels =
        made == report.times.end() ? "," : line("%.1f,%.2f", made->levels.cpu_ms, *levels_in_frames(report));
    for_each_ratio(report, [&](const std::string& scene, const char* compared, const char*, const char* peer,
                               double r) {
        text += line("%zu,%u,", report.triangles, report.options.samples) + csv_field(driver_threads) + "," + scene +
                "," + compared + "," + peer + line(",%.4f,", r) + levels + "," + csv_field(report.machine) + "\n";
    });
    return text;
}

Json frame_json(const FrameReport& report) {
    Json json = {{"machine", report.machine},
                 {"device", report.device},
                 {"triangles", report.triangles},
                 {"patches", report.patches},
                 {"samples", report.options.samples}};
    json["times"] = Json::array();
    for (const FrameTimes& t : report.times) {
        Json row = row_of(report, t);
        for (const auto& [name, value] : t.counters) row["counters"][name] = value;
        json["times"].push_back(row);
    }
    json["ratios"] = ratios(report);
    if (const auto frames = levels_in_frames(report)) json["levels_in_frames"] = *frames;
    if (report.idle) json["idle"] = {{"seconds", report.idle->seconds}, {"cpu_share", report.idle->cpu_share}};
    if (report.first) json["first_picture"] = {{"wall_ms", report.first->wall_ms}, {"cpu_ms", report.first->cpu_ms}};
    json["left_out"] = report.left_out;
    return json;
}

}  // namespace burin::bench
