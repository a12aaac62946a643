// SPDX-License-Identifier: MIT
#include "document/document_file.hpp"

#include <array>
#include <bit>
#include <cstring>

#include "record/crc32c.hpp"

namespace burin::document {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are summed as they lie in memory");

}  // namespace

bool is_document_name(std::string_view path) { return path.size() > kEnding.size() && path.ends_with(kEnding); }

std::uint32_t crc_of(std::int64_t part, const scene::PageName& name, std::size_t bytes,
                     std::span<const std::byte> data) {
    struct {
        std::uint64_t number, bytes, data;
        std::uint32_t part;
    } const head{static_cast<std::uint64_t>(name.number), bytes, data.size(), static_cast<std::uint32_t>(part)};
    std::array<std::byte, 28> packed{};
    std::memcpy(packed.data(), &head.part, 4);
    std::memcpy(packed.data() + 4, &head, 24);
    return record::crc32c(data, record::crc32c(std::as_bytes(std::span(name.kind)), record::crc32c(packed)));
}

std::uint32_t crc_of(std::int64_t part, std::int64_t saves, const scene::Steps& steps) {
    const std::array numbers{part, saves, steps.first, steps.done, steps.last};
    return record::crc32c(std::as_bytes(std::span(numbers)));
}

const char* history_tables() {
    return R"(
CREATE TABLE IF NOT EXISTS history(part INTEGER PRIMARY KEY, saves INTEGER NOT NULL, first INTEGER NOT NULL,
    done INTEGER NOT NULL, last INTEGER NOT NULL, crc INTEGER NOT NULL);
CREATE TABLE IF NOT EXISTS step(part INTEGER NOT NULL, kind TEXT NOT NULL, number INTEGER NOT NULL,
    bytes INTEGER NOT NULL, crc INTEGER NOT NULL, data BLOB NOT NULL, PRIMARY KEY(part, number, kind));
)";
}

const char* document_tables() {
    return R"(
CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE part(part INTEGER PRIMARY KEY, kind TEXT NOT NULL);
CREATE TABLE page(part INTEGER NOT NULL, kind TEXT NOT NULL, number INTEGER NOT NULL, bytes INTEGER NOT NULL,
    crc INTEGER NOT NULL, data BLOB NOT NULL, PRIMARY KEY(part, kind, number));
CREATE TABLE change(part INTEGER NOT NULL, kind TEXT NOT NULL, number INTEGER NOT NULL, bytes INTEGER NOT NULL,
    crc INTEGER NOT NULL, data BLOB NOT NULL, PRIMARY KEY(part, kind, number));
CREATE TABLE command(at INTEGER PRIMARY KEY, text TEXT NOT NULL);
)";
}

}  // namespace burin::document
