// SPDX-License-Identifier: MIT
#include "haptics/realtime.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <future>

namespace burin::haptics {
namespace {

// Above ordinary real-time work, below the kernel's own threads (which sit at 99, interrupts at 50 unless tuned).
constexpr int kPriority = 80;

void add_line(std::string& text, const std::string& line) {
    if (!text.empty()) text += '\n';
    text += line;
}

// Touches the stack in advance. A tick needs some tens of kilobytes; a missing page would be faulted in during one.
void touch_stack() {
    std::array<volatile char, 256 * 1024> stack;
    for (std::size_t i = 0; i < stack.size(); i += 1024) stack[i] = 0;
}

void lock_memory(RealtimeNotice& notice) {
    constexpr const char* kRemedy =
        "a swapped-out page may delay a tick; allow it with 'memlock unlimited' in /etc/security/limits.d";
    if (mlockall(MCL_CURRENT) != 0) {
        add_line(notice.text, std::string("memory lock refused (") + std::strerror(errno) + "); " + kRemedy);
        return;
    }
    rlimit limit{};
    const bool unlimited = getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY;
    // Locks pages as they are touched, not as they are allocated: a driver reserves gigabytes that it never uses.
    if (unlimited && mlockall(MCL_FUTURE | MCL_ONFAULT) == 0) {
        notice.memory_locked = true;
        return;
    }
    add_line(notice.text, std::string("memory is locked only as far as it is held now; ") + kRemedy);
}

}  // namespace

RealtimeNotice ask_for_realtime() {
    RealtimeNotice notice;
    sched_param param{};
    param.sched_priority = kPriority;
    if (const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &param); error == 0)
        notice.priority = true;
    else
        add_line(notice.text, std::string("real-time priority refused (") + std::strerror(error) +
                                  "); ticks may come late; allow it with 'rtprio 80' in /etc/security/limits.d");
    // In ns; the usual slack of 50 us would delay every wake-up. Real-time threads have none.
    prctl(PR_SET_TIMERSLACK, 1UL);
    lock_memory(notice);
    touch_stack();
    return notice;
}

RealtimeNotice HapticThread::start() {
    std::promise<RealtimeNotice> ready;
    std::future<RealtimeNotice> notice = ready.get_future();
    // Moves the promise into the thread: on this stack it could be destroyed before set_value() has returned.
    thread_ = std::thread([this, ready = std::move(ready)]() mutable {
        ready.set_value(ask_for_realtime());
        loop_.run(stop_, pace_);
    });
    return notice.get();
}

void HapticThread::stop() {
    // release: pairs with the acquire in HapticLoop::run_ticks().
    stop_.store(true, std::memory_order_release);
    if (thread_.joinable()) thread_.join();
}

}  // namespace burin::haptics
