// SPDX-License-Identifier: MIT
#include "bench/recording/recording.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/statistics.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "bench/measure/timing.hpp"
#include "haptics/tick_record.hpp"
#include "record/record_writer.hpp"

namespace burin::bench {
namespace {

constexpr double kTicksPerSecond = 1000.0;

Result<void> measure_blocks(const std::string& path, RecordFigures& figures) {
    BURIN_TRY(reader, record::RecordReader::open(path));
    const record::HandRecord& hand = reader.hands().front();
    figures.columns = hand.columns.size();
    for (const record::Column& column : hand.columns) figures.row_bytes += record::size_of(column.type);
    std::vector<double> pack_ms, unpack_ms;
    std::uint64_t bytes = 0;
    for (std::size_t number = 0; number < hand.blocks.size(); ++number) {
        BURIN_TRY(block, reader.block(0, number));
        Stopwatch watch;
        const Result<record::PackedBlock> packed = record::pack(block, hand.blocks[number].header);
        pack_ms.push_back(watch.lap_ms());
        if (!packed) return std::unexpected(packed.error());
        const Result<record::Block> back = record::unpack(*packed, hand.types(), path);
        unpack_ms.push_back(watch.lap_ms());
        if (!back) return std::unexpected(back.error());
        bytes += packed->data.size();
        figures.ticks += block.rows();
    }
    if (figures.ticks == 0) return fail(path, "holds no ticks", "record some first: burin sculpt --help");
    figures.raw_bytes_per_s = kTicksPerSecond * static_cast<double>(figures.row_bytes);
    figures.packed_bytes_per_s = kTicksPerSecond * static_cast<double>(bytes) / static_cast<double>(figures.ticks);
    figures.pack_ms = quantile(pack_ms, 0.5);
    figures.pack_worst_ms = *std::ranges::max_element(pack_ms);
    figures.unpack_ms = quantile(unpack_ms, 0.5);
    return {};
}

haptics::TickRecord tick_number(std::uint64_t tick) {
    haptics::TickRecord record;
    record.tick = tick;
    record.time_ns = static_cast<Nanoseconds>(tick) * 1'000'000;
    record.contact.point_count = 1;
    record.sample.position_device_m = {std::sin(0.01 * static_cast<double>(tick)), 0.1, 0.2};
    return record;
}

void measure_rows(RecordFigures& figures) {
    haptics::Histogram taken;
    MonotonicClock clock;
    for (std::uint64_t tick = 1; tick <= 10'000; ++tick) {
        const haptics::TickRecord record = tick_number(tick);
        const Nanoseconds before_ns = clock.now_ns();
        const std::vector<record::Word> row = record::row_of(record, {});
        taken.add(clock.now_ns() - before_ns + (row.empty() ? 1 : 0));
    }
    figures.row_us = 1e-3 * static_cast<double>(taken.quantile_ns(0.5));
}

Result<RecordFigures::Paced> push_at_pace(const RecordTask& task, std::size_t ring_ticks) {
    namespace fs = std::filesystem;
    const std::string path =
        (fs::path(task.folder) / formatted("burin-bench-%d-%zu.session", ::getpid(), ring_ticks)).string();
    Ring<haptics::TickRecord> ring(ring_ticks);
    BURIN_TRY(writer, record::RecordWriter::create(path, {{"bench", {}, {}, &ring}}, {}));
    haptics::Histogram push;
    MonotonicClock clock;
    Nanoseconds due_ns = clock.now_ns();
    RecordFigures::Paced paced{.ring_ticks = ring_ticks};
    for (paced.pushed = 0; paced.pushed < std::uint64_t{task.seconds} * 1000; ++paced.pushed) {
        clock.sleep_until(due_ns += 1'000'000);
        const haptics::TickRecord record = tick_number(paced.pushed + 1);
        const Nanoseconds before_ns = clock.now_ns();
        ring.push(record);
        push.add(clock.now_ns() - before_ns);
    }
    const Result<void> closed = writer->close();
    const haptics::Histogram& took = writer->transaction_duration();
    paced.lost = ring.refused();
    paced.push_us = 1e-3 * static_cast<double>(push.quantile_ns(0.5));
    paced.push_p99_us = 1e-3 * static_cast<double>(push.quantile_ns(0.99));
    paced.transaction_ms = 1e-6 * static_cast<double>(took.quantile_ns(0.5));
    paced.transaction_p99_ms = 1e-6 * static_cast<double>(took.quantile_ns(0.99));
    paced.transaction_worst_ms = 1e-6 * static_cast<double>(took.largest_ns());
    std::error_code ignored;
    fs::remove(path, ignored);
    if (!closed) return std::unexpected(closed.error());
    return paced;
}

}  // namespace

Result<RecordFigures> measure_recording(const RecordTask& task) {
    RecordFigures figures;
    if (!task.session.empty()) BURIN_TRY_DO(measure_blocks(task.session, figures));
    measure_rows(figures);
    for (const std::size_t ring_ticks : {std::size_t{1024}, record::kRingTicks}) {
        BURIN_TRY(paced, push_at_pace(task, ring_ticks));
        figures.paced.push_back(paced);
    }
    return figures;
}

namespace {

std::string block_table(const RecordFigures& f) {
    std::string text = formatted("%llu ticks, %zu columns, %zu bytes a tick\n",
                                 static_cast<unsigned long long>(f.ticks), f.columns, f.row_bytes);
    text += formatted("  a second: %.1f kB, packed %.1f kB (%.0f %%)\n", 1e-3 * f.raw_bytes_per_s,
                      1e-3 * f.packed_bytes_per_s, 100.0 * f.packed_bytes_per_s / f.raw_bytes_per_s);
    return text + formatted("  a block: packed in %.2f ms (median), %.2f ms (largest), unpacked in %.2f ms\n",
                            f.pack_ms, f.pack_worst_ms, f.unpack_ms);
}

}  // namespace

std::string recording_table(const RecordFigures& f) {
    std::string text = f.ticks > 0 ? block_table(f) : "sizes and blocks: not measured, name a session file\n";
    text += formatted("  a row is made in %.2f us\n", f.row_us);
    for (const RecordFigures::Paced& p : f.paced) {
        text += formatted("  ring of %zu: push %.2f us (median), %.2f us (p99); %llu of %llu ticks lost\n",
                          p.ring_ticks, p.push_us, p.push_p99_us, static_cast<unsigned long long>(p.lost),
                          static_cast<unsigned long long>(p.pushed));
        text += formatted("    a transaction: %.1f ms (median), %.1f ms (p99), %.1f ms (largest)\n", p.transaction_ms,
                          p.transaction_p99_ms, p.transaction_worst_ms);
    }
    return text;
}

Json recording_json(const RecordFigures& f) {
    Json json{{"machine", machine()}};
    if (f.ticks > 0) {
        json.update({{"ticks", f.ticks}, {"columns", f.columns}, {"row_bytes", f.row_bytes}});
        json["raw_bytes_per_s"] = f.raw_bytes_per_s;
        json["packed_bytes_per_s"] = f.packed_bytes_per_s;
        json["pack_ms"] = {{"median", f.pack_ms}, {"largest", f.pack_worst_ms}};
        json["unpack_ms"] = {{"median", f.unpack_ms}};
    }
    json["row_us"] = {{"median", f.row_us}};
    json["paced"] = Json::array();
    for (const RecordFigures::Paced& p : f.paced)
        json["paced"].push_back(
            {{"ring_ticks", p.ring_ticks},
             {"pushed", p.pushed},
             {"lost", p.lost},
             {"push_us", {{"median", p.push_us}, {"p99", p.push_p99_us}}},
             {"transaction_ms",
              {{"median", p.transaction_ms}, {"p99", p.transaction_p99_ms}, {"largest", p.transaction_worst_ms}}}});
    return json;
}

}  // namespace burin::bench
