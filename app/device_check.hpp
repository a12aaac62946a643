// SPDX-License-Identifier: MIT
// The guided check of a force-feedback device: does it answer, where can it be moved, do its buttons, and does it push
// the way that it is told. `burin devices test NAME`.
//
// Force: along each of its directions it taps to and fro with no more than CheckOptions::force_N, through the same gate
// as a session's (haptics/stability/safety_gate.hpp), and only while the dead man's key is held. What the handle does
// is compared between both ways in an order of eight taps (+ - - + - + + -, Thue-Morse), in which a hand's own motion
// cancels as far as it is a parabola in time; so the hand need not keep still.
// Thread: one, which ticks the device a thousand times a second by the clock; with a simulated clock at once.
#pragma once

#include <string>
#include <vector>

#include "base/clock.hpp"
#include "base/json.hpp"
#include "devices/haptic/opened_device.hpp"

namespace burin::app {

struct CheckOptions {
    double force_N = 1.0;   // the most that it taps with
    double watch_s = 15.0;  // for the handle's motion, and for its buttons: the longest that is waited
    // Nobody answers: what is asked for counts as done, a little motion is enough, and the key counts as held.
    bool by_itself = false;
    bool pushes = true;  // false: no force is tried
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

enum class Verdict : std::uint8_t { passed, failed, skipped };
[[nodiscard]] const char* name_of(Verdict verdict);

struct CheckLine {
    std::string check;  // answers, position, buttons, force, steadiness; of a part: "position of index"
    Verdict verdict = Verdict::skipped;
    std::string found;
    Json figures = Json::object();
};

// Checks an opened device, whose force is zero at the end. The clock is that of the device.
[[nodiscard]] std::vector<CheckLine> check_device(devices::OpenedDevice& device, Clock& clock, CheckGuide& guide,
                                                  const CheckOptions& options);

}  // namespace burin::app
