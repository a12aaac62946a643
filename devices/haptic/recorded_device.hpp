// SPDX-License-Identifier: MIT
// A recorded hand as a device, for demonstrations and tests: --device recorded:FILE.session. What the device of the
// recording read is read again, part by part and tick by tick: position, orientation, buttons, joints, faults. Forces
// are taken and dropped. Its description is that of the device that was recorded.
//
// Time: a sample belongs to a tick of the device's rate, counted from the first read(). A turn that comes late has
// the sample of its own tick all the same; where two deadlines or more were missed, so are their samples. Where
// the recording has no tick, since its loop idled or missed a deadline, the sample before stays. A sample is as
// old at its tick as it was when it was recorded. At the end the hand rests at its last pose with no button down;
// with `loop` it rests for half a second, glides to the beginning within one, and goes on.
// Who reads files is above this folder: Recordings is what it is asked by.
// Thread: read() and write() as HapticDevice has it, wait-free; take_messages() the frame's thread's.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "devices/haptic/opened_device.hpp"

namespace burin::devices {

inline constexpr const char* kRecordedDevice = "recorded";

// A sample of one part. due_ns: the deadline of its tick, from 0 at the first, rising; the sample's own time is
// relative to when its tick began.
struct RecordedSample {
    Nanoseconds due_ns = 0;
    DeviceSample sample;
};
struct RecordedHandPart {
    std::string name;  // within the device, as DevicePart has it
    std::vector<RecordedSample> samples;
};
struct RecordedHand {
    std::string device;  // what was recorded, as --device names it
    std::vector<RecordedHandPart> parts;
};

// Reads recordings, on behalf of devices. Any thread.
class Recordings {
public:
    // Bounds the memory: half an hour of a thousand ticks a second.
    static constexpr std::size_t kMostTicks = 1'800'000;

    virtual ~Recordings() = default;
    // Returns what a hand's device was; hand empty: the only one, or the first. An Error names file and remedy.
    [[nodiscard]] virtual Result<std::string> device_of(const std::string& file, const std::string& hand) const = 0;
    [[nodiscard]] virtual Result<RecordedHand> hand_of(const std::string& file, const std::string& hand) const = 0;
};

// FILE, FILE:HAND, each with ",loop".
struct RecordedChoice {
    std::string file, hand;
    bool loops = false;
};
[[nodiscard]] Result<RecordedChoice> recorded_choice(const std::string& text);

// Plays the samples to all parts of a device, which share it, and counts the ticks.
class RecordedPlayer final : public DeviceMessages {
public:
    static constexpr Nanoseconds kRest_ns = 500'000'000, kGlide_ns = 1'000'000'000;
    static constexpr Nanoseconds kLeftOut = 2;  // periods behind at which samples are left out

    // `like`: the device that was recorded, opened to stand in for it; kept for its descriptions. As many parts as
    // samples of parts.
    RecordedPlayer(RecordedHand hand, RecordedChoice choice, OpenedDevice like, Clock& clock);

    [[nodiscard]] DeviceSample read(std::size_t part) noexcept;
    void write(std::size_t, const DeviceWrench&) noexcept {}
    [[nodiscard]] std::vector<std::string> take_messages() override;
    [[nodiscard]] const OpenedDevice& like() const { return like_; }
    [[nodiscard]] const std::string& name() const { return name_; }

private:
    void begin_turn() noexcept;
    [[nodiscard]] DeviceSample at_end(const RecordedHandPart& part) const noexcept;
    [[nodiscard]] DeviceSample gliding(const RecordedHandPart& part, std::uint64_t past_end) const noexcept;

    RecordedHand hand_;
    RecordedChoice choice_;
    OpenedDevice like_;
    Clock& clock_;
    std::string name_;
    Nanoseconds period_ns_ = 0;
    std::uint64_t length_ = 0;  // ticks until the end of the longest part
    // Used by the haptic thread alone:
    bool begun_ = false;
    std::uint64_t tick_ = 0;
    Nanoseconds base_ns_ = 0;  // the clock's reading at tick 0, as the earliest turn shows it
    Nanoseconds now_ns_ = 0;
    std::atomic<bool> ended_ = false;
    bool told_ = false;
};

// Opens the device that `hand` was recorded with as `like`, and has it played.
[[nodiscard]] OpenedDevice recorded_device(RecordedHand hand, const RecordedChoice& choice, OpenedDevice like,
                                           Clock& clock);

}  // namespace burin::devices
