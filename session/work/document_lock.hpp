// SPDX-License-Identifier: MIT
// Who works on a document: a session that opens one notes its process, its host and the time in a file that it keeps
// locked, in the folder of the person's journals. Another session of this person that opens the document is told; it
// may read the document, and saves under another name. A note whose lock is free is of a session that is dead.
// Sessions of other persons are not seen here; none of them writes over another's save either, by the document's count
// of saves. Any thread; touches a file.
#pragma once

#include <optional>
#include <string>

namespace burin::session {

struct DocumentHolder {
    std::string process, host, since;  // "4711", "workshop", "2026-11-28 14:02"
};

class DocumentLock {
public:
    DocumentLock() = default;
    DocumentLock(DocumentLock&& other) noexcept;
    DocumentLock& operator=(DocumentLock&& other) noexcept;
    ~DocumentLock();

    // Takes the document for this process, and gives up the one before. Returns who has it; nothing where it is taken,
    // or where the folder lets nobody note anything. An empty folder: nobody is told.
    [[nodiscard]] std::optional<DocumentHolder> take(const std::string& folder, const std::string& document);

private:
    void release();

    int file_ = -1;
    std::string path_;
};

// Says who has a document, and since when.
[[nodiscard]] std::string text_of(const DocumentHolder& holder);

}  // namespace burin::session
