// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <utility>

#include "app/cli/output_files.hpp"
#include "app/walls/wall_commands.hpp"
#include "base/csv.hpp"
#include "base/file_io.hpp"
#include "base/json.hpp"
#include "base/try.hpp"
#include "wall/wall_file.hpp"

namespace burin::app {
namespace {

constexpr std::array kAsked{"lower_left", "lower_right", "upper_left", "upper_right"};
constexpr int kTouches = 3;  // of each corner: two that agree tell which third is wrong

std::string_view trimmed(std::string_view text) {
    const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!text.empty() && blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    return text;
}

// The fields of a place and three numbers, or of three numbers, with a tab, a semicolon or a comma between them.
std::vector<CsvField> fields_of(std::string_view line) {
    for (const char separator : {'\t', ';'}) {
        std::vector<CsvField> fields = split_csv(line, separator).fields;
        if (fields.size() == 3 || fields.size() == 4) return fields;
    }
    return split_csv(line).fields;
}

bool is_header(std::string_view line) {
    constexpr std::array kNames{"place", "x", "y", "z"};
    return std::ranges::equal(fields_of(line), kNames, {}, [](const CsvField& f) { return column_name(f.text); });
}

// Parses a line. `asked` is the place of a line of three numbers; empty: the line must name its place.
Result<wall::CalibrationSample> parse_sample(std::string_view line, const std::string& where, const std::string& asked,
                                             double unit_m) {
    std::vector<CsvField> fields = fields_of(line);
    wall::CalibrationSample sample{asked, {}};
    if (fields.size() == 4) {
        sample.place = fields[0].text;
        fields.erase(fields.begin());
    }
    if (fields.size() != 3 || sample.place.empty()) {
        return fail(where, "is not a sample", "write place,x,y,z, such as lower_left,0.1,0.2,0.3");
    }
    if (!wall::screen_place(sample.place)) {
        return fail(
            where, "names no place on a screen: " + sample.place,
            "use lower_left, lower_right, upper_left, upper_right, left, right, bottom, top or u:v from 0 to 1");
    }
    for (int i = 0; i < 3; ++i) {
        const std::string& f = fields[static_cast<std::size_t>(i)].text;
        const std::optional<double> value = finite_number(f);
        if (!value || std::abs(*value) > 1e6) {
            return fail(where, "holds a number that cannot be read: " + f.substr(0, 40),
                        f.contains(',') ? "write a decimal point, not a comma" : "correct the number");
        }
        sample.tip_tracker[i] = unit_m * *value;
    }
    return sample;
}

bool skipped(std::string_view line) { return line.empty() || line.front() == '#'; }

Result<std::vector<wall::CalibrationSample>> read_samples(const WallCalibrationOptions& options, double unit_m) {
    if (options.samples == kStandardOutput) return guided_samples(std::cin, std::cerr, unit_m);
    BURIN_TRY(text, read_text_file(options.samples, 1 << 24));
    return parse_samples(text, options.samples, unit_m);
}

Result<std::size_t> find_screen(const wall::WallSetup& setup, const WallCalibrationOptions& options) {
    std::string names;
    for (std::size_t i = 0; i < setup.screens.size(); ++i) {
        if (setup.screens[i].name == options.screen) return i;
        names += (names.empty() ? "" : ", ") + setup.screens[i].name;
    }
    return fail(options.wall, "has no screen named " + options.screen, "its screens are " + names);
}

Json describe(const wall::ScreenFit& fit, const wall::SampleDistances& before) {
    Json out{{"before_rms_mm", before.rms_mm}, {"before_max_mm", before.max_mm}, {"rms_mm", fit.rms_mm},
             {"max_mm", fit.max_mm},           {"width_m", fit.width_m},         {"height_m", fit.height_m}};
    out["places"] = Json::array();
    for (const wall::PlaceResidual& p : fit.places) {
        out["places"].push_back({{"place", p.place}, {"samples", p.samples}, {"rms_mm", p.rms_mm}});
    }
    out["outliers"] = Json::array();
    for (const wall::SampleOutlier& o : fit.outliers) {
        out["outliers"].push_back({{"sample", o.index + 1}, {"place", o.place}, {"distance_mm", o.distance_mm}});
    }
    return out;
}

void print(const wall::ScreenFit& fit, const wall::SampleDistances& before, const std::string& screen) {
    std::printf("screen %s: %.4f by %.4f m\n", screen.c_str(), fit.width_m, fit.height_m);
    std::printf("  %-34s %.2f mm RMS, %.2f mm at most\n", "samples from the screen, before", before.rms_mm,
                before.max_mm);
    std::printf("  %-34s %.2f mm RMS, %.2f mm at most\n", "after", fit.rms_mm, fit.max_mm);
    for (const wall::PlaceResidual& p : fit.places) {
        std::printf("  %-34s %.2f mm RMS of %d\n", p.place.c_str(), p.rms_mm, p.samples);
    }
    for (const wall::SampleOutlier& o : fit.outliers) {
        std::printf("  set aside: sample %zu (%s), %.1f mm off\n", o.index + 1, o.place.c_str(), o.distance_mm);
    }
}

// Refuses a screen that cannot be drawn, say because left and right were exchanged while touching, before it is
// written; prints its warnings.
Result<void> refuse_errors(const wall::WallSetup& setup, const std::string& screen) {
    for (const wall::WallProblem& p : wall::check(setup)) {
        if (p.where != screen) continue;
        if (p.error) return fail("screen " + screen, "as touched " + p.what, p.remedy);
        std::printf("  %s\n", line_of(p).c_str());
    }
    return {};
}

}  // namespace

Result<std::vector<wall::CalibrationSample>> parse_samples(std::string_view text, const std::string& name,
                                                           double unit_m) {
    std::vector<wall::CalibrationSample> samples;
    bool first = true;
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::size_t end = text.find('\n');
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (skipped(line)) continue;
        const bool head = first && (is_header(line) || declared_separator(line));
        first = first && declared_separator(line);
        if (head) continue;
        BURIN_TRY(sample, parse_sample(line, name + ":" + std::to_string(number), "", unit_m));
        samples.push_back(std::move(sample));
    }
    return samples;
}

