// SPDX-License-Identifier: MIT
// The thread that listens to a SpaceMouse: reports to how its cap stands now. Whoever moves something by it, a hand or
// the scene, asks for the newest state.
//
// A cap that is pushed reports each 8 to 16 ms, also while it stands still. So one that was pushed and has said nothing
// for kSpaceMouseStale_ns counts as let go, and one whose cable is gone at once: what it moves stands still. It is
// looked for each second then, by the same place, which may be another device's meanwhile. Reports of a wrong length
// are counted and told at most once a second.
// Threads: open() and destruction on one; newest() on one other, wait-free; take_messages() and take_presses() on
// any; `on_state` is called on the thread that listens.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/clock.hpp"
#include "base/newest_slot.hpp"
#include "devices/spacemouse/spacemouse_port.hpp"

namespace burin::devices {

inline constexpr Nanoseconds kSpaceMouseStale_ns = 200'000'000;
inline constexpr Nanoseconds kSpaceMouseAgain_ns = 1'000'000'000;  // between two looks for one that is gone

struct SpaceMouseState {
    Nanoseconds time_ns = 0;  // when the thread last looked, at least each 50 ms; 0: never
    bool is_there = false;
    Vec3 push{0.0}, turn{0.0};  // -1 to 1 along and about each axis, device frame
    std::uint32_t buttons = 0;  // bit 0: the first
};

class SpaceMouseLine {
public:
    // Called after each report and at least each 50 ms, with the state.
    using OnState = std::function<void(const SpaceMouseState&)>;

    // `where` names the device in messages. Fails where there is none at the place.
    [[nodiscard]] static Result<std::unique_ptr<SpaceMouseLine>> open(const std::string& where,
                                                                      const std::string& place, OnState on_state = {},
                                                                      const HidrawPlaces& places = {});
    ~SpaceMouseLine();
    SpaceMouseLine(const SpaceMouseLine&) = delete;
    SpaceMouseLine& operator=(const SpaceMouseLine&) = delete;

    [[nodiscard]] const SpaceMouseState& newest() noexcept { return state_.newest(); }
    [[nodiscard]] std::vector<std::string> take_messages();
    // Returns the buttons that went down since the last call, in order: 0 is the first.
    [[nodiscard]] std::vector<std::uint32_t> take_presses();
    [[nodiscard]] std::uint64_t refused() const noexcept { return refused_.load(std::memory_order_relaxed); }
    [[nodiscard]] const SpaceMouseProduct& product() const { return product_; }

private:
    SpaceMouseLine(std::string where, std::string place, OnState on_state, HidrawPlaces places, SpaceMousePort port)
        : where_(std::move(where)),
          place_(std::move(place)),
          on_state_(std::move(on_state)),
          places_(std::move(places)),
          product_(port.product),
          port_(std::move(port)) {
        now_.is_there = true;
    }
    void run();
    void look_again(Nanoseconds now_ns);
    void read_reports(Nanoseconds now_ns);
    void take(std::span<const std::byte> report, Nanoseconds now_ns);
    void rest_if_stale(Nanoseconds now_ns);
    void lose(Nanoseconds now_ns);
    void publish(Nanoseconds now_ns);
    void say(const std::string& what);

    std::string where_, place_;
    OnState on_state_;
    HidrawPlaces places_;
    SpaceMouseProduct product_;
    NewestSlot<SpaceMouseState> state_;
    std::atomic<std::uint64_t> refused_ = 0;  // relaxed: the number says nothing of other memory
    std::mutex mutex_;                        // guards the two that follow
    std::vector<std::string> messages_;
    std::vector<std::uint32_t> presses_;
    StopSign stop_;
    // The thread's:
    MonotonicClock clock_;
    std::optional<SpaceMousePort> port_;
    SpaceMouseState now_;
    Nanoseconds moved_ns_ = 0, tried_ns_ = 0;
    std::optional<Nanoseconds> complained_ns_;
    std::thread thread_;
};

}  // namespace burin::devices
