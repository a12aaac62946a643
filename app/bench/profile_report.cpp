// SPDX-License-Identifier: MIT
#include <array>
#include <cstdio>
#include <utility>

#include "app/bench/profile.hpp"
#include "app/carve/report.hpp"

namespace burin::app {
namespace {

double ms(Nanoseconds t_ns) { return 1e3 * seconds(t_ns); }

Json in_ms(const session::FigureSummary& summary) {
    if (summary.count == 0) return nullptr;
    return {{"median", ms(summary.median_ns)}, {"p99", ms(summary.p99_ns)}, {"worst", ms(summary.most_ns)}};
}

Json in_us(const session::FigureSummary& summary) {
    if (summary.count == 0) return nullptr;
    return {{"median", 1e3 * ms(summary.median_ns)},
            {"p99", 1e3 * ms(summary.p99_ns)},
            {"worst", 1e3 * ms(summary.most_ns)}};
}

template <typename Of>
session::FigureSummary summary_of(const std::vector<session::TimedFrame>& frames, const Of& of) {
    std::vector<Nanoseconds> values;
    for (const session::TimedFrame& frame : frames)
        if (const std::optional<Nanoseconds> value = of(frame)) values.push_back(*value);
    return session::summarised(std::move(values));
}

Json stages_of(const std::vector<session::TimedFrame>& frames) {
    Json stages;
    for (std::size_t i = 0; i < session::kFrameStages; ++i) {
        stages[name_of(static_cast<session::FrameStage>(i))] =
            in_ms(summary_of(frames, [i](const session::TimedFrame& f) { return std::optional(f.stage_ns[i]); }));
    }
    return stages;
}

Json ages_of_all(const std::vector<session::TimedFrame>& frames) {
    Json ages;
    for (std::size_t i = 0; i < session::kFrameFigures; ++i) {
        const auto figure = static_cast<session::FrameFigure>(i);
        ages[name_of(figure)] = in_ms(
            summary_of(frames, [figure](const session::TimedFrame& f) { return session::worse_eye(f.ages, figure); }));
    }
    return ages;
}

// Names an activity of a person with a mouse, how its frames are recognised, and the frame rate aimed at for it.
struct Doing {
    const char* name;
    double aim_per_s;
    bool (*is)(const session::FrameMotion&);
};
constexpr std::array kDoings{
    Doing{"turning", 30.0, [](const session::FrameMotion& m) { return m.view; }},
    Doing{"carving", 25.0, [](const session::FrameMotion& m) { return !m.view && m.works; }},
    Doing{"looking", 30.0, [](const session::FrameMotion& m) { return !m.view && !m.works && m.tool; }},
};
// From the click until its cut is seen: so many frames at most, of those that are drawn while carving.
constexpr double kMostFramesOfAClick = 2.0;

Json describe_doing(const std::vector<session::TimedFrame>& all, const Doing& doing) {
    std::vector<session::TimedFrame> frames;
    std::size_t followed = 0;  // frames whose time since the frame before is known
    Nanoseconds together_ns = 0;
    for (const session::TimedFrame& frame : all) {
        if (!doing.is(frame.motion)) continue;
        frames.push_back(frame);
        const auto time_ns = session::worse_eye(frame.ages, session::FrameFigure::frame_time);
        if (!time_ns) continue;
        ++followed;
        together_ns += *time_ns;
    }
    Json json{{"frames", frames.size()}, {"aim_per_s", doing.aim_per_s}};
    json["drawn_per_s"] = together_ns > 0 ? Json(static_cast<double>(followed) / seconds(together_ns)) : Json(nullptr);
    json["frame_ms"] = in_ms(summary_of(frames, [](const session::TimedFrame& f) {
        return session::worse_eye(f.ages, session::FrameFigure::frame_time);
    }));
    json["processor_ms"] =
        in_ms(summary_of(frames, [](const session::TimedFrame& f) { return std::optional(f.processor_ns); }));
    return json;
}

Json describe_clicks(const std::vector<session::TimedFrame>& frames, const Json& carving) {
    Json json = in_ms(summary_of(frames, [](const session::TimedFrame& f) { return f.click_ns; }));
    if (json.is_null() || carving["frame_ms"].is_null()) return json;
    json["aim_frames"] = kMostFramesOfAClick;
    json["frames"] = json["median"].get<double>() / carving["frame_ms"]["median"].get<double>();
    return json;
}

std::string line(const char* format, auto... values) {
    std::array<char, 256> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

std::string row(const std::string& name, const Json& figure) {
    if (figure.is_null()) return line("  %-22s%12s%12s%12s\n", name.c_str(), "-", "-", "-");
    return line("  %-22s%12.2f%12.2f%12.2f\n", name.c_str(), figure["median"].get<double>(),
                figure["p99"].get<double>(), figure["worst"].get<double>());
}

std::string rows(const Json& figures) {
    std::string text;
    for (const auto& [name, figure] : figures.items()) text += row(name, figure);
    return text;
}

std::string heading(const char* title) { return line("%-24s%12s%12s%12s\n", title, "median", "p99", "worst"); }

// Returns what a person's doings were given beside what is aimed at.
std::string doings(const Json& run) {
    std::string text =
        line("%-24s%12s%12s%12s%20s\n", "a person's frames", "a second", "aim", "median, ms", "processor, ms");
    for (const auto& [name, doing] : run["doing"].items()) {
        if (doing["drawn_per_s"].is_null()) continue;
        text += line("  %-22s%12.1f%12.0f%12.2f%20.2f\n", name.c_str(), doing["drawn_per_s"].get<double>(),
                     doing["aim_per_s"].get<double>(), doing["frame_ms"]["median"].get<double>(),
                     doing["processor_ms"]["median"].get<double>());
    }
    const Json& click = run["click_to_cut_ms"];
    if (!click.is_null() && click.contains("frames"))
        text +=
            line("  from a click until its cut is seen: %.2f ms in the median, %.2f at worst; %.1f frames, aim %.0f\n",
                 click["median"].get<double>(), click["worst"].get<double>(), click["frames"].get<double>(),
                 click["aim_frames"].get<double>());
    return text + "\n";
}

// Returns what carving and drawing asked of the device, and carving for an update; empty without either.
std::string asked_of_device(const Json& run) {
    const Json engine = run["engine"].value("traffic", Json()), picture = run.value("picture", Json());
    if (engine.is_null() && picture.is_null()) return {};
    const double updates = run["engine"].value("updates", 0.0), rays = run["engine"].value("rays_changed", 0.0);
    const auto for_an_update = [updates](double all) { return updates > 0.0 ? line("%.1f", all / updates) : "-"; };
    const auto cell = [](const Json& traffic, const char* key) {
        return traffic.is_null() ? std::string("-") : std::to_string(traffic[key].get<std::uint64_t>());
    };
    std::string text = line("\n%-24s%12s%16s%12s\n", "asked of the device", "to carve", "for an update", "to draw");
    for (const auto& [key, title] :
         {std::pair{"submissions", "submissions"}, std::pair{"blocking_waits", "blocking waits"},
          std::pair{"bytes_to_device", "bytes to the device"}, std::pair{"bytes_to_host", "bytes to the host"}}) {
        const std::string an_update = engine.is_null() ? "-" : for_an_update(engine[key].get<double>());
        text += line("  %-22s%12s%16s%12s\n", title, cell(engine, key).c_str(), an_update.c_str(),
                     cell(picture, key).c_str());
    }
    text += line("  %-22s%12s%16s%12s\n", "most memory, bytes", cell(engine, "most_memory_bytes").c_str(), "",
                 cell(picture, "most_memory_bytes").c_str());
    return text + line("  %-22s%12.0f%16s   in %.0f updates, by the engine %s\n", "rays changed", rays,
                       for_an_update(rays).c_str(), updates, run["engine"]["name"].get<std::string>().c_str());
}

double number(const Json& figure, const char* key) { return figure.is_null() ? 0.0 : figure[key].get<double>(); }

}  // namespace

Json describe_run(const ProfiledRun& run) {
    const session::SessionRecord& r = run.record;
    const double wall_s = seconds(r.wall_ns);
    Json json;
    json["device"] = r.device;
    json["driver_threads"] = run.driver_threads ? Json(*run.driver_threads) : Json(nullptr);
    json["seconds"] = wall_s;
    json["frames"] = {{"drawn", r.frames.size()},
                      {"skipped", r.skipped},
                      {"drawn_per_s", wall_s > 0.0 ? static_cast<double>(r.frames.size()) / wall_s : 0.0}};
    json["stages_ms"] = stages_of(r.frames);
    json["carve_update_ms"] = in_ms(r.carve_update);
    json["engine"] = {{"name", r.engine}, {"updates", r.updates}, {"rays_changed", r.rays_changed}};
    if (r.engine_traffic) json["engine"]["traffic"] = describe_traffic(*r.engine_traffic);
    if (r.picture_traffic) json["picture"] = describe_traffic(*r.picture_traffic);
    json["processor_ms"] =
        in_ms(summary_of(r.frames, [](const session::TimedFrame& f) { return std::optional(f.processor_ns); }));
    json["cores_busy"] = wall_s > 0.0 ? seconds(r.processor_ns) / wall_s : 0.0;
    const double rested_s = seconds(r.rested_ns);
    json["at_rest"] = {{"seconds", rested_s},
                       {"cores_busy", rested_s > 0.0 ? seconds(r.rested_processor_ns) / rested_s : 0.0}};
    json["ages_ms"] = ages_of_all(r.frames);
    json["ticks"] = {{"count", r.ticks},
                     {"late", r.late_ticks},
                     {"missed_deadlines", r.missed_deadlines},
                     {"machine_pace", r.machine_pace},
                     {"lost_targets", r.lost_targets},
                     {"duration_us", in_us(r.tick_duration)},
                     {"lateness_us", in_us(r.tick_lateness)}};
    for (const Doing& doing : kDoings) json["doing"][doing.name] = describe_doing(r.frames, doing);
    json["click_to_cut_ms"] = describe_clicks(r.frames, json["doing"]["carving"]);
    json["warnings"] = r.warnings;
    return json;
}

std::string profile_table(const Json& run) {
    const Json &frames = run["frames"], &ticks = run["ticks"];
    std::string text = line("%s", run["device"].get<std::string>().c_str());
    if (!run["driver_threads"].is_null()) text += line(", driver threads: %u", run["driver_threads"].get<unsigned>());
    text += line("\n%.1f s, %zu frames drawn (%.1f a second), %zu skipped, %.2f cores busy\n\n",
                 run["seconds"].get<double>(), frames["drawn"].get<std::size_t>(), frames["drawn_per_s"].get<double>(),
                 frames["skipped"].get<std::size_t>(), run["cores_busy"].get<double>());
    if (const Json& rest = run["at_rest"]; rest["seconds"].get<double>() > 0.0) {
        text.pop_back();
        text += line("at rest for %.1f s of these, with %.2f %% of a core\n\n", rest["seconds"].get<double>(),
                     100.0 * rest["cores_busy"].get<double>());
    }
    text += doings(run) + heading("a frame, ms") + rows(run["stages_ms"]) +
            row("processor, all threads", run["processor_ms"]);
    text += row("carving, beside it", run["carve_update_ms"]);
    text += asked_of_device(run);
    text += "\n" + heading("when seen, ms") + rows(run["ages_ms"]);
    text += "\n" + heading("1 kHz loop, us") + row("tick", ticks["duration_us"]) + row("late by", ticks["lateness_us"]);
    text += line("  %zu ticks, %zu late, %zu deadlines missed\n", ticks["count"].get<std::size_t>(),
                 ticks["late"].get<std::size_t>(), ticks["missed_deadlines"].get<std::size_t>());
    text +=
        line("  contact takes this machine %.2f times as long as the reference core; %zu targets of the hand lost\n",
             ticks["machine_pace"].get<double>(), ticks["lost_targets"].get<std::size_t>());
    for (const Json& warning : run["warnings"]) text += "\nwarning: " + warning.get<std::string>();
    if (!run["warnings"].empty()) text += "\n";
    return text;
}

std::string comparison_table(const std::vector<Json>& runs) {
    if (runs.size() < 2) return {};
    std::string text = "driver threads   frames/s   draw, ms   late by, us: median       p99     worst   missed\n";
    for (const Json& run : runs) {
        const Json& late = run["ticks"]["lateness_us"];
        const std::string threads =
            run["driver_threads"].is_null() ? "-" : std::to_string(run["driver_threads"].get<unsigned>());
        text += line("%14s%11.1f%11.2f%22.1f%10.1f%10.1f%9zu\n", threads.c_str(),
                     run["frames"]["drawn_per_s"].get<double>(), number(run["stages_ms"]["draw"], "median"),
                     number(late, "median"), number(late, "p99"), number(late, "worst"),
                     run["ticks"]["missed_deadlines"].get<std::size_t>());
    }
    return text;
}

}  // namespace burin::app
