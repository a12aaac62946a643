// SPDX-License-Identifier: MIT
// A session that is ended from outside, by a signal or because its display dies, leaves all that was done: the journal
// opens with the strokes, the recording is whole, and the terminal says which command goes on.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

namespace fs = std::filesystem;

// Starts a program in a folder, with its output in a file there.
pid_t started(const fs::path& folder, const std::string& command, const std::string& output) {
    const pid_t child = fork();
    if (child != 0) return child;
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // also when the test crashes
    if (chdir(folder.c_str()) != 0) _exit(127);
    const int to = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(to, STDOUT_FILENO);
    dup2(to, STDERR_FILENO);
    execlp("sh", "sh", "-c", ("exec " + command).c_str(), static_cast<char*>(nullptr));
    _exit(127);
}

class SessionEndedFromOutside : public testing::Test {
protected:
    void SetUp() override {
        const auto devices = gpu::list_devices();
        if (!devices) GTEST_SKIP() << "no Vulkan device: " << devices.error().line();
    }
    static bool has_ended(pid_t program) {
        siginfo_t ended{};
        waitid(P_PID, static_cast<id_t>(program), &ended, WEXITED | WNOHANG | WNOWAIT);
        return ended.si_pid != 0;
    }
    // Waits for a program to say something; false: it has ended before.
    bool wait_for(pid_t program, const std::string& output, const std::string& words) {
        for (;;) {
            if (place.read(output).contains(words)) return true;
            if (has_ended(program)) return place.read(output).contains(words);
            usleep(20'000);
        }
    }
    // Waits until what is carved stays as it is: the last three meshes, a second or more apart, are the same, and are
    // no longer the first. Where one is not done in time the next is left out. Returns that mesh; nothing where the
    // program has ended before.
    std::string carved_by(pid_t program) {
        while (!has_ended(program)) {
            std::vector<std::string> made;
            for (int number = 0; number < kExports; ++number)
                if (fs::exists(place / "o" / part(number))) made.push_back("o/" + part(number));
            if (made.size() >= 4) {
                const std::string last = place.read(made.back());
                if (last != place.read(made.front()) && last == place.read(made[made.size() - 2]) &&
                    last == place.read(made[made.size() - 3]))
                    return last;
            }
            usleep(20'000);
        }
        return {};
    }
    // Carves in real time, has `end` end it once that is done, and looks at what is left. Returns what was said.
    template <typename End>
    std::string carve_until(const std::string& how, End end) {
        std::string script = "burin-input 1 test\n0.1 command export " + part(0) +
                             "\n0.5 mouse 160 90\n0.6 button press left\n1.6 mouse 175 100\n1.8 button release left\n";
        for (int number = 1; number < kExports; ++number)
            script += std::to_string(number + 2) + " command export " + part(number) + "\n";
        place.write("script.txt", script + "600 command quit\n");
        const pid_t burin =
            started(place / "",
                    how + std::string(kBurinCommand) +
                        " sculpt ball:0.1 --resolution 64 --tool ball:0.012 --mouse surface --width 320 "
                        "--height 180 --journal j --outputs o --input script.txt --record r.session" +
                        (how.empty() ? " --offscreen" : ""),
                    "said.txt");
        const std::string carved = carved_by(burin);
        EXPECT_FALSE(carved.empty()) << place.read("said.txt");
        end(burin);
        int status = 0;
        EXPECT_EQ(waitpid(burin, &status, 0), burin);
        std::string said = place.read("said.txt");
        EXPECT_TRUE(WIFEXITED(status)) << "it was cut off by signal " << WTERMSIG(status) << ": " << said;
        EXPECT_EQ(WEXITSTATUS(status), 1) << said;
        EXPECT_TRUE(said.contains("what was not saved is kept: burin sculpt j/ball-")) << said;
        const auto checked = place.run(std::string(kBurinCommand) + " session check r.session");
        EXPECT_EQ(checked.status, 0) << checked.output;
        place.write("look.txt", "burin-input 1 test\n0.1 command export kept.ply\n0.2 command quit\n");
        const auto opened =
            place.run(std::string(kBurinCommand) + " sculpt j/ball-*.burin --offscreen --outputs k --input look.txt");
        EXPECT_EQ(opened.status, 0) << opened.output;
        EXPECT_TRUE(opened.output.contains(" change")) << "nothing was carved: " << opened.output;
        EXPECT_TRUE(place.read("k/kept.ply") == carved);
        return said;
    }
    static std::string part(int number) { return "part-" + std::to_string(number) + ".ply"; }

    static constexpr int kExports = 100;
    Workplace place;
};

class SessionEndedByASignal : public SessionEndedFromOutside, public testing::WithParamInterface<int> {};

}  // namespace

TEST_P(SessionEndedByASignal, KeepsAllThatWasDone) {
    const std::string said = carve_until("", [](pid_t burin) { kill(burin, GetParam()); });
    EXPECT_TRUE(said.contains("ended by a signal")) << said;
}

INSTANTIATE_TEST_SUITE_P(Each, SessionEndedByASignal, testing::Values(SIGINT, SIGTERM, SIGHUP));

TEST_F(SessionEndedFromOutside, ByTheDeathOfItsDisplayKeepsAllThatWasDone) {
    const pid_t server =
        started(place / "", "Xvfb -displayfd 1 -screen 0 640x400x24 -nolisten tcp -noreset 2>/dev/null", "display.txt");
    if (!wait_for(server, "display.txt", "\n")) GTEST_SKIP() << "Xvfb is not installed or does not start";
    const std::string display = place.read("display.txt");
    const std::string said = carve_until("env DISPLAY=:" + display.substr(0, display.find('\n')) + " ", [&](pid_t) {
        kill(server, SIGKILL);
        waitpid(server, nullptr, 0);
    });
    EXPECT_TRUE(said.contains("the display: is gone")) << said;
}

}  // namespace burin::session
