// SPDX-License-Identifier: MIT
#include "devices/trackers/vrpn_protocol.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "base/text.hpp"

namespace burin::devices {
namespace {

constexpr std::string_view kCookie = "vrpn: ver. 07.38  0";
constexpr std::size_t kMajorEnd = std::string_view("vrpn: ver. 07.").size(), kVersionBegin = 11, kVersionEnd = 16;
constexpr std::size_t kAlign = 8;

constexpr std::size_t padded(std::size_t bytes) { return (bytes + kAlign - 1) / kAlign * kAlign; }

void put(std::vector<std::byte>& to, std::int32_t value) {
    std::array<std::byte, sizeof(value)> bytes;
    std::memcpy(bytes.data(), &value, sizeof(value));
    if constexpr (std::endian::native == std::endian::little) std::ranges::reverse(bytes);
    for (const std::byte byte : bytes) to.push_back(byte);
}

// The caller has seen to it that the payload is long enough.
template <typename Number>
Number number_at(std::span<const std::byte> from, std::size_t at) {
    std::array<std::byte, sizeof(Number)> bytes;
    std::ranges::copy(from.subspan(at, sizeof(Number)), bytes.begin());
    if constexpr (std::endian::native == std::endian::little) std::ranges::reverse(bytes);
    return std::bit_cast<Number>(bytes);
}

std::int32_t int_at(std::span<const std::byte> from, std::size_t at) { return number_at<std::int32_t>(from, at); }
double double_at(std::span<const std::byte> from, std::size_t at) { return number_at<double>(from, at); }

// Text of unknown origin, for a message.
std::string printable(std::span<const std::byte> bytes) {
    std::string text;
    for (const std::byte b : bytes) {
        const char c = static_cast<char>(b);
        text += c >= ' ' && c <= '~' ? c : '.';
    }
    return text;
}

}  // namespace

VrpnBytes& VrpnBytes::cookie() {
    for (std::size_t i = 0; i < kVrpnCookieBytes; ++i)
        bytes_.push_back(i < kCookie.size() ? static_cast<std::byte>(kCookie[i]) : std::byte{0});
    return *this;
}

VrpnBytes& VrpnBytes::name(VrpnSystemType kind, std::int32_t number, std::string_view name) {
    std::vector<std::byte> payload;
    put(payload, static_cast<std::int32_t>(name.size() + 1));
    for (const char c : name) payload.push_back(static_cast<std::byte>(c));
    payload.push_back(std::byte{0});
    return message(number, kind, payload);
}

VrpnBytes& VrpnBytes::message(std::int32_t sender, std::int32_t type, std::span<const std::byte> payload) {
    put(bytes_, static_cast<std::int32_t>(kVrpnHeaderBytes + payload.size()));
    put(bytes_, 0);  // seconds and microseconds
    put(bytes_, 0);
    put(bytes_, sender);
    put(bytes_, type);
    put(bytes_, 0);
    for (const std::byte byte : payload) bytes_.push_back(byte);
    bytes_.resize(bytes_.size() + padded(payload.size()) - payload.size());
    return *this;
}

std::optional<VrpnPose> vrpn_pose(std::span<const std::byte> payload) {
    if (payload.size() < 64) return std::nullopt;
    VrpnPose pose;
    pose.sensor = int_at(payload, 0);
    pose.position_m = {double_at(payload, 8), double_at(payload, 16), double_at(payload, 24)};
    pose.orientation =
        Quat(double_at(payload, 56), double_at(payload, 32), double_at(payload, 40), double_at(payload, 48));
    return pose;
}

std::optional<VrpnButton> vrpn_button(std::span<const std::byte> payload) {
    if (payload.size() < 8) return std::nullopt;
    return VrpnButton{int_at(payload, 0), int_at(payload, 4)};
}

std::optional<std::vector<std::int32_t>> vrpn_buttons(std::span<const std::byte> payload) {
    if (payload.size() < 4) return std::nullopt;
    const std::int32_t count = int_at(payload, 0);
    if (count < 0 || static_cast<std::size_t>(count) > kMostVrpnButtons ||
        payload.size() < 4 + 4 * static_cast<std::size_t>(count))
        return std::nullopt;
    std::vector<std::int32_t> states;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) states.push_back(int_at(payload, 4 + 4 * i));
    return states;
}

