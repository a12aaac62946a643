// SPDX-License-Identifier: MIT
// Tables of trials as people and programs write them, and what is said of those that are wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "base/csv.hpp"
#include "study/table/trial_table.hpp"

namespace burin::study {
namespace {

constexpr const char* kHeader = "participant,group,trial,deviation,time_s\n";

// "LINE:COLUMN" of every fault.
std::vector<std::string> places_of(const ParsedTable& parsed) {
    std::vector<std::string> places;
    for (const TableFault& fault : parsed.faults)
        places.push_back(std::to_string(fault.line) + ":" + std::to_string(fault.column));
    return places;
}

// Expects one fault there, with these words in what or remedy.
void expect_fault(const std::string& text, const std::string& place, const std::string& words) {
    const ParsedTable parsed = parse_trials(text);
    ASSERT_EQ(places_of(parsed), std::vector<std::string>{place}) << text;
    const std::string line = line_of(parsed.faults[0], "a.csv");
    EXPECT_NE(line.find(words), std::string::npos) << line;
    EXPECT_EQ(line.rfind("a.csv:" + place + ": ", 0), 0u) << line;
    EXPECT_FALSE(parsed.faults[0].remedy.empty()) << line;
}

TEST(TrialTable, KeepsNumbersAndUnitsAsTheFileHasThem) {
    const ParsedTable parsed = parse_trials(
        "# exported on a Monday\n\ntime_min, user ,note,group,trial,deviation_mm\n"
        "1.784,7,\"slow, then \"\"fast\"\"\",haptic,1,4.5892e-2\n 2 ,08,,\"visual\",02,0\n");
    ASSERT_TRUE(parsed.faults.empty()) << line_of(parsed.faults[0], "");
    const TrialTable& table = parsed.table;
    EXPECT_EQ(table.time_unit, "min");
    EXPECT_EQ(table.deviation_unit, "mm");
    EXPECT_EQ(table.groups, (std::vector<std::string>{"haptic", "visual"}));
    EXPECT_EQ(table.other_columns, std::vector<std::string>{"note"});
    ASSERT_EQ(table.trials.size(), 2u);
    EXPECT_EQ(table.trials[0].participant, "7");
    EXPECT_EQ(table.trials[0].time, 1.784);
    EXPECT_EQ(table.trials[0].deviation, 0.045892);
    EXPECT_EQ(table.trials[1].participant, "08");
    EXPECT_EQ(table.trials[1].number, 2);
    EXPECT_EQ(table.trials[1].deviation, 0.0);
}

TEST(TrialTable, ReadsAFieldInQuotesThatGoesOverLines) {
    const std::string rows = "7,haptic,1,0.5,2,\"first line\nsecond, \"\"third\"\"\n\nlast\"\n8,visual,1,0.25,3,\n";
    const ParsedTable parsed = parse_trials("participant,group,trial,deviation,time_s,\"what was\nsaid\"\n" + rows);
    ASSERT_TRUE(parsed.faults.empty()) << line_of(parsed.faults[0], "");
    ASSERT_EQ(parsed.table.trials.size(), 2u);
    EXPECT_EQ(parsed.table.trials[0].time, 2.0);
    EXPECT_EQ(parsed.table.trials[1].participant, "8");
    EXPECT_EQ(parsed.table.other_columns, std::vector<std::string>{"what was said"});
    expect_fault(kHeader + std::string("\"7\n7\",haptic,1,0.5,2\n"), "2:1", "goes over lines");
    // The lines are those of the file.
    expect_fault("participant,group,trial,deviation,time_s,note\n7,a,1,1,2,\"x\ny\"\n8,a,1,1,0,\n", "4:9",
                 "not above 0");
    // A quote that is never closed is a fault of its own line.
    expect_fault("participant,group,trial,deviation,time_s,note\n7,a,1,1,2,\"x\n8,a,1,1,2,\n", "2:11", "never closed");
}

TEST(TrialTable, ReadsNamesOfColumnsInCapitals) {
    for (const char* header :
         {"PARTICIPANT,GROUP,TRIAL,DEVIATION_MM,TIME_S\n", "User;Group;Trial;Deviation_mm;Time_s\n"}) {
        std::string row = "A7,Haptic,1,0.5,2\n";
        if (std::string(header).contains(';')) std::ranges::replace(row, ',', ';');
        const ParsedTable parsed = parse_trials(header + row);
        ASSERT_TRUE(parsed.faults.empty()) << line_of(parsed.faults[0], "");
        ASSERT_EQ(parsed.table.trials.size(), 1u);
        EXPECT_EQ(parsed.table.trials[0].participant, "A7") << "codes keep their letters";
        EXPECT_EQ(parsed.table.trials[0].group, "Haptic");
        EXPECT_EQ(parsed.table.deviation_unit, "mm");
    }
}

TEST(TrialTable, NamesWhatIsWrongWithAField) {
    const std::string head = kHeader;
    expect_fault(head + "1,a,1,0.1,0\n", "2:11", "not above 0");
    expect_fault(head + "1,a,1,-0.1,2\n", "2:7", "below 0");
    expect_fault(head + "1,a,1,nan,2\n", "2:7", "finite");
    expect_fault(head + "1,a,1,0.1,inf\n", "2:11", "finite");
    expect_fault(head + "1,a,1,0.1,1e999\n", "2:11", "finite");
    expect_fault(head + "1,a,1,0.1,2e9\n", "2:11", "absurdly large");
    expect_fault(head + "1,a,1,0.1,\n", "2:11", "finite");
    expect_fault(head + "1,a,1,\"0,1\",2\n", "2:7", "decimal point");
    expect_fault(head + "1,a,1,0.1 m,2\n", "2:7", "finite");
    expect_fault(head + "1,a,0,0.1,2\n", "2:5", "whole number");
    expect_fault(head + "1,a,1.5,0.1,2\n", "2:5", "whole number");
    expect_fault(head + "1,a,1e300,0.1,2\n", "2:5", "whole number");
    expect_fault(head + "1,,1,0.1,2\n", "2:3", "names no group");
    expect_fault(head + " ,a,1,0.1,2\n", "2:2", "names no participant");
    expect_fault(head + "p@x.org,a,1,0.1,2\n", "2:1", "mail address");
    expect_fault(head + "\xc3\xa4\xc3\xb6,a,1,0.1,x\n", "2:12", "finite");  // two letters of two bytes each
}

TEST(TrialTable, NamesRowsThatContradictEachOther) {
    const std::string head = kHeader;
    expect_fault(head + "1,a,1,0.1,2\n1,b,2,0.1,2\n", "3:3", "in group a in line 2");
    expect_fault(head + "1,a,1,0.1,2\n2,a,1,0.1,2\n1,a,1,0.2,3\n", "4:5", "already in line 2");
    expect_fault(head + "1,a,1,0.1\n", "2:7", "4 fields where the first line names 5");
    expect_fault(head + "1,a,1,0.1,2,3\n", "2:13", "6 fields");
    expect_fault(head + "1,\"a,1,0.1,2\n", "2:3", "never closed");
}

TEST(TrialTable, NamesWhatIsWrongWithTheWhole) {
    expect_fault("", "1:1", "holds no table");
    expect_fault("# only a remark\n", "1:1", "holds no table");
    expect_fault(kHeader, "1:1", "holds no trial");
    expect_fault("user,group,trial,deviation\n1,a,1,0.1\n", "1:1", "time_s or time_min");
    expect_fault("user,participant,group,trial,deviation,time_s\n1,1,a,1,0.1,2\n", "1:6", "says again");
    const ParsedTable bars = parse_trials("user|group|trial|deviation|time_s\n");
    ASSERT_EQ(bars.faults.size(), 5u);
    EXPECT_NE(bars.faults[0].remedy.find("by commas, semicolons or tabs, not by |"), std::string::npos);
    std::string many = kHeader;
    for (int i = 0; i < 100; ++i) many += std::to_string(i) + ",g" + std::to_string(i) + ",1,0.1,2\n";
    expect_fault(many, "22:4", "more than 20 groups");
    std::string samples = kHeader;
    for (std::size_t i = 1; i <= kMostRows; ++i) samples += "1,a," + std::to_string(i) + ",0.1,2\n";
    EXPECT_TRUE(parse_trials(samples).faults.empty());
    expect_fault(samples + "1,a,x,y,z\n1,a,x,y,z\n", std::to_string(kMostRows + 2) + ":1", "not for each sample");
}

TEST(TrialTable, ListsAllFaultsByLineAndColumn) {
    const ParsedTable parsed = parse_trials(std::string(kHeader) + "1,a,1,x,y\n2,a,1,0.1,2\n2,b,1,-1,2\n3,a,1,0.1\n");
    EXPECT_EQ(places_of(parsed), (std::vector<std::string>{"2:7", "2:9", "4:3", "4:5", "4:7", "5:7"}));
}

TEST(TrialTable, IsReadWithCommasSemicolonsOrTabsBetweenItsColumns) {
    const std::string commas =
        "user,group,trial,deviation_mm,time_s\n1,a,1,1.5,20.25\n2,b,1,3.5999999999999996,17.25\n";
    const auto separated = [&](char separator) {
        std::string text = commas;
        std::ranges::replace(text, ',', separator);
        return text;
    };
    for (const std::string& text :
         {commas, separated(';'), separated('\t'), "sep=,\n" + commas, "sep=;\n" + separated(';'),
          "\"sep=;\"\n" + separated(';'), "sep=\t\n" + separated('\t'), "Sep=,\n# a remark\n" + commas}) {
        const ParsedTable parsed = parse_trials(text);
        ASSERT_TRUE(parsed.faults.empty()) << text << line_of(parsed.faults[0], "");
        ASSERT_EQ(parsed.table.trials.size(), 2u) << text;
        EXPECT_EQ(parsed.table.deviation_unit, "mm");
        EXPECT_EQ(parsed.table.trials[1].participant, "2");
        EXPECT_EQ(parsed.table.trials[1].deviation, 3.5999999999999996);
        EXPECT_EQ(parsed.table.trials[1].time, 17.25);
    }
    // An empty field between tabs is a field; a semicolon in one name of many is none between columns.
    expect_fault("user\tgroup\ttrial\tdeviation\ttime_s\n1\t\t1\t0.1\t2\n", "2:3", "names no group");
    EXPECT_TRUE(parse_trials("user,group,trial,deviation,time_s,a;b\n1,a,1,0.1,2,x\n").faults.empty());
    expect_fault("user;group;trial;deviation;time_s\n1;a;1;0,1;2\n", "2:7", "decimal point");
    expect_fault("user;group;trial;deviation;time_s\n1;a;1;0.1\n", "2:7", "with a semicolon between them");
    expect_fault("sep=|\n" + commas, "1:1", "declares a separator that is none: sep=|");
}

TEST(TrialTable, RefusesAFileThatIsNoTextAtAll) {
    std::string bytes;
    for (int i = 0; i < 5000; ++i) bytes += static_cast<char>(i * i % 251);
    EXPECT_FALSE(parse_trials(bytes).faults.empty());
    EXPECT_FALSE(read_trials("no-such-file.csv").has_value());
}

TEST(Csv, ReadsBackWhatItWrites) {
    for (const std::string text : {"plain", "a, b", "say \"no\"", "", "\"", ",,"}) {
        const CsvLine split = split_csv("x," + csv_field(text) + ",y");
        ASSERT_EQ(split.fields.size(), 3u) << text;
        EXPECT_EQ(split.fields[1].text, text);
        EXPECT_EQ(split.unclosed_quote, 0u);
    }
}

TEST(Csv, SeesWhatSeparatesTheFields) {
    EXPECT_EQ(separator_in("a,b,c"), ',');
    EXPECT_EQ(separator_in("a;b;c"), ';');
    EXPECT_EQ(separator_in("a\tb\tc"), '\t');
    EXPECT_EQ(separator_in("alone"), ',');
    EXPECT_EQ(separator_in("0,5;0,5;0,5;0,5;0,5;0,5"), ',') << "there is one comma more than semicolons";
    EXPECT_EQ(separator_in("a;0,5;0,5"), ';') << "of as many fields the semicolon's";
    EXPECT_EQ(separator_in("\"a;b;c;d\",e"), ',') << "quotes hold a field together";
    EXPECT_EQ(declared_separator("sep=;"), ';');
    EXPECT_EQ(declared_separator("sep=\t"), '\t');
    EXPECT_EQ(declared_separator("sep="), '\0');
    EXPECT_EQ(declared_separator("sep,group"), std::nullopt);
    EXPECT_EQ(declared_separator("separator=;"), std::nullopt);
}

}  // namespace
}  // namespace burin::study
