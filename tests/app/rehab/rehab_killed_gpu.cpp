// SPDX-License-Identifier: MIT
// burin rehab that is killed where nobody could foresee it: each run is kept as far as it came, and once.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <random>
#include <set>
#include <string>

#include "base/json.hpp"
#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

namespace fs = std::filesystem;

class KilledRehabSessions : public testing::Test {
protected:
    void SetUp() override {
        if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    }
    [[nodiscard]] std::string rehab(unsigned participant, const std::string& more = "--repetitions 2") const {
        return "cd " + std::string(kSessionsFolder) + "/../.. && exec " + kBurinCommand +
               " rehab ball --hand scripted --offscreen --seed 1 --outputs " + (at / "out").string() + " --results " +
               results.string() + " --participant " + std::to_string(participant) + " " + more;
    }
    // Starts it in a process of its own.
    [[nodiscard]] pid_t start(const std::string& command) const {
        const pid_t child = ::fork();
        if (child != 0) return child;
        const int nowhere = ::open("/dev/null", O_WRONLY);
        ::dup2(nowhere, 1);
        ::dup2(nowhere, 2);
        ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
        ::_exit(127);
    }
    // Returns the journal that a participant has; empty: none.
    [[nodiscard]] std::string journal_of(unsigned participant) const {
        std::error_code gone;
        const fs::path own = results / ("participant-00" + std::to_string(participant));
        for (fs::directory_iterator file(own, gone), end; !gone && file != end; file.increment(gone))
            if (file->path().extension() == ".journal") return file->path().string();
        return "";
    }
    // Waits until so many lines of another journal than the one before are there, or the run has ended; returns whether
    // it goes on.
    [[nodiscard]] bool wait_for_lines(pid_t child, unsigned participant, std::ptrdiff_t lines,
                                      const std::string& before = "") const {
        for (std::string now; (now = journal_of(participant)) == before || now.empty() ||
                              std::ranges::count(at.read(now), '\n') < lines;) {
            siginfo_t ended{};
            if (::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 ||
                ended.si_pid == child)
                return false;
            ::poll(nullptr, 0, 1);  // leaves the processor to the run
        }
        return true;
    }
    void kill_hard(pid_t child) const {
        ::kill(child, SIGKILL);
        int status = 0;
        ::waitpid(child, &status, 0);
    }
    // Returns all kept runs by participant's folder and file's name: two may have begun in one second.
    [[nodiscard]] std::map<std::string, Json> kept() const {
        std::map<std::string, Json> runs;
        for (const auto& file : fs::recursive_directory_iterator(results))
            if (file.path().extension() == ".json")
                runs[fs::relative(file.path(), results).string()] = Json::parse(at.read(file.path().string()));
        return runs;
    }
    [[nodiscard]] Workplace::Outcome report() const {
        return at.run(std::string(kBurinCommand) + " rehab report " + results.string());
    }
    const Workplace at;
    const fs::path results = at / "results";
};

}  // namespace

