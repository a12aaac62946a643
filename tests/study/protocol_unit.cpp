// SPDX-License-Identifier: MIT
// Protocols: what is read, and every fault at its place with a remedy.
#include "study/protocol/protocol.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace burin::study {
namespace {

std::string thesis_protocol() {
    std::ifstream in("assets/studies/kinesthetic-path/protocol.toml");
    return {std::istreambuf_iterator<char>(in), {}};
}

// The thesis' protocol with one text in place of another, which must be there.
ParsedProtocol with(const std::string& old_text, const std::string& new_text) {
    std::string text = thesis_protocol();
    const std::size_t at = text.find(old_text);
    EXPECT_NE(at, std::string::npos) << old_text;
    if (at != std::string::npos) text.replace(at, old_text.size(), new_text);
    return parse_protocol(text);
}

std::size_t line_with(const std::string& part) {
    const std::string text = thesis_protocol();
    return 1 +
           static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<long>(text.find(part)), '\n'));
}

TEST(StudyProtocol, OfTheThesisIsWithoutFault) {
    const ParsedProtocol parsed = parse_protocol(thesis_protocol());
    for (const ProtocolFault& f : parsed.faults) ADD_FAILURE() << line_of(f, "protocol.toml");
    const Protocol& p = parsed.protocol;
    EXPECT_EQ(p.point_offset_m, 0.03);
    EXPECT_EQ(p.force_limit_N, 2.0);
    ASSERT_EQ(p.worlds.size(), 1u);
    EXPECT_EQ(p.worlds[0].tube_radius_m, 0.045);
    ASSERT_EQ(p.groups.size(), 2u);
    EXPECT_TRUE(p.groups[0].feels_tube && !p.groups[0].sees_tube);
    EXPECT_TRUE(p.groups[1].sees_tube && !p.groups[1].feels_tube);
    // 300 s interactive and 120 s not (W15), two trials.
    EXPECT_EQ(p.stage("interactive")->ends_after_s, 300.0);
    EXPECT_EQ(p.stage("led")->ends_after_s, 120.0);
    EXPECT_EQ(std::ranges::count(p.days.at(0).stages, "test"), 2);
    EXPECT_FALSE(p.stage("test")->sees_world || p.stage("test")->feels_world);
}

TEST(StudyProtocol, TellsEachFaultWithItsLine) {
    struct Case {
        const char *old_text, *new_text, *what;
    };
    for (const Case& c : {Case{"force_N = 2.0", "force_N = 20.0", "force_N is 20"},
                          Case{"point_offset_m = 0.03", "point_offset_m = 0.08 ", "lies 0.08 m off"},
                          Case{"funnel_half_width_m = 0.045", "funnel_half_width_m = 0.02", "too narrow for both"},
                          Case{"blocks = [2, 4]", "blocks = [2, 3]", "no multiple"},
                          Case{"code = \"visual\"", "code = \"haptic\"", "another group"},
                          Case{"code = \"visual\"", "code = \"Anna Smith\"", "not a code"},
                          Case{"sees_tube = true", "see_tube = true", "no key named see_tube"},
                          Case{"kind = \"trial\"", "kind = \"trail\"", "no kind of stage"},
                          Case{"ends_after_s = 300", "ends_after_s = -1", "ends_after_s is -1"},
                          Case{"ends_by_operator = true", "ends_by_operator = 1", "neither true nor false"},
                          Case{"clock_starts = \"leave\"", "clock_starts = \"go\"", "neither leave nor touch"},
                          Case{"alpha = 0.05", "alpha = nan", "alpha is not a number"},
                          Case{"format = 1", "format = 2", "format is 2"}}) {
        const ParsedProtocol parsed = with(c.old_text, c.new_text);
        const bool told = std::ranges::any_of(
            parsed.faults, [&](const ProtocolFault& f) { return f.what.contains(c.what) && !f.remedy.empty(); });
        EXPECT_TRUE(told) << c.what << (parsed.faults.empty() ? "" : ": " + parsed.faults.front().what);
    }
    const ParsedProtocol parsed = with("alpha = 0.05", "alpha = 5");
    ASSERT_EQ(parsed.faults.size(), 1u);
    EXPECT_EQ(parsed.faults[0].line, line_with("alpha = 0.05"));
    EXPECT_EQ(parsed.faults[0].column, 9u);
}

TEST(StudyProtocol, TellsAllFaultsAtOnceInTheOrderOfLines) {
    std::string text = thesis_protocol();
    for (const auto& [old_text, new_text] :
         {std::pair{"force_N = 2.0", "force_N = -1"}, std::pair{"world = \"tube\"", "world = \"tub\""},
          std::pair{"alpha = 0.05", "alpha = 7"}})
        text.replace(text.find(old_text), std::string(old_text).size(), new_text);
    const ParsedProtocol parsed = parse_protocol(text);
    ASSERT_EQ(parsed.faults.size(), 3u);
    EXPECT_TRUE(std::ranges::is_sorted(parsed.faults, {}, &ProtocolFault::line));
}

TEST(StudyProtocol, SurvivesWhatIsNoProtocol) {
    for (const char* text : {"", "[[[", "format = 1", "group = 3", "[[stage]]\n[[stage]]", "day = [[]]", "world = [1]",
                             "stratum = [{name='a',codes=['x']}]", "\xff\xfe", "a = 1e999", "limits = []"})
        EXPECT_FALSE(parse_protocol(text).faults.empty()) << text;
    const std::string whole = thesis_protocol();
    for (std::size_t length = 0; length < whole.size(); length += 37) {
        const ParsedProtocol cut = parse_protocol(whole.substr(0, length));
        for (const ProtocolFault& f : cut.faults) EXPECT_GE(f.line, 1u);
    }
}

TEST(StudyProtocol, SaysDaysTransferAndBaseline) {
    const ParsedProtocol parsed = with("[validity]",
                                       "[[stage]]\nname = \"baseline\"\nkind = \"trial\"\nworld = \"tube\"\n"
                                       "ends_at_exit = true\nends_after_s = 120\n\n[[day]]\nleast_delay_h = 20\n"
                                       "most_delay_h = 30\nstages = [\"baseline\", \"test\"]\n\n[validity]");
    ASSERT_TRUE(parsed.faults.empty()) << parsed.faults[0].what;
    ASSERT_EQ(parsed.protocol.days.size(), 2u);
    EXPECT_EQ(parsed.protocol.days[1].least_delay_h, 20.0);
    EXPECT_FALSE(parsed.protocol.stage("baseline")->outcome);
}

}  // namespace
}  // namespace burin::study
