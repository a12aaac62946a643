// SPDX-License-Identifier: MIT
// Sessions in real time, with an emulated device in a process of its own: whether a hand comes to what it should grasp
// depends on whether the machine lets the session, the emulator and the drawing in software run in time. A machine that
// did not is found out by counts in the session's own recording, never by a clock of the test: ticks that never ran,
// frames that were drawn, and how the recording ended. Such a run is tried again, and at last the test is skipped with
// these counts as its reason; a run at full pace is judged, whatever came of it.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <optional>
#include <sstream>
#include <string>

#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {

// What a session's recording says of the machine's pace.
struct SessionPace {
    std::size_t ticks = 0, never_run = 0, frames = 0;
    bool is_cut_off = false;  // the recording ended before the session, since the scene or the disk stood still

    // A tick is 1 ms. Of 20 ticks one may never have run, and there are five frames a second at least.
    [[nodiscard]] bool is_kept() const { return !is_cut_off && never_run * 20 <= ticks && frames * 200 >= ticks; }
    [[nodiscard]] std::string text() const {
        return std::to_string(ticks) + " ticks, " + std::to_string(never_run) + " never run, " +
               std::to_string(frames) + " frames" + (is_cut_off ? ", recording cut off" : "");
    }
};

[[nodiscard]] inline SessionPace pace_of(const Workplace& at, const std::string& recording) {
    SessionPace pace;
    const auto count_behind = [](const std::string& line, const std::string& title) {
        return line.starts_with(title)
                   ? static_cast<std::size_t>(std::strtoull(line.substr(title.size()).c_str(), nullptr, 10))
                   : 0;
    };
    std::istringstream info(at.run(std::string(kBurinCommand) + " session info " + recording).output);
    for (std::string line; std::getline(info, line);) {
        pace.never_run += count_behind(line, "  ticks never run, hand 0 ");
        pace.is_cut_off |= line.starts_with("  end ") && line.contains("stood still");
        if (const std::size_t end = line.find(" ticks from tick 1 in "); end != std::string::npos && pace.ticks == 0)
            pace.ticks =
                static_cast<std::size_t>(std::strtoull(line.substr(line.rfind(' ', end - 1) + 1).c_str(), nullptr, 10));
    }
    std::istringstream log(at.run(std::string(kBurinCommand) + " convert " + recording + " --to log -").output);
    for (std::string line; std::getline(log, line);) pace.frames += line.contains(" saw ") ? 1 : 0;
    return pace;
}

// Runs a session that makes this recording until it comes out or is to be judged as it came out. Returns the reason to
// skip the test: of four runs none came out, and in none did the machine keep pace.
[[nodiscard]] inline std::optional<std::string> kept_from_real_time(const Workplace& at, const std::string& recording,
                                                                    const std::function<bool()>& comes_out) {
    SessionPace pace;
    for (int run = 0; run < 4; ++run) {
        std::filesystem::remove(at / recording);
        if (comes_out() || !std::filesystem::exists(at / recording)) return {};
        pace = pace_of(at, recording);
        if (pace.is_kept()) return {};
    }
    return "the machine did not keep real time in four runs; in the last: " + pace.text();
}

}  // namespace burin::app
