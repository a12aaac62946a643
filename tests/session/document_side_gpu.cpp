// SPDX-License-Identifier: MIT
// Where a user's saves go: to the file that was opened or written before, and never over another's.
#include "session/live/document_side.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "document/document_reader.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

namespace fs = std::filesystem;

class DocumentOfAUser : public testing::Test {
protected:
    // Saves pages that say what was saved; returns the outcome.
    document::SaveOutcome save(const std::string& name, char what) {
        document::SaveRequest request = side.request({name}, files, options, {});
        scene::Pages& pages = request.content.parts.emplace_back();
        pages.part = "a thing";
        pages.pages[{"tile", what}] = {static_cast<std::byte>(what)};
        if (!request.changed_alone) pages.pages[{"head", 0}] = {std::byte{1}};
        side.writer().save(std::move(request));
        side.finish();
        return side.take_outcomes().at(0);
    }
    std::size_t pages_in(const std::string& path) {
        Result<document::DocumentReader> reader = document::DocumentReader::open(path);
        EXPECT_TRUE(reader) << reader.error().line();
        return reader ? reader->pages_of("a thing")->pages.size() : 0;
    }
    void expect_saved(const document::SaveOutcome& outcome, const std::string& path, std::size_t pages) {
        EXPECT_TRUE(outcome.saved) << outcome.saved.error().line();
        EXPECT_EQ(outcome.path, path);
        EXPECT_EQ(pages_in(path), pages);
    }
    Workplace at;
    MessageLog log;
    SessionSetup options;
    AskedFiles files{options, log};
    DocumentSide side;
    const std::string path = at / "ball.burin", second = at / "ball-2.burin";
};

}  // namespace

TEST_F(DocumentOfAUser, IsUpdatedByEverySaveAfterTheFirstWhereItsNameWasTaken) {
    at.write("ball.burin", "another's");
    expect_saved(save(path, 1), second, 2);
    expect_saved(save("", 2), second, 3);
    expect_saved(save(path, 3), second, 4);
    EXPECT_EQ(at.files(), 2u);
    EXPECT_EQ(at.read("ball.burin"), "another's");
}

TEST_F(DocumentOfAUser, WhoseFirstSaveFailedIsNotSavedOverWhatLiesThereNow) {
    const std::string folder = at / "folder", later = folder + "/ball.burin";
    EXPECT_FALSE(save(later, 1).saved) << "there is no folder";
    fs::create_directory(folder);
    at.write("folder/ball.burin", "another's");
    expect_saved(save("", 2), folder + "/ball-2.burin", 2);
    EXPECT_EQ(at.read("folder/ball.burin"), "another's");
}

TEST_F(DocumentOfAUser, WhoseFirstSaveFailedIsSavedWholeByTheNext) {
    const std::string folder = at / "folder", later = folder + "/ball.burin";
    EXPECT_FALSE(save(later, 1).saved) << "there is no folder";
    EXPECT_FALSE(save("", 2).saved);
    fs::create_directory(folder);
    expect_saved(save("", 3), later, 4);
}

TEST_F(DocumentOfAUser, StaysTheSessionsWhereASaveElsewhereFails) {
    expect_saved(save(path, 1), path, 2);
    EXPECT_FALSE(save(at / "nowhere/other.burin", 2).saved);
    EXPECT_EQ(side.name(options), path);
    EXPECT_TRUE(side.has_file());
    expect_saved(save("", 3), path, 4);
    EXPECT_EQ(at.files(), 1u);
    expect_saved(save(second, 4), second, 2);
    expect_saved(save("", 5), second, 3);
}

TEST_F(DocumentOfAUser, ThatWasOpenedMayBeReplacedByWhatCameOfIt) {
    expect_saved(save(path, 1), path, 2);
    options.carve.workpiece.source = path;
    AskedFiles of_opened{options, log};
    EXPECT_TRUE(of_opened.is_taken(path, second)) << "it is asked about";
    EXPECT_FALSE(of_opened.place_document(path, second));
    const auto place = of_opened.place_document(path, second, true);
    ASSERT_TRUE(place) << place.error().line();
    EXPECT_EQ(place->path, path);
    EXPECT_TRUE(place->replaces);
}

TEST_F(DocumentOfAUser, ThatWasDeletedMeanwhileIsWrittenAnew) {
    expect_saved(save(path, 1), path, 2);
    fs::remove(path);
    expect_saved(save("", 2), path, 2);
    expect_saved(save("", 3), path, 3);
    EXPECT_EQ(at.files(), 1u);
}

TEST_F(DocumentOfAUser, ThatWasExchangedForAnotherIsNotSavedOver) {
    expect_saved(save(path, 1), path, 2);
    fs::remove(path);
    DocumentSide other;
    std::swap(side, other);
    expect_saved(save(path, 7), second, 2);
    std::swap(side, other);
    fs::rename(second, path);
    const auto refused = save("", 2);
    ASSERT_FALSE(refused.saved);
    EXPECT_TRUE(refused.saved.error().line().contains("another window")) << refused.saved.error().line();
    EXPECT_EQ(pages_in(path), 2u);
}

}  // namespace burin::session
