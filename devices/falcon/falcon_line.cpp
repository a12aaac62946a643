// SPDX-License-Identifier: MIT
#include "devices/falcon/falcon_line.hpp"

#include "base/try.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace burin::devices {
namespace {

enum FalconNotice : std::uint32_t {
    kFalconWantsHoming = 1,
    kFalconHomed,
    kFalconNowhere,
    kFalconGone,
    kFalconBack,
    kFalconLoaded
};

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

constexpr Nanoseconds kPatient_ns = 1'000'000'000;

}  // namespace

Result<std::vector<std::byte>> read_falcon_firmware(const std::string& file) {
    const std::string where = "falcon firmware " + file;
    const std::string remedy =
        "name the firmware image of Novint's driver (7,914 bytes) or libnifalcon's "
        "nvent_firmware.bin (8,492 bytes)";
    std::error_code code;
    const auto size = std::filesystem::file_size(file, code);
    if (code) return fail(where, "cannot be read: " + code.message(), remedy);
    if (size != kNovintFirmware && size != kNventFirmware)
        return fail(where, "has " + std::to_string(size) + " bytes, as no firmware of a Falcon has", remedy);
    std::vector<std::byte> bytes(size);
    std::ifstream from(file, std::ios::binary);
    if (!from.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
        return fail(where, "cannot be read", remedy);
    return bytes;
}

Result<void> FalconLine::open() {
    const std::string where = "haptic device " + name_;
    BURIN_TRY(port, open_port_());
    port_ = std::move(port);
    if (settings_for_run() == Cable::pulled) {
        close();
        return fail(where, "does not take its settings", "plug it in again");
    }
    if (!answers()) {
        if (firmware_.empty()) {
            close();
            return fail(where, "has no firmware yet, as after it is switched on",
                        "name a firmware file: " + name_ + (name_ == "falcon" ? ":" : "@") + "FILE (docs/devices.md)");
        }
        if (auto runs = give_firmware(); !runs) {
            close();
            return runs;
        }
    }
    has_pose_ = is_homed_ = told_unhomed_ = false;
    if (std::exchange(is_gone_, false)) tell(kFalconBack);
    return {};
}

void FalconLine::close() noexcept {
    port_.reset();
    reader_.forget();
}

Cable FalconLine::settings_for_run() noexcept {
    using enum FtdiRequest;
    for (const auto& [what, value] :
         {std::pair{latency, std::uint16_t{1}}, {baud, kFtdiRun}, {reset, kFtdiPurgeIn}, {reset, kFtdiPurgeOut}})
        if (const Cable cable = port_->request(what, value); cable != Cable::well) return cable;
    reader_.forget();
    return Cable::well;
}

// A Falcon that runs answers each packet; the first after a purge may be lost.
bool FalconLine::answers() noexcept {
    constexpr int kTries = 5;
    FalconReport report;
    for (int i = 0; i < kTries; ++i) {
        const Cable cable = exchange({.motors = {}, .lamps = kFalconRed, .homes = true}, report);
        if (cable == Cable::well) return true;
        if (cable == Cable::pulled) return false;
    }
    return false;
}

Cable FalconLine::exchange(const FalconCommand& command, FalconReport& report) noexcept {
    const FalconBytes bytes = falcon_bytes(command);
    if (const Cable cable = port_->write(bytes, kAnswer_ns); cable != Cable::well) return cable;
    const Nanoseconds until_ns = clock_.now_ns() + kAnswer_ns;
    bool has_report = false;
    while (!has_report) {
        const Nanoseconds left_ns = until_ns - clock_.now_ns();
        if (left_ns <= 0) return Cable::late;
        std::array<std::byte, kFtdiPiece> piece;
        std::size_t count = 0;
        const Cable cable = port_->read(piece, count, left_ns);
        if (cable != Cable::well) return cable;
        // Of several packets in a piece the newest counts.
        for (std::size_t i = kFtdiOwn; i < count; ++i)
            if (const auto packet = reader_.take(piece[i]); packet)
                if (const auto read = falcon_report(*packet); read) {
                    report = *read;
                    has_report = true;
                }
    }
    return Cable::well;
}

bool FalconLine::turn(const DeviceWrench& wrench, ServedState& state) noexcept {
    FalconCommand command;
    if (has_pose_ && is_homed_) command.motors = falcon_commands(falcon_torques(pose_, wrench.force_device_N));
    command.lamps = !is_homed_ ? kFalconRed : wrench.force_device_N == Vec3(0.0) ? kFalconGreen : kFalconBlue;
    FalconReport report;
    if (exchange(command, report) != Cable::well) {
        if (!std::exchange(is_gone_, true)) tell(kFalconGone);
        return false;
    }
    state.buttons = report.buttons;
    is_homed_ = report.is_homed();
    // From where it was: it moves by less than a millimetre in a turn.
    const auto pose = falcon_forward(falcon_angles(report.encoders), has_pose_ ? pose_.grip_m : kFalconMiddle_m);
    has_pose_ = pose.has_value();
    if (has_pose_) {
        pose_ = *pose;
        state.pose_device.position_m = pose_.grip_m - kFalconMiddle_m;
    }
    if (!has_pose_ || !is_homed_) state.fault = DeviceFault::other;
    if (!has_pose_ && is_homed_) tell(kFalconNowhere);
    if (is_homed_ == told_unhomed_) tell(is_homed_ ? kFalconHomed : kFalconWantsHoming);
    told_unhomed_ = !is_homed_;
    return true;
}

LineNotice FalconLine::notice() noexcept {
    if (std::exchange(told_loads_, loads_) != loads_ && loads_ > 1) return {kFalconLoaded, loads_};
    return std::exchange(notice_, {});
}

std::string FalconLine::words_for(const LineNotice& notice) const {
    switch (notice.what) {
        case kFalconWantsHoming:
            return "the " + name_ + " does not know where its grip is: pull the grip all the way out, then push it in";
        case kFalconHomed: return "the " + name_ + " is homed";
        case kFalconNowhere:
            return "the " + name_ + " reads angles that its legs cannot have: switch it off and on, and home it again";
        case kFalconGone: return "the " + name_ + " is gone: see that its cable and its power are plugged in";
        case kFalconBack: return "the " + name_ + " is there again";
        case kFalconLoaded:
            return "the " + name_ + " runs its firmware, which it was given " + std::to_string(notice.number) +
                   " times: a load fails now and then";
    }
    return {};
}

// The boot loader repeats what it is told, in pieces as they come.
Cable FalconLine::hear(std::vector<std::byte>& heard, std::size_t count, Nanoseconds within_ns) {
    const Nanoseconds until_ns = clock_.now_ns() + within_ns;
    heard.clear();
    while (heard.size() < count) {
        const Nanoseconds left_ns = until_ns - clock_.now_ns();
        if (left_ns <= 0) return Cable::late;
        std::array<std::byte, kFtdiPiece> piece;
        std::size_t came = 0;
        const Cable cable = port_->read(piece, came, left_ns);
        if (cable != Cable::well) return cable;
        if (came > kFtdiOwn)
            heard.insert(heard.end(), piece.begin() + kFtdiOwn, piece.begin() + static_cast<long>(came));
    }
    return Cable::well;
}

Result<void> FalconLine::greet_boot_loader() {
    using enum FtdiRequest;
    const std::string where = "haptic device " + name_, remedy = "switch it off and on, and try again";
    for (const auto& [what, value] : {std::pair{reset, kFtdiPurgeIn},
                                      {reset, kFtdiPurgeOut},
                                      {latency, std::uint16_t{16}},
                                      {baud, kFtdiBoot},
                                      {data, kFtdi8N1},
                                      {flow, std::uint16_t{0}},
                                      {modem, kFtdiRtsLow},
                                      {modem, kFtdiDtrLow},
                                      {modem, kFtdiDtrHigh}})
        if (port_->request(what, value) != Cable::well) return fail(where, "does not take its settings", remedy);
    constexpr int kTries = 100;
    constexpr Nanoseconds kPiece_ns = 30'000'000;  // of latency 16 ms, and the line's own 7 ms
    const auto greeting = bytes_of("\x0a\x43\x0d"), answer = bytes_of("\x0a\x44\x2c\x0d");
    std::vector<std::byte> heard;
    bool is_there = false;
    for (int i = 0; i < kTries && !is_there; ++i) {
        if (port_->write(greeting, kPatient_ns) == Cable::pulled)
            return fail(where, "was unplugged", "plug it in again");
        if (hear(heard, answer.size(), kPiece_ns) == Cable::pulled)
            return fail(where, "was unplugged", "plug it in again");
        is_there = std::ranges::search(heard, answer).size() == answer.size();
    }
    is_boot_loader_silent_ = !is_there;
    if (!is_there)
        return fail(where, "runs no firmware, and its boot loader does not answer",
                    "see that its power supply is plugged in, switch it off and on, and try again");
    const auto upload = bytes_of("A");
    bool is_ready =
        port_->request(modem, kFtdiDtrLow) == Cable::well && port_->request(baud, kFtdiUpload) == Cable::well;
    if (is_ready) wait_until_clear_to_send();
    is_ready = is_ready && port_->write(upload, kPatient_ns) == Cable::well &&
               hear(heard, 1, kPatient_ns) == Cable::well && heard.front() == upload.front();
    if (!is_ready) return fail(where, "its boot loader takes no firmware", remedy);
    return {};
}

void FalconLine::wait_until_clear_to_send() {
    constexpr Nanoseconds kMost_ns = 250'000'000, kPiece_ns = 20'000'000;
    const Nanoseconds until_ns = clock_.now_ns() + kMost_ns;
    for (Nanoseconds left_ns = kMost_ns; left_ns > 0; left_ns = until_ns - clock_.now_ns()) {
        std::array<std::byte, kFtdiPiece> piece;
        std::size_t count = 0;
        const Cable cable = port_->read(piece, count, std::min(left_ns, kPiece_ns));
        if (cable == Cable::pulled) return;
        if (cable == Cable::well && count > 0 && (piece[0] & kFtdiClearToSend) != std::byte{0}) return;
    }
}

Result<void> FalconLine::give_firmware() {
    const std::string where = "haptic device " + name_;
    Error last;
    for (int load = 1; load <= kMostLoads; ++load) {
        const bool was_silent = is_boot_loader_silent_;
        const auto loaded = load_firmware();
        if (loaded && settings_for_run() == Cable::well && answers()) {
            loads_ = load;
            return {};
        }
        last = loaded ? Error{where, "has taken its firmware and is silent", "switch it off and on, and try again"}
                      : loaded.error();
        if (port_->request(FtdiRequest::reset, kFtdiPurgeIn) == Cable::pulled)
            return fail(where, "was unplugged", "plug it in again");
        // One that never says anything has no power; one that has spoken before may come round.
        if (is_boot_loader_silent_ && (load == 1 || was_silent)) return std::unexpected(last);
    }
    return fail(where, last.what + ", " + std::to_string(kMostLoads) + " times in a row", last.remedy);
}

Result<void> FalconLine::load_firmware() {
    const std::string where = "haptic device " + name_, remedy = "switch it off and on, and try again";
    BURIN_TRY_DO(greet_boot_loader());
    std::vector<std::byte> heard;
    std::span<const std::byte> left(firmware_);
    constexpr std::size_t kPiece = kFtdiPiece - kFtdiOwn;
    while (!left.empty()) {
        const auto piece = left.first(std::min(kPiece, left.size()));
        if (port_->write(piece, kPatient_ns) != Cable::well || hear(heard, piece.size(), kPatient_ns) != Cable::well)
            return fail(where, "stopped while it was given its firmware", remedy);
        if (!std::ranges::equal(heard, piece))
            return fail(where, "has heard another firmware than it was given", remedy);
        left = left.subspan(piece.size());
    }
    return {};
}

}  // namespace burin::devices
