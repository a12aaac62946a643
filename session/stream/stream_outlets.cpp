// SPDX-License-Identifier: MIT
#include "session/stream/stream_outlets.hpp"

#include <utility>

#include "base/text.hpp"
#include "base/try.hpp"
#include "session/stream/stream_text.hpp"

namespace burin::session {
namespace {

// What an inlet that is slow may lag behind: seconds of a regular stream, hundreds of samples of another.
constexpr std::int32_t kMostBuffered = 360;

std::unexpected<Error> not_made(const devices::LslApi& api, const std::string& stream) {
    return fail("the stream " + stream, "is not made by " + api.library + ": " + api.why(),
                "see that this machine has a network interface that is up, if only that to itself, and that no "
                "firewall keeps liblsl from its ports");
}

// What both kinds of streams say of how their stamps came about. Absent texts are the library's own failures, which
// show when the outlet is made.
void describe_clock(const devices::LslApi& api, devices::LslXml description, const StreamClock& clock) {
    const devices::LslXml acquisition = api.append_child(description, "acquisition");
    api.append_child_value(acquisition, "software", "Burin");
    const devices::LslXml synchronization = api.append_child(description, "synchronization");
    api.append_child_value(synchronization, "can_drop_samples", "true");
    api.append_child_value(synchronization, "clock_offset_s", formatted("%.9f", clock.offset_s).c_str());
    api.append_child_value(synchronization, "clock_offset_within_s", formatted("%.9f", clock.within_s).c_str());
}

void describe_channel(const devices::LslApi& api, devices::LslXml channels, const std::string& label,
                      const std::string& unit, const std::string& type) {
    const devices::LslXml channel = api.append_child(channels, "channel");
    api.append_child_value(channel, "label", label.c_str());
    if (!unit.empty()) api.append_child_value(channel, "unit", unit.c_str());
    api.append_child_value(channel, "type", type.c_str());
}

}  // namespace

StreamOutlets::StreamOutlets(StreamOutlets&& other) noexcept
    : api_(std::move(other.api_)),
      parts_(std::exchange(other.parts_, {})),
      events_(std::exchange(other.events_, nullptr)) {}

StreamOutlets::~StreamOutlets() {
    for (const Part& part : parts_)
        if (part.outlet != nullptr) api_.destroy_outlet(part.outlet);
    if (events_ != nullptr) api_.destroy_outlet(events_);
}

Result<StreamOutlets> StreamOutlets::open(const devices::LslApi& api, std::span<const StreamedPart> parts,
                                          const StreamClock& clock, const std::string& source) {
    StreamOutlets outlets(api);
    for (const StreamedPart& part : parts) BURIN_TRY_DO(outlets.open_ticks(part, clock, source));
    BURIN_TRY_DO(outlets.open_events(clock, source));
    return outlets;
}

Result<void> StreamOutlets::open_ticks(const StreamedPart& part, const StreamClock& clock, const std::string& source) {
    StreamedColumns columns(record::shape_of(part.device, part.probe));
    const std::string clean = streamable(part.name), name = "Burin ticks " + clean;
    const devices::LslInfo info =
        api_.create_info(name.c_str(), "Haptics", static_cast<std::int32_t>(columns.all().size()), part.rate_Hz,
                         devices::LslFormat::float32, (source + " ticks " + clean).c_str());
    if (info == nullptr) return not_made(api_, name);
    const devices::LslXml description = api_.description_of(info);
    describe_clock(api_, description, clock);
    const devices::LslXml device = api_.append_child(description, "device");
    api_.append_child_value(device, "model", streamable(part.device.name).c_str());
    const devices::LslXml channels = api_.append_child(description, "channels");
    for (const StreamedColumn& column : columns.all())
        describe_channel(api_, channels, column.label, column.unit, std::string(column.kind));
    parts_.push_back({std::move(columns), api_.create_outlet(info, 0, kMostBuffered)});
    // The outlet has a copy.
    std::expected<void, Error> made = {};
    if (parts_.back().outlet == nullptr) made = not_made(api_, name);
    api_.destroy_info(info);
    return made;
}

Result<void> StreamOutlets::open_events(const StreamClock& clock, const std::string& source) {
    const std::string name = "Burin events";
    const devices::LslInfo info = api_.create_info(name.c_str(), "Markers", 1, devices::kLslIrregularRate,
                                                   devices::LslFormat::string, (source + " events").c_str());
    if (info == nullptr) return not_made(api_, name);
    const devices::LslXml description = api_.description_of(info);
    describe_clock(api_, description, clock);
    describe_channel(api_, api_.append_child(description, "channels"), "event", "", "Marker");
    events_ = api_.create_outlet(info, 0, kMostBuffered);
    std::expected<void, Error> made = {};
    if (events_ == nullptr) made = not_made(api_, name);
    api_.destroy_info(info);
    return made;
}

bool StreamOutlets::push(std::size_t part, std::span<const float> values, std::span<const double> stamps_s) {
    constexpr std::int32_t kAtOnce = 1;
    return api_.push_floats(parts_[part].outlet, values.data(), values.size(), stamps_s.data(), kAtOnce) ==
           devices::kLslNoError;
}

bool StreamOutlets::push_event(const std::string& marker, double stamp_s) {
    constexpr std::int32_t kAtOnce = 1;
    const char* text = marker.c_str();
    return api_.push_text(events_, &text, stamp_s, kAtOnce) == devices::kLslNoError;
}

}  // namespace burin::session
