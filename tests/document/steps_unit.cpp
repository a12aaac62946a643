// SPDX-License-Identifier: MIT
// Steps of undo and redo in documents and journals, of two parts at once: what a save or a journal takes over, what it
// leaves out, and what a step that is made anew leaves of the one before.
//
// Steps are written as a line, "2-4>5: 2ab 3c 4- 5d": the first, the last done, the last of all; then each step with a
// letter for each of its pages, "-" where it has none there.
#include <gtest/gtest.h>

#include <optional>
#include <sstream>

#include "document/document_reader.hpp"
#include "document/document_writer.hpp"
#include "document/journal.hpp"
#include "tests/record/failing_disk.hpp"
#include "tests/support/run_command.hpp"

namespace burin::document {
namespace {

std::string page_kind(std::size_t index) { return index == 0 ? "rays" : "rays " + std::to_string(index + 1); }

scene::Steps steps_from(const std::string& line) {
    scene::Steps steps;
    char mark = ' ';
    std::istringstream in(line);
    in >> steps.first >> mark >> steps.done >> mark >> steps.last >> mark;
    std::int64_t number = 0;
    for (std::string letters; in >> number >> letters;)
        for (std::size_t i = 0; i < letters.size() && letters != "-"; ++i)
            steps.pages[{page_kind(i), number}] = {static_cast<std::byte>(letters[i])};
    return steps;
}

// Content of two parts whose steps are as in the lines; an empty line: that part has none.
Content content_of(const std::string& first, const std::string& second) {
    Content content{.facts = {{kJournalNameFact, "work.burin"}}};
    for (const std::string& line : {first, second}) {
        scene::Pages& part = content.parts.emplace_back(scene::Pages{.part = line == first ? "one" : "other"});
        part.pages[{"head", 0}] = {std::byte{1}};
        if (!line.empty()) part.steps = steps_from(line);
    }
    return content;
}

std::string steps_of_part(const std::string& path, std::size_t part) {
    Result<DocumentReader> reader = DocumentReader::open(path);
    if (!reader) return reader.error().line();
    const auto steps = reader->steps(reader->parts().at(part));
    if (!steps) return steps.error().line();
    if (!*steps) return "";
    std::string line = std::to_string((*steps)->first) + "-" + std::to_string((*steps)->done) + ">" +
                       std::to_string((*steps)->last) + ":";
    for (std::int64_t number = -10; number <= 20; ++number) {
        const auto step = reader->step(reader->parts().at(part), number);
        const bool is_named = number >= (*steps)->first && number <= (*steps)->last;
        if (!step && !is_named) continue;
        line += " " + std::to_string(number);
        if (!step) line += "-";
        if (step)
            for (const auto& [name, bytes] : step->pages) line += static_cast<char>(bytes.at(0));
    }
    return line;
}

class StoredSteps : public testing::Test {
protected:
    void SetUp() override { disk.reset(); }
    void TearDown() override { disk.reset(); }
    void expect_steps(const std::string& first, const std::string& second, const std::string& of) const {
        EXPECT_EQ(steps_of_part(path, 0), first) << of << ", the first part";
        EXPECT_EQ(steps_of_part(path, 1), second) << of << ", the second part";
    }
    record::test::FailingDisk& disk = record::test::failing_disk();
    Workplace at;
    const std::string path = at / "work.burin";
};

// What a save brings for a part that has steps 1 to 4 of one to three pages, and what is there then.
struct SavedSteps {
    const char *brings, *leaves;
};
constexpr const char* kThereBefore = "1-4>4: 1abc 2de 3f 4gh";
constexpr SavedSteps kSavedSteps[]{
    {"1-4>4:", "1-4>4: 1abc 2de 3f 4gh"},
    {"1-5>5: 5k", "1-5>5: 1abc 2de 3f 4gh 5k"},
    {"1-4>4: 1k", "1-4>4: 1k 2de 3f 4gh"},
    {"1-4>4: 1kl", "1-4>4: 1kl 2de 3f 4gh"},
    {"1-4>4: 2k", "1-4>4: 1abc 2k 3f 4gh"},
    {"1-4>4: 4k", "1-4>4: 1abc 2de 3f 4k"},
    {"1-4>4: 3kl", "1-4>4: 1abc 2de 3kl 4gh"},
    {"1-4>4: 1k 2l 3mno 4p", "1-4>4: 1k 2l 3mno 4p"},
    {"1-2>2:", "1-2>2: 1abc 2de"},
    {"1-2>2: 2k", "1-2>2: 1abc 2k"},
    {"3-4>4:", "3-4>4: 3f 4gh"},
    {"3-5>5: 2k 5l", "3-5>5: 3f 4gh 5l"},
    {"1-2>4:", "1-2>4: 1abc 2de 3f 4gh"},
    {"1-2>3: 3k 9l", "1-2>3: 1abc 2de 3k"},
    {"", ""},
};

}  // namespace

// Each row beside another in the other part, so that each is of the first part and of the second.
TEST_F(StoredSteps, MadeAnewHaveNoPageOfTheOnesBefore) {
    for (std::size_t i = 0; i < std::size(kSavedSteps); ++i) {
        const SavedSteps &one = kSavedSteps[i], &other = kSavedSteps[(i + 4) % std::size(kSavedSteps)];
        const auto saved = write_document(path, content_of(kThereBefore, kThereBefore), Place::replaced);
        ASSERT_TRUE(saved) << saved.error().line();
        const auto changed = update_document(path, content_of(one.brings, other.brings), saved->version);
        ASSERT_TRUE(changed) << changed.error().line();
        expect_steps(one.leaves, other.leaves, std::string(one.brings) + " beside " + other.brings);
        // And once more, onto what the second save has left.
        ASSERT_TRUE(update_document(path, content_of(kThereBefore, "1-4>4: 1q 2r 3s 4t"), changed->version));
        expect_steps(kThereBefore, "1-4>4: 1q 2r 3s 4t", std::string("after ") + one.brings);
    }
}

TEST_F(StoredSteps, OfASaveThatFailedHaveNoPageOfTheOnesBeforeInTheNext) {
    for (const SavedSteps& row : kSavedSteps) {
        if (*row.brings == '\0') continue;
        std::filesystem::remove(path);
        DocumentWriter writer(disk.kName);
        const auto save = [&](const char* line, bool changed_alone) {
            writer.save(
                {.path = path, .name = "work", .content = content_of(line, line), .changed_alone = changed_alone});
            writer.finish();
            return static_cast<bool>(writer.take_outcomes().at(0).saved);
        };
        ASSERT_TRUE(save("1-0>0:", false));
        disk.is_full = true;
        EXPECT_FALSE(save(kThereBefore, true));
        disk.is_full = false;
        ASSERT_TRUE(save(row.brings, true));
        expect_steps(row.leaves, row.leaves, row.brings);
    }
}

// What a journal begins with, what a save brings, and how far its undo goes then: never farther than its steps.
TEST_F(StoredSteps, OfAJournalThatTakesOverASaveGoNoFartherBackThanItsOwn) {
    struct TakenOver {
        const char *begins, *saved, *leaves;
    };
    for (const TakenOver& row : {TakenOver{"3-4>4: 3ab 4c", "1-5>5: 5d", "3-5>5: 3ab 4c 5d"},
                                 {"3-4>4: 3ab 4c", "1-4>4:", "3-4>4: 3ab 4c"},
                                 {"3-4>4: 3ab 4c", "4-6>6: 5d 6e", "4-6>6: 4c 5d 6e"},
                                 {"3-4>5: 3ab 4c 5d", "1-3>5:", "3-3>5: 3ab 4c 5d"},
                                 {"3-4>5: 3ab 4c 5d", "1-1>5: 2k 3l 4m", "2-1>5: 2k 3l 4m 5d"},
                                 {"-2-1>1: -2a -1b 0c 1d", "-6-1>1:", "-2-1>1: -2a -1b 0c 1d"},
                                 {"3-4>4: 3ab 4c", "1-4>4: 3k", "3-4>4: 3k 4c"},
                                 {"1-0>0:", "1-2>2: 1a 2b", "1-2>2: 1a 2b"}})
        for (const bool is_second : {false, true}) {
            const char* const plain = "1-1>1: 1z";
            const auto both = [&](const char* mine, const char* others) {
                return is_second ? content_of(others, mine) : content_of(mine, others);
            };
            std::filesystem::remove(path);
            auto journal = Journal::begin(path, both(row.begins, plain));
            ASSERT_TRUE(journal) << journal.error().line();
            for (int times = 0; times < 2; ++times)  // the second save is held to the same
                ASSERT_TRUE(journal->take_over(both(row.saved, "1-1>1:")));
            ASSERT_TRUE(journal->add({{.part = 0, .pages = {.whole = false, .pages = {{{"rays", 0}, {}}}}}}));
            journal->end();
            expect_steps(is_second ? plain : row.leaves, is_second ? row.leaves : plain, row.saved);
        }
}

TEST_F(StoredSteps, OfAJournalThatBeginsAnewGoAsFarBackAsThatBeginning) {
    auto journal = Journal::begin(path, content_of("3-4>4: 3a 4b", "1-1>1: 1z"));
    ASSERT_TRUE(journal);
    ASSERT_TRUE(journal->begin_anew(content_of("2-5>5: 2k 3l 4m 5n", "2-2>2: 2y"), true));
    ASSERT_TRUE(journal->take_over(content_of("1-6>6: 6o", "1-2>2:")));
    ASSERT_TRUE(journal->add({{.part = 0, .pages = {.whole = false, .pages = {{{"rays", 0}, {}}}}}}));
    journal->end();
    expect_steps("2-6>6: 2k 3l 4m 5n 6o", "2-2>2: 2y", "anew");
}

}  // namespace burin::document
