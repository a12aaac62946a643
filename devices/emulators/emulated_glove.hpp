// SPDX-License-Identifier: MIT
// The controller of a glove that is not there: what it does in a step, pure, and the pseudo-terminal on which it talks
// as a glove on a serial line does.
//
// Model: a hand whose fingers close by a script (grip_shape.hpp), each until its piston pushes with 2 N, and held with
// kGrip_Nm_per_rad; the piston's force opens the finger against that grip. The script begins when a host first
// commands, so that a session finds the hand open. A piston follows its command as a low-pass of kBand_Hz, as the
// paper's glove does from 10 to 50 Hz, and gives nothing when no command has come for kWatchdog_s. A finger that the
// host has left to it is rendered at 500 Hz by its law of piston length (DriveLaw), from its own joints. Line: 38,400
// bit/s carry 3,840 bytes a second, so a set of 32 bytes takes 8.3 ms and arrives when it is out, one of version 2 8.6.
// Units: SI.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "devices/emulators/glove_wire.hpp"
#include "devices/gloves/glove_hand.hpp"
#include "devices/gloves/grip_shape.hpp"

namespace burin::devices {

// closing: rests for some seconds, closes, rests, and opens again, and so on.
enum class GloveMotion { still, closing };

struct EmulatedGlove {
    static constexpr double kStep_s = 0.002;  // the controller's loop of 500 Hz
    static constexpr double kBand_Hz = 25.0, kGrip_Nm_per_rad = 1.5, kWatchdog_s = 0.1;
    // Time over which it goes from the host's force to a law's and back, so that neither is a step.
    static constexpr double kBlend_s = 0.05;

    GloveMotion motion = GloveMotion::closing;
    // A drill: sends nothing from then on, in seconds of the script, for so many seconds; from 0: never, for 0: for
    // good.
    double silent_from_s = 0.0, silent_for_s = 0.0;
    // Drills: motors that are off, pistons that give nothing (bit i: finger i), sets that an adapter hands over two at
    // a time; and the version of its frames.
    bool motors_on = true, in_pairs = false;
    std::uint8_t dead = 0, version = 1;
    double time_s = 0.0, scripted_s = 0.0;
    bool commanded = false;  // to give forces, ever
    Grip grip = {};
    GloveForces commanded_N{}, given_N{};
    GloveLaws laws{};         // the newest of each finger; none that holds: there is none
    std::uint8_t local = 0;   // which fingers it is to render by itself: bit i
    GloveForces blended{};    // from 0, the host's force, to 1, the law's
    GloveForces pistons_m{};  // their lengths; 0: not known yet
    GloveForces shorten_m_per_s{};
    double since_command_s = kWatchdog_s;
    GloveJoints joints{};
    std::uint8_t number = 0;  // of the next set
};
// Takes the controller on by a step. in_time: the step begins when it is due. One that makes up for the emulator's own
// delay says nothing of the host's silence, and does not count towards kWatchdog_s.
[[nodiscard]] EmulatedGlove stepped(EmulatedGlove glove, bool in_time = true);
[[nodiscard]] EmulatedGlove with_command(EmulatedGlove glove, const GloveCommand& command);
[[nodiscard]] bool is_silent(const EmulatedGlove& glove);
// Returns the set that it sends now.
[[nodiscard]] GloveSet set_of(const EmulatedGlove& glove);

// A pseudo-terminal at whose far end a program finds a glove. One thread.
class GlovePort {
public:
    [[nodiscard]] static Result<GlovePort> create();
    ~GlovePort();
    GlovePort(GlovePort&& other) noexcept;
    GlovePort& operator=(GlovePort&&) = delete;

    [[nodiscard]] const std::string& name() const { return name_; }  // of the far end: "/dev/pts/3"
    // Runs a controller in real time until `ends` says so, which is asked 500 times a second. `watch` sees each of its
    // steps.
    void run(EmulatedGlove glove, const std::function<bool()>& ends,
             const std::function<void(const EmulatedGlove&)>& watch = {});
    // Falls silent without closing the line, as a glove whose cable is pulled at the hand; for drills.
    void fall_silent(bool is_silent) { is_silent_.store(is_silent, std::memory_order_relaxed); }
    // Returns the forces that the pistons gave last. Any thread.
    [[nodiscard]] double given_N(std::size_t finger) const { return given_N_[finger].load(std::memory_order_relaxed); }
    // Returns the newest kMostHeard frames that the host has sent, in their order, as they came. Any thread.
    [[nodiscard]] std::vector<HeardGloveFrame> heard() const;
    static constexpr std::size_t kMostHeard = 4096;

private:
    struct Heard {
        std::mutex mutex;
        std::deque<HeardGloveFrame> frames;
    };
    GlovePort(int file, int far_end, std::string name) : file_(file), far_end_(far_end), name_(std::move(name)) {}
    [[nodiscard]] EmulatedGlove hear(EmulatedGlove glove, GloveControllerEar& ear);

    int file_, far_end_;  // the far end is held open, so that a program may come and go
    std::string name_;
    std::unique_ptr<Heard> heard_ = std::make_unique<Heard>();
    std::atomic<bool> is_silent_ = false;
    std::array<std::atomic<double>, kGloveFingers> given_N_{};
};

}  // namespace burin::devices
