// SPDX-License-Identifier: MIT
// A study's protocol: who does what, on which path, in which order, and when a trial counts. Read from TOML
// (docs/study.md); a text's faults are found all at once. SI units; the frame is the world's. Pure but for
// read_protocol; any thread; allocates no more than the text asks for, which is at most kMostProtocolBytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/space.hpp"

namespace burin::study {

// What a person sees and feels of the tube.
struct Group {
    std::string code;  // letters, digits, hyphen, underscore
    unsigned ratio = 1;
    bool sees_tube = false, feels_tube = false;  // in training; in a trial nobody does
};

// A property by which groups are balanced, told by codes that name nobody.
struct Stratum {
    std::string name;
    std::vector<std::string> codes;  // at least two
};

// A tube around a polyline; it begins at the first point of the spine and ends at the last.
struct StudyWorld {
    std::string name;
    std::vector<Vec3> spine_m;  // at least two
    double tube_radius_m = 0.0;
    double cap_half_width_m = 0.0;                     // of the square caps at both ends
    double cap_depth_m = 0.02;                         // how deep they are sensed, away from the tube
    double funnel_half_width_m = 0.0;                  // of the narrow end of the funnels; 0: no funnels
    double wall_N_per_m = 600.0, wall_Ns_per_m = 0.5;  // of tube and funnels, where they are felt
};

enum class StageKind { page, show_model, free_training, led_training, trial };
[[nodiscard]] const char* name_of(StageKind kind);

struct Stage {
    std::string name;
    StageKind kind = StageKind::page;
    std::string world;      // empty for a page
    std::string page_text;  // what a page says
    // Any of them ends the stage.
    std::optional<double> ends_after_s;
    bool ends_at_exit = false;  // the end cap, reached properly
    bool ends_by_operator = false;
    bool sees_world = true, sees_wand = true, feels_world = true, records = true;
    unsigned attempts = 1;                             // of a trial
    bool outcome = false;                              // of a trial: its row goes into the analysis
    double guidance_first = 1.0, guidance_last = 1.0;  // shares of guidance_N_per_m, at the stage's begin and end
};

struct Day {
    double least_delay_h = 0.0, most_delay_h = 0.0;  // since the day before; 0 for the first
    std::vector<std::string> stages;                 // in order; a stage may come again
};

// When the clock of a trial starts: at the touch of the start cap by both points, or when they leave it for the tube.
enum class ClockStart { touch, leave };

struct Validity {
    double stray_m = 0.15;  // farther from the tube's axis: the attempt went around the tube
    double still_s = 10.0;  // a wand that moves less than still_m for so long was laid down
    double still_m = 0.002;
    double longest_gap_s = 0.05;  // between ticks; a longer one makes the trial invalid
    double return_m = 0.03;       // so far along the path before a touch of the start cap is a return
};

struct Protocol {
    std::string name, title, consent_version;
    double point_offset_m = 0.03;  // the wand's two points lie so far from its middle, along its axis
    double force_limit_N = 2.0;
    double calibration_tolerance_m = 0.002;
    double resume_within_min = 10.0;
    double guidance_N_per_m = 0.0;
    double lead_m_per_s = 0.06;    // of the point along the path that a led hand follows
    std::vector<unsigned> blocks;  // sizes of the permuted blocks; each a multiple of the sum of ratios
    std::vector<Stratum> strata;
    std::vector<Group> groups;
    std::vector<StudyWorld> worlds;
    std::vector<Stage> stages;
    std::vector<Day> days;
    ClockStart clock = ClockStart::leave;
    Validity validity;
    std::string primary_outcome = "deviation";  // or "time"
    double alpha = 0.05;

    [[nodiscard]] const StudyWorld* world(std::string_view named) const;
    [[nodiscard]] const Stage* stage(std::string_view named) const;
};

// Line and column count from 1. "FILE:LINE:COLUMN: what; remedy"
struct ProtocolFault {
    std::size_t line = 1, column = 1;
    std::string what, remedy;
};
[[nodiscard]] std::string line_of(const ProtocolFault& fault, const std::string& file);

// To be used only where there are no faults.
struct ParsedProtocol {
    Protocol protocol;
    std::vector<ProtocolFault> faults;  // by line, then column
};
[[nodiscard]] ParsedProtocol parse_protocol(std::string_view text);

// The text of a protocol that comes with the program (`protocol.toml` in its folder of assets/studies).
[[nodiscard]] std::optional<std::string_view> known_protocol(std::string_view name);

inline constexpr std::uint64_t kMostProtocolBytes = std::uint64_t{1} << 20;
// More force than this no device of Burin displays.
inline constexpr double kDeviceForce_N = 3.3;

}  // namespace burin::study
