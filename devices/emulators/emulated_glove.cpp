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
#include "devices/emulators/glove_wire.hpp"
#include "devices/served/served_arm.hpp"

namespace burin::devices {
namespace {

// Returns how long a set takes on the serial line.
double set_s(const EmulatedGlove& glove) {
    constexpr double kLineBytes_per_s = 3840.0;
    return static_cast<double>(bytes_of(set_of(glove))) / kLineBytes_per_s;
}

// Of the script: for how long the hand rests open, is closed or closing, and open again.
constexpr double kOpen_s = 2.0, kClosed_s = 5.0, kAll_s = 9.0;
// The approximate lever arm of the piston's force about the first joint.
constexpr double kArm_m = 0.07;

// Whether the script wants a closed hand.
bool wants_closed(const EmulatedGlove& glove) {
    const double phase_s = std::fmod(glove.scripted_s, kAll_s);
    return glove.motion == GloveMotion::closing && phase_s >= kOpen_s && phase_s < kOpen_s + kClosed_s;
}

// Takes the host's forces and the laws away at once.
EmulatedGlove stopped(EmulatedGlove glove) {
    glove.commanded_N = {};
    glove.laws = {};
    glove.local = 0;
    glove.blended = {};
    return glove;
}

// What a law gives at a piston's length, while that grows shorter by so much a second.
double force_by(const DriveLaw& law, double piston_m, double shortens_m_per_s) {
    const double pressed_m = law.start_m - piston_m;
    if (!law.holds || pressed_m <= 0.0) return 0.0;
    constexpr double kFull_m_per_s = 0.002;  // friction is full from there on, and changes its sign without a step
    const double friction_N = law.friction_N * std::clamp(shortens_m_per_s / kFull_m_per_s, -1.0, 1.0);
    const double force_N = law.spring_N_per_m * pressed_m + law.damping_Ns_per_m * shortens_m_per_s + friction_N;
    return std::clamp(force_N, 0.0, std::min(law.most_N, kMostPistonForce_N));
}

// Reads its pistons' lengths off the joints, and how fast they grow shorter.
void measure_pistons(EmulatedGlove& glove) {
    constexpr double kFollows = 0.3;  // of a difference over one step, whose noise it smooths
    for (std::size_t i = 0; i < kGloveFingers; ++i) {
        const double before_m = std::exchange(glove.pistons_m[i], place_of(usual_hand()[i], glove.joints[i]).piston_m);
        const double speed_m_per_s = before_m > 0.0 ? (before_m - glove.pistons_m[i]) / EmulatedGlove::kStep_s : 0.0;
        glove.shorten_m_per_s[i] += kFollows * (speed_m_per_s - glove.shorten_m_per_s[i]);
    }
}

// What a piston is to give: the host's force, its law's, or on the way between them.
double wanted_N(const EmulatedGlove& glove, std::size_t finger) {
    const double by_law_N = force_by(glove.laws[finger], glove.pistons_m[finger], glove.shorten_m_per_s[finger]);
    return glove.commanded_N[finger] + glove.blended[finger] * (by_law_N - glove.commanded_N[finger]);
}

}  // namespace

EmulatedGlove stepped(EmulatedGlove glove, bool in_time) {
    glove.time_s += EmulatedGlove::kStep_s;
    if (in_time) glove.since_command_s += EmulatedGlove::kStep_s;
    if (glove.since_command_s > EmulatedGlove::kWatchdog_s) glove = stopped(glove);
    measure_pistons(glove);
    const double follows = 1.0 - std::exp(-2.0 * std::numbers::pi * EmulatedGlove::kBand_Hz * EmulatedGlove::kStep_s);
    if (glove.commanded) glove.scripted_s += EmulatedGlove::kStep_s;
    for (std::size_t i = 0; i < kGloveFingers; ++i) {
        const bool is_local = (glove.local >> i & 1u) != 0 && glove.laws[i].holds;
        const double most = EmulatedGlove::kStep_s / EmulatedGlove::kBlend_s;
        glove.blended[i] = std::clamp(glove.blended[i] + (is_local ? most : -most), 0.0, 1.0);
        const bool gives = glove.motors_on && (glove.dead >> i & 1u) == 0;
        glove.given_N[i] += follows * ((gives ? wanted_N(glove, i) : 0.0) - glove.given_N[i]);
    }
    glove.grip = stepped(glove.grip, wants_closed(glove) ? 1.0 : 0.0, glove.given_N, EmulatedGlove::kStep_s);
    for (std::size_t i = 0; i < kGloveFingers; ++i) {
        glove.joints[i] = bent_in(GripShape::whole, i, glove.grip.closed[i]);
        glove.joints[i][1] = std::max(glove.joints[i][1] - glove.given_N[i] * kArm_m / EmulatedGlove::kGrip_Nm_per_rad,
                                      angle_limits(i).lowest[1]);
    }
    return glove;
}

EmulatedGlove with_command(EmulatedGlove glove, const GloveCommand& command) {
    if (command.law) {
        glove.laws[command.law->finger] = command.law->law;
        return glove;
    }
    if (command.stop) glove = stopped(glove);
    if (!command.stop) {
        glove.commanded_N = command.forces_N;
        glove.local = command.local;
        // A law is gone when its finger has gone back to the host's force; it is on the way there until then.
        for (std::size_t i = 0; i < kGloveFingers; ++i)
            if ((glove.local >> i & 1u) == 0 && glove.blended[i] == 0.0) glove.laws[i] = {};
    }
    glove.since_command_s = 0.0;
    // A host says stop until its session begins, which takes a busy machine long; the script waits for that.
    glove.commanded = glove.commanded || !command.stop;
    return glove;
}

bool is_silent(const EmulatedGlove& glove) {
    const double since_s = glove.scripted_s - glove.silent_from_s;
    return glove.silent_from_s > 0.0 && since_s >= 0.0 && (glove.silent_for_s == 0.0 || since_s < glove.silent_for_s);
}

GloveSet set_of(const EmulatedGlove& glove) {
    return {.number = glove.number,
            .motors_on = glove.motors_on,
            .fault = false,
            .is_local = glove.local != 0,
            .joints = glove.joints,
            .forces_N = glove.given_N,
            .version = glove.version};
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
      name_(std::move(other.name_)),
      heard_(std::move(other.heard_)) {}

GlovePort::~GlovePort() {
    if (far_end_ >= 0) ::close(far_end_);
    if (file_ >= 0) ::close(file_);
}

std::vector<HeardGloveFrame> GlovePort::heard() const {
    const std::lock_guard lock(heard_->mutex);
    return {heard_->frames.begin(), heard_->frames.end()};
}

EmulatedGlove GlovePort::hear(EmulatedGlove glove, GloveControllerEar& ear) {
    std::array<std::byte, 256> bytes;
    const ssize_t count = ::read(file_, bytes.data(), bytes.size());
    for (ssize_t i = 0; i < count; ++i) {
        auto heard = ear.take(bytes[static_cast<std::size_t>(i)]);
        if (!heard) continue;
        glove = with_command(glove, heard->command);
        const std::lock_guard lock(heard_->mutex);
        heard_->frames.push_back(std::move(*heard));
        if (heard_->frames.size() > kMostHeard) heard_->frames.pop_front();
    }
    return glove;
}

void GlovePort::run(EmulatedGlove glove, const std::function<bool()>& ends,
                    const std::function<void(const EmulatedGlove&)>& watch) {
    static_cast<void>(ask_for_servo_priority());
    MonotonicClock clock;
    GloveControllerEar ear;
    const Nanoseconds step_ns = nanoseconds(EmulatedGlove::kStep_s);
    Nanoseconds due_ns = clock.now_ns();
    double next_set_s = glove.time_s;
    std::vector<std::byte> frame;    // that goes to the host, or two
    std::vector<std::byte> on_line;  // a set takes a period to go out: it is of where the fingers were at its turn
    while (!ends()) {
        due_ns = std::max(due_ns + step_ns, clock.now_ns() - 50 * step_ns);
        const bool in_time = clock.now_ns() < due_ns;
        clock.sleep_until(due_ns);
        glove = stepped(hear(glove, ear), in_time);
        if (watch) watch(glove);
        for (std::size_t i = 0; i < kGloveFingers; ++i) given_N_[i].store(glove.given_N[i], std::memory_order_relaxed);
        if (glove.time_s < next_set_s) continue;
        next_set_s = std::max(next_set_s + set_s(glove), glove.time_s - set_s(glove));
        if (is_silent_.load(std::memory_order_relaxed) || is_silent(glove)) continue;
        const std::vector<std::byte> out = std::exchange(on_line, controller_frame(set_of(glove)));
        frame.insert(frame.end(), out.begin(), out.end());
        const bool waits = glove.in_pairs && glove.number % 2 == 0;
        ++glove.number;
        if (frame.empty() || waits) continue;
        // Frames that nobody reads are lost, as on a real serial line.
        if (::write(file_, frame.data(), frame.size()) < 0) static_cast<void>(::tcflush(file_, TCIOFLUSH));
        frame.clear();
    }
}

}  // namespace burin::devices
