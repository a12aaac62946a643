// SPDX-License-Identifier: MIT
// The guided check of a force-feedback device: does it answer, where can it be moved, do its buttons, and does it push
// the way that it is told. `burin devices test NAME`.
//
// Force: along each of its directions it taps to and fro with no more than CheckOptions::force_N, through the same gate
// as a session's (haptics/stability/safety_gate.hpp), and only while the dead man's key is held. Taps without force,
// between the others in a random order (bench/devices/tap_series.hpp), show what the hand does by itself; the verdict
// follows from both (bench/devices/tap_response.hpp). A hand that moves so much that neither a motor that works nor one
// that does not can be told is a verdict of its own, Verdict::unclear.
// Thread: one, which ticks the device a thousand times a second by the clock; with a simulated clock at once.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/json.hpp"
#include "devices/haptic/opened_device.hpp"

namespace burin::bench {

struct CheckOptions {
    double force_N = 1.0;   // the most that it taps with
    double watch_s = 15.0;  // for the handle's motion, and for its buttons: the longest that is waited
    // Nobody answers: what is asked for counts as done, a little motion is enough, and the key counts as held.
    bool by_itself = false;
    bool pushes = true;      // false: no force is tried
    std::uint64_t seed = 1;  // of the order of the taps
};

// Keys that the person at the terminal has pressed or holds.
struct CheckAnswers {
    bool goes_on = false;  // has pressed Enter since the last time
    bool skips = false;    // s
    bool ends = false;     // q, or a signal
    bool holds = false;    // the dead man's key is down
};

class CheckGuide {
public:
    virtual ~CheckGuide() = default;
    // A line that stays: what is asked for, and verdicts.
    virtual void say(const std::string& line) = 0;
    // A line that is written over: where the handle is.
    virtual void show(const std::string& line) = 0;
    [[nodiscard]] virtual CheckAnswers answers(Nanoseconds now_ns) = 0;
};

// unclear: neither passed nor failed.
enum class Verdict : std::uint8_t { passed, failed, skipped, unclear };
[[nodiscard]] const char* name_of(Verdict verdict);

struct CheckLine {
    std::string check;  // answers, position, buttons, force, steadiness; of a part: "position of index"
    Verdict verdict = Verdict::skipped;
    std::string found;
    Json figures = Json::object();
};

// Returns the exit status of a check: kCannotTell where none failed and one is unclear, otherwise 0. Fails where one
// failed, with the names of those that did.
inline constexpr int kCannotTell = 3;
[[nodiscard]] Result<int> outcome_of(const std::string& where, const std::vector<CheckLine>& lines);
// Returns the names of the checks with a verdict, with commas between them.
[[nodiscard]] std::string checks_with(Verdict verdict, const std::vector<CheckLine>& lines);

// Checks an opened device, whose force is zero at the end. The clock is that of the device.
[[nodiscard]] std::vector<CheckLine> check_device(devices::OpenedDevice& device, Clock& clock, CheckGuide& guide,
                                                  const CheckOptions& options);

}  // namespace burin::bench
