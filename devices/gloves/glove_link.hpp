// SPDX-License-Identifier: MIT
// The serial line to a glove's controller: a thread that reads its sets and sends it what the pistons are to give.
//
// Data flow: line -> GloveFrameReader -> GloveTimeline, which tells when the controller took each set -> the newest
// sets, with the time of the last arrival -> the haptic thread. The newest
// forces -> a command each kSend_ns -> line, and one of the laws that hold before it; a line of 38,400 bit/s carries no
// more. When the object ends, and where the haptic thread has given no forces for kSilent_ns, the pistons are told to
// stop, and the line is set as it was before.
// Failures: a port that is missing, forbidden, busy or no terminal, and one on which no glove is heard, are errors of
// open(). A serial adapter that keeps bytes back to hand over more at once is asked not to, as long as the line is
// open; where the port is none that can be asked, nothing is said. A line that goes silent, or vanishes, shows in age:
// GloveHeard::time_ns stays.
// Threads: open() and the destructor on one; newest() and command() on the haptic thread, wait-free.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/newest_slot.hpp"
#include "devices/gloves/glove_timeline.hpp"

struct termios;

namespace burin::devices {

struct GloveHeard {
    Nanoseconds time_ns = 0;    // of the newest set's arrival; 0: none yet
    Nanoseconds before_ns = 0;  // of the one before; 0: none
    GloveSet set;               // the newest
    GloveSets sets;             // and those before it, by the times at which the controller took them
};

class GloveLink {
public:
    static constexpr Nanoseconds kSend_ns = 8'333'333;
    static constexpr Nanoseconds kSilent_ns = 100'000'000;
    // Time within which a glove must be heard when the line is opened.
    static constexpr Nanoseconds kFirst_ns = 1'000'000'000;

    // The clock must outlive the link. Sets the line to 38,400 bit/s, 8 bits, no parity, one stop bit.
    [[nodiscard]] static Result<std::unique_ptr<GloveLink>> open(const std::string& port, Clock& clock);
    ~GloveLink();
    GloveLink(const GloveLink&) = delete;
    GloveLink& operator=(const GloveLink&) = delete;

    [[nodiscard]] const GloveHeard& newest() noexcept { return heard_.newest(); }
    // Has the pistons give these forces from the next command on; those with a law that holds are the controller's,
    // once it has been sent.
    void command(const GloveForces& forces_N, const GloveLaws& laws = {}) noexcept;

private:
    GloveLink(int file, Clock& clock);
    [[nodiscard]] bool read_some();
    void send(GloveCommand command);
    void send_forces(Nanoseconds now_ns);
    void run();

    struct Wanted {
        GloveForces forces_N{};
        GloveLaws laws{};
        Nanoseconds time_ns = 0;
    };
    int file_;
    bool waits_less_ = false;  // the adapter has been asked for that, and is asked to wait again at the end
    std::unique_ptr<const termios> before_;  // how the line was set, and is set again at the end; null: not set yet
    Clock& clock_;
    GloveFrameReader<GloveSet> reader_;
    GloveTimeline timeline_;
    GloveHeard last_;
    std::uint64_t bytes_ = 0;
    std::uint8_t number_ = 0;
    GloveLaws sent_{};              // the laws that the controller has been sent, as far as they hold
    std::size_t next_law_ = 0;      // the finger whose law is sent next, of those that hold
    NewestSlot<GloveHeard> heard_;  // the link's thread -> the haptic thread
    NewestSlot<Wanted> wanted_;     // the haptic thread -> the link's
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

}  // namespace burin::devices
