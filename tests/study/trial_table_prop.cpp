// SPDX-License-Identifier: MIT
// Tables of trials that are damaged or are none at all: each fault has a place in the text, and nothing crashes.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <string>

#include "study/analysis/analysis.hpp"
#include "study/published/published.hpp"
#include "study/report/analysis_tables.hpp"
#include "study/report/analysis_text.hpp"
#include "study/report/html_report.hpp"
#include "study/table/trial_table.hpp"

namespace burin::study {
namespace {

void expect_places_within(const std::vector<TableFault>& faults, const std::string& text) {
    const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n')) + 1;
    for (const TableFault& fault : faults) {
        RC_ASSERT(fault.line >= 1 && fault.line <= lines);
        RC_ASSERT(fault.column >= 1 && fault.column <= text.size() + 1);
        RC_ASSERT(!fault.what.empty() && !fault.remedy.empty());
    }
}

std::string a_table(int rows) {
    std::string text = "participant,group,trial,deviation,time_s\n";
    for (int i = 0; i < rows; ++i) {
        text += std::to_string(i / 2) + "," + (i / 2 % 2 == 0 ? "a" : "b") + "," + std::to_string(1 + i % 2) + "," +
                std::to_string(*rc::gen::inRange(0, 4)) + "," + std::to_string(*rc::gen::inRange(1, 4)) + "\n";
    }
    return text;
}

TEST(TrialTable, TakesAnyBytesAndSaysWhereTheyAreWrong) {
    EXPECT_TRUE(rc::check([] {
        const std::string text = *rc::gen::container<std::string>(
            rc::gen::oneOf(rc::gen::arbitrary<char>(), rc::gen::element(',', '"', '\n', '1', '.', '#', ' ')));
        expect_places_within(parse_trials(text).faults, text);
        const std::string with_header = "user,group,trial,deviation,time_s\n" + text;
        expect_places_within(parse_trials(with_header).faults, with_header);
        expect_places_within(parse_published(text).faults, text);
    }));
}

TEST(TrialTable, WithOneByteChangedIsReadOrRefused) {
    EXPECT_TRUE(rc::check([] {
        std::string text = a_table(*rc::gen::inRange(1, 12));
        text[*rc::gen::inRange<std::size_t>(0, text.size())] = *rc::gen::element(',', '"', '\n', '-', 'x', '\0', '9');
        const ParsedTable parsed = parse_trials(text);
        expect_places_within(parsed.faults, text);
        if (!parsed.faults.empty()) return;
        // What is read can be analysed and reported, however few and tied its values are.
        const Analysis analysis = analyse(parsed.table);
        RC_ASSERT(!analysis_text(analysis).empty());
        RC_ASSERT(!html_report(analysis, {}, {}).contains("nan"));
        RC_ASSERT(analysis_tables(analysis).size() == 5u);
        // The table that is written is read back the same.
        const ParsedTable again = parse_trials(analysis_tables(analysis)[0].text);
        RC_ASSERT(again.faults.empty());
        RC_ASSERT(json_text(analysis_json(analyse(again.table))).size() > 100u);
        RC_ASSERT(again.table.trials.size() == parsed.table.trials.size());
        for (std::size_t i = 0; i < again.table.trials.size(); ++i) {
            RC_ASSERT(again.table.trials[i].participant == parsed.table.trials[i].participant);
            RC_ASSERT(again.table.trials[i].time == parsed.table.trials[i].time);
            RC_ASSERT(again.table.trials[i].deviation == parsed.table.trials[i].deviation);
        }
    }));
}

}  // namespace
}  // namespace burin::study
