// SPDX-License-Identifier: MIT
// Lets a session end in good order when the system or its user asks the program to: SIGINT, SIGTERM, and SIGHUP of a
// terminal that was closed.
// Thread: the frame's.
#pragma once

#include <signal.h>

#include <array>

namespace burin::session {

// While an instance exists, the first signal asks the session to end, which then finishes its files; a second one ends
// the program at once, as without a handler. A signal that was ignored when the program started stays ignored. At most
// one instance at a time.
class EndSignals {
public:
    EndSignals() : before_{{{SIGINT, {}}, {SIGTERM, {}}, {SIGHUP, {}}}} {
        came_ = 0;
        for (Before& one : before_) {
            sigaction(one.signal, nullptr, &one.action);
            if (one.action.sa_handler == SIG_IGN) continue;
            struct sigaction ours{};
            ours.sa_handler = [](int) { came_ = 1; };
            ours.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
            sigemptyset(&ours.sa_mask);
            sigaction(one.signal, &ours, nullptr);
        }
    }
    ~EndSignals() {
        for (const Before& one : before_) sigaction(one.signal, &one.action, nullptr);
    }
    EndSignals(const EndSignals&) = delete;
    EndSignals& operator=(const EndSignals&) = delete;

    [[nodiscard]] bool came() const { return came_ != 0; }

private:
    struct Before {
        int signal = 0;
        struct sigaction action{};
    };
    // Static because a signal handler cannot reach anything but static state.
    static inline volatile sig_atomic_t came_ = 0;
    std::array<Before, 3> before_;
};

}  // namespace burin::session
