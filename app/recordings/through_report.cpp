// SPDX-License-Identifier: MIT
#include "app/recordings/through_report.hpp"

#include <algorithm>
#include <cstdio>

#include "activities/replay/through_table.hpp"
#include "app/cli/output_files.hpp"
#include "app/recordings/recording_kinds.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "record/examination.hpp"

namespace burin::app {
namespace {

constexpr const char* kProgram = "burin " BURIN_VERSION;

std::string place_mm(const Vec3& p) { return formatted("(%g, %g, %g) mm", 1e3 * p.x, 1e3 * p.y, 1e3 * p.z); }

// Says how near a point came that touched nothing, and why it may have touched nothing where it came to a surface.
std::string why_nothing(const activities::ThroughPoint& point) {
    if (point.came_nearest.empty()) return "";
    if (point.came_nearest_m > 0.0)
        return formatted("; it came within %.3g mm of %s", 1e3 * point.came_nearest_m, point.came_nearest.c_str());
    return "; it came to " + point.came_nearest +
           ", and a proxy that begins outside a surface does not touch it from inside";
}

void print_point(const activities::ThroughFigures& f, const activities::ThroughPoint& point) {
    const std::string proxy = point.name.empty() ? "the proxy" : "the proxy of " + point.name;
    std::printf("  %s begins at the hand, at tick %lld, %s", proxy.c_str(), static_cast<long long>(f.first_tick),
                place_mm(point.begins_scene_m).c_str());
    if (point.begins_inside) std::printf(", inside material, and is moved out");
    if (!point.nearest.empty() && !point.begins_inside) {
        if (point.nearest_m < 0.0)
            std::printf(", where the ball overlaps %s by %.3g mm", point.nearest.c_str(), -1e3 * point.nearest_m);
        else
            std::printf(", outside, %.3g mm from %s", 1e3 * point.nearest_m, point.nearest.c_str());
    }
    std::printf("\n    ");
    if (point.first_contact_tick)
        std::printf("touches %s first, at tick %lld; in contact for %llu of %llu ticks\n",
                    point.first_contact.empty() ? "a surface" : point.first_contact.c_str(),
                    static_cast<long long>(*point.first_contact_tick),
                    static_cast<unsigned long long>(point.ticks_in_contact), static_cast<unsigned long long>(f.ticks));
    else
        std::printf("touches nothing%s\n", why_nothing(point).c_str());
}

void print_through(const activities::ThroughFigures& f, bool has_torque) {
    double proxies_m = 0.0;
    for (const activities::ThroughPoint& point : f.points) {
        print_point(f, point);
        proxies_m = std::max(proxies_m, point.proxy_deviation_max_m);
    }
    std::printf("  largest force %.3g N; from the recording at most %.3g N and %s %.3g mm away\n", f.force_max_N,
                f.force_deviation_max_N, f.points.size() > 1 ? "a proxy" : "the proxy", 1e3 * proxies_m);
    if (has_torque)
        std::printf("  largest torque %.3g N mm; from the recording at most %.3g N mm\n", 1e3 * f.torque_max_Nm,
                    1e3 * f.torque_deviation_max_Nm);
}

Json point_json(const activities::ThroughPoint& point) {
    const Vec3& begins = point.begins_scene_m;
    Json json{{"name", point.name},
              {"begins_scene_m", Json::array({begins.x, begins.y, begins.z})},
              {"begins_inside", point.begins_inside},
              {"nearest", point.nearest},
              {"nearest_m", point.nearest_m},
              {"ticks_in_contact", point.ticks_in_contact},
              {"first_contact", point.first_contact},
              {"force_max_N", point.force_max_N},
              {"proxy_deviation_max_m", point.proxy_deviation_max_m}};
    json["came_nearest"] = point.first_contact_tick ? Json() : Json(point.came_nearest);
    json["came_nearest_m"] = point.first_contact_tick ? Json() : Json(point.came_nearest_m);
    json["first_contact_tick"] = point.first_contact_tick ? Json(*point.first_contact_tick) : Json();
    return json;
}

Json through_json(const activities::ThroughFigures& f, bool has_torque) {
    Json json{{"ticks", f.ticks},
              {"ticks_in_contact", f.ticks_in_contact},
              {"ticks_pushed_out", f.ticks_pushed_out},
              {"first_tick", f.first_tick},
              {"force_max_N", f.force_max_N},
              {"force_deviation_max_N", f.force_deviation_max_N},
              {"points", Json::array()}};
    if (has_torque) {
        json["torque_max_Nm"] = f.torque_max_Nm;
        json["torque_deviation_max_Nm"] = f.torque_deviation_max_Nm;
    }
    for (const activities::ThroughPoint& point : f.points) json["points"].push_back(point_json(point));
    return json;
}

// Returns the radius of the balls that touched.
Result<double> recorded_radius_m(const record::RecordReader& reader) {
    std::optional<double> ball_m;
    if (const auto kind = kind_of(reader)) {
        BURIN_TRY(own_m, (*kind)->ball_radius_m(reader));
        ball_m = own_m;
    }
    if (ball_m) return *ball_m;
    return fail(reader.path(), "does not say how large the ball was that touched", "give it by --radius METRES");
}

}  // namespace

Result<void> replay_through(const ThroughReplay& options) {
    BURIN_TRY_DO(activities::check_is_of_no_study(options.file));
    BURIN_TRY(reader, record::RecordReader::open(options.file));
    BURIN_TRY_DO(record::check_ticks(reader, options.range));
    BURIN_TRY(radius_m, options.radius_m ? Result<double>(*options.radius_m) : recorded_radius_m(reader));
    BURIN_TRY(made, activities::feel_into_table(reader,
                                                {options.world, radius_m, options.materials, options.range, kProgram}));
    Json report{{"file", options.file}, {"through", options.world}, {"table", made.name}, {"program", kProgram}};
    report["was_there"] = made.was_there;
    report["figures"] = through_json(made.figures, made.has_torque);
    BURIN_TRY_DO(write_output(options.json, json_text(report)));
    if (options.json == kStandardOutput) return {};
    std::printf("%s: %llu ticks, %zu columns: %s\n", options.file.c_str(),
                static_cast<unsigned long long>(made.figures.ticks), made.columns,
                made.was_there ? "equal to the bit with the derived table that is there" : "a new derived table");
    std::printf("  %s, by %s\n", made.name.c_str(), kProgram);
    print_through(made.figures, made.has_torque);
    return {};
}

}  // namespace burin::app