// The run is in simulated time: what it has reached at an event is what the whole run has there.
TEST_F(KilledRehabSessions, LeaveEachRunAsFarAsItCameAndNoneTwice) {
    const auto whole = at.run(rehab(1, "--repetitions 2 --report " + (at / "whole.json").string()));
    ASSERT_EQ(whole.status, 0) << whole.output;
    const Json all = Json::parse(at.read("whole.json")).at("events");
    ASSERT_GE(all.size(), 8u);
    std::mt19937_64 random(64);
    std::size_t runs = 1, broken_off = 0;
    std::set<std::size_t> reached;
    for (int i = 0; i < 20; ++i) {
        const std::string before = journal_of(7);
        // Each of another day: two of one second that came equally far would be copies of one another.
        const pid_t child = start(rehab(7, "--repetitions 2 --date 2026-03-" + std::to_string(10 + i)));
        const auto lines = static_cast<std::ptrdiff_t>(1 + random() % (all.size() + 2));
        static_cast<void>(wait_for_lines(child, 7, lines, before));
        kill_hard(child);
        ++runs;
        if (i % 2 != 0) continue;  // the next run takes it up
        const auto told = report();
        ASSERT_EQ(told.status, 0) << told.output;
        ASSERT_EQ(kept().size(), runs) << "a run is lost, or is there twice";
    }
    ASSERT_EQ(report().status, 0);
    for (int again = 0; again < 2; ++again) {
        const auto now = kept();
        EXPECT_EQ(now.size(), runs);
        for (const auto& [name, run] : now) {
            const Json& events = run.at("report").at("events");
            ASSERT_LE(events.size(), all.size());
            for (std::size_t i = 0; i < events.size(); ++i) EXPECT_EQ(events.at(i), all.at(i)) << name;
            const auto counted =
                std::ranges::count_if(events, [](const Json& event) { return event.at("what") == "counted"; });
            EXPECT_EQ(run.at("report").at("counts").at("repetitions"), counted) << name;
            EXPECT_EQ(run.at("hand"), "scripted, seed 1");
            broken_off += again == 0 && run.at("report").at("ended") == "broken off" ? 1 : 0;
            reached.insert(events.size());
        }
        ASSERT_EQ(report().status, 0);
    }
    EXPECT_GE(broken_off, 10u);
    EXPECT_GE(reached.size(), 5u) << "kills were at different states";
    for (const auto& file : fs::recursive_directory_iterator(results))
        EXPECT_NE(file.path().extension(), ".journal") << file.path();
}

TEST_F(KilledRehabSessions, KeepTheirParticipantFromOthersWhileTheyLive) {
    const pid_t child = start(rehab(7, "--repetitions 40 --time-limit 600"));
    ASSERT_TRUE(wait_for_lines(child, 7, 2));
    const auto second = at.run(rehab(7));
    EXPECT_EQ(second.status, 1);
    EXPECT_TRUE(second.output.contains("participant 7: has a run under way: process " + std::to_string(child)))
        << second.output;
    const auto other = at.run(rehab(8, "--time-limit 3 --repetitions 1"));
    EXPECT_EQ(other.status, 0) << other.output;
    EXPECT_TRUE(wait_for_lines(child, 7, 2)) << "it goes on";
    EXPECT_EQ(kept().size(), 1u) << "the other's alone";
    kill_hard(child);
    EXPECT_EQ(report().status, 0);
    EXPECT_EQ(kept().size(), 2u);
}

// In real time: how far it comes depends on the machine, and what the recording has is at least as far as the journal.
TEST_F(KilledRehabSessions, ThatWereRecordedAreBroughtBackAsWhatTheyWere) {
    const std::string session = (at / "k.session").string();
    const pid_t child = start(rehab(7, "--repetitions 2 --record " + session));
    ASSERT_TRUE(wait_for_lines(child, 7, 5));
    kill_hard(child);
    ASSERT_EQ(report().status, 0);
    const auto before = kept();
    ASSERT_EQ(before.size(), 1u);
    const auto again = at.run("cd " + std::string(kSessionsFolder) + "/../.. && " + kBurinCommand +
                              " rehab ball --repetitions 2" + " --start at_once --offscreen --input " + session +
                              " --outputs " + (at / "out2").string() + " --results " + results.string());
    EXPECT_EQ(again.status, 0) << again.output;
    const auto after = kept();
    ASSERT_EQ(after.size(), 1u) << again.output;
    const Json &was = before.begin()->second, &is = after.begin()->second;
    for (const char* key : {"participant", "date", "time", "hand"}) EXPECT_EQ(is.at(key), was.at(key)) << key;
    EXPECT_EQ(is.at("hand"), "scripted, seed 1");
    EXPECT_EQ(is.at("report").at("ended"), "broken off");
    EXPECT_GE(is.at("report").at("time_s").get<double>(), was.at("report").at("time_s").get<double>());
    const Json &first = was.at("report").at("events"), &all = is.at("report").at("events");
    ASSERT_GE(all.size(), first.size());
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(all.at(i), first.at(i));
}

}  // namespace burin::app
