// SPDX-License-Identifier: MIT
// A VRPN server whose bytes a test chooses, and what a tracker makes of them.
#pragma once

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "devices/emulators/vrpn_wire.hpp"
#include "devices/trackers/network.hpp"
#include "devices/trackers/vrpn_tracker.hpp"

namespace burin::devices {

// A server whose bytes the test chooses: takes one client at a time.
class RawServer {
public:
    RawServer() : at_(listen_at({"127.0.0.1", 0}).value()) {}
    [[nodiscard]] std::string where() const { return "vrpn:127.0.0.1:" + std::to_string(at_.bound.port); }
    // Waits for a client, but not for ever.
    void accept() {
        for (int i = 0; i < 5000 && !client_; ++i) {
            client_ = OwnedFile(::accept4(at_.socket.get(), nullptr, nullptr, SOCK_CLOEXEC));
            if (!client_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    void send(std::span<const std::byte> bytes) const {
        ASSERT_EQ(::send(client_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
    }
    // What the client has said since it was asked last.
    [[nodiscard]] std::vector<std::byte> heard() const {
        std::vector<std::byte> bytes(4096);
        const ssize_t count = ::recv(client_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
        bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
        return bytes;
    }
    void hang_up() { client_ = OwnedFile(); }
    // Opens a tracker while it sends its cookie and names.
    [[nodiscard]] std::unique_ptr<Tracker> opened(Clock& clock, const std::string& settings = "") {
        std::thread greets([this] { greet(); });
        auto tracker = VrpnTracker::open(where() + settings, {clock, {}, {}});
        greets.join();
        EXPECT_TRUE(tracker) << tracker.error().line();
        return std::move(*tracker);
    }
    void greet() {
        accept();
        send(VrpnServerBytes().cookie().sender(9, "Tracker0").type(7, "vrpn_Tracker Pos_Quat").bytes());
    }
    void send_pose(const Vec3& position_m, const Quat& orientation = {1, 0, 0, 0}, std::int32_t sensor = 0,
                   std::int64_t time_us = 0) const {
        send(VrpnServerBytes().message(9, 7, vrpn_pos_quat(sensor, {position_m, orientation}), time_us).bytes());
    }

private:
    BoundSocket at_;
    OwnedFile client_;
};

// Waits until `enough` of what has come, but not for ever.
template <typename Enough>
std::vector<TrackerSample> heard_until(Tracker& tracker, Enough enough) {
    std::vector<TrackerSample> all;
    for (int i = 0; i < 10'000 && !enough(all); ++i) {
        for (TrackerSample& sample : tracker.take()) all.push_back(std::move(sample));
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return all;
}

template <typename Kind>
std::vector<Kind> of_kind(const std::vector<TrackerSample>& samples) {
    std::vector<Kind> found;
    for (const TrackerSample& sample : samples)
        if (const auto* one = std::get_if<Kind>(&sample.input)) found.push_back(*one);
    return found;
}

inline std::string all_messages(Tracker& tracker) {
    std::string text;
    for (const std::string& message : tracker.take_messages()) text += message + "\n";
    return text;
}

}  // namespace burin::devices
