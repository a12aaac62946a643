// SPDX-License-Identifier: MIT
// Makes the file into which a session is recorded: a session file with every tick, or an input log as text.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "record/record_writer.hpp"

namespace burin::session {

class InputLogWriter;  // session/record/input_log.hpp
class Session;         // session/live/session.hpp
struct SessionSetup;   // session/options/session_setup.hpp

// Facts of a session file, which the session does not know itself: of the program and of the files that were read.
using SessionFacts = std::vector<std::pair<std::string, std::string>>;

// Makes the file that options.record.path names, of a session whose threads have not started. Fails where there is one.
// A session file reads the session's ring of tick records from now on; the session must outlive it. also: takes every
// tick that a session file takes.
[[nodiscard]] Result<InputLogWriter> create_recording(const SessionSetup& options, const SessionFacts& facts,
                                                      Session& session, record::OnRecord also = {});

}  // namespace burin::session
