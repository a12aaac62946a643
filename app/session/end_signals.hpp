// SPDX-License-Identifier: MIT
// While it exists, SIGINT and SIGTERM ask the session to end, which then finishes its files; a second one ends the program at once, as
// without it. A signal that the program was started to ignore stays ignored. One at a time; main thread.
#pragma once

#include <signal.h>

#include <array>

namespace burin {

class EndSignals {
public:
    EndSignals();
    ~EndSignals();
    EndSignals(const EndSignals&) = delete;
    EndSignals& operator=(const EndSignals&) = delete;

    [[nodiscard]] bool came() const;

private:
    struct Before {
        int signal = 0;
        struct sigaction action{};
    };
    std::array<Before, 2> before_;
};

}  // namespace burin