std::optional<std::vector<double>> vrpn_channels(std::span<const std::byte> payload) {
    if (payload.size() < 8) return std::nullopt;
    const double said = double_at(payload, 0);
    if (!(said >= 0.0 && said <= static_cast<double>(kMostVrpnChannels))) return std::nullopt;
    const auto count = static_cast<std::size_t>(said);
    if (payload.size() < 8 + 8 * count) return std::nullopt;
    std::vector<double> channels;
    for (std::size_t i = 0; i < count; ++i) channels.push_back(double_at(payload, 8 + 8 * i));
    return channels;
}

std::span<std::byte> VrpnReader::room() {
    if (begin_ > 0) {
        std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
                  buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
        end_ -= begin_;
        begin_ = 0;
    }
    return std::span(buffer_).subspan(end_);
}

void VrpnReader::read_version() {
    if (failure_ || has_cookie() || end_ - begin_ < kVrpnCookieBytes) return;
    const auto cookie = std::span<const std::byte>(buffer_).subspan(begin_, kVrpnCookieBytes);
    const std::string text = printable(cookie);
    if (!text.starts_with("vrpn: ver. ")) {
        failure_ = "is no VRPN server: it says '" + text + "'";
    } else if (!text.starts_with(kCookie.substr(0, kMajorEnd))) {
        failure_ = "speaks version " + text.substr(kVersionBegin, kVersionEnd - kVersionBegin) +
                   " of VRPN, and Burin version 07";
    } else {
        version_ = text.substr(kVersionBegin, kVersionEnd - kVersionBegin);
        begin_ += kVrpnCookieBytes;
    }
}

std::optional<VrpnMessage> VrpnReader::next() {
    read_version();
    if (failure_ || !has_cookie() || end_ - begin_ < kVrpnHeaderBytes) return std::nullopt;
    const auto came = std::span<const std::byte>(buffer_).subspan(begin_, end_ - begin_);
    const std::int64_t length = int_at(came, 0);
    if (length < static_cast<std::int64_t>(kVrpnHeaderBytes) ||
        length > static_cast<std::int64_t>(kVrpnHeaderBytes + kMostVrpnPayload)) {
        failure_ = formatted("sends a message of %lld bytes, and there are from %zu to %zu",
                             static_cast<long long>(length), kVrpnHeaderBytes, kVrpnHeaderBytes + kMostVrpnPayload);
        return std::nullopt;
    }
    const std::size_t payload = static_cast<std::size_t>(length) - kVrpnHeaderBytes;
    if (came.size() < kVrpnHeaderBytes + padded(payload)) return std::nullopt;
    begin_ += kVrpnHeaderBytes + padded(payload);
    const std::int64_t seconds = int_at(came, 4), microseconds = int_at(came, 8);
    const bool is_time = seconds >= 0 && microseconds >= 0 && microseconds < 1'000'000;
    return VrpnMessage{int_at(came, 12), int_at(came, 16), came.subspan(kVrpnHeaderBytes, payload),
                       is_time ? seconds * 1'000'000 + microseconds : 0};
}

bool VrpnNames::take(const VrpnMessage& message) {
    if (message.type != kVrpnSender && message.type != kVrpnType) return false;
    std::vector<std::string>& names = message.type == kVrpnSender ? senders_ : types_;
    const std::int32_t said = message.payload.size() >= 4 ? int_at(message.payload, 0) : 0;
    const bool fits = message.sender >= 0 && static_cast<std::size_t>(message.sender) < kMostVrpnNames && said > 0 &&
                      static_cast<std::size_t>(said) <= kMostVrpnName + 1 &&
                      message.payload.size() >= 4 + static_cast<std::size_t>(said);
    if (!fits) {
        ++left_out_;
        return true;
    }
    std::string name = printable(message.payload.subspan(4, static_cast<std::size_t>(said) - 1));
    const auto number = static_cast<std::size_t>(message.sender);
    if (names.size() <= number) names.resize(number + 1);
    names[number] = std::move(name);
    return true;
}

std::string_view VrpnNames::name_of(const std::vector<std::string>& names, std::int32_t number) {
    return number >= 0 && static_cast<std::size_t>(number) < names.size() ? names[static_cast<std::size_t>(number)]
                                                                          : std::string_view();
}

}  // namespace burin::devices
