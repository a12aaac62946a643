// SPDX-License-Identifier: MIT
#include "devices/emulators/emulated_falcon.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/try.hpp"
#include "devices/emulators/circling_hand.hpp"
#include "devices/falcon/falcon_device.hpp"
#include "devices/falcon/falcon_line.hpp"
#include "devices/falcon/falcon_port.hpp"
#include "devices/falcon/falcon_socket.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "devices/presence/emulator_socket.hpp"
#include "devices/served/served_arm.hpp"

namespace burin::devices {
namespace {

// The firmware's end of the line, from the packet's form alone (devices/falcon/falcon_packet.hpp) and without the
// driver's code, so that a fault in one of the two shows where they meet: '<', three numbers of four characters, the
// lowest nibble first and 'A' for zero, a character of states, one that says nothing, '>'.
constexpr std::size_t kPacketLength = 16, kStatesAt = 13;

std::optional<unsigned> nibble_of(char character, unsigned most) {
    const int value = static_cast<unsigned char>(character) - 'A';
    return value >= 0 && value <= static_cast<int>(most) ? std::optional(static_cast<unsigned>(value)) : std::nullopt;
}

struct HeardByFalcon {
    FalconCounts motors{};
    unsigned int lamps = 0;  // green 2, blue 4, red 8
    bool homes = false;
};

// Returns what a whole packet says; nothing where it is none.
std::optional<HeardByFalcon> heard_in(const std::string& packet) {
    if (packet.size() != kPacketLength || packet.front() != '<' || packet.back() != '>') return std::nullopt;
    HeardByFalcon heard;
    for (std::size_t leg = 0; leg < kFalconLegs; ++leg) {
        unsigned value = 0, place = 1;
        for (std::size_t i = 0; i < 4; ++i, place *= 16) {
            const auto nibble = nibble_of(packet[1 + 4 * leg + i], 15);
            if (!nibble) return std::nullopt;
            value += place * *nibble;
        }
        heard.motors[leg] =
            static_cast<std::int16_t>(value < 0x8000 ? static_cast<int>(value) : static_cast<int>(value) - 0x10000);
    }
    const auto states = nibble_of(packet[kStatesAt], 15);
    if (!states) return std::nullopt;
    heard.homes = *states % 2 == 1;
    heard.lamps = *states - (heard.homes ? 1 : 0);
    return heard;
}

std::string packet_said(const FalconCounts& encoders, unsigned buttons, bool is_homed) {
    std::string packet = "<";
    for (const std::int16_t encoder : encoders) {
        unsigned value = encoder < 0 ? static_cast<unsigned>(0x10000 + encoder) : static_cast<unsigned>(encoder);
        for (int i = 0; i < 4; ++i, value /= 16) packet += static_cast<char>('A' + value % 16);
    }
    packet += static_cast<char>('A' + buttons % 16 + (is_homed ? 0x70u : 0u));
    return packet + "A>";
}

std::vector<std::byte> bytes_in(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

}  // namespace

// All that is not drawn or told: the chip, what runs behind it, and the arm.
class EmulatedFalcon::Device {
public:
    Device(EmulatedFalcon& owner, SimulatedHand hand)
        : owner_(owner),
          arm_(std::move(hand), falcon_model()),
          has_firmware_(owner.options_.has_firmware),
          pose_(falcon_forward(*falcon_inverse(kFalconMiddle_m)).value()) {}

    // Takes the arm on by a millisecond; before a host has spoken the hand's time stands.
    void step() {
        const FalconAngles torques = falcon_torques_of(motors_);
        arm_.write({falcon_force(pose_, torques), Vec3(0.0)});
        if (has_packet_) arm_.advance(1'000'000);
        if (loader_ == Loader::greeted && baud_ == kFtdiUpload && ++steps_at_upload_ >= kClearAfter)
            says_status_ = true;
        const DeviceSample sample = arm_.read();
        buttons_ = sample.buttons;
        const auto angles = falcon_inverse(kFalconMiddle_m + sample.position_device_m);
        if (!angles) return;  // a corner of the box, where the legs end before it
        encoders_ = falcon_encoders(*angles);
        owner_.encoders_->set(encoders_);
        if (const auto pose = falcon_forward(falcon_angles(encoders_), pose_.grip_m)) pose_ = *pose;
    }

    void take(std::span<const std::byte> message) {
        if (message.size() == 4 && message[0] == static_cast<std::byte>(kFalconControl))
            set(static_cast<FtdiRequest>(message[1]),
                static_cast<std::uint16_t>(std::to_integer<int>(message[2]) | std::to_integer<int>(message[3]) << 8));
        if (message.size() > 1 && message[0] == static_cast<std::byte>(kFalconWrite)) hear(message.subspan(1));
    }

