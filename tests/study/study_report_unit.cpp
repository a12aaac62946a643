// SPDX-License-Identifier: MIT
// What a study's report shows of single trials, and how its lines are told apart without colours.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "study/protocol/protocol.hpp"
#include "study/report/trial_figures.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::study {
namespace {

const std::string kReported = std::string(kBurinCommand) + " study ";

// The thesis' study with stages short enough for a test.
std::string brief_stages() {
    std::string text{known_protocol("kinesthetic-path").value()};
    for (const char* seconds : {"ends_after_s = 60", "ends_after_s = 300", "ends_after_s = 120"}) {
        for (std::size_t at = text.find(seconds); at != std::string::npos; at = text.find(seconds, at + 1))
            text.replace(at, std::string(seconds).size(), "ends_after_s = 1");
    }
    return text;
}

std::size_t count_of(const std::string& part, const std::string& text) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

// Of the rows of trials.csv whose proxies followed the hand, or of the others: the deviations of a group as printed.
std::vector<std::string> deviations_mm(const std::string& csv, const std::string& group, bool followed) {
    std::vector<std::string> names, found;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with('#')) continue;
        std::vector<std::string> fields;
        std::istringstream rest(line);
        for (std::string field; std::getline(rest, field, ',');) fields.push_back(field);
        if (names.empty()) {
            names = fields;
            continue;
        }
        const auto field = [&](const char* name) {
            return fields.at(static_cast<std::size_t>(std::ranges::find(names, name) - names.begin()));
        };
        if (field("group") == group && (field("deviations_differ") == "0") == followed)
            found.push_back(formatted("%.3g mm", std::strtod(field("deviation_mm").c_str(), nullptr)));
    }
    return found;
}

}  // namespace

TEST(StudyReport, ShowsATrialInWhichTheProxyFollowedTheHandAndListsTheOthersInOneSentence) {
    const Workplace place;
    place.write("p.toml", brief_stages());
    ASSERT_EQ(place.run(kReported + "init p.toml s --participants 8 --seed 7").status, 0);
    ASSERT_EQ(place.run(kReported + "run s --simulated").status, 0);
    ASSERT_EQ(place.run(kReported + "report s").status, 0);
    const std::string html = place.read("s/reports/001/report.html"), csv = place.read("s/trials.csv");
    std::size_t flagged = 0;
    for (const char* group : {"haptic", "visual"}) {
        const std::vector<std::string> followed = deviations_mm(csv, group, true);
        ASSERT_FALSE(followed.empty());
        flagged += deviations_mm(csv, group, false).size();
        const std::string section = html.substr(html.find(std::string("A trial of group ") + group), 600);
        bool is_of_them = false;
        for (const std::string& mm : followed) is_of_them = is_of_them || section.contains("deviation, " + mm);
        EXPECT_TRUE(is_of_them) << section;
    }
    const std::string sign = "haptic less visual";  // the protocol's order
    EXPECT_TRUE(html.contains("r: " + sign) && html.contains("Hodges-Lehmann: " + sign));
    ASSERT_GT(flagged, 1u) << "a seed without such trials tests nothing";
    EXPECT_EQ(count_of("differ by more than", html), 1u);
    EXPECT_TRUE(html.contains(formatted("in %zu trials", flagged)));
}

TEST(StudyReport, TellsTheLinesOfAPathApartWithoutColours) {
    const Protocol protocol = parse_protocol(brief_stages()).protocol;
    ShownTrial trial{"haptic: p1", {}, &protocol.worlds.at(0)};
    for (std::size_t i = 0; i < 2; ++i) {
        trial.model.points_m[i] = trial.model.collision_points_m[i] = protocol.worlds.at(0).spine_m;
        trial.model.forces_N[i].resize(protocol.worlds.at(0).spine_m.size());
    }
    const std::string path = trial_figures(trial).at(0);
    // Two views and the legend each have one line dashed, one dotted and one whole.
    EXPECT_EQ(count_of("stroke-dasharray=\"7 3\"", path), 3u);
    EXPECT_EQ(count_of("stroke-dasharray=\"2 3\"", path), 3u);
    EXPECT_EQ(count_of("<circle", path), 0u);
}

TEST(StudyPictures, DrawAPageAsItsText) {
    const Workplace place;
    place.write("p.toml", brief_stages());
    ASSERT_EQ(place.run(kReported + "init p.toml s --participants 1 --seed 7").status, 0);
    // Where there is no graphics device the pages are drawn all the same.
    static_cast<void>(place.run(kReported + "run s --simulated --pictures"));
    const std::string page = place.read("s/pictures/day1-01-introduction.svg");
    EXPECT_TRUE(page.contains("You will learn to move the wand along a path.")) << page;
    EXPECT_TRUE(page.contains("without giving a reason.</text>")) << page;
}

}  // namespace burin::study
