// SPDX-License-Identifier: MIT
// A recording whose program was killed lies there as a file and its log. Reading it makes nothing beside it, and needs
// no place that may be written.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <string>

#include "record/derived.hpp"
#include "record/private_index.hpp"
#include "record/record_store.hpp"
#include "tests/record/made_ticks.hpp"

namespace burin::record {
namespace {

namespace fs = std::filesystem;
using test::sound_ticks;

// The superuser may write anywhere: while this lives the process is nobody in particular.
class AsNobody {
public:
    AsNobody() {
        if (was_ == 0) become(65534);
    }
    ~AsNobody() {
        if (was_ == 0) become(was_);
    }
    AsNobody(const AsNobody&) = delete;
    AsNobody& operator=(const AsNobody&) = delete;

private:
    static void become(uid_t user) { EXPECT_EQ(::seteuid(user), 0); }
    uid_t was_ = ::geteuid();
};

class TornRecording : public testing::Test {
protected:
    // Leaves what a kill leaves behind: the file and its log.
    void SetUp() override {
        fs::create_directory(at / "torn");
        test::Recording recording;
        ASSERT_TRUE(recording.begin(at / "whole.session"));
        for (int batch = 0; batch < 100 && recording.writer->acknowledged() == 0; ++batch) recording.push(300);
        acknowledged = recording.writer->acknowledged();
        ASSERT_GT(acknowledged, 0u);
        for (const char* const ending : {"", "-wal"})
            fs::copy_file(at / ("whole.session" + std::string(ending)), path + ending);
        ASSERT_GT(fs::file_size(path + "-wal"), 4096u);
    }
    void TearDown() override { fs::permissions(at / "torn", fs::perms::owner_all); }
    void make_read_only() const {
        constexpr auto kReads = fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read;
        constexpr auto kEnters = fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec;
        for (const auto& file : fs::directory_iterator(at / "torn")) fs::permissions(file.path(), kReads);
        fs::permissions(at / "", kReads | kEnters | fs::perms::owner_write);
        fs::permissions(at / "torn", kReads | kEnters);
    }
    [[nodiscard]] std::size_t files_beside() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(at / "torn"), {}));
    }
    Workplace at;
    std::uint64_t acknowledged = 0;  // ticks
    const std::string path = at / "torn/a.session";
};

}  // namespace

TEST_F(TornRecording, IsReadAndNothingIsLeftBesideIt) {
    const std::string file = at.read("torn/a.session"), log = at.read("torn/a.session-wal");
    for (int time = 0; time < 2; ++time) {
        const auto ticks = sound_ticks(path);
        ASSERT_TRUE(ticks) << ticks.error().line();
        EXPECT_EQ(*ticks, acknowledged);
        EXPECT_EQ(files_beside(), 2u) << "no index of the log";
    }
    EXPECT_EQ(at.read("torn/a.session"), file);
    EXPECT_EQ(at.read("torn/a.session-wal"), log);
}

TEST_F(TornRecording, IsReadWhereNothingMayBeWritten) {
    make_read_only();
    const AsNobody nobody;
    const auto ticks = sound_ticks(path);
    ASSERT_TRUE(ticks) << ticks.error().line();
    EXPECT_EQ(*ticks, acknowledged);
}

TEST_F(TornRecording, IsReadWhateverAnIndexThatWasLeftSays) {
    for (const std::string& left : {std::string("xyz"), std::string(32768, '\0'), std::string(32768, 'x')}) {
        at.write("torn/a.session-shm", left);
        const auto ticks = sound_ticks(path);
        ASSERT_TRUE(ticks) << ticks.error().line();
        EXPECT_EQ(*ticks, acknowledged);
        EXPECT_EQ(at.read("torn/a.session-shm"), left);
    }
}

TEST_F(TornRecording, IsReadByTwoAtOnce) {
    const auto first = RecordReader::open(path), second = RecordReader::open(path);
    ASSERT_TRUE(first) << first.error().line();
    ASSERT_TRUE(second) << second.error().line();
    EXPECT_EQ(*sound_ticks(path), acknowledged);
    EXPECT_EQ(files_beside(), 2u);
}

// As burin session replay --through does it: what was open reads on what it had.
TEST_F(TornRecording, TakesAComputedTableWhileItIsRead) {
    auto reader = RecordReader::open(path);
    ASSERT_TRUE(reader) << reader.error().line();
    auto writer = DerivedWriter::create({"counts", "test 1", 0, {{"tick", "", "", ColumnType::i64}}, {}, "{}"});
    ASSERT_TRUE(writer) << writer.error().line();
    for (std::int64_t tick = 1; tick <= 200'000; ++tick) {
        const std::array row{static_cast<Word>(tick) * 0x9e3779b97f4a7c15u};  // which no compression makes small
        ASSERT_TRUE(writer->add(tick, 1000 * tick, row));
    }
    const auto added = writer->finish(path);
    ASSERT_TRUE(added) << added.error().line();
    EXPECT_EQ(reader->tables(), 1u);
    std::uint64_t rows = 0;
    for (std::size_t n = 0; n < reader->hands()[0].blocks.size(); ++n) {
        const auto block = reader->block(0, n);
        ASSERT_TRUE(block) << block.error().line();
        rows += block->rows();
    }
    EXPECT_EQ(rows, acknowledged);
    EXPECT_EQ(*sound_ticks(path), acknowledged);
    const auto again = RecordReader::open(path);
    ASSERT_TRUE(again) << again.error().line();
    EXPECT_EQ(again->tables(), 2u);
}

