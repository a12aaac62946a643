// SPDX-License-Identifier: MIT
#include "devices/emulators/emulated_glove.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

#include "base/clock.hpp"

namespace burin::devices {
namespace {

constexpr double kSet_s = 1.0 / 120.0;
// Of the script: for how long the hand rests open, is closed or closing, and open again.
constexpr double kOpen_s = 2.0, kClosed_s = 5.0, kAll_s = 9.0;
// The approximate lever arm of the piston's force about the first joint.
constexpr double kArm_m = 0.07;

// Whether the script wants a closed hand.
bool wants_closed(const EmulatedGlove& glove) {
    const double phase_s = std::fmod(glove.scripted_s, kAll_s);
    return glove.motion == GloveMotion::closing && phase_s >= kOpen_s && phase_s < kOpen_s + kClosed_s;
}

}  // namespace

EmulatedGlove stepped(EmulatedGlove glove) {
    glove.time_s += EmulatedGlove::kStep_s;
    glove.since_command_s += EmulatedGlove::kStep_s;
    if (glove.since_command_s > EmulatedGlove::kWatchdog_s) glove.commanded_N = {};
    const double follows = 1.0 - std::exp(-2.0 * std::numbers::pi * EmulatedGlove::kBand_Hz * EmulatedGlove::kStep_s);
    if (glove.commanded) glove.scripted_s += EmulatedGlove::kStep_s;
    for (std::size_t i = 0; i < kGloveFingers; ++i)
        glove.given_N[i] += follows * (glove.commanded_N[i] - glove.given_N[i]);
    glove.grip = stepped(glove.grip, wants_closed(glove) ? 1.0 : 0.0, glove.given_N, EmulatedGlove::kStep_s);
    for (std::size_t i = 0; i < kGloveFingers; ++i) {
        glove.joints[i] = bent_in(GripShape::whole, i, glove.grip.closed[i]);
        glove.joints[i][1] =
            std::max(glove.joints[i][1] - glove.given_N[i] * kArm_m / EmulatedGlove::kGrip_Nm_per_rad, -0.5);
    }
    return glove;
}

EmulatedGlove with_command(EmulatedGlove glove, const GloveCommand& command) {
    glove.commanded_N = command.stop ? GloveForces{} : command.forces_N;
    glove.since_command_s = 0.0;
    glove.commanded = true;
    return glove;
}

bool is_silent(const EmulatedGlove& glove) {
    const double since_s = glove.scripted_s - glove.silent_from_s;
    return glove.silent_from_s > 0.0 && since_s >= 0.0 && (glove.silent_for_s == 0.0 || since_s < glove.silent_for_s);
}

GloveSet set_of(const EmulatedGlove& glove) {
    return {
        .number = glove.number, .motors_on = true, .fault = false, .joints = glove.joints, .forces_N = glove.given_N};
}

Result<GlovePort> GlovePort::create() {
    const int file = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    std::array<char, 128> name{};
    if (file < 0 || ::grantpt(file) != 0 || ::unlockpt(file) != 0 || ::ptsname_r(file, name.data(), name.size()) != 0) {
        const int code = errno;
        if (file >= 0) ::close(file);
        return fail("a pseudo-terminal", std::strerror(code), "see that /dev/pts is mounted");
    }
    const int far_end = ::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios line{};
    if (far_end < 0 || ::tcgetattr(far_end, &line) != 0) {
        ::close(file);
        return fail(name.data(), "cannot be opened", "see that /dev/pts is mounted");
    }
    ::cfmakeraw(&line);
    static_cast<void>(::tcsetattr(far_end, TCSANOW, &line));
    return GlovePort(file, far_end, name.data());
}

GlovePort::GlovePort(GlovePort&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      far_end_(std::exchange(other.far_end_, -1)),
      name_(std::move(other.name_)) {}

GlovePort::~GlovePort() {
    if (far_end_ >= 0) ::close(far_end_);
    if (file_ >= 0) ::close(file_);
}

void GlovePort::run(EmulatedGlove glove, const std::function<bool()>& ends) {
    MonotonicClock clock;
    GloveFrameReader<GloveCommand> reader;
    const Nanoseconds step_ns = nanoseconds(EmulatedGlove::kStep_s);
    Nanoseconds due_ns = clock.now_ns();
    double next_set_s = glove.time_s;
    while (!ends()) {
        due_ns = std::max(due_ns + step_ns, clock.now_ns() - 50 * step_ns);
        clock.sleep_until(due_ns);
        std::array<std::byte, 256> bytes;
        const ssize_t count = ::read(file_, bytes.data(), bytes.size());
        for (ssize_t i = 0; i < count; ++i)
            if (const auto command = reader.take(bytes[static_cast<std::size_t>(i)]))
                glove = with_command(glove, *command);
        glove = stepped(glove);
        for (std::size_t i = 0; i < kGloveFingers; ++i) given_N_[i].store(glove.given_N[i], std::memory_order_relaxed);
        if (glove.time_s < next_set_s) continue;
        next_set_s = std::max(next_set_s + kSet_s, glove.time_s - kSet_s);
        if (is_silent_.load(std::memory_order_relaxed) || is_silent(glove)) continue;
        const GloveBytes frame = frame_of(set_of(glove));
        ++glove.number;
        // Frames that nobody reads are lost, as on a real serial line.
        if (::write(file_, frame.bytes.data(), frame.count) < 0) static_cast<void>(::tcflush(file_, TCIOFLUSH));
    }
}

}  // namespace burin::devices
