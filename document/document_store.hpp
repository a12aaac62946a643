// SPDX-License-Identifier: MIT
// Writes documents: as a new file, or what has changed into the one that is there.
//
//   new file     made beside its place under another name, filled, flushed, then renamed: the place holds what was
//                there, or all of the new
//   update       one transaction of the file: pages that were given take the place of theirs, all others stay
//
// Thread: one, the writer's (document/document_writer.hpp). Failures are Errors that name the file and the remedy, and
// leave the file as it was: a full disk, a folder that takes no files, a file that was exchanged meanwhile.
#pragma once

#include <string>

#include "base/error.hpp"
#include "document/document_file.hpp"

namespace burin::document {

// Which document a file is, and in which state: an update goes to just that.
struct Version {
    std::string id;
    std::int64_t saves = 0;

    bool operator==(const Version&) const = default;
};

// Says whether a new file may replace one that exists at its path.
enum class Place : std::uint8_t { nothing, replaced };

struct Saved {
    Version version;
    std::uint64_t pages = 0;       // written
    std::uint64_t page_bytes = 0;  // as they lie in the file
    bool replaced = false;         // there was a file
};

// Writes all of a document to a new file. vfs: the name of one of SQLite's file systems, for tests.
[[nodiscard]] Result<Saved> write_document(const std::string& path, const Content& content, Place place,
                                           const std::string& vfs = {});
// Puts what has changed into a document, which is still the one of this version.
[[nodiscard]] Result<Saved> update_document(const std::string& path, const Content& changed, const Version& known,
                                            const std::string& vfs = {});

}  // namespace burin::document
