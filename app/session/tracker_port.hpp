// SPDX-License-Identifier: MIT
// Trackers of any make, by the network: datagrams whose lines are those of the input log without their times (docs/formats.md), such as
// "head 0 1.6 2 0 0 0 1". A few lines of script bring VRPN, OptiTrack or a telephone to it.
//
// Each is stamped when it arrives, on a thread of its own that does nothing else, so that the head's prediction does not take the frame's
// delay for the tracker's. What is not understood is passed over, counted, and said at most once a second.
// Threads: take() and take_messages() from one; on_news is called on the port's own and must not wait.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "app/session/input_event.hpp"
#include "base/error.hpp"

namespace burin {

class TrackerPort {
public:
    // where: "udp:PORT" hears this machine alone; "udp:ADDRESS:PORT" hears whoever reaches that address of it. PORT 0: any that is free.
    // The clock must outlive the port.
    [[nodiscard]] static Result<std::unique_ptr<TrackerPort>> open(const std::string& where, Clock& clock,
                                                                   std::function<void()> on_news);
    ~TrackerPort();
    TrackerPort(const TrackerPort&) = delete;
    TrackerPort& operator=(const TrackerPort&) = delete;

    struct Heard {
        Nanoseconds time_ns = 0;  // by the clock
        Input input;
    };
    [[nodiscard]] std::vector<Heard> take();                 // in the order of arrival
    [[nodiscard]] std::vector<std::string> take_messages();  // for people
    [[nodiscard]] std::uint16_t port() const { return port_; }
    [[nodiscard]] std::uint64_t refused() const;  // lines, so far

private:
    TrackerPort(Clock& clock, std::function<void()> on_news) : clock_(clock), on_news_(std::move(on_news)) {}
    [[nodiscard]] Result<void> bind_to(const std::string& where);
    void listen();
    void hear(std::string_view datagram, Nanoseconds now_ns);
    void refuse(const std::string& why, Nanoseconds now_ns);

    Clock& clock_;
    std::function<void()> on_news_;
    int socket_ = -1, stop_ = -1;
    std::uint16_t port_ = 0;
    mutable std::mutex mutex_;  // guards what follows
    std::vector<Heard> heard_;
    std::vector<std::string> messages_;
    std::uint64_t refused_ = 0;
    Nanoseconds said_ns_ = 0;
    bool said_ = false;
    std::thread thread_;
};

}  // namespace burin
