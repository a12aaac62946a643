// SPDX-License-Identifier: MIT
// The person at a terminal who is guided through a check of a device: lines to read, and keys, of which the space bar
// is the dead man's. A terminal knows no key that is let go: the space bar counts as held for kFirst_ns after it is
// pressed, until the keyboard begins to repeat it, and for kAgain_ns after each repetition.
// While it lives the terminal gives each key at once and does not show it. One thread.
#pragma once

#include <termios.h>

#include <string>

#include "bench/devices/device_check.hpp"
#include "session/drive/end_signals.hpp"

namespace burin::app {

class TerminalGuide final : public bench::CheckGuide {
public:
    static constexpr Nanoseconds kFirst_ns = 600'000'000, kAgain_ns = 150'000'000;

    // Returns whether a person can press keys: standard input is a terminal.
    [[nodiscard]] static bool is_there();

    // is_quiet: nothing is written, as standard output has something else.
    explicit TerminalGuide(bool is_quiet, bool takes_keys);
    ~TerminalGuide() override;
    TerminalGuide(const TerminalGuide&) = delete;
    TerminalGuide& operator=(const TerminalGuide&) = delete;

    void say(const std::string& line) override;
    void show(const std::string& line) override;
    [[nodiscard]] bench::CheckAnswers answers(Nanoseconds now_ns) override;

private:
    bool is_quiet_, takes_keys_, shows_;
    bool has_shown_ = false;
    termios before_{};
    Nanoseconds held_until_ns_ = 0;
    session::EndSignals signals_;
};

}  // namespace burin::app