std::vector<wall::CalibrationSample> guided_samples(std::istream& in, std::ostream& prompts, double unit_m) {
    std::vector<wall::CalibrationSample> samples;
    std::string line;
    std::size_t asked = 0;
    const auto prompt = [&] {
        if (asked < kAsked.size() * kTouches) {
            prompts << "touch " << kAsked[asked / kTouches] << " with the wand's tip, " << asked % kTouches + 1
                    << " of " << kTouches << ": " << std::flush;
        } else {
            prompts << "enough; done, or place,x,y,z for more: " << std::flush;
        }
    };
    bool first = true;
    for (prompt(); std::getline(in, line); prompt()) {
        const std::string_view text = trimmed(std::exchange(first, false) ? without_byte_order_mark(line) : line);
        if (text == "done") break;
        if (skipped(text)) continue;
        const std::string place = asked < kAsked.size() * kTouches ? kAsked[asked / kTouches] : "";
        const auto sample = parse_sample(text, "this line", place, unit_m);
        if (!sample) {
            prompts << sample.error().line() << "\n";
            continue;
        }
        samples.push_back(*sample);
        if (sample->place == place) ++asked;
    }
    prompts << "\n";
    return samples;
}

Result<void> calibrate_wall(const WallCalibrationOptions& options) {
    const std::array outputs{options.out, options.json};
    BURIN_TRY_DO(check_places(outputs, std::array{options.samples}));
    // The new wall file may take the old one's place; the residuals may not.
    BURIN_TRY_DO(check_overwrites_none(options.json, std::array{options.wall}));
    BURIN_TRY(setup, wall::read_wall(options.wall));
    BURIN_TRY(index, find_screen(setup, options));
    wall::WallScreen& screen = setup.screens[index];
    BURIN_TRY(samples, read_samples(options, metres_in(setup.unit)));
    std::optional<wall::ScreenSize> size;
    if (options.keep_size) {
        size = wall::ScreenSize{glm::length(screen.lower_right_tracker - screen.lower_left_tracker),
                                glm::length(screen.upper_left_tracker - screen.lower_left_tracker)};
    }
    BURIN_TRY(fit, wall::fit_screen(samples, size));
    BURIN_TRY(before, wall::distances_from(screen, samples));
    if (options.json != kStandardOutput) print(fit, before, screen.name);
    screen.lower_left_tracker = fit.lower_left_tracker;
    screen.lower_right_tracker = fit.lower_right_tracker;
    screen.upper_left_tracker = fit.upper_left_tracker;
    BURIN_TRY_DO(refuse_errors(setup, screen.name));
    BURIN_TRY_DO(write_text(options.out, wall::wall_text(setup)));
    return write_output(options.json, json_text(describe(fit, before)));
}

namespace {

CommandAction add_wall_calibrate(Command command) {
    const auto options = std::make_shared<WallCalibrationOptions>();
    WallCalibrationOptions& c = *options;
    command.option("--wall", c.wall, "The wall file as it is").asset(AssetRoom::walls).required();
    command
        .option("--samples", c.samples,
                "CSV with place,x,y,z in the wall's unit and the tracker's frame; - for standard input, with a "
                "prompt for each touch")
        .required();
    command.option("--screen", c.screen, "Which screen was touched").required();
    command.option("--out", c.out, "Where to write the new wall file; may be the old one").required();
    command.option("--json", c.json, "A file for the residuals; - for standard output");
    command.flag("--keep-size", c.keep_size, "Move and turn the screen, but leave its width and height");
    return action([options] { return calibrate_wall(*options); });
}

}  // namespace

CommandRow wall_calibrate_row() {
    return {"calibrate", "A screen's corners from touches with a tracked wand", add_wall_calibrate};
}

}  // namespace burin::app
