// SPDX-License-Identifier: MIT
#include "devices/emulators/emulated_inverse3.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>

#include "base/clock.hpp"
#include "base/json.hpp"
#include "devices/emulators/circling_hand.hpp"
#include "devices/haply/inverse3_device.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "devices/presence/emulator_socket.hpp"
#include "devices/served/served_arm.hpp"

namespace burin::devices {
namespace {

constexpr Nanoseconds kHaplyHolds_ns = 50'000'000;

std::string haply_number(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 9);
    return {text.data(), end.ptr};
}

std::string haply_place(double x, double y, double z) {
    return R"({"x":)" + haply_number(x) + R"(,"y":)" + haply_number(y) + R"(,"z":)" + haply_number(z) + "}";
}

const char* haply_truth(bool is_true) { return is_true ? "true" : "false"; }

// Returns the force that a message has for a device; none: it has none.
std::optional<Vec3> haply_force(const Json& message, const std::string& id, HaplyVersion version) {
    if (!message.is_object() || !message.contains("inverse3") || !message["inverse3"].is_array()) return std::nullopt;
    const char* const name = version == HaplyVersion::v3_5 ? "vector" : "values";
    for (const Json& device : message["inverse3"]) {
        if (!device.is_object() || device.value("device_id", Json()) != id) continue;
        const Json force = device.value("/commands/set_cursor_force"_json_pointer, Json());
        if (!force.is_object() || !force.contains(name) || !force[name].is_object()) return std::nullopt;
        const Json& parts = force[name];
        for (const char* const part : {"x", "y", "z"})
            if (!parts.contains(part) || !parts[part].is_number()) return std::nullopt;
        // Its y is away from the user, who is at the device frame's +z; its z is up.
        return Vec3(parts["x"].get<double>(), parts["z"].get<double>(), -parts["y"].get<double>());
    }
    return std::nullopt;
}

}  // namespace

Result<EmulatedInverse3> EmulatedInverse3::create(const std::string& name, EmulatedInverse3Options options) {
    auto listener = listen_as_emulator("inverse3", name);
    if (!listener) return std::unexpected(listener.error());
    auto server = WebSocketServer::listen({"127.0.0.1", 0});
    if (!server) return fail("emulated inverse3 " + name, "cannot be made: " + server.error(), "try it again");
    if (options.script.empty()) options.script = circling_hand();
    return EmulatedInverse3(std::move(*listener), std::move(*server), std::move(options));
}

void EmulatedInverse3::say(const std::string& text) {
    const std::lock_guard lock(drill_->mutex);
    drill_->says = text;
    drill_->lies = drill_->pushes = 0;
}

Vec3 EmulatedInverse3::written_N() const {
    const std::lock_guard lock(drill_->mutex);
    return drill_->written_N;
}

void EmulatedInverse3::hear(std::string_view text, Nanoseconds now_ns) {
    ++drill_->messages;
    heard_ns_ = now_ns;
    const auto force_N = haply_force(Json::parse(text, nullptr, false), options_.id, options_.version);
    if (!force_N) ++drill_->refused;
    const Vec3 given_N = force_N.value_or(Vec3(0.0));
    const std::lock_guard lock(drill_->mutex);
    drill_->written_N = given_N;
    if (drill_->lies > 0 && given_N != Vec3(0.0)) ++drill_->pushes;
}

