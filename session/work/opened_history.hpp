// SPDX-License-Identifier: MIT
// The undo history of a document that is opened: what its solid held before each stroke. Any thread.
#pragma once

#include <string>

#include "compute/engine/history.hpp"
#include "document/document_reader.hpp"

namespace burin::session {

// Reads the history of the solid as its pages are, within so much memory: the newest steps. What is damaged ends it,
// and is added to `lost` in words.
[[nodiscard]] compute::History history_in(document::DocumentReader& reader, const document::PartPlace& part,
                                          const compute::Solid& solid, std::size_t undo_bytes, std::string& lost);

}  // namespace burin::session
