// SPDX-License-Identifier: MIT
// A study of two groups whose trials last some seconds, and scripts of visits in which everything is lost once.
#pragma once

#include <cmath>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "base/space.hpp"
#include "base/text.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::study {

inline const std::string kLostStudy = std::string(kBurinCommand) + " study ";

// Two worlds of 17 points each, by their middles: an arc, and a wave that lies lower.
inline Vec3 on_spine(const std::string& world, double x_m) {
    const double bend = std::cos(std::numbers::pi * x_m / 0.3), wave = std::sin(2.0 * std::numbers::pi * x_m / 0.3);
    return world == "arc" ? Vec3(x_m, 0.165 + 0.05 * bend, 0.06 - 0.1 * bend)
                          : Vec3(x_m, 0.2 - 0.03 * bend, -0.02 + 0.03 * wave);
}

// `stages`: as a day has them, such as "\"test\", \"transfer\""; several days: a line each.
inline std::string lost_protocol(const std::vector<std::string>& days) {
    std::string text =
        "format = 1\nname = \"lost\"\nconsent = \"v2\"\n[limits]\nforce_N = 2.0\n"
        "[[group]]\ncode = \"touch\"\nfeels_tube = true\n[[group]]\ncode = \"sight\"\nsees_tube = true\n";
    for (const std::string world : {"arc", "wave"}) {
        text += "[[world]]\nname = \"" + world +
                "\"\ntube_radius_m = 0.045\ncap_half_width_m = 0.068\ncap_depth_m = 0.03\nfunnel_half_width_m = "
                "0.045\nspine_m = [\n";
        for (int i = 0; i <= 16; ++i) {
            const Vec3 at_m = on_spine(world, -0.15 + 0.3 * i / 16.0);
            text += formatted("[%.6f, %.6f, %.6f],\n", at_m.x, at_m.y, at_m.z);
        }
        text += "]\n";
    }
    for (const auto& [name, world] : {std::pair{"before", "arc"}, std::pair{"test", "arc"}, {"transfer", "wave"}})
        text += formatted(
            "[[stage]]\nname = \"%s\"\nkind = \"trial\"\nworld = \"%s\"\nends_at_exit = true\n"
            "attempts = 3\noutcome = %s\n",
            name, world, std::string(name) == "before" ? "false" : "true");
    for (std::size_t day = 0; day < days.size(); ++day)
        text += "[[day]]\nstages = [" + days[day] + "]\n" + (day > 0 ? "most_delay_h = 48\n" : "");
    return text;
}

// What a participant's hand does and what the operator says, each after the other.
class LostVisit {
public:
    LostVisit& say(const std::string& words) {
        time_s_ += 0.1;
        text_ += formatted("%.3f %s\n", time_s_, words.c_str());
        time_s_ += 0.1;
        return *this;
    }
    // Into the start cap, which lies beyond the first point.
    LostVisit& come(const std::string& world) {
        world_ = world;
        move(0.0, 0.3, 0.4, 0.0);
        return in_cap(1.0);
    }
    LostVisit& in_cap(double seconds) {
        const Vec3 first = on_spine(world_, -0.15), next = on_spine(world_, -0.13125);
        return rest(first - 0.014 * glm::normalize(next - first), seconds);
    }
    // Along the path and beyond its end.
    LostVisit& through() {
        along(-0.15, 0.15);
        const Vec3 last = on_spine(world_, 0.15), before = on_spine(world_, 0.13125);
        return rest(last + 0.014 * glm::normalize(last - before), 1.0);
    }
    LostVisit& along(double from_m, double to_m) {
        for (int i = 0; i <= 16; ++i) {
            const Vec3 at_m = on_spine(world_, from_m + (to_m - from_m) * i / 16.0);
            move(at_m.x, at_m.y, at_m.z, 0.1);
        }
        return *this;
    }
    // Goes in and comes back, which fails the attempt as often as it is done.
    LostVisit& goes_back(int times) {
        for (int i = 0; i < times; ++i) along(-0.15, -0.06).along(-0.06, -0.15).in_cap(0.6).in_cap(0.6);
        return *this;
    }
    // The operator does what takes an attempt back; then the hand stands in the start cap again.
    LostVisit& taken_back(const std::string& by) {
        along(-0.15, -0.06).say(by).along(-0.06, -0.15).in_cap(0.6);
        return by == "pause" ? say("go on").in_cap(0.6).in_cap(0.6) : in_cap(0.6);
    }
    [[nodiscard]] std::string text() const { return "burin-study-input 1\n0.000 hand -0.1598 0.1599 0.0702\n" + text_; }

private:
    LostVisit& rest(const Vec3& at_m, double seconds) {
        move(at_m.x, at_m.y, at_m.z, 0.5 * seconds);
        move(at_m.x, at_m.y, at_m.z, 0.5 * seconds);
        return *this;
    }
    void move(double x_m, double y_m, double z_m, double seconds) {
        time_s_ += seconds;
        text_ += formatted("%.3f hand %.6f %.6f %.6f\n", time_s_, x_m, y_m, z_m);
    }

    double time_s_ = 0.2;
    std::string text_, world_ = "arc";
};

// The rows of a table by their columns' names; comments are left out. No field of it holds a comma in quotes but
// `reason`, whose commas stand between double quotes.
inline std::vector<std::map<std::string, std::string>> rows_of_csv(const std::string& csv) {
    std::vector<std::string> names;
    std::vector<std::map<std::string, std::string>> rows;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with('#')) continue;
        std::vector<std::string> fields(1);
        bool quoted = false;
        for (const char c : line) {
            if (c == '"')
                quoted = !quoted;
            else if (c == ',' && !quoted)
                fields.emplace_back();
            else
                fields.back() += c;
        }
        if (names.empty()) {
            names = fields;
            continue;
        }
        auto& row = rows.emplace_back();
        for (std::size_t i = 0; i < fields.size(); ++i) row[names.at(i)] = fields[i];
    }
    return rows;
}

// Makes the study s with p01 (sight), p02 (touch), p03 (sight), p04 (touch): so the seed has it.
inline void make_lost_study(const Workplace& place, const std::vector<std::string>& days) {
    place.write("p.toml", lost_protocol(days));
    ASSERT_EQ(place.run(kLostStudy + "init p.toml s --participants 4 --seed 7").status, 0);
    for (const char* id : {"p01", "p02", "p03", "p04"}) ASSERT_EQ(place.run(kLostStudy + "enrol s " + id).status, 0);
}

inline Workplace::Outcome visit_by(const Workplace& place, const std::string& id, const LostVisit& visit) {
    place.write("visit.txt", visit.text());
    return place.run(kLostStudy + "run s --participant " + id + " --input visit.txt");
}

}  // namespace burin::study
