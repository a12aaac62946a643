// SPDX-License-Identifier: MIT
#include "activities/world/world_recorder.hpp"

#include <algorithm>

#include "base/try.hpp"
#include "record/touched_columns.hpp"

namespace burin::activities {

Result<std::unique_ptr<WorldRecorder>> WorldRecorder::create(
    const std::string& path, const devices::DeviceDescription& device, const haptics::Probe& probe, Facts facts,
    std::vector<std::pair<std::int64_t, std::string>> objects) {
    std::unique_ptr<WorldRecorder> recorder(new WorldRecorder);
    recorder->points_ = std::min(probe.count, haptics::kMostProbePoints);
    record::RecordedHand hand{device.name, device, probe, &recorder->ticks_};
    hand.more_columns = record::touched_columns({.points = recorder->points_});
    hand.more_values = [r = recorder.get()](const haptics::TickRecord& tick, std::vector<record::Word>& row) {
        r->append_objects(tick, row);
    };
    record::WriterOptions options;
    options.facts = std::move(facts);
    options.objects = std::move(objects);
    std::vector<record::RecordedHand> hands;
    hands.push_back(std::move(hand));
    BURIN_TRY(made, record::RecordWriter::create(path, std::move(hands), std::move(options)));
    recorder->writer_ = std::move(made);
    return recorder;
}

void WorldRecorder::add(const haptics::TickRecord& tick, std::span<const std::uint32_t> objects) {
    Objects numbers{tick.tick, {}};
    std::ranges::copy(objects.first(std::min<std::size_t>(objects.size(), numbers.numbers.size())),
                      numbers.numbers.begin());
    objects_.push(numbers);
    ticks_.push(tick);
}

// On the writer's thread. A tick that the ring refused has left its objects behind.
void WorldRecorder::append_objects(const haptics::TickRecord& tick, std::vector<record::Word>& row) {
    const Objects* of_tick = objects_.oldest();
    while (of_tick != nullptr && of_tick->tick < tick.tick) {
        objects_.drop();
        of_tick = objects_.oldest();
    }
    const bool is_there = of_tick != nullptr && of_tick->tick == tick.tick;
    for (std::uint32_t i = 0; i < points_; ++i) row.push_back(is_there ? of_tick->numbers[i] : 0u);
    record::append_walls(tick, {.points = points_}, row);
}

Result<void> WorldRecorder::update(Nanoseconds time_ns, std::uint64_t last_tick) {
    writer_->note_line(time_ns, kUpdateLine + std::to_string(last_tick));
    writer_->take_now();
    if (const auto failed = writer_->failure()) return std::unexpected(*failed);
    return {};
}

}  // namespace burin::activities
