// SPDX-License-Identifier: MIT
#include "base/file_io.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/flush_log.hpp"
#include "tests/support/run_command.hpp"

namespace burin {
namespace {

using namespace std::string_literals;

std::string read_back(const std::string& bytes, std::uint64_t max_bytes = kMaxFileBytes) {
    const Workplace place;
    place.write("notes.txt", bytes);
    const auto text = read_text_file(place / "notes.txt", max_bytes);
    if (!text) {
        EXPECT_EQ(text.error().where, (place / "notes.txt").string());
    }
    return text ? *text : "refused: it " + text.error().what + "; " + text.error().remedy;
}

TEST(ReadTextFile, LeavesOutAByteOrderMarkAtTheStartAlone) {
    EXPECT_EQ(read_back("\xEF\xBB\xBF"
                        "1 \xC3\xBC\n\xEF\xBB\xBF"
                        "2"),
              "1 \xC3\xBC\n\xEF\xBB\xBF"
              "2");
    EXPECT_EQ(read_back("\xEF\xBB\xBF"), "");
    EXPECT_EQ(read_back("\xEF\xBB"), "\xEF\xBB");
    EXPECT_EQ(read_back(""), "");
}

TEST(ReadTextFile, EndsEveryLineWithALineFeed) {
    EXPECT_EQ(read_back("a\r\nb\rc\n\r\r\nd\r"), "a\nb\nc\n\n\nd\n");
    EXPECT_EQ(read_back("\xEF\xBB\xBF\r\n\r"), "\n\n");
}

TEST(ReadTextFile, RefusesUtf16AndUtf32WithTheRemedy) {
    const std::string utf16 = "refused: it is UTF-16 text; save it as UTF-8";
    const std::string utf32 = "refused: it is UTF-32 text; save it as UTF-8";
    EXPECT_EQ(read_back("\xFF\xFEv\0 \0"s), utf16);
    EXPECT_EQ(read_back("\xFE\xFF\0v\0 "s), utf16);
    EXPECT_EQ(read_back("\xFF\xFE\x2D\x4E"s), utf16) << "no letter of ASCII";
    EXPECT_EQ(read_back("\xFF\xFE"s), utf16);
    EXPECT_EQ(read_back("v\0 \0"s), utf16) << "without a mark";
    EXPECT_EQ(read_back("\0v\0 "s), utf16) << "without a mark";
    EXPECT_EQ(read_back("\xFF\xFE\0\0v\0\0\0"s), utf32);
    EXPECT_EQ(read_back("\0\0\xFE\xFF\0\0\0v"s), utf32);
    EXPECT_EQ(read_back("v\0\0\0 \0\0\0"s), utf32) << "without a mark";
}

TEST(ReadTextFile, KeepsItsLimitAndNamesAMissingFile) {
    EXPECT_EQ(read_back("12345", 5), "12345");
    EXPECT_NE(read_back("12345", 4).find("more than the limit of 4"), std::string::npos);
    EXPECT_NE(read_text_file("no/such/file").error().line().find("no/such/file"), std::string::npos);
}

// A power cut leaves the old content or the new: the bytes are on the disk before the name is, and the name at the end.
TEST(WriteFileAtomically, BringsTheBytesAndThenTheNameToTheDisk) {
    const Workplace place;
    for (const char* const content : {"first", "second"}) {
        forget_flushes();
        const std::string text = content;
        ASSERT_TRUE(write_file_atomically(place / "a.txt", std::as_bytes(std::span(text))));
        EXPECT_EQ(place.read("a.txt"), content);
        const std::vector<Flushed> all = all_flushes();
        ASSERT_EQ(all.size(), 2u);
        EXPECT_FALSE(all[0].is_folder);
        EXPECT_NE(all[0].path, (place / "a.txt").string()) << "under another name";
        EXPECT_TRUE(all[1].is_folder);
        EXPECT_EQ(all[1].names, std::vector<std::string>{"a.txt"}) << "once it has its name";
    }
}

}  // namespace
}  // namespace burin
