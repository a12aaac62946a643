// SPDX-License-Identifier: MIT
// libFuzzer body of the reader of session files. Whatever the bytes: no fault, no hang, no memory beyond the bounds
// (run with -rss_limit_mb); every failure has a place and a remedy. The bytes are taken in three ways: as a file; as
// header and data of a block whose check sum fits, so that what lies behind the sum is reached too; and as changes of
// a sound file.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "haptics/tick_record.hpp"
#include "record/examination.hpp"
#include "record/record_writer.hpp"
#include "tests/fuzz/changed_file.hpp"

namespace {

using namespace burin::record;
using namespace burin::fuzz;

void check_error(const burin::Error& error) {
    require(!error.what.empty() && !error.where.empty() && !error.remedy.empty());
}

void read_file(const std::string& path) {
    burin::Result<RecordReader> reader = RecordReader::open(path);
    if (!reader) return check_error(reader.error());
    for (std::size_t hand = 0; hand < reader->hands().size(); ++hand) {
        static_cast<void>(summary_of(reader->hands()[hand]));
        for (const burin::Error& error : examine(*reader, hand).damaged) check_error(error);
    }
    static_cast<void>(reader->trials());
    static_cast<void>(reader->events());
    if (const auto clocks = reader->clocks()) static_cast<void>(wall_clock_moved_ns(*clocks));
    static_cast<void>(reader->each_line([](std::int64_t, const std::string&) {}));
}

// A session of two blocks with a line, a trial and an event.
std::vector<std::uint8_t> sound_file() {
    const std::string path = own_path();
    burin::Ring<burin::haptics::TickRecord> ring(64);
    auto writer = RecordWriter::create(path, {{"fuzz", {}, {}, &ring}}, {});
    require(writer.has_value());
    for (const std::uint64_t tick : {1u, 2u, 3u, 2000u, 2001u}) {
        burin::haptics::TickRecord record;
        record.tick = tick;
        record.time_ns = static_cast<burin::Nanoseconds>(tick) * 1'000'000;
        ring.push(record);
    }
    (*writer)->note_line(1, "a line");
    (*writer)->note_event(2, "touched", "wall", (*writer)->begin_trial(1, "one"));
    require((*writer)->close().has_value());
    return take_file(path);
}

void read_changed(const std::uint8_t* data, std::size_t size) {
    static const std::vector<std::uint8_t> sound = sound_file();
    read_file(changed_file(sound, data, size));
}

void read_block(const std::uint8_t* data, std::size_t size) {
    if (size < 3) return;
    PackedBlock block;
    block.header.rows = data[0] + 256u * data[1];
    const std::size_t columns = data[2] % 40u;
    const auto* bytes = reinterpret_cast<const std::byte*>(data);
    block.data.assign(bytes + 3, bytes + size);
    block.crc = crc_of(block.header, block.data);
    std::vector<ColumnType> types;
    for (std::size_t c = 0; c < columns; ++c) types.push_back(static_cast<ColumnType>((c * 7 + data[2]) % 3));
    const burin::Result<Block> read = unpack(block, types, "fuzz");
    if (!read) return check_error(read.error());
    require(read->rows() == block.header.rows && read->columns() == columns);
    for (std::size_t c = 0; c < columns; ++c) require(read->bytes(c).size() == read->rows() * size_of(types[c]));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    read_block(data, size);
    read_file(file_with(data, size));
    read_changed(data, size);
    return 0;
}
