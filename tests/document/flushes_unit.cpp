// SPDX-License-Identifier: MIT
// What a power cut cannot take: each document and journal is on the disk, and its name in its folder, before whoever
// asked for it is told so.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "base/file_io.hpp"
#include "document/document_writer.hpp"
#include "document/journal.hpp"
#include "tests/support/flush_log.hpp"
#include "tests/support/run_command.hpp"

namespace burin::document {
namespace {

Content content_that_is_flushed(char mark = 'a') {
    Content content{.facts = {{kJournalNameFact, "work.burin"}}};
    content.parts.push_back({.part = "a thing"});
    content.parts[0].pages = {{{"tile", 0}, std::vector<std::byte>(5000, static_cast<std::byte>(mark))}};
    return content;
}

Change change_that_is_flushed() {
    return {.part = 0, .pages = {.whole = false, .pages = {{{"rays", 0}, std::vector<std::byte>(3000)}}}};
}

class FlushedFiles : public testing::Test {
protected:
    void SetUp() override { forget_flushes(); }
    // The flushes since the last call, of the file, or of its log.
    [[nodiscard]] static std::size_t flushes_of(const std::string& name) {
        return static_cast<std::size_t>(std::ranges::count_if(
            all_flushes(), [&](const Flushed& one) { return !one.is_folder && one.path.contains("/" + name); }));
    }
    // Expects that the folder was flushed, as the last thing of all, when it held the name for good.
    void expect_name_flushed(const std::string& name, const std::string& of) const {
        const std::vector<Flushed> all = all_flushes();
        ASSERT_FALSE(all.empty()) << of;
        const Flushed& last = all.back();
        EXPECT_TRUE(last.is_folder) << of << ": " << last.path;
        EXPECT_EQ(last.path, std::filesystem::canonical(at / "").string()) << of;
        EXPECT_TRUE(std::ranges::find(last.names, name) != last.names.end()) << of;
        for (const std::string& other : last.names) EXPECT_FALSE(other.contains(".saving-")) << of << ": " << other;
    }
    Workplace at;
    const std::string path = at / "work.burin", journal_path = at / "work-1.burin";
};

}  // namespace

TEST_F(FlushedFiles, OfANewDocumentAreOnTheDiskAndThenInTheirFolder) {
    for (const Place place : {Place::nothing, Place::replaced, Place::replaced}) {
        forget_flushes();
        ASSERT_TRUE(write_document(path, content_that_is_flushed(), place));
        EXPECT_GE(flushes_of("work.burin.saving-"), 1u);
        expect_name_flushed("work.burin", place == Place::nothing ? "a new one" : "one in place of another");
    }
}

TEST_F(FlushedFiles, OfADocumentThatIsSavedElsewhereAreInTheFolderOfTheNewOne) {
    DocumentWriter writer;
    for (const char* const name : {"work.burin", "second.burin", "third.burin"}) {
        forget_flushes();
        writer.save({.path = at / name, .name = name, .content = content_that_is_flushed()});
        writer.finish();
        ASSERT_TRUE(writer.take_outcomes().at(0).saved);
        expect_name_flushed(name, name);
    }
}

TEST_F(FlushedFiles, OfADocumentInTheWorkingFolderAreInThatFolder) {
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(at / "");
    const auto saved = write_document("work.burin", content_that_is_flushed(), Place::nothing);
    std::filesystem::current_path(before);
    ASSERT_TRUE(saved);
    expect_name_flushed("work.burin", "without a folder");
}

TEST_F(FlushedFiles, OfAnUpdateAreOnTheDiskBeforeItIsTold) {
    auto saved = write_document(path, content_that_is_flushed(), Place::nothing);
    for (const char mark : {'b', 'c', 'd'}) {
        ASSERT_TRUE(saved);
        forget_flushes();
        saved = update_document(path, content_that_is_flushed(mark), saved->version);
        EXPECT_GE(flushes_of("work.burin-wal"), 1u) << mark << ": the commit";
    }
}

TEST_F(FlushedFiles, OfAJournalAreThereFromItsBeginningAndAfterEachChange) {
    auto journal = Journal::begin(journal_path, content_that_is_flushed());
    ASSERT_TRUE(journal);
    expect_name_flushed("work-1.burin", "its beginning");
    EXPECT_GE(flushes_of("work-1.burin"), 1u);
    for (int number = 0; number < 3; ++number) {
        forget_flushes();
        ASSERT_TRUE(journal->add({change_that_is_flushed()}));
        EXPECT_GE(flushes_of("work-1.burin"), 1u) << number;
    }
    forget_flushes();
    ASSERT_TRUE(journal->take_over(content_that_is_flushed('b')));
    EXPECT_GE(flushes_of("work-1.burin"), 1u) << "what was saved";
    forget_flushes();
    ASSERT_TRUE(journal->begin_anew(content_that_is_flushed('c'), true));
    EXPECT_GE(flushes_of("work-1.burin"), 1u) << "what it begins anew with";
}

// What is no document: exports, recordings' words, runs of exercises, settings.
TEST_F(FlushedFiles, WrittenInOneGoAreOnTheDiskBeforeTheyHaveTheirNameAndThenInTheirFolder) {
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::create_directory(at / "folder");
    std::filesystem::create_symlink(at / "folder/there.json", at / "link.json");
    std::filesystem::current_path(at / "");
    for (const std::string name : {"new.json", "new.json", "folder/there.json", "link.json"}) {
        forget_flushes();
        const std::vector<std::byte> bytes(70'000, static_cast<std::byte>(name.size()));
        for (const bool is_relative : {false, true}) {
            const std::filesystem::path file = is_relative ? std::filesystem::path(name) : at / name;
            ASSERT_TRUE(write_file_atomically(file, bytes)) << name;
            const std::filesystem::path is = std::filesystem::canonical(at / name);
            const std::vector<Flushed> all = all_flushes();
            ASSERT_GE(all.size(), 2u) << name;
            EXPECT_FALSE(all[all.size() - 2].is_folder) << name;
            EXPECT_TRUE(all[all.size() - 2].path.contains(is.filename().string() + ".")) << all[all.size() - 2].path;
            EXPECT_TRUE(all.back().is_folder) << name;
            EXPECT_EQ(all.back().path, is.parent_path().string());
            const auto& names = all.back().names;
            EXPECT_TRUE(std::ranges::find(names, is.filename().string()) != names.end()) << name;
            for (const std::string& other : names) EXPECT_FALSE(other.ends_with(".part")) << other;
        }
    }
    std::filesystem::current_path(before);
}

}  // namespace burin::document
