// SPDX-License-Identifier: MIT
// A journal that has lost its end: its digests are whole, and the files that nothing names tell of it.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "record/record_reader.hpp"
#include "study/folder/interruption.hpp"
#include "study/folder/unnamed_files.hpp"
#include "tests/study/lost_study.hpp"

namespace burin::study {
namespace {

// A study whose first participant went through both trials.
void make_whole(const Workplace& place) {
    make_lost_study(place, {"\"test\", \"transfer\""});
    LostVisit visit;
    visit.say("start").come("arc").through().say("start").come("wave").through();
    ASSERT_EQ(visit_by(place, "p01", visit).status, 0);
    ASSERT_EQ(place.run(kLostStudy + "check s").status, 0);
}

// Keeps the journal's lines up to the first that holds the words, which goes too.
void cut_from(const Workplace& place, const std::string& words) {
    const std::string journal = place.read("s/journal.jsonl");
    const std::size_t at = journal.find(words);
    ASSERT_NE(at, std::string::npos);
    place.write("s/journal.jsonl", journal.substr(0, journal.rfind('\n', at) + 1));
}

}  // namespace

TEST(CutJournals, AreToldByTheFilesThatNothingNames) {
    const Workplace place;
    make_whole(place);
    cut_from(place, "\"event\":\"visit\"");
    const auto checked = place.run(kLostStudy + "check s");
    EXPECT_EQ(checked.status, 1) << checked.output;
    for (const char* name : {"day1-01-run1.json", "day1-01-run1.session", "day1-02-run1.json", "day1-02-run1.session"})
        EXPECT_TRUE(checked.output.contains(std::string("s/data/p01/") + name +
                                            ": is named by no line of the journal, whose end may have been cut off; "
                                            "restore the journal from a copy"))
            << name << "\n"
            << checked.output;
    EXPECT_TRUE(checked.output.contains("4 faults")) << checked.output;
    const auto status = place.run(kLostStudy + "status s");
    EXPECT_TRUE(status.output.contains("4 files of data stand in no line of the journal")) << status.output;
}

TEST(CutJournals, AreToldByTheFiguresOfAStageWithoutItsEnd) {
    const Workplace place;
    make_whole(place);
    cut_from(place, "\"event\":\"stage ended\",\"participant\":\"p01\",\"day\":1,\"place\":2");
    const auto checked = place.run(kLostStudy + "check s");
    EXPECT_EQ(checked.status, 1) << checked.output;
    EXPECT_TRUE(
        checked.output.contains("s/data/p01/day1-02-run1.json: is written when its stage ends, and no line of "
                                "the journal tells that end"))
        << checked.output;
    EXPECT_FALSE(checked.output.contains("day1-02-run1.session: is named by no line")) << checked.output;
}

TEST(Interruptions, AreNoFaultAndTellTheTicksThatAreKept) {
    const Workplace place;
    make_lost_study(place, {"\"test\", \"transfer\""});
    LostVisit broken;
    ASSERT_EQ(visit_by(place, "p01", broken.say("start").come("arc")).status, 0);
    const auto checked = place.run(kLostStudy + "check s");
    EXPECT_EQ(checked.status, 0) << checked.output;
    EXPECT_TRUE(checked.output.contains("1 stages interrupted")) << checked.output;
    auto reader = record::RecordReader::open((place / "s/data/p01/day1-01-run1.session").string());
    ASSERT_TRUE(reader);
    EXPECT_TRUE(
        checked.output.contains(std::to_string(reader->hands().front().rows()) + " ticks of its motion are kept"))
        << checked.output;
}

// "0 ticks kept" stood for a recording that could not be read.
TEST(Interruptions, SayWhyARecordingCannotBeRead) {
    const Workplace place;
    make_lost_study(place, {"\"test\""});
    LostVisit broken;
    ASSERT_EQ(visit_by(place, "p01", broken.say("start").come("arc")).status, 0);
    place.write("s/data/p01/day1-01-run1.session", "no recording at all");
    auto checked = place.run(kLostStudy + "check s");
    EXPECT_EQ(checked.status, 1) << checked.output;
    EXPECT_TRUE(checked.output.contains("its motion cannot be read (")) << checked.output;
    std::filesystem::remove(place / "s/data/p01/day1-01-run1.session");
    checked = place.run(kLostStudy + "check s");
    EXPECT_TRUE(checked.output.contains("cannot be found; restore it from a copy")) << checked.output;
    EXPECT_FALSE(place.run(kLostStudy + "status s").output.contains("0 ticks of its motion"));
}

}  // namespace burin::study
