// SPDX-License-Identifier: MIT
// How a kind of force-feedback device is opened, as the rows of device_registry.cpp say it. A driver names all its
// functions, or its row does not compile; what they have in common is written once, in open_haptic_device().
// Thread: the one that opens the session.
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "devices/hand/any_hand.hpp"
#include "devices/haptic/opened_device.hpp"
#include "devices/presence/device_presence.hpp"

namespace burin::devices {

struct HapticHost;

// A field of a table's row that has to be written: it has no default, and takes no null pointer.
template <typename T>
class Needed {
public:
    // Both are implicit, so that a row reads as its values do; the second takes a lambda for a function.
    consteval Needed(T value) : value_(value) {
        if constexpr (std::is_pointer_v<T>)
            if (value_ == nullptr) throw "a row of a table lacks a function";
    }
    template <typename From>
        requires(std::convertible_to<From, T> && !std::same_as<From, T>)
    consteval Needed(From value) : Needed(static_cast<T>(value)) {}
    constexpr operator T() const { return value_; }

private:
    T value_;
};

// The functions of a device that is really there. `text` is what follows the name and a colon.
struct DriverFunctions {
    using Open = Result<OpenedDevice> (*)(const std::string& text, AnyHand hand, Clock& clock);

    // Refuses a text of another form than the driver's, before anything is looked for: a slip is told as one,
    // also where no device could be opened. The Error's remedy names a text that is right.
    Needed<Result<void> (*)(const std::string& text)> check;
    Needed<Open> open;  // called in real time alone
    // Opens one of the same description that is nowhere and rests: a recording is done again, in any time.
    Needed<Open> at_rest;
    Needed<std::vector<DevicePresence> (*)()> look;  // for such devices, without opening them
};

class Opening {
public:
    using OpenSimulated = Result<OpenedDevice> (*)(HapticHost host, const std::string& text);

    // Of a device that the program itself simulates, in any time.
    [[nodiscard]] static consteval Opening simulated(Needed<OpenSimulated> open) { return Opening(open); }
    [[nodiscard]] static consteval Opening driver(DriverFunctions functions) { return Opening(functions); }

    [[nodiscard]] constexpr bool is_driver() const { return simulated_ == nullptr; }
    // Refuses what no device of the kind can be called. A simulated one refuses it as it is opened.
    [[nodiscard]] Result<void> check(const std::string& text) const { return driver_.check(text); }
    // Opens it, or what stands in for it. Fails where a device that is really there was asked for in simulated time.
    // `name` is the kind's.
    [[nodiscard]] Result<OpenedDevice> operator()(std::string_view name, HapticHost host,
                                                  const std::string& text) const;
    // Not for a simulated one, which is always there.
    [[nodiscard]] std::vector<DevicePresence> look() const { return driver_.look(); }

private:
    consteval explicit Opening(OpenSimulated open) : simulated_(open), driver_{any_text, unused, unused, unused_look} {}
    consteval explicit Opening(DriverFunctions functions) : driver_(functions) {}
    static Result<void> any_text(const std::string&) { return {}; }
    static Result<OpenedDevice> unused(const std::string&, AnyHand, Clock&) { return OpenedDevice{}; }
    static std::vector<DevicePresence> unused_look() { return {}; }

    OpenSimulated simulated_ = nullptr;
    DriverFunctions driver_;
};

}  // namespace burin::devices