    // Returns the next piece for the host; nothing: there is none.
    [[nodiscard]] std::optional<std::vector<std::byte>> piece() {
        if (owner_.drill_->is_silent) said_.clear();
        if (said_.empty() && !says_status_) return std::nullopt;
        says_status_ = false;
        constexpr std::byte kReady{0x01}, kClearToSend{0x10};  // the chip's own, and that its line is free
        std::vector<std::byte> piece{steps_at_upload_ >= kClearAfter ? kReady | kClearToSend : kReady, std::byte{0x60}};
        // Some have nothing but that, and some end in the middle of a packet.
        ++pieces_;
        std::size_t count = std::min(said_.size(), kFtdiPiece - kFtdiOwn);
        if (pieces_ % 5 == 0) count = 0;
        if (pieces_ % 7 == 0) count = std::min<std::size_t>(count, 9);
        piece.insert(piece.end(), said_.begin(), said_.begin() + static_cast<long>(count));
        said_.erase(said_.begin(), said_.begin() + static_cast<long>(count));
        return piece;
    }

    // The cable is pulled: nothing that drives the motors comes any more.
    void unplug() {
        motors_ = {};
        said_.clear();
        has_firmware_ = owner_.options_.has_firmware;
        owner_.drill_->is_homed = owner_.options_.is_homed;
        loader_ = Loader::sleeps;
        steps_at_upload_ = bad_loads_ = 0;
        waiting_.clear();
    }

private:
    enum class Loader { sleeps, listens, greeted, loads };
    // Steps from the change of speed until it is clear to send; what is written before that is not heard.
    static constexpr int kClearAfter = 5;

    void set(FtdiRequest what, std::uint16_t value) {
        if (what == FtdiRequest::baud) {
            if (loader_ == Loader::loads && value == kFtdiRun) end_load();
            baud_ = value;
            steps_at_upload_ = 0;
        }
        // The boot loader begins to listen when the line's signal rises, and takes firmware when it has fallen again.
        if (what == FtdiRequest::modem && value == kFtdiDtrHigh && !has_firmware_) loader_ = Loader::listens;
        if (what == FtdiRequest::modem && value == kFtdiDtrLow && loader_ != Loader::greeted) loader_ = Loader::sleeps;
        if (what == FtdiRequest::reset) said_.clear();
    }

    void end_load() {
        has_firmware_ = !is_bad_ && (loaded_ == kNovintFirmware || loaded_ == kNventFirmware);
        owner_.drill_->loads += has_firmware_ ? 1 : 0;
        loader_ = Loader::sleeps;
    }

    void hear(std::span<const std::byte> bytes) {
        if (has_firmware_ && baud_ == kFtdiRun) {
            for (const std::byte byte : bytes) {
                waiting_ += std::to_integer<char>(byte);
                if (waiting_.front() != '<') waiting_.clear();
                if (waiting_.size() == kPacketLength) answer(std::exchange(waiting_, {}));
            }
            return;
        }
        if (loader_ == Loader::loads && baud_ == kFtdiUpload) {
            const std::size_t before = loaded_;
            loaded_ += bytes.size();
            said_.insert(said_.end(), bytes.begin(), bytes.end());
            constexpr std::size_t kWrongAt = 2000;
            if (is_bad_ && before <= kWrongAt && loaded_ > kWrongAt) said_.back() ^= std::byte{0x40};
        } else if (loader_ == Loader::greeted && baud_ == kFtdiUpload && steps_at_upload_ >= kClearAfter &&
                   std::ranges::equal(bytes, bytes_in("A"))) {
            loader_ = Loader::loads;
            loaded_ = 0;
            is_bad_ = bad_loads_++ < owner_.options_.bad_loads;
            said_ = bytes_in("A");
        } else if (loader_ != Loader::sleeps && baud_ == kFtdiBoot &&
                   std::ranges::equal(bytes, bytes_in("\x0a\x43\x0d"))) {
            loader_ = Loader::greeted;
            said_ = bytes_in("\x0a\x44\x2c\x0d");
        }
    }

