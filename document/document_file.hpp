// SPDX-License-Identifier: MIT
// Defines the document: a .burin file, SQLite with the tables of docs/formats.md, "Documents".
//
// A document holds what was made and how it goes on: the pages of each part of the scene (scene/pages.hpp), the
// commands that bring tool and settings back, and facts: versions, units, where the work came from. It knows no kind of
// part. A page is compressed by itself and has a check sum of its own, so that the others are there where one is
// damaged. Units and frames are those of the part.
// Threads: any; plain data and pure functions.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "document/history.hpp"
#include "record/store_file.hpp"
#include "scene/pages.hpp"

namespace burin::document {

// Marks in the header of the SQLite file: "BrnD" as PRAGMA application_id, and the version as PRAGMA user_version.
inline constexpr std::int32_t kApplicationId = 0x42726e44;
inline constexpr std::int32_t kDocumentVersion = 1;
inline constexpr std::string_view kEnding = ".burin";
inline constexpr record::StoreKind kDocumentKind{.application_id = kApplicationId,
                                                 .version = kDocumentVersion,
                                                 .name = "a new document",
                                                 .words = {.wrong_file = "name a document that burin has saved",
                                                           .full_disk = "free some space or save to another disk",
                                                           .no_log = "save to a disk of this machine"}};

// Facts that the writer itself keeps.
inline constexpr const char* kIdFact = "document";  // tells it from all others, also after it was copied and changed
inline constexpr const char* kSavesFact = "saves";  // how often it was saved
inline constexpr const char* kSavedFact = "saved utc";
// The SHA-256 of the file that the work began with.
inline constexpr const char* kSourceDigestFact = "source sha256";

// Bounds of what a reader takes.
inline constexpr std::size_t kMostPages = 1'000'000, kMostParts = 1000, kMostFacts = 10'000;
inline constexpr std::size_t kMostPageBytes = std::size_t{64} << 20, kMostTextBytes = std::size_t{1} << 20;

struct Content {
    std::map<std::string, std::string> facts = {};
    std::vector<std::string> commands = {};  // of a session (session/state/command_table.hpp), in their order
    std::vector<scene::Pages> parts = {};
    std::optional<History> history = {};  // of the steps of all parts; nothing: nobody keeps one
};

// The history lies in the tables of steps as the one step, and in those of changes as a page, of a part of its own.
inline constexpr std::int64_t kHistoryPart = -1, kHistoryStep = 1;
inline constexpr const char* kOrderPage = "order";

// Returns whether a name is a document's, by its ending.
[[nodiscard]] bool is_document_name(std::string_view path);

// The check sum of a page: CRC-32C of its part u32, its number i64, the length of its bytes u64 and of its data u64,
// little-endian, of its kind and of its compressed data.
[[nodiscard]] std::uint32_t crc_of(std::int64_t part, const scene::PageName& name, std::size_t bytes,
                                   std::span<const std::byte> data);

// The check sum of a row of the table of histories: CRC-32C of part, saves, first, done and last, each i64
// little-endian.
[[nodiscard]] std::uint32_t crc_of(std::int64_t part, std::int64_t saves, const scene::Steps& steps);

// The statements that make the tables; those of histories are no part of older documents.
[[nodiscard]] const char* document_tables();
[[nodiscard]] const char* history_tables();

}  // namespace burin::document
