// SPDX-License-Identifier: MIT
#include "devices/emulators/vrpn_wire.hpp"

#include <bit>
#include <utility>

namespace burin::devices {
namespace {

// vrpn_Connection.C: the magic's 16 characters, two blanks, the mode in which nothing is logged, and zeros.
constexpr std::string_view kServerGreets{"vrpn: ver. 07.38  0\0\0\0\0\0", 24};
constexpr std::string_view kGreetingOfMajor{"vrpn: ver. 07."};  // whose length ends with the last point
constexpr std::int32_t kDescribesSender = -1, kDescribesType = -2;
constexpr std::size_t kHeader = 24, kMultiple = 8;
constexpr std::uint32_t kLongestMessage = 64'000;
constexpr std::size_t kMostDescribed = 2000, kLongestName = 100;  // a name with its zero

// Network order: the highest byte first.
void add_network(std::vector<std::byte>& to, std::uint64_t value, int bytes) {
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
        to.push_back(static_cast<std::byte>(value >> shift & 0xff));
}
void add_int(std::vector<std::byte>& to, std::int32_t value) { add_network(to, static_cast<std::uint32_t>(value), 4); }
void add_float64(std::vector<std::byte>& to, double value) { add_network(to, std::bit_cast<std::uint64_t>(value), 8); }

std::uint32_t network_word(std::span<const std::byte> from, std::size_t word) {
    std::uint32_t value = 0;
    for (const std::byte byte : from.subspan(4 * word, 4)) value = value << 8 | std::to_integer<std::uint32_t>(byte);
    return value;
}

std::string text_in(std::span<const std::byte> bytes) {
    std::string text;
    for (const std::byte byte : bytes) text += std::to_integer<char>(byte);
    return text;
}

// The name in a description: its length with the zero at the end, and its characters. Nothing: it is none.
std::optional<std::string> described_name(std::span<const std::byte> payload) {
    if (payload.size() < 4) return std::nullopt;
    const std::size_t length = network_word(payload, 0);
    if (length < 1 || length > payload.size() - 4 || length > kLongestName) return std::nullopt;
    return text_in(payload.subspan(4, length - 1));
}

}  // namespace

VrpnServerBytes& VrpnServerBytes::cookie() {
    for (const char character : kServerGreets) bytes_.push_back(static_cast<std::byte>(character));
    return *this;
}

VrpnServerBytes& VrpnServerBytes::sender(std::int32_t number, std::string_view name) {
    return description(kDescribesSender, number, name);
}

VrpnServerBytes& VrpnServerBytes::type(std::int32_t number, std::string_view name) {
    return description(kDescribesType, number, name);
}

VrpnServerBytes& VrpnServerBytes::description(std::int32_t kind, std::int32_t number, std::string_view name) {
    const std::string with_zero = std::string(name) + '\0';
    std::vector<std::byte> told;
    add_int(told, static_cast<std::int32_t>(with_zero.size()));
    for (const char character : with_zero) told.push_back(static_cast<std::byte>(character));
    return message(number, kind, told);
}

// Header: length without what fills up the end, seconds, microseconds, sender, type, and a word that nobody reads.
VrpnServerBytes& VrpnServerBytes::message(std::int32_t sender, std::int32_t type, std::span<const std::byte> payload,
                                          std::int64_t time_us) {
    constexpr std::int64_t kMicroseconds = 1'000'000;
    const auto length = static_cast<std::int32_t>(kHeader + payload.size());
    const auto whole_s = static_cast<std::int32_t>(time_us / kMicroseconds);
    const auto rest_us = static_cast<std::int32_t>(time_us % kMicroseconds);
    for (const std::int32_t word : {length, whole_s, rest_us, sender, type, 0}) add_int(bytes_, word);
    bytes_.insert(bytes_.end(), payload.begin(), payload.end());
    while (bytes_.size() % kMultiple != 0) bytes_.push_back(std::byte{0});  // all before are multiples as well
    return *this;
}

// The sensor stands there twice, so that the numbers behind it lie at multiples of 8.
std::vector<std::byte> vrpn_pos_quat(std::int32_t sensor, const Pose& pose) {
    std::vector<std::byte> payload;
    add_int(payload, sensor);
    add_int(payload, sensor);
    const auto& [place_m, turn] = pose;
    for (const double value : {place_m.x, place_m.y, place_m.z, turn.x, turn.y, turn.z, turn.w})
        add_float64(payload, value);
    return payload;
}

std::vector<std::byte> vrpn_button_change(std::int32_t button, std::int32_t state) {
    std::vector<std::byte> payload;
    add_int(payload, button);
    add_int(payload, state);
    return payload;
}

std::vector<std::byte> vrpn_button_states(std::span<const std::int32_t> states) {
    std::vector<std::byte> payload;
    add_int(payload, static_cast<std::int32_t>(states.size()));
    for (const std::int32_t state : states) add_int(payload, state);
    return payload;
}

// Their number is one of 64 bits with a point, too.
std::vector<std::byte> vrpn_analog_channels(std::span<const double> channels) {
    std::vector<std::byte> payload;
    add_float64(payload, static_cast<double>(channels.size()));
    for (const double channel : channels) add_float64(payload, channel);
    return payload;
}

std::vector<HeardVrpn> VrpnServerEar::take(std::span<const std::byte> bytes) {
    std::vector<HeardVrpn> heard;
    waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
    std::span<const std::byte> rest(waiting_);
    if (!is_greeted_ && rest.size() >= kServerGreets.size()) {
        is_greeted_ = true;
        is_lost_ = !text_in(rest.first(kServerGreets.size())).starts_with(kGreetingOfMajor);
        rest = rest.subspan(kServerGreets.size());
    }
    while (is_greeted_ && !is_lost_ && rest.size() >= kHeader) {
        const std::uint32_t length = network_word(rest, 0);
        const std::size_t filled_up = (length + kMultiple - 1) / kMultiple * kMultiple;
        is_lost_ = length < kHeader || length > kLongestMessage;
        if (is_lost_ || rest.size() < filled_up) break;
        if (auto message = understood(rest.first(length))) heard.push_back(std::move(*message));
        rest = rest.subspan(filled_up);
    }
    if (is_lost_) rest = {};
    waiting_ = {rest.begin(), rest.end()};
    return heard;
}

std::optional<HeardVrpn> VrpnServerEar::understood(std::span<const std::byte> message) {
    const auto sender = static_cast<std::int32_t>(network_word(message, 3));
    const auto type = static_cast<std::int32_t>(network_word(message, 4));
    const std::span<const std::byte> payload = message.subspan(kHeader);
    if (type == kDescribesSender || type == kDescribesType) {
        auto& names = type == kDescribesSender ? senders_ : types_;
        if (const auto name = described_name(payload); name && names.size() < kMostDescribed) names[sender] = *name;
        return std::nullopt;
    }
    const auto name_of = [](const auto& names, std::int32_t number) {
        const auto found = names.find(number);
        return found == names.end() ? std::string() : found->second;
    };
    return HeardVrpn{name_of(senders_, sender), name_of(types_, type), {payload.begin(), payload.end()}};
}

}  // namespace burin::devices
