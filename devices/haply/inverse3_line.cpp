// SPDX-License-Identifier: MIT
#include "devices/haply/inverse3_line.hpp"

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "base/try.hpp"

namespace burin::devices {
namespace {

enum Inverse3Notice : std::uint32_t {
    kInverse3IsGone = 1,
    kInverse3Back,
    kInverse3Unsound,
    kInverse3NotThere,
    kInverse3Unwell,  // number: the trouble
    kInverse3Slow,
    kInverse3Well,
    kInverse3Rate,  // number: a second
    kInverse3Age    // number: microseconds
};

}  // namespace

Result<Inverse3Greeting> greet_inverse3(const std::string& where, const NetworkAddress& service,
                                        Nanoseconds within_ns) {
    const std::string at = service.text();
    auto socket = WebSocketClient::connect(service, within_ns);
    if (!socket)
        return fail(where, "no service of Haply's answers at " + at + ": " + socket.error(),
                    "start the maker's service (Haply Hub installs it), or write inverse3:HOST:PORT where it is "
                    "elsewhere");
    std::string text;
    auto heard = socket->receive(text, within_ns);
    if (heard == WebSocketClient::Outcome::late &&
        socket->send(inverse3_asks_for_all(), within_ns) == WebSocketClient::Outcome::well)
        heard = socket->receive(text, within_ns);
    if (heard != WebSocketClient::Outcome::well)
        return fail(where, "the service at " + at + " says nothing of its devices",
                    "restart the maker's service; Burin speaks with its versions 3.1 to 3.5");
    auto words = read_inverse3(text);
    if (!words)
        return fail(
            where, "the service at " + at + " speaks another language",
            "Burin speaks with versions 3.1 to 3.5 of the maker's service: port 10001, and not the older 10000");
    return Inverse3Greeting{std::move(*socket), std::move(*words)};
}

Result<void> Inverse3Line::open() {
    const std::string where = "haptic device " + name_;
    const auto service = find_();
    if (!service) return std::unexpected(service.error());
    BURIN_TRY(greeting, greet_inverse3(where, *service, kInverse3Greets_ns));
    const auto& devices = greeting.words.devices;
    if (devices.empty())
        return fail(where, "the service sees no Inverse3", "plug one in and switch it on: its power and its USB cable");
    const std::vector<std::string_view> ids(inverse3_ids(greeting.words));
    const std::string wanted(wanted_.empty() ? ids.front() : wanted_);
    const Inverse3State* const device = inverse3_of(greeting.words, wanted);
    if (device == nullptr)
        return fail(where, "the service sees no Inverse3 of this number",
                    "write one of those that there are: " + joined(ids));
    id_ = wanted;
    trouble_ = device->trouble.value_or(Inverse3Trouble::none);
    takes_vector_ = greeting.words.takes_vector;
    socket_ = std::move(greeting.socket);
    sent_ns_ = clock_.now_ns();
    owed_ = answers_ = 0;
    if (std::exchange(is_gone_, false)) tell(kInverse3Back);
    return {};
}

void Inverse3Line::close() noexcept {
    constexpr Nanoseconds kGoodbye_ns = 100'000'000;
    if (socket_) socket_->close(kGoodbye_ns);
    socket_.reset();
}

bool Inverse3Line::send(const Vec3& force_N) noexcept {
    const double size_N = glm::length(force_N);
    const Vec3 given_N = size_N > kInverse3Most_N ? force_N * (kInverse3Most_N / size_N) : force_N;
    const auto sent = socket_->send(inverse3_force(id_, given_N, takes_vector_), kInverse3Late_ns);
    if (sent == WebSocketClient::Outcome::well && owed_++ == 0) sent_ns_ = clock_.now_ns();
    return sent != WebSocketClient::Outcome::gone;
}

bool Inverse3Line::turn(const DeviceWrench& wrench, ServedState& state) noexcept {
    const auto is_lost = [&] {
        if (!std::exchange(is_gone_, true)) tell(kInverse3IsGone);
        return false;
    };
    // The last turn of a line that is let go waits for nothing.
    if (is_gone_) {
        if (socket_) static_cast<void>(send(Vec3(0.0)));
        return false;
    }
    // What is owed was asked for by zero.
    if (owed_ == 0 && !send(wrench.force_device_N)) return is_lost();
    auto heard = socket_->receive(text_, kInverse3Late_ns);
    if (heard == WebSocketClient::Outcome::well) {
        const Nanoseconds now_ns = clock_.now_ns();
        waited_ns_ += now_ns - sent_ns_;
        owed_ = std::max(owed_ - 1, 0);
        sent_ns_ = now_ns;  // of an answer that is still owed
        count(now_ns);
        take(state);
        return true;
    }
    if (heard == WebSocketClient::Outcome::gone || clock_.now_ns() - sent_ns_ > kInverse3Gone_ns) return is_lost();
    // Once: a service that is stopped hears it when it goes on.
    if (owed_ == 1 && !send(Vec3(0.0))) return is_lost();
    state.fault = DeviceFault::disconnected;
    tell(kInverse3Slow);
    is_told_unwell_ = true;
    return true;
}

void Inverse3Line::take(ServedState& state) noexcept {
    const auto words = read_inverse3(text_);
    const Inverse3State* const device = words ? inverse3_of(*words, id_) : nullptr;
    if (device != nullptr && device->trouble) trouble_ = *device->trouble;
    if (words && device == nullptr) {
        state.fault = DeviceFault::disconnected;
        tell(kInverse3NotThere);
    } else if (!words || !device->position_m || (words->has_handle && !words->orientation)) {
        state.fault = DeviceFault::other;
        tell(kInverse3Unsound);
    } else {
        state.pose_device.position_m = *device->position_m;
        if (words->orientation) state.pose_device.orientation = *words->orientation;
        state.buttons = words->buttons;
        if (trouble_ != Inverse3Trouble::none) {
            state.fault = DeviceFault::other;
            tell(kInverse3Unwell, static_cast<std::int32_t>(trouble_));
        }
    }
    const bool is_unwell = state.fault != DeviceFault::none;
    if (std::exchange(is_told_unwell_, is_unwell) && !is_unwell) tell(kInverse3Well);
}

void Inverse3Line::count(Nanoseconds now_ns) noexcept {
    if (answers_ > kCounted) return;
    if (answers_++ == 0) {
        first_ns_ = now_ns;
        waited_ns_ = 0;
    } else if (answers_ == kCounted + 1) {
        measured_ = {LineNotice{kInverse3Rate, static_cast<std::int32_t>(kCounted / seconds(now_ns - first_ns_))},
                     LineNotice{kInverse3Age, static_cast<std::int32_t>(seconds(waited_ns_ / kCounted) * 1e6)}};
    }
}

LineNotice Inverse3Line::notice() noexcept {
    for (LineNotice& measured : measured_)
        if (measured.what != 0) return std::exchange(measured, {});
    const LineNotice notice = std::exchange(notice_, {});
    // A state that lasts is told when it begins, and no more.
    if (notice == told_) return {};
    if (notice.what != 0) told_ = notice;
    return notice;
}

std::string Inverse3Line::words_for(const LineNotice& notice) const {
    const std::string who = "the " + name_;
    switch (notice.what) {
        case kInverse3IsGone: return who + " is gone: its service does not answer; see that the maker's service runs";
        case kInverse3Back: return who + " is there again";
        case kInverse3Unsound: return who + " has a state that is none: switch it off and on";
        case kInverse3NotThere:
            return who + " is no longer among its service's devices: see that its cable and its power are plugged in";
        case kInverse3Slow: return who + " is answered too late by its service, and gives no force until it is";
        case kInverse3Well: return who + " gives force again";
        case kInverse3Rate:
            return who + " exchanges " + std::to_string(notice.number) +
                   " states and forces a second with its service" +
                   (notice.number < 500 ? ": so few that hard walls feel rough" : "");
        case kInverse3Age:
            return who + " has samples of " + std::to_string(notice.number) +
                   " us, from a force until its answer, in the mean";
        case kInverse3Unwell: break;
        default: return {};
    }
    switch (static_cast<Inverse3Trouble>(notice.number)) {
        case Inverse3Trouble::uncalibrated: return who + " is not calibrated: calibrate it as its manual says";
        case Inverse3Trouble::without_power: return who + " has no power: plug its power supply in";
        case Inverse3Trouble::not_ready:
        case Inverse3Trouble::none: break;
    }
    return who + " is not ready yet, as its service says";
}

}  // namespace burin::devices