std::string EmulatedInverse3::state(bool is_whole) const {
    const Vec3& at = sample_.position_device_m;
    const Quat& turn = sample_.orientation_device;
    const bool is_new = options_.version == HaplyVersion::v3_5;
    std::string text = "{";
    if (is_whole && is_new) text += R"("session_id":7,)";
    text += R"("inverse3":[)";
    if (!drill_->is_unplugged) {
        text += R"({"device_id":")" + options_.id + R"(",)";
        if (is_whole) {
            text += R"("config":{"type":"inverse3","device_info":{"major_version":10,"minor_version":2,"id":1181},)"
                    R"("handedness":"right","gravity_compensation":{"enabled":true,"scaling":1.0})";
            if (is_new) text += R"(,"preset":"defaults","basis":{"permutation":"XYZ"},"mount":{},"filters":{})";
            text += "},";
        }
        const Vec3 written_N = this->written_N();
        text += R"("state":{"cursor_position":)" + haply_place(at.x, -0.13 - at.z, 0.16 + at.y) +
                R"(,"cursor_velocity":{"x":0.0,"y":0.0,"z":0.0},)" +
                R"("angular_position":{"a0":-57.1,"a1":83.4,"a2":133.9},)" +
                R"("body_orientation":{"w":1.0,"x":0.0,"y":0.0,"z":0.0},)" + R"("current_cursor_force":)" +
                haply_place(written_N.x, -written_N.z, written_N.y) +
                R"(,"control_mode":"force","mode":"force","transform":{}},)" + R"("status":{"calibrated":)" +
                haply_truth(drill_->is_calibrated) + R"(,"in_use":true,"power_supply":)" +
                haply_truth(drill_->has_power) + R"(,"ready":true,"started":true}})";
    }
    text += "]";
    if (options_.handle != HaplyHandle::none) {
        const bool has_cable = options_.handle == HaplyHandle::with_cable;
        const auto is_down = [&](unsigned int bit) { return haply_truth((sample_.buttons >> bit & 1u) != 0); };
        text += std::string(R"(,")") + (has_cable ? "verse_grip" : "wireless_verse_grip") +
                R"(":[{"device_id":"61548","state":{"orientation":{"w":)" + haply_number(turn.w) + R"(,"x":)" +
                haply_number(turn.x) + R"(,"y":)" + haply_number(-turn.z) + R"(,"z":)" + haply_number(turn.y) + "},";
        text += has_cable ? std::string(R"("button":)") + is_down(0)
                          : std::string(R"("buttons":{"a":)") + is_down(0) + R"(,"b":)" + is_down(1) + R"(,"c":)" +
                                is_down(2) + "}";
        text += R"(,"hall":0}}])";
    }
    return text + "}";
}

void EmulatedInverse3::answer(WebSocketServer::Guest to) {
    std::string says;
    {
        const std::lock_guard lock(drill_->mutex);
        says = drill_->says;
        if (!says.empty()) ++drill_->lies;
    }
    server_.send(to, says.empty() ? state(false) : says);
}

void EmulatedInverse3::run(const std::function<bool()>& ends) {
    auto hand = SimulatedHand::create(options_.script, HandPath::monotone_cubic);
    if (!hand) return;
    SimulatedOmni arm(std::move(*hand), inverse3_model());
    static_cast<void>(ask_for_servo_priority());
    constexpr Nanoseconds kPeriod_ns = 1'000'000;
    MonotonicClock clock;
    const std::string port = std::to_string(service().port);
    const auto is_silent = [&, begun_ns = clock.now_ns()] {
        return drill_->is_silent || options_.silence.is_silent(seconds(clock.now_ns() - begun_ns));
    };
    const WebSocketServer::Host host{
        .came =
            [&](WebSocketServer::Guest guest) {
                if (options_.greets) server_.send(guest, options_.greeting.empty() ? state(true) : options_.greeting);
            },
        .said =
            [&](WebSocketServer::Guest guest, std::string_view text) {
                hear(text, clock.now_ns());
                const auto late_ns = nanoseconds(drill_->late_s);
                if (late_ns > 0)
                    owed_.push_back({clock.now_ns() + late_ns, guest});
                else
                    answer(guest);
            }};
    Nanoseconds due_ns = clock.now_ns();
    while (!ends()) {
        due_ns = std::max(due_ns + kPeriod_ns, clock.now_ns() - 50 * kPeriod_ns);
        if (is_silent()) server_.drop_all();
        server_.serve_for(std::max<Nanoseconds>(due_ns - clock.now_ns(), 0), host);
        if (const OwnedFile came = accept_host(listener_); came)
            static_cast<void>(::send(came.get(), port.data(), port.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
        const Nanoseconds now_ns = clock.now_ns();
        std::erase_if(owed_, [&](const Owed& owed) {
            if (owed.due_ns > now_ns) return false;
            answer(owed.to);
            return true;
        });
        const bool is_heard = heard_ns_ > 0 && now_ns - heard_ns_ < kHaplyHolds_ns && !is_silent();
        arm.write({is_heard ? written_N() : Vec3(0.0), Vec3(0.0)});
        if (heard_ns_ > 0) arm.advance(kPeriod_ns);
        sample_ = arm.read();
    }
}

}  // namespace burin::devices
