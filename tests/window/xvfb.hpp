// SPDX-License-Identifier: MIT
// A display for the window tests: Xvfb on a free number, started when the first test asks for it and ended with the
// program.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

namespace burin::window {

class Xvfb {
public:
    // The display of this program; empty name() where Xvfb is not installed or does not start.
    static const Xvfb& running() {
        static const Xvfb one;
        return one;
    }
    [[nodiscard]] const std::string& name() const { return name_; }

    // Its server dies, as by a crash.
    void die() const {
        kill(child_, SIGKILL);
        waitpid(child_, nullptr, 0);
    }

    Xvfb(const Xvfb&) = delete;
    Xvfb& operator=(const Xvfb&) = delete;

private:
    Xvfb() {
        int ends[2];
        if (pipe(ends) != 0) return;
        child_ = fork();
        if (child_ == 0) serve(ends[1]);
        close(ends[1]);
        const std::string number = read_line(ends[0]);
        close(ends[0]);
        if (number.empty()) return;
        name_ = ":" + number;
        setenv("DISPLAY", name_.c_str(), 1);
    }
    ~Xvfb() {
        if (child_ <= 0) return;
        kill(child_, SIGTERM);
        waitpid(child_, nullptr, 0);
    }

    [[noreturn]] static void serve(int number_to) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);  // also when a test crashes
        const int nowhere = open("/dev/null", O_RDWR);
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
        const std::string fd = std::to_string(number_to);
        execlp("Xvfb", "Xvfb", "-displayfd", fd.c_str(), "-screen", "0", "1280x800x24", "-nolisten", "tcp", "-noreset",
               static_cast<char*>(nullptr));
        _exit(127);
    }

    static std::string read_line(int from) {
        std::string line;
        pollfd ready{from, POLLIN, 0};
        while (poll(&ready, 1, 30'000) > 0) {  // a guard for the run, not a measure
            char c = 0;
            if (read(from, &c, 1) != 1 || c == '\n') break;
            line += c;
        }
        return line;
    }

    pid_t child_ = -1;
    std::string name_;
};

}  // namespace burin::window
