// SPDX-License-Identifier: MIT
// A study that its reader may not write: it is one, and what is refused says what helps.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "study/folder/study_folder.hpp"
#include "study/report/study_trials.hpp"
#include "tests/study/short_study.hpp"

namespace burin::study {
namespace {

namespace fs = std::filesystem;

class StudyOfAnother : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_EQ(make_study(place).status, 0);
        const auto run = place.run(kBurinStudy + "run s --simulated");
        ASSERT_EQ(run.status, 0) << run.output;
    }
    // Has nobody write it, and takes away the superuser's right to write anywhere.
    void close_it() {
        constexpr auto kWrites = fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write;
        constexpr auto kReads = fs::perms::group_read | fs::perms::others_read;
        constexpr auto kEnters = fs::perms::group_exec | fs::perms::others_exec;
        fs::permissions(place / "", kReads | kEnters, fs::perm_options::add);
        for (const auto& entry : fs::recursive_directory_iterator(place / "s"))
            set_permissions(entry.path(), entry.is_directory() ? kReads | kEnters : kReads, kWrites);
        set_permissions(place / "s", kReads | kEnters, kWrites);
        if (user_ == 0) {
            ASSERT_EQ(::seteuid(65534), 0);
        }
    }
    void TearDown() override {
        if (user_ == 0) {
            ASSERT_EQ(::seteuid(user_), 0);
        }
        fs::permissions(place / "s", fs::perms::owner_all, fs::perm_options::add);
        for (const auto& entry : fs::recursive_directory_iterator(place / "s"))
            fs::permissions(entry.path(), fs::perms::owner_all, fs::perm_options::add);
    }
    [[nodiscard]] std::string why_not_opened(StudyAccess access) const {
        const auto study = StudyFolder::open(place / "s", access);
        return study ? "" : study.error().line();
    }
    [[nodiscard]] Result<TrialsMade> trials() const {
        const auto study = StudyFolder::open(place / "s", StudyAccess::read);
        if (!study) return std::unexpected(study.error());
        return make_trials(*study, [](const std::string&) {});
    }
    Workplace place;

private:
    static void set_permissions(const fs::path& path, fs::perms added, fs::perms taken) {
        fs::permissions(path, added, fs::perm_options::add);
        fs::permissions(path, taken, fs::perm_options::remove);
    }
    uid_t user_ = ::geteuid();
};

}  // namespace

TEST_F(StudyOfAnother, IsNotCalledNone) {
    close_it();
    const std::string why = why_not_opened(StudyAccess::write);
    EXPECT_TRUE(why.contains("may not be written") && why.contains("permission")) << why;
    EXPECT_EQ(why_not_opened(StudyAccess::read), "");
}

TEST_F(StudyOfAnother, WhoseJournalAloneIsClosedIsRefusedBeforeAnythingIsDone) {
    fs::permissions(place / "s/lock", fs::perms::all);
    close_it();
    const std::string why = why_not_opened(StudyAccess::write);
    EXPECT_TRUE(why.contains("may not be written") && why.contains("permission")) << why;
}

TEST_F(StudyOfAnother, ThatMayNotEvenBeReadSaysSo) {
    fs::permissions(place / "s/study.json", fs::perms::none);
    fs::permissions(place / "", fs::perms::group_exec | fs::perms::others_exec, fs::perm_options::add);
    if (::geteuid() == 0) {
        ASSERT_EQ(::seteuid(65534), 0);
    }
    const std::string why = why_not_opened(StudyAccess::read);
    EXPECT_TRUE(why.contains("may not be read") && why.contains("permission")) << why;
}

TEST_F(StudyOfAnother, IsAnalysedWhereItsTableIsThereAsItIs) {
    ASSERT_TRUE(trials());
    close_it();
    const auto made = trials();
    EXPECT_TRUE(made) << made.error().line();
}

TEST_F(StudyOfAnother, WithoutItsTableSaysToCopyTheStudy) {
    fs::remove(place / "s/trials.csv");
    close_it();
    const auto none = trials();
    ASSERT_FALSE(none);
    EXPECT_TRUE(none.error().line().contains("copy the study's folder")) << none.error().line();
}

TEST_F(StudyOfAnother, HasNoNewReportBesideTheOthersAndSaysToCopyTheStudy) {
    if (::geteuid() == 0) GTEST_SKIP() << "a program that is started by the superuser may write anywhere";
    ASSERT_TRUE(trials());
    close_it();
    const auto report = place.run(kBurinStudy + "report s");
    EXPECT_EQ(report.status, 1);
    EXPECT_TRUE(report.output.contains("copy the study's folder")) << report.output;
}

}  // namespace burin::study
