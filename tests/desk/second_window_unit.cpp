// SPDX-License-Identifier: MIT
// A document that is open in one window is opened in a second: its person is told, and neither writes over the other.
#include <gtest/gtest.h>

#include <unistd.h>

#include "session/work/document_lock.hpp"
#include "tests/desk/person_desk.hpp"

namespace burin::session {
namespace {

namespace fs = std::filesystem;

TEST(SecondWindow, IsToldWhoHasTheDocumentAndSavesItUnderAnotherName) {
    const Workplace place;
    const std::string path = (place / "plate.burin").string();
    {
        PersonDesk first({}, &place);
        first.run({{CommandInput{"save-as", {path}}, 10'000'000}});
        first.wait_for_disk();
    }
    PersonDesk first(path, &place);
    EXPECT_TRUE(first.told().has_file);
    testing::internal::CaptureStderr();
    PersonDesk second(path, &place);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_TRUE(said.contains("is open in another window, process " + std::to_string(::getpid()) + " on ")) << said;
    EXPECT_TRUE(second.desk->place_on_panel("message 0")) << "the window says it too";
    EXPECT_FALSE(second.told().has_file);
    second.carve();
    second.ctrl(Key::s);
    ASSERT_TRUE(second.desk->place_on_panel("name")) << "it wants another name";
    second.ctrl(Key::a);
    second.type((place / "second").string());
    second.key(Key::enter);
    second.wait_for_disk();
    EXPECT_EQ(saves_of(place / "second.burin"), 1);
    EXPECT_EQ(saves_of(path), 1);
    first.carve();
    first.ctrl(Key::s);
    first.wait_for_disk();
    EXPECT_EQ(saves_of(path), 2) << "the first goes on as ever";
}

TEST(SecondWindow, AfterTheFirstHasClosedHasTheDocument) {
    const Workplace place;
    place.write("a.burin", "");
    const std::string folder = (place / "journals").string(), path = (place / "a.burin").string();
    DocumentLock second;
    {
        DocumentLock first;
        EXPECT_FALSE(first.take(folder, path));
        EXPECT_FALSE(first.take(folder, path)) << "a session's own lock is no other's";
        const auto holder = second.take(folder, path);
        ASSERT_TRUE(holder);
        EXPECT_EQ(holder->process, std::to_string(::getpid()));
        EXPECT_TRUE(holder->since.starts_with("20"));
        fs::create_symlink(path, place / "b.burin");
        EXPECT_TRUE(second.take(folder, (place / "b.burin").string())) << "by another name it is the same";
    }
    EXPECT_FALSE(second.take(folder, path));
    EXPECT_FALSE(DocumentLock().take("", path)) << "where no journal is kept nobody is told";
    EXPECT_FALSE(DocumentLock().take("/proc/no/folder", path));
}

}  // namespace
}  // namespace burin::session
