// SPDX-License-Identifier: MIT
// libFuzzer body of the reader of session files. Whatever the bytes: no fault, no hang, no memory beyond the bounds
// (run with -rss_limit_mb); every failure has a place and a remedy. The bytes are taken in three ways: as a file; as
// header and data of a block whose check sum fits, so that what lies behind the sum is reached too; and as changes of
// a sound file.
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "record/examination.hpp"
#include "record/record_writer.hpp"

namespace {

using namespace burin::record;

void require(bool condition) {
    if (!condition) std::abort();
}

void check_error(const burin::Error& error) {
    require(!error.what.empty() && !error.where.empty() && !error.remedy.empty());
}

// One file in memory, which every input replaces.
const std::string& file_with(const std::uint8_t* data, std::size_t size) {
    static const int fd = memfd_create("fuzz", 0);
    static const std::string path = "/proc/self/fd/" + std::to_string(fd);
    require(fd >= 0 && ftruncate(fd, 0) == 0);
    require(pwrite(fd, data, size, 0) == static_cast<ssize_t>(size));
    return path;
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
    const std::string path = std::filesystem::temp_directory_path() / ("fuzz-" + std::to_string(::getpid()));
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
    std::ifstream in(path, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    std::filesystem::remove(path);
    return {bytes.begin(), bytes.end()};
}

// Each four bytes of the input change one byte of the sound file: three say where, one how.
void read_changed(const std::uint8_t* data, std::size_t size) {
    static const std::vector<std::uint8_t> sound = sound_file();
    std::vector<std::uint8_t> changed = sound;
    for (std::size_t i = 0; i + 4 <= size; i += 4) {
        const std::size_t at = data[i] + 256u * data[i + 1] + 65536u * data[i + 2];
        changed[at % changed.size()] ^= data[i + 3];
    }
    read_file(file_with(changed.data(), changed.size()));
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
