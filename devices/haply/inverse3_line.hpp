// SPDX-License-Identifier: MIT
// The driver of a Haply Inverse3: a line whose turn sends a force to its maker's service and waits for the state that
// the service answers (inverse3_words.hpp, devices/served/line_servo.hpp).
//
// A state is sound where the device is in it with a place of three numbers, is calibrated and has power; a handle that
// is there has a turn. The service forgets a force when it gets no further one, as its maker says. One that owes an
// answer for kInverse3Late_ns is given zero, and one that owes it for kInverse3Gone_ns is gone. What it is owed is
// waited for and not asked for again, so that a slow service is not buried.
// Thread: the servo's.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "base/clock.hpp"
#include "devices/haply/inverse3_words.hpp"
#include "devices/served/line_servo.hpp"
#include "devices/trackers/network.hpp"
#include "devices/websocket/websocket_client.hpp"

namespace burin::devices {

inline constexpr double kInverse3Most_N = 5.0;
inline constexpr Nanoseconds kInverse3Late_ns = 20'000'000;
inline constexpr Nanoseconds kInverse3Gone_ns = 500'000'000;
inline constexpr Nanoseconds kInverse3Greets_ns = 1'000'000'000;

// What a service said to whoever came.
struct Inverse3Greeting {
    WebSocketClient socket;
    Inverse3Words words;
};
// Connects to a service and has it say what there is. `where` names the device in an Error.
[[nodiscard]] Result<Inverse3Greeting> greet_inverse3(const std::string& where, const NetworkAddress& service,
                                                      Nanoseconds within_ns);

class Inverse3Line final : public DeviceLine {
public:
    using FindService = std::function<Result<NetworkAddress>()>;
    // `name` is as the user calls it, for messages; `id` is the device's; empty: the first that there is.
    Inverse3Line(std::string name, FindService find, std::string id)
        : name_(std::move(name)), find_(std::move(find)), wanted_(std::move(id)) {}

    [[nodiscard]] Result<void> open() override;
    [[nodiscard]] bool turn(const DeviceWrench& wrench, ServedState& state) noexcept override;
    void close() noexcept override;
    [[nodiscard]] LineNotice notice() noexcept override;
    [[nodiscard]] std::string words_for(const LineNotice& notice) const override;

private:
    // Takes the answer that `text_` is.
    void take(ServedState& state) noexcept;
    [[nodiscard]] bool send(const Vec3& force_N) noexcept;
    void count(Nanoseconds now_ns) noexcept;
    void tell(std::uint32_t what, std::int32_t number = 0) noexcept { notice_ = {what, number}; }

    std::string name_;
    FindService find_;
    std::string wanted_, id_;
    std::optional<WebSocketClient> socket_;
    bool takes_vector_ = false, is_gone_ = false, is_told_unwell_ = false;
    Inverse3Trouble trouble_ = Inverse3Trouble::none;
    std::string text_;
    MonotonicClock clock_;
    Nanoseconds sent_ns_ = 0;
    int owed_ = 0;  // answers
    // Of the rate: of the first kCounted answers.
    static constexpr int kCounted = 1000;
    int answers_ = 0;
    Nanoseconds first_ns_ = 0, waited_ns_ = 0;
    LineNotice told_, notice_;
    std::array<LineNotice, 2> measured_{};
};

}  // namespace burin::devices