// The transaction in the journal can be taken back by writing alone.
TEST_F(TornRecording, InTheMiddleOfAChangeIsReadOrSaysWhatHelps) {
    const std::string whole = at / "whole.session";
    const auto whole_ticks = sound_ticks(whole);
    ASSERT_TRUE(whole_ticks) << whole_ticks.error().line();
    for (const char* const ending : {"", "-wal"}) fs::remove(path + ending);
    {
        auto database = Database::open(whole, Database::Use::write);
        ASSERT_TRUE(database &&
                    database->run("PRAGMA cache_size = 1; BEGIN; UPDATE block SET tick0 = tick0 + 1, data = "
                                  "zeroblob(100000)"));
        fs::copy_file(whole, path);
        fs::copy_file(whole + "-journal", path + "-journal");
    }
    make_read_only();
    {
        const AsNobody nobody;
        const auto ticks = sound_ticks(path);
        ASSERT_FALSE(ticks);
        EXPECT_TRUE(ticks.error().line().contains("copy it to a folder that you may write to")) << ticks.error().line();
    }
    for (const auto& file : fs::directory_iterator(at / "torn")) fs::permissions(file.path(), fs::perms::owner_all);
    fs::permissions(at / "torn", fs::perms::owner_all);
    const auto ticks = sound_ticks(path);
    ASSERT_TRUE(ticks) << ticks.error().line();
    EXPECT_EQ(*ticks, *whole_ticks);
    EXPECT_EQ(files_beside(), 1u);
}

TEST(IndexOfALog, ThatLiesThereAloneBlocksNoName) {
    const Workplace at;
    const std::string path = at / "a.session";
    at.write("a.session-shm", std::string(32768, 'x'));
    EXPECT_TRUE(check_new_place(path));
    {
        test::Recording recording;
        const auto begun = recording.begin(path);
        ASSERT_TRUE(begun) << begun.error().line();
        recording.push(10);
    }
    EXPECT_EQ(*sound_ticks(path), 10u);
    for (const char* const ending : {"-wal", "-journal"}) {
        at.write("b.session" + std::string(ending), "left");
        const auto place = check_new_place(at / "b.session");
        ASSERT_FALSE(place) << ending;
        EXPECT_TRUE(place.error().line().contains("belongs to another recording")) << place.error().line();
        fs::remove(at / ("b.session" + std::string(ending)));
    }
}

// Who has it open writes there what others have to know, and has to know what they read.
TEST(IndexOfALog, IsSharedAsLongAsSomebodyHasItOpen) {
    const Workplace at;
    const std::string path = at / "a";
    EXPECT_FALSE(is_index_shared(path)) << "there is none";
    int told[2];
    ASSERT_EQ(::pipe(told), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        sqlite3* other = nullptr;
        sqlite3_open(path.c_str(), &other);
        const int code = sqlite3_exec(other, "PRAGMA journal_mode = WAL; CREATE TABLE t(x)", nullptr, nullptr, nullptr);
        const char done = code == SQLITE_OK ? 'y' : 'n';
        if (::write(told[1], &done, 1) == 1) ::pause();
        ::_exit(1);
    }
    ::close(told[1]);
    char done = 0;
    ASSERT_EQ(::read(told[0], &done, 1), 1);
    ::close(told[0]);
    EXPECT_EQ(done, 'y');
    EXPECT_TRUE(is_index_shared(path));
    ::kill(child, SIGKILL);
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    EXPECT_TRUE(fs::exists(path + "-shm"));
    EXPECT_FALSE(is_index_shared(path));
}

// SQLite says of a call that finds no room that the disk has an error.
TEST(FullDisk, IsNamedWhicheverCallFindsIt) {
    struct Refused {
        int code, reason;
        bool is_full;
    };
    for (const Refused& one : {Refused{SQLITE_FULL, 0, true},
                               {SQLITE_IOERR_SHMSIZE, ENOSPC, true},
                               {SQLITE_IOERR_SHMSIZE, EIO, false},
                               {SQLITE_CANTOPEN, EDQUOT, true},
                               {SQLITE_CANTOPEN, EACCES, false}}) {
        const Error error = database_error(one.code, one.reason, "SQLite's words", "a", {});
        EXPECT_EQ(error.what == "the disk is full", one.is_full) << one.code << ' ' << one.reason;
    }
}

}  // namespace burin::record
