// SPDX-License-Identifier: MIT
#include "devices/gloves/glove_link.hpp"

#include <fcntl.h>
#include <linux/serial.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>

#include "base/text.hpp"
#include "base/try.hpp"
#include "devices/served/served_arm.hpp"

namespace burin::devices {
namespace {

std::unexpected<Error> no_port(const std::string& port, int code) {
    const std::string where = "glove " + port;
    switch (code) {
        case ENOENT: return fail(where, "there is no such port", "name one that is there, such as glove:/dev/ttyUSB0");
        case EACCES:
            return fail(where, "may not be opened by this user",
                        "join the group that owns serial ports: sudo usermod -aG dialout $USER, and log in again");
        case EBUSY: return fail(where, "is held by another program", "end that one, or name another port");
        default: return fail(where, std::string("cannot be opened: ") + std::strerror(code), "see to the device");
    }
}

// 38,400 bit/s, 8 bits, no parity, one stop bit, and nothing that the terminal would do to bytes by itself. Returns how
// the line was set before.
Result<termios> set_up_line(int file, const std::string& port) {
    termios line{};
    if (::tcgetattr(file, &line) != 0)
        return fail("glove " + port, "is no serial line", "name a port such as glove:/dev/ttyUSB0");
    const termios before = line;
    ::cfmakeraw(&line);
    line.c_cflag |= CLOCAL | CREAD;
    ::cfsetispeed(&line, B38400);
    ::cfsetospeed(&line, B38400);
    if (::tcsetattr(file, TCSANOW, &line) != 0)
        return fail("glove " + port, std::string("does not take 38,400 bit/s: ") + std::strerror(errno),
                    "see to the device");
    return before;
}

// Has a serial adapter hand bytes over at once, or wait for more again: one on USB waits for 16 ms else. Returns
// whether that has been changed; a port that is no such adapter is left as it is.
bool ask_to_wait_less(int file, bool less) {
    serial_struct port{};
    if (::ioctl(file, TIOCGSERIAL, &port) != 0) return false;
    constexpr int kLowLatency = 1 << ASYNCB_LOW_LATENCY;
    if (((port.flags & kLowLatency) != 0) == less) return false;
    port.flags ^= kLowLatency;
    return ::ioctl(file, TIOCSSERIAL, &port) == 0;
}

// Waits until what was written has gone out, but never for long: a line may take nothing.
void let_out(int file) {
    constexpr int kMostWaits = 10;
    int waiting = 0;
    for (int i = 0; i < kMostWaits && ::ioctl(file, TIOCOUTQ, &waiting) == 0 && waiting > 0; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

}  // namespace

GloveLink::GloveLink(int file, Clock& clock) : file_(file), clock_(clock) {}

Result<std::unique_ptr<GloveLink>> GloveLink::open(const std::string& port, Clock& clock) {
    const int file = ::open(port.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return no_port(port, errno);
    std::unique_ptr<GloveLink> link(new GloveLink(file, clock));
    // TIOCEXCL keeps others out, but not root; so two programs also agree by a lock.
    if (::flock(file, LOCK_EX | LOCK_NB) != 0)
        return fail("glove " + port, "is in use by another program", "end that program, or name another port");
    BURIN_TRY(before, set_up_line(file, port));
    link->before_ = std::make_unique<const termios>(before);
    if (::ioctl(file, TIOCEXCL) != 0) return no_port(port, errno);
    link->waits_less_ = ask_to_wait_less(file, true);
    MonotonicClock watch;  // the session's own clock may stand still until the session begins
    const Nanoseconds until_ns = watch.now_ns() + kFirst_ns;
    while (link->last_.time_ns == 0 && watch.now_ns() < until_ns) {
        pollfd waits{file, POLLIN, 0};
        if (::poll(&waits, 1, 20) > 0 && !link->read_some()) break;
    }
    if (link->last_.time_ns == 0)
        return fail("glove " + port,
                    link->bytes_ == 0 ? "sends nothing"
                                      : formatted("sends %llu bytes in a second, and no set of a glove among them",
                                                  static_cast<unsigned long long>(link->bytes_)),
                    "switch the glove's controller on, and see that it is on this port");
    link->thread_ = std::thread([own = link.get()] { own->run(); });
    return link;
}

GloveLink::~GloveLink() {
    // relaxed: the flag says nothing of other memory.
    ends_.store(true, std::memory_order_relaxed);
    if (thread_.joinable()) thread_.join();
    // Another device, which was taken for a glove, gets no byte.
    if (last_.time_ns != 0) send({.number = ++number_, .stop = true});
    if (before_) {
        let_out(file_);
        if (waits_less_) static_cast<void>(ask_to_wait_less(file_, false));
        static_cast<void>(::tcsetattr(file_, TCSANOW, before_.get()));
        static_cast<void>(::ioctl(file_, TIOCNXCL));
    }
    ::close(file_);
}

void GloveLink::command(const GloveForces& forces_N, const GloveLaws& laws) noexcept {
    wanted_.draft() = {forces_N, laws, clock_.now_ns()};
    wanted_.publish();
}

// Reads what has come; false where the line is gone.
bool GloveLink::read_some() {
    std::array<std::byte, 256> bytes;
    const ssize_t count = ::read(file_, bytes.data(), bytes.size());
    if (count == 0) return false;
    if (count < 0) return errno == EAGAIN || errno == EINTR;
    bytes_ += static_cast<std::uint64_t>(count);
    for (ssize_t i = 0; i < count; ++i) {
        const std::optional<GloveSet> set = reader_.take(bytes[static_cast<std::size_t>(i)]);
        if (!set) continue;
        const Nanoseconds now_ns = clock_.now_ns();
        if (timeline_.take(*set, now_ns)) {
            last_.before_ns = last_.time_ns;
            last_.set = *set;
            last_.time_ns = now_ns;
        }
        last_.sets = timeline_.sets();
        heard_.draft() = last_;
        heard_.publish();
    }
    return true;
}

void GloveLink::send(GloveCommand command) {
    const GloveBytes frame = frame_of(command);
    // A line that takes nothing now loses this command, and gets the next one.
    static_cast<void>(::write(file_, frame.bytes.data(), frame.count));
}

// Sends the newest forces, and before them one of the laws that hold: one that the controller does not have first, then
// each in its turn, since a frame may be lost. A finger is the controller's when its law has been sent.
void GloveLink::send_forces(Nanoseconds now_ns) {
    const Wanted& wanted = wanted_.newest();
    if (wanted.time_ns == 0 || now_ns - wanted.time_ns > kSilent_ns) {
        sent_ = {};
        return send({.number = ++number_, .stop = true});
    }
    std::optional<std::size_t> next;
    for (std::size_t n = 0; n < kGloveFingers; ++n) {
        const std::size_t i = (next_law_ + n) % kGloveFingers;
        if (!wanted.laws[i].holds) sent_[i] = {};
        if (wanted.laws[i].holds && (!next || (sent_[i] != wanted.laws[i] && sent_[*next] == wanted.laws[*next])))
            next = i;
    }
    if (next) {
        sent_[*next] = wanted.laws[*next];
        next_law_ = *next + 1;
        send({.number = ++number_, .law = GloveCommand::Law{static_cast<std::uint8_t>(*next), wanted.laws[*next]}});
    }
    std::uint8_t local = 0;
    for (std::size_t i = 0; i < kGloveFingers; ++i)
        if (sent_[i].holds) local = static_cast<std::uint8_t>(local | 1u << i);
    send({.number = ++number_, .forces_N = wanted.forces_N, .local = local});
}

void GloveLink::run() {
    static_cast<void>(ask_for_servo_priority());
    Nanoseconds sent_ns = 0;
    // relaxed: as where it is set.
    while (!ends_.load(std::memory_order_relaxed)) {
        pollfd waits{file_, POLLIN, 0};
        const int ready = ::poll(&waits, 1, 2);
        if (ready > 0 && !read_some()) break;  // what was heard last grows old, and the device says so
        const Nanoseconds now_ns = clock_.now_ns();
        if (now_ns - sent_ns < kSend_ns) continue;
        sent_ns = now_ns;
        send_forces(now_ns);
    }
}

}  // namespace burin::devices
