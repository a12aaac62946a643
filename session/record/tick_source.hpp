// SPDX-License-Identifier: MIT
// Where a replay finds what the ticks of a recorded session saw: in the lines of a text log, of one hand with one part;
// or in the columns of a session file, of every part of every hand. One thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "record/motion.hpp"
#include "session/record/thread_log.hpp"

namespace burin::session {

class TickSource {
public:
    virtual ~TickSource() = default;
    [[nodiscard]] virtual std::size_t parts() const = 0;
    // Returns the next tick of a part, from the first on; nothing after the last that can be repeated: the end of the
    // recording, or a tick before one that was lost. Fails where it cannot be read.
    [[nodiscard]] virtual Result<std::optional<TickSeen>> next(std::size_t part) = 0;
    // Says what is wrong behind the last tick of a part, where more ticks stand there that do not follow it; nothing at
    // the end of the recording.
    [[nodiscard]] virtual std::optional<std::string> hole(std::size_t /*part*/) const { return std::nullopt; }
    // Says where the last tick of a part stands, for messages: "FILE:LINE", or the file and the tick.
    [[nodiscard]] virtual std::string place(std::size_t part) const = 0;
};

// The ticks in the lines of a log; name: its file's. The log must outlive the source.
[[nodiscard]] std::unique_ptr<TickSource> ticks_of_lines(const ThreadLog& log, std::string name);

// The ticks in a file's columns. Fails where columns are missing. The reader must outlive the source.
[[nodiscard]] Result<std::unique_ptr<TickSource>> ticks_of_columns(record::RecordReader& reader);

}  // namespace burin::session
