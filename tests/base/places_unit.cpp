// SPDX-License-Identifier: MIT
#include "base/places.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/file_io.hpp"
#include "tests/support/run_command.hpp"

namespace burin {
namespace {

namespace fs = std::filesystem;

// Stands in a folder that has been deleted, until the end of the scope.
class DeletedFolder {
public:
    DeletedFolder() : home_(fs::current_path()) {
        const fs::path gone = place_ / "gone";
        fs::create_directory(gone);
        fs::current_path(gone);
        fs::remove(gone);
    }
    ~DeletedFolder() { fs::current_path(home_); }
    DeletedFolder(const DeletedFolder&) = delete;
    DeletedFolder& operator=(const DeletedFolder&) = delete;
    [[nodiscard]] const Workplace& place() const { return place_; }

private:
    const Workplace place_;
    const fs::path home_;
};

TEST(Places, ARelativePathHasNoneInADeletedWorkingFolder) {
    EXPECT_FALSE(working_folder_is_gone());
    EXPECT_TRUE(check_working_folder("part.stl"));
    EXPECT_EQ(absolute_path("part.stl"), fs::current_path() / "part.stl");
    const DeletedFolder here;
    EXPECT_TRUE(working_folder_is_gone());
    EXPECT_EQ(absolute_path("part.stl"), "part.stl");
    EXPECT_FALSE(resolved_path("part.stl"));
    EXPECT_TRUE(resolved_path(here.place() / "part.stl"));
    const Result<void> checked = check_working_folder("part.stl");
    ASSERT_FALSE(checked);
    EXPECT_EQ(
        checked.error().line(),
        "part.stl: has no place: the working folder has been deleted; change to a folder that exists (cd), or give "
        "a path that begins with /");
    EXPECT_TRUE(check_working_folder(here.place() / "part.stl"));
}

TEST(Places, AFileInADeletedWorkingFolderIsNeitherReadNorWritten) {
    const DeletedFolder here;
    for (const Result<void>& refused : {check_writable("part.stl"), write_file_atomically("part.stl", {})}) {
        ASSERT_FALSE(refused);
        EXPECT_NE(refused.error().what.find("the working folder has been deleted"), std::string::npos);
    }
    const auto read = read_file("part.stl");
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().what.find("the working folder has been deleted"), std::string::npos);
    EXPECT_TRUE(check_writable(here.place() / "part.stl"));
}

TEST(Places, EntriesAreSortedAndAFolderThatIsNotThereIsAnError) {
    const Workplace place;
    place.write("b.txt", "");
    place.write("a.txt", "");
    fs::create_directory(place / "c");
    place.write("c/d.txt", "");
    EXPECT_EQ(entries_of(place / "").value_or(std::vector<fs::path>()).size(), 3u);
    EXPECT_EQ(entries_below(place / "c"), (std::vector<fs::path>{place / "c" / "d.txt"}));
    EXPECT_EQ(entries_of(place / "").value().front().filename(), "a.txt");
    for (const auto& gone : {entries_of(place / "gone"), entries_below(place / "gone"), entries_of(place / "a.txt")})
        EXPECT_FALSE(gone);
}

}  // namespace
}  // namespace burin