    void answer(const std::string& packet) {
        const auto command = heard_in(packet);
        if (!command) return;
        owner_.heard_->keep(packet);
        has_packet_ = true;
        motors_ = command->motors;
        owner_.written_->set(motors_);
        owner_.drill_->lamps = command->lamps;
        const FalconCounts encoders = owner_.drill_->is_lost ? FalconCounts{-4000, 4000, 0} : encoders_;
        for (int i = 0; i < owner_.drill_->babble; ++i) said_.push_back(static_cast<std::byte>("<>A\x7f"[i % 4]));
        const std::vector<std::byte> bytes =
            bytes_in(packet_said(encoders, buttons_, owner_.drill_->is_homed && command->homes));
        said_.insert(said_.end(), bytes.begin(), bytes.end());
    }

    EmulatedFalcon& owner_;
    SimulatedOmni arm_;
    bool has_firmware_, has_packet_ = false;
    FalconPose pose_;
    FalconCounts encoders_{}, motors_{};
    std::uint32_t buttons_ = 0;
    std::uint16_t baud_ = 0;
    Loader loader_ = Loader::sleeps;
    std::size_t loaded_ = 0;
    int steps_at_upload_ = 0, bad_loads_ = 0;
    bool is_bad_ = false, says_status_ = false;
    std::string waiting_;  // the bytes of a packet that is not whole yet
    std::vector<std::byte> said_;
    unsigned int pieces_ = 0;
};

Result<EmulatedFalcon> EmulatedFalcon::create(const std::string& name, EmulatedFalconOptions options) {
    BURIN_TRY(listener, listen_as_emulator("falcon", name));
    if (options.script.empty()) options.script = circling_hand();
    EmulatedFalcon falcon(std::move(listener), std::move(options));
    falcon.drill_->is_homed = falcon.options_.is_homed;
    return falcon;
}

void EmulatedFalcon::Heard::keep(const std::string& packet) {
    const std::lock_guard lock(mutex);
    packets.push_back(packet);
    if (packets.size() > kMostHeard) packets.pop_front();
}

std::vector<std::string> EmulatedFalcon::heard() const {
    const std::lock_guard lock(heard_->mutex);
    return {heard_->packets.begin(), heard_->packets.end()};
}

Vec3 EmulatedFalcon::written_N() const {
    const auto pose = falcon_forward(falcon_angles(encoders_->get()));
    return pose ? falcon_force(*pose, falcon_torques_of(written())) : Vec3(0.0);
}

void EmulatedFalcon::run(const std::function<bool()>& ends) {
    static_cast<void>(ask_for_servo_priority());
    constexpr Nanoseconds kPeriod_ns = 1'000'000;
    MonotonicClock clock;
    auto hand = SimulatedHand::create(options_.script, HandPath::monotone_cubic);
    if (!hand) return;
    Device device(*this, std::move(*hand));
    OwnedFile host;
    const Nanoseconds begun_ns = clock.now_ns();
    Nanoseconds due_ns = begun_ns;
    while (!ends()) {
        const Nanoseconds now_ns = clock.now_ns();
        const bool is_pulled = drill_->is_pulled || options_.silence.is_silent(seconds(now_ns - begun_ns));
        if (is_pulled && host) {
            host = OwnedFile();
            device.unplug();
        }
        // One host at a time: others find the connection closed.
        if (OwnedFile came = accept_host(listener_); came) {
            if (!host && !is_pulled) {
                host = std::move(came);
                constexpr std::array<std::byte, kFtdiOwn> kStatus{std::byte{0x01}, std::byte{0x60}};
                static_cast<void>(::send(host.get(), kStatus.data(), kStatus.size(), MSG_NOSIGNAL));
            }
        }
        // What the host says is answered at once, until the arm's next step is due.
        due_ns = std::max(due_ns + kPeriod_ns, now_ns - 50 * kPeriod_ns);
        for (Nanoseconds left_ns = due_ns - clock.now_ns(); left_ns > 0; left_ns = due_ns - clock.now_ns()) {
            pollfd waits{host.get(), POLLIN, 0};
            const timespec time{0, left_ns};
            if (::ppoll(&waits, 1, &time, nullptr) <= 0) continue;
            std::array<std::byte, kMostFalconMessage> message;
            const ssize_t count = ::recv(host.get(), message.data(), message.size(), 0);
            if (count == 0 || (count < 0 && errno != EAGAIN)) {
                host = OwnedFile();
                continue;
            }
            if (count > 0) device.take(std::span(message).first(static_cast<std::size_t>(count)));
            while (const auto piece = device.piece())
                static_cast<void>(::send(host.get(), piece->data(), piece->size(), MSG_NOSIGNAL));
        }
        device.step();
        while (const auto piece = device.piece())
            static_cast<void>(::send(host.get(), piece->data(), piece->size(), MSG_NOSIGNAL));
    }
}

}  // namespace burin::devices
